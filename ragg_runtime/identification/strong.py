"""Strong effects, one after the other, each derived into the model before the next is asked for.

A signature is first order alone; of a strong effect the second order is significant too. Fits with effects begin at the sheet.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Protocol

import numpy as np
from scipy.special import comb

from ragg_runtime.estimation import calibration, likelihood_ratio
from ragg_runtime.estimation.calibration import QUIET, measure_deviance, measure_to_nominal, restore_priors
from ragg_runtime.estimation.fitted import (
    Fitted,
    Scored,
    calibrate_certain,
    fit,
    prepare_evidence,
    release_held,
)
from ragg_runtime.estimation.least_squares import compute_r_factor
from ragg_runtime.estimation.likelihood_ratio import Test, weigh
from ragg_runtime.estimation.observation import spread
from ragg_runtime.estimation.scores import INDISTINGUISHABLE
from ragg_runtime.identification import selection
from ragg_runtime.identification.parameters import list_bounded_columns
from ragg_runtime.identification.selection import Blocks, ProjectedProblem
from ragg_runtime.identification.steps import add_steps
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.model.model import Model

# Chi-square of an effect from which it counts as strong (50 sigma): a linearisation that is right to 2 % then misses one sigma
STRONG = 2500.0

# what an effect leaves over what the best leaves, in chi-square, up to which it is a contender: second orders may turn the order of
# two
NEAR = 10.0
CONTENDERS = 3  # most effects that are tried in the model at each stage
PARTS = 4  # segments of a long record, at most, on which contenders are tried before those that are left are tried on all of it


class Extend(Protocol):
    """Derives a model with further effects; with ``candidates`` also the signatures of the rest.

    Given by the caller: this package cannot derive.
    """

    def __call__(self, model: Model, ids: Sequence[str], /, *, candidates: bool = False) -> Model: ...


def derive_with(
    f: Fitted,
    ids: Sequence[str],
    instants: Mapping[str, float],
    extend: Extend,
    *,
    held: frozenset[str] = frozenset(),
    candidates: bool = False,
) -> tuple[Model, Instrument]:
    """The model of some flights with further effects in it, and the priors of the sheet, with the ``instants`` of steps, s.

    Coefficients labelled in ``held`` are not fitted.
    """
    steps = tuple(EffectSetting(e, {"t_step": RawQuantity(instants[e], "s")}) for e in ids if e in instants)
    sheet = restore_priors(f.instrument)
    sheet = replace(sheet, effects=(*sheet.effects, *steps), held=sheet.held | held)
    return extend(f.model, ids, candidates=candidates), sheet


@dataclass(frozen=True)
class Stage:
    """What is known with some effects in the model: the flights fitted, the problem of the rest, the ``instants`` of steps, s, and what is
    ``chosen``.
    """

    problem: ProjectedProblem
    fitted: Fitted
    instants: Mapping[str, float]
    chosen: Blocks

    @cached_property
    def scored(self) -> Scored:
        """How large the residual is."""
        return self.fitted.score([np.zeros(self.fitted.size)])[0]

    @cached_property
    def alternatives(self) -> Mapping[str, tuple[str, ...]]:
        """For every chosen effect those that would explain as much in its place."""
        return selection.find_alternatives(self.problem, self.chosen)

    @staticmethod
    def of(f: Fitted, *, beside: bool = False) -> Stage:
        """Of a fit, or of one with the sheet's own priors, if effects beside these are more probable than priors that were widened.

        ``beside``: of what is left beside effects that were taken into the model.
        """
        stage = Stage._of(f, beside)
        by_sheet = _with_priors_of_sheet(f)
        # what is stronger is no matter of linear tests: it is tried in the model, where the sheet has its own priors
        if by_sheet is None or by_sheet.calibration.chi2 > f.calibration.chi2 + STRONG:
            return stage
        other = Stage._of(by_sheet, beside)
        return other if other._deviance(by_sheet) < stage._deviance(f) else stage

    @staticmethod
    def _of(f: Fitted, beside: bool) -> Stage:
        problem, fitted, instants = add_steps(f)
        return Stage(problem, fitted, instants, selection.choose(problem, beside=beside))

    def _deviance(self, f: Fitted) -> float:
        """Chi-square of the fit before this stage, with what wider priors cost, less twice the log evidence of what is chosen."""
        charge = sum(self.problem.tests()[e].charge for e in self.chosen)
        evidence = selection.weigh_blocks(self.problem, self.chosen) - charge
        return measure_deviance(f.instrument, f.calibration) - 2.0 * evidence

    def without_choice(self) -> Stage:
        """The same, none of the effects being what is missing."""
        return replace(self, chosen={})

    @property
    def strong(self) -> bool:
        """Whether what is chosen is too strong for a linearisation, or has a memory, which a search knows at one value only."""
        shaped = {e.id for e in self.fitted.model.candidates if e.memory is not None}
        return any(self.problem.tests()[e].chi2 > STRONG or e in shaped for e in self.chosen)

    def derive(self, effect: str, extend: Extend, *, candidates: bool = False) -> tuple[Model, Instrument]:
        """The model with an effect in it, of whose coefficients those are fitted that its test needs."""
        held = list_unneeded(self.problem, effect, self.problem.tests()[effect].which)
        return derive_with(self.fitted, [effect], self.instants, extend, held=held, candidates=candidates)


@dataclass(frozen=True)
class AddedEffect:
    """An effect that was derived into the model: its linear test, the fits before and after, ``alternatives`` that would have done as
    well, and the instant of a step, s.
    """

    effect: str
    test: Test
    before: Fitted
    after: Fitted
    alternatives: tuple[str, ...]
    instant: float | None


# nonlinear fits that a search may make: a flight with strong effects of the catalogue takes two to eight
FITS = 16


def _with_priors_of_sheet(f: Fitted) -> Fitted | None:
    """The fit with the same noise and the priors of the sheet; ``None`` if none of them was widened."""
    effects = [c.name for c in f.calibration.columns if c.effect is not None]
    sheet = restore_priors(f.instrument, effects)
    if sheet.widths == f.instrument.widths:
        return None
    c = calibration.fit(f.model, sheet, f.observations, noise=f.calibration.noise, start=f.calibration.p)
    return prepare_evidence(f.model, sheet, f.observations, c)


def select_strong(
    first: Stage, extend: Extend | None, mistakes: Sequence[Sequence[str]] = ()
) -> tuple[list[AddedEffect], Stage, bool]:
    """The strong effects, the strongest first; the stage at which none is left, or what is missing is not in the catalogue, or
    all fits are made; and whether they are. Where the strongest is none of those that describe ``mistakes``, nothing of the record can be
    claimed, and what is strong beside it remains.
    """
    steps: list[AddedEffect] = []
    stage, fits = first, FITS
    while extend is not None and stage.strong and len(steps) < selection.MOST and fits > 0:
        contest = Contest(stage, extend, fits)
        one = contest.add_strongest()
        if one is None:
            return steps, stage.without_choice(), contest.fits <= 0
        steps.append(one)
        stage, fits = Stage.of(one.after, beside=True), contest.fits
        if stage.strong and any(steps[0].effect not in effects for effects in mistakes):
            return steps, stage.without_choice(), fits <= 0
    return steps, stage, fits <= 0


def list_unneeded(problem: ProjectedProblem, effect: str, which: Sequence[int]) -> frozenset[str]:
    """Labels of an effect's columns that its test does not need."""
    return frozenset(c.label for n, c in problem.candidates[effect] if n not in which)


def score_fit(f: Fitted, model: Model, sheet: Instrument) -> tuple[float, bool]:
    """Chi-square that a nonlinear fit to the flights of a fit leaves with effects in the model, by its noise, with what the parameters
    cost, and whether it came to an optimum.

    Every parameter that only the sheet knew before, and the record does now, costs 2 (AIC).
    """
    _, instrument, c = calibrate_certain(model, sheet, f.observations, noise=f.calibration.noise)
    x = -measure_to_nominal(model, instrument, c)
    rank = len(c.columns) - float(np.trace(c.covariance))
    left_out = f.calibration.rows - c.rows  # each would have its share of the noise
    sizes = x[[n for n, q in enumerate(c.columns) if q.effect is not None]]
    # Cauchy's tails for those of the prior: of two effects that explain the same, fifty and sixty times as large as usual,
    # Gaussian ones would exclude one, and of a fault nothing is known but what size is usual
    tails = float(np.sum(np.log1p(sizes**2) - sizes**2))
    return measure_deviance(instrument, c) + left_out + 2.0 * rank + tails, c.converged


# where a fit of what has a memory begins, over the neutral value of the first of its shapes: of a resonance 2, 4, 8 and 16 Hz
SCALES = (0.4, 0.8, 1.6, 3.2)


def choose_start(f: Fitted, model: Model, sheet: Instrument, effect: str) -> Instrument:
    """The sheet with the shape of an effect that has a memory at which it leaves least, while the shape is held; from another a fit may
    end in a narrow minimum. Values that the sheet has stay.
    """
    derived = next(e for e in model.effects if e.id == effect)
    shapes = [q for q in derived.parameters if q.shape]
    if derived.memory is None or sheet.effect(effect) not in (None, EffectSetting(effect)):
        return sheet
    others = tuple(s for s in sheet.effects if s.id != effect)
    held = sheet.held | {f"{effect}.{q.name}" for q in shapes}
    sheets = []
    for scale in SCALES:
        value = RawQuantity(scale * shapes[0].default, shapes[0].unit)
        begun = EffectSetting(effect, {shapes[0].name: value})
        sheets.append(replace(sheet, effects=(*others, begun)))
    left = [score_fit(f, model, replace(s, held=held))[0] for s in sheets]
    return sheets[int(np.argmin(left))]


CERTAIN = 5.0  # standard deviations from the values that are possible at which an estimate is impossible
# what an estimate may be off besides, as a share of the only physical value: by what else the model leaves out
ROOM = 0.1


# how many times wider than ten times its plausible size, the usual width, a prior may have to be for an effect to be claimed: of 135
# right claims (10 to 3,000 sigma, seeds 4401, 4403 and 4412) none took more than 70
FARTHEST = 100.0


def find_impossible(f: Fitted, effects: Iterable[str]) -> tuple[str, ...]:
    """Those of the effects, all in the fitted model, whose parameter has a size that it cannot have, or that is unheard of."""
    calibration, impossible = f.calibration, []
    for n, c, q in list_bounded_columns(f):
        true = q.physical or 0.0
        room = ROOM * abs(true) if q.largest is None else q.largest
        off = abs(float(calibration.p[calibration.index[n]]) - true * c.unit_factor)
        if off > room * c.unit_factor + CERTAIN * c.scale * np.sqrt(calibration.covariance[n, n]):
            impossible.append(c.effect)
    impossible += [c.effect for c in calibration.columns if f.instrument.widths.get(c.name, 1.0) > FARTHEST]
    return tuple(e for e in dict.fromkeys(effects) if e in impossible)


@dataclass
class Contest:
    """Effects of a stage, each tried in the model by itself, with the ``fits`` that may still be made.

    ``left``: what each leaves (:func:`score_fit`) of all samples, or ``in_parts`` of a long record; ``arrived``: whether any fit came to an
    optimum.
    """

    stage: Stage
    extend: Extend
    fits: int
    left: dict[str, float] = field(default_factory=dict)
    in_parts: dict[str, float] = field(default_factory=dict)
    arrived: bool = False

    def add_strongest(self) -> AddedEffect | None:
        """The effect that explains most once it is in the model, of those that are possible at the size that they then have.

        ``None`` where only an impossible one leaves but noise, or none of several comes to an optimum.
        """
        tests = {e: t for e, t in self.stage.problem.tests().items() if t.rank}
        while True:
            effect, alternatives = self._choose_best(tests)
            if (self.left or self.in_parts) and not self.arrived:
                return None
            added = _add_to_model(self.stage, effect, alternatives, self.extend)
            self.fits -= 1
            if len(tests) == 1 or self.fits <= 0 or not find_impossible(added.after, (effect,)):
                return added
            if added.after.calibration.excess <= QUIET and not alternatives:
                return None
            tests.pop(effect)

    def _choose_best(self, tests: Mapping[str, Test]) -> tuple[str, tuple[str, ...]]:
        """The effect that leaves least in the model, that of the greatest linear evidence among equals, and those equals."""
        problem = self.stage.problem
        total = problem.chi2
        least = min(total - t.chi2 for t in tests.values())
        near = [e for e, t in tests.items() if total - t.chi2 <= NEAR * max(least, 1.0)]
        # charged for the choice of the coefficients that each needs from all that it has
        columns = {e: len(problem.candidates[e]) for e in near}
        ways = {e: float(np.log(comb(n, min(tests[e].rank, n)))) for e, n in columns.items()}
        near = sorted(near, key=lambda e: (ways[e] - tests[e].weigh_alone(), e))
        tried = self._find_equal(near[:CONTENDERS])
        left = self._try_effects(tried) if len(tried) > 1 else dict.fromkeys(tried, 0.0)
        best = min(tried, key=lambda e: (left[e], e))
        # effects with the same signature are all of its group, however many they are
        same = [e for e in near[CONTENDERS:] if abs(tests[e].chi2 - tests[best].chi2) < INDISTINGUISHABLE]
        same = [e for e in same if _as_sure(tests[e], tests[best])]
        left = self._try_effects([*tried, *same]) if same else left
        equal = {e for e in left if left[e] < left[best] + INDISTINGUISHABLE}
        effect = min((e for e in equal if equal.isdisjoint(problem.contains.get(e, ()))), key=near.index)
        as_near = {e for e in left if left[e] < left[effect] + INDISTINGUISHABLE}
        others = equal | {e for e in as_near if _as_sure(tests[e], tests[effect])}
        return effect, tuple(
            e for e in sorted(others) if e != effect and effect not in problem.contains.get(e, ())
        )

    def _find_equal(self, ids: list[str]) -> list[str]:
        """Those of the effects that parts of a long record do not tell from the best of them: all of it can only tell more apart."""
        if len(ids) == 1 or all(len(o.segments) <= PARTS for o in self.stage.fitted.observations):
            return ids
        left = self._try_effects(ids, in_parts=True)
        return [e for e in ids if left[e] < min(left.values()) + INDISTINGUISHABLE]

    def _try_effects(self, ids: Sequence[str], *, in_parts: bool = False) -> dict[str, float]:
        """What these leave."""
        f, left = self.stage.fitted, self.left
        if in_parts:
            f, left = take_parts(f), self.in_parts
        for e in ids:
            if e not in left:
                self.fits -= 1
                left[e], converged = score_fit(f, *self.stage.derive(e, self.extend))
                self.arrived |= converged
        return {e: left[e] for e in ids}


def take_parts(f: Fitted) -> Fitted:
    """A fit with a few segments of its observations, evenly spread, in their place."""
    pairs = zip(f.observations, f.calibration.noise, strict=True)
    parts = [(o.part(rows), noise) for o, noise in pairs for rows in spread(o.segments, PARTS)]
    observations, noise = zip(*parts, strict=True)
    rows = sum(int(np.sum(o.record.valid)) * len(o.series) for o in observations)
    return replace(f, observations=observations, calibration=replace(f.calibration, noise=noise, rows=rows))


def _add_to_model(stage: Stage, effect: str, alternatives: tuple[str, ...], extend: Extend) -> AddedEffect:
    """An effect of a stage derived into the model, with the coefficients that it needs, and everything fitted anew."""
    f, problem, test = stage.fitted, stage.problem, stage.problem.tests()[effect]
    model, instrument = stage.derive(effect, extend, candidates=True)
    after = fit(model, instrument, f.observations)
    tests = _test_about_values(release_held(after))
    held = frozenset().union(*(unneeded for unneeded, _ in tests.values()))
    if tests and held != after.instrument.held:
        after = fit(model, replace(instrument, held=held), f.observations)
    if effect in tests and tests[effect][1].rank:
        unneeded, about = tests[effect]
        charge = about.charge + problem.penalty.get(effect, 0.0)
        log_b = weigh(test.chi2, about.rank, charge, spread=test.inflation)
        which = tuple(n for n, c in problem.candidates[effect] if c.label not in unneeded)
        test = replace(test, rank=about.rank, log_b=log_b, which=which)
    return AddedEffect(effect, test, f, after, alternatives, stage.instants.get(effect))


def _test_about_values(f: Fitted) -> dict[str, tuple[frozenset[str], Test]]:
    """Of every effect of a fit a linear test about the fitted values, where it is right, and labels of the coefficients that it does
    not need.
    """
    c, tests = f.calibration, {}
    for effect in dict.fromkeys(q.effect for q in c.columns if q.effect is not None):
        # what is not zero on the sheet shapes the effect, and is no coefficient of it
        columns = [n for n, q in enumerate(c.columns) if q.effect == effect and not f.sheet[c.index[n]]]
        others = [n for n in range(f.n_base) if n not in columns]
        without = f.whole[:, -1] - f.whole[:, columns] @ f.to_nominal[columns]
        T = compute_r_factor(np.vstack([f.whole[:, [*others, *columns]].T, without]))
        P = T[len(others) :, len(others) :]
        tested = [(k, c.columns[n]) for k, n in enumerate(columns)]
        test = likelihood_ratio.test(P, tested, np.full(P.shape[1], likelihood_ratio.TESTABLE))
        tests[effect] = frozenset(q.label for k, q in tested if k not in test.which), test
    return tests


def _as_sure(a: Test, b: Test) -> bool:
    """Whether the first is no less sure for its many coefficients."""
    return a.weigh_alone() - b.weigh_alone() > -selection.AS_SURE
