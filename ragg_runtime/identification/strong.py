"""Strong effects, one after the other, each derived into the model before the next is asked for.

A signature is first order alone; of a strong effect the second order is significant too. Fits with effects begin at the sheet.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy.special import comb

from ragg_runtime.estimation import calibration, whitening
from ragg_runtime.estimation.calibration import QUIET, prior_volume, restore_priors
from ragg_runtime.estimation.fitted import Fitted, fit, prepare_evidence, release_held
from ragg_runtime.estimation.least_squares import fold, pick_columns, prior
from ragg_runtime.estimation.noise_estimate import estimate_noise
from ragg_runtime.estimation.observation import BLOCKS
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.estimation.scores import INDISTINGUISHABLE
from ragg_runtime.identification import contenders, selection
from ragg_runtime.identification import steps as special
from ragg_runtime.identification.contenders import Contest, Extend
from ragg_runtime.identification.likelihood_ratio import Test, log_bayes
from ragg_runtime.identification.parameters import physical_columns
from ragg_runtime.identification.selection import Choice, Field, list_testable, make_field
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]

STRONG = 2500.0
"""Chi-square of an effect from which it counts as strong (50 sigma): a linearisation that is right to 2 % then misses
one sigma."""

NEAR = 10.0
"""What an effect leaves over what the best leaves, in chi-square, up to which it is a contender: second orders may turn
the order of two."""

CONTENDERS = 3
"""Most effects that are tried in the model at each stage."""


@dataclass(frozen=True)
class Stage:
    """What is known with some effects in the model: the field of the rest, the flights fitted, and what is chosen."""

    field: Field
    fitted: Fitted
    instants: Mapping[str, float]
    choice: Choice

    @staticmethod
    def of(f: Fitted, *, beside: bool = False) -> Stage:
        """Of a fit, or of one with the sheet's own priors, if effects beside these are more probable than priors that were widened.

        ``beside``: of what is left beside effects that were taken into the model.
        """
        stage = Stage._of(f, beside)
        said = _with_priors_of_sheet(f)
        # what is stronger is no matter of linear tests: it is tried in the model, where the sheet has its own priors
        if said is None or said.calibration.chi2 > f.calibration.chi2 + STRONG:
            return stage
        other = Stage._of(said, beside)
        return other if other._deviance(said) < stage._deviance(f) else stage

    @staticmethod
    def _of(f: Fitted, beside: bool) -> Stage:
        field, fitted, instants = add_steps(f)
        return Stage(field, fitted, instants, selection.choose(field, beside=beside))

    def _deviance(self, f: Fitted) -> float:
        """Chi-square of the fit before this stage, with what wider priors cost, less twice the log evidence of what is chosen."""
        evidence = selection.evidence(self.field, self.choice)
        return f.calibration.chi2 + prior_volume(f.instrument, f.calibration) - 2.0 * evidence

    def without_choice(self) -> Stage:
        """The same, none of the effects being what is missing."""
        choice = replace(self.choice, chosen=(), blocks={}, conditional=self.choice.tests, chi2=0.0)
        return replace(self, choice=choice)

    @property
    def strong(self) -> bool:
        """Whether what is chosen is too strong for a linearisation, or has a memory, which a search knows at one value only."""
        shaped = {e.id for e in self.fitted.model.candidates if e.memory is not None}
        return any(self.choice.tests[e].chi2 > STRONG or e in shaped for e in self.choice.chosen)


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


FITS = 16
"""Nonlinear fits that a search may make: a flight with strong effects of the catalogue takes two to eight."""


class Budget:
    """How many fits a search may still make."""

    def __init__(self, left: int = FITS) -> None:
        self.left = left

    @property
    def spent(self) -> bool:
        return self.left <= 0


def _with_priors_of_sheet(f: Fitted) -> Fitted | None:
    """The fit with the same noise and the priors of the sheet; ``None`` if none of them was widened."""
    effects = [c.name for c in f.calibration.columns if c.effect is not None]
    sheet = restore_priors(f.instrument, effects)
    if sheet.widths == f.instrument.widths:
        return None
    c = calibration.fit(f.model, sheet, f.observations, noise=f.calibration.noise, start=f.calibration.p)
    return prepare_evidence(f.model, sheet, f.observations, c)


def select_strong(first: Stage, extend: Extend | None, budget: Budget) -> tuple[list[AddedEffect], Stage]:
    """The strong effects, the strongest first, and the stage at which none is left, or what is missing is not in the catalogue, or
    the budget is spent.
    """
    found: list[AddedEffect] = []
    stage = first
    while extend is not None and stage.strong and len(found) < selection.MOST and not budget.spent:
        one = _strongest(stage, extend, budget)
        if one is None:
            return found, stage.without_choice()
        found.append(one)
        stage = Stage.of(one.after, beside=True)
    return found, stage


def list_unneeded(field: Field, effect: str, which: Sequence[int]) -> frozenset[str]:
    """Labels of an effect's columns that its test does not need."""
    return frozenset(c.label for n, c in field.candidates[effect] if n not in which)


def _strongest(stage: Stage, extend: Extend, budget: Budget) -> AddedEffect | None:
    """The effect that explains most once it is in the model, of those that are possible at the size that they then have.

    ``None`` where only an impossible one leaves but noise, or none of several comes to an optimum.
    """
    f, tests = stage.fitted, {e: t for e, t in stage.choice.tests.items() if t.rank}

    def entered(e: str) -> tuple[Model, Instrument]:
        held = list_unneeded(stage.field, e, tests[e].which)
        return contenders.derive_with(f, [e], stage.instants, extend, held=held)

    def left(ids: Sequence[str]) -> dict[str, float]:
        budget.left -= len(ids)
        return contest.left(ids)

    contest = Contest(f, entered)
    while True:
        effect, alternatives = _best(stage, tests, left)
        if not contest.arrived:
            return None
        found = _in_model(stage, effect, alternatives, extend)
        budget.left -= 1
        if len(tests) == 1 or budget.spent or not find_impossible(found.after, (effect,)):
            return found
        if found.after.calibration.excess <= QUIET and not alternatives:
            return None
        tests.pop(effect)


CERTAIN = 5.0
"""Standard deviations from the only physical value at which an estimate excludes it."""

ROOM = 0.1
"""What an estimate may be off besides, as a share of that value: by what else the model leaves out."""


def find_impossible(f: Fitted, effects: Iterable[str]) -> tuple[str, ...]:
    """Those of the effects, all in the fitted model, whose parameter has a size that it cannot have."""
    calibration, found = f.calibration, []
    for n, c, q in physical_columns(f):
        true = float(q.physical or 0.0) * c.unit_factor
        off = abs(float(calibration.p[calibration.index[n]]) - true)
        if off > CERTAIN * c.scale * np.sqrt(calibration.covariance[n, n]) + ROOM * abs(true):
            found.append(c.effect)
    return tuple(e for e in dict.fromkeys(effects) if e in found)


def _best(
    stage: Stage, tests: Mapping[str, Test], score: Callable[[Sequence[str]], dict[str, float]]
) -> tuple[str, tuple[str, ...]]:
    """The effect that leaves least by its ``score``, that of the greatest linear evidence among equals, and those equals."""
    total = stage.field.chi2
    least = min(total - t.chi2 for t in tests.values())
    near = [e for e, t in tests.items() if total - t.chi2 <= NEAR * max(least, 1.0)]
    near = sorted(near, key=lambda e: (-_evidence(tests[e], len(stage.field.candidates[e])), e))
    tried = near[:CONTENDERS]
    left = score(tried) if len(tried) > 1 else dict.fromkeys(tried, 0.0)
    best = min(tried, key=lambda e: (left[e], e))
    # effects with the same signature are all of its group, however many they are
    alike = [e for e in near[CONTENDERS:] if _alike(tests[e], tests[best])]
    left |= score(alike) if alike else {}
    contains = stage.field.contains
    equal = [e for e in left if left[e] < left[best] + INDISTINGUISHABLE]
    effect = min((e for e in equal if not {*contains.get(e, ())} & {*equal}), key=near.index)
    as_near = [
        e for e in left if left[e] < left[effect] + INDISTINGUISHABLE and _as_sure(tests[e], tests[effect])
    ]
    others = sorted({*equal, *as_near} - {effect})
    return effect, tuple(e for e in others if effect not in contains.get(e, ()))


def _evidence(t: Test, columns: int) -> float:
    """Log evidence of an effect, charged for the choice of the coefficients that it needs from all that it has."""
    return float(log_bayes(t.chi2, t.rank)) - float(np.log(comb(columns, min(t.rank, columns))))


def _in_model(stage: Stage, effect: str, alternatives: tuple[str, ...], extend: Extend) -> AddedEffect:
    """An effect of a stage derived into the model, with the coefficients that its test needs, and everything fitted anew."""
    f = stage.fitted
    held = list_unneeded(stage.field, effect, stage.choice.tests[effect].which)
    model, instrument = contenders.derive_with(
        f, [effect], stage.instants, extend, candidates=True, held=held
    )
    return AddedEffect(
        effect=effect,
        test=stage.choice.tests[effect],
        before=f,
        after=_with_released(fit(model, instrument, f.observations)),
        alternatives=alternatives,
        instant=stage.instants.get(effect),
    )


def _with_released(f: Fitted) -> Fitted:
    """The fit with all coefficients of its effects, if those that were held are plainly needed: beside the strongest a test sees few."""
    if not f.instrument.held:
        return f
    free = release_held(f)
    gain = float(np.sum(f.whole[f.n_base :, -1] ** 2) - np.sum(free.whole[free.n_base :, -1] ** 2))
    if log_bayes(gain, free.n_base - f.n_base) < selection.DISTINGUISHABLE:
        return f
    released = replace(f.instrument, held=frozenset())
    return fit(f.model, released, f.observations, start=f.calibration.p)


def _alike(a: Test, b: Test) -> bool:
    """Whether two effects explain the same, with as much evidence, by a linear test."""
    return abs(a.chi2 - b.chi2) < INDISTINGUISHABLE and _as_sure(a, b)


def _as_sure(a: Test, b: Test) -> bool:
    """Whether the first is no less sure for its many coefficients."""
    return float(log_bayes(a.chi2, a.rank) - log_bayes(b.chi2, b.rank)) > -selection.AS_SURE


BESIDE = 20.0
"""Logarithm of the p-value by which a step must be surer beside the first effect than by itself to be taken at that instant."""


@dataclass(frozen=True)
class _Found:
    """A step that was found: the first sample after it, and the columns of others beside which it was."""

    sample: int
    given: Sequence[int]


def add_steps(
    f: Fitted, known: Mapping[str, _Found] = MappingProxyType({})
) -> tuple[Field, Fitted, dict[str, float]]:
    """The field of all deterministic candidates, steps at their most likely instant, the flight with the steps' columns put in, and
    the instants by effect, s.

    Once the instant of a step is ``known`` the noise is estimated again, and everything with it.
    """
    available = list_testable(f)
    steps = [e for e in f.model.candidates if e.kind == "step"]
    if len(f.flights) != 1 or not steps:
        return make_field(f, available), f, {}
    owned = {e.id: [(n, c) for n, c in enumerate(f.candidates) if c.effect == e.id] for e in steps}
    places = {e: [f.n_base + n for n, _ in own] for e, own in owned.items()}
    time, edges = f.observations[0].record.time, f.prepared[0].edges
    exact = {e: _sharpened(f, step, places[e]) for e, step in known.items()}
    if exact:
        f = _from(f, exact)
    plain = _with_penalty(f, [*available, *exact])
    first = [n for e in selection.choose(plain).chosen for n, _ in plain.candidates[e]]
    unknown = [e for e in owned if e not in exact]
    likeliest = _scanned(f, [owned[e] for e in unknown], first) if unknown else []
    scans = dict(zip(unknown, likeliest, strict=True))
    samples = {e: step.sample for e, (step, _) in scans.items()}
    scanned = {e: places[e] for e in samples}
    found: dict[str, _Found] = {}
    root = _root(f, edges, samples, places)
    # blocks of time do not judge a step yet: one that is in the noise makes it uneven
    unjudged = replace(plain, blocks=()) if plain.blocks else plain
    for n, (e, (step, given)) in enumerate(scans.items()):
        so_far = [*samples][: n + 1]
        field = _with_penalty(f, [*available, *exact, *so_far], _picked(root, f, so_far, scanned), unjudged)
        if e in selection.choose(replace(field, blocks=())).chosen:
            step = special.refine_step(f.prepared, step, f.n_base, given, owned[e], f.to_nominal)
            found[e] = _Found(_sharpened(f, _Found(step.sample, given), places[e]), given)
            samples[e] = found[e].sample
            root = _root(f, edges, samples, places)
    if found and not known:
        instants = {e: float(time[x.sample]) for e, x in found.items()}
        noise = [estimate_noise(replace(x.at, instants=instants), x.observation) for x in f.prepared]
        calmer = fit(f.model, f.instrument, f.observations, noise, f.calibration.p)
        return add_steps(calmer, found)
    if found:  # the columns themselves, to the sample, and through the filter
        exact |= {e: x.sample for e, x in found.items()}
        f = _from(f, exact)
    rest = {e: k for e, k in samples.items() if e not in exact}
    instants = {e: float(time[k]) for e, k in (exact | rest).items()}
    f = _begun(f, edges, rest, places)
    f = replace(f, prepared=tuple(x.with_steps(instants) for x in f.prepared))
    return _with_penalty(f, [*available, *instants], within=plain), f, instants


def _sharpened(f: Fitted, step: _Found, places: Sequence[int]) -> int:
    everything = [t for own in f.r_factors for t in own]
    projector = whitening.projector(everything, f.n_base, step.given)
    return special.sharpen_step(f.prepared, step.sample, projector, places)


def _from(f: Fitted, exact: Mapping[str, int]) -> Fitted:
    """The same with the columns of steps from these samples on, made anew and put through the filter."""
    time = f.observations[0].record.time
    instants = {e: float(time[k]) for e, k in exact.items()}
    prepared = [x.with_steps(instants) for x in f.prepared]
    r_factors, sums = zip(*(whitening.blocks(x) for x in prepared), strict=True)
    return replace(f, prepared=tuple(prepared), r_factors=r_factors, sums=sums)


def _scanned(
    f: Fitted, owned: Sequence[Sequence[tuple[int, Column]]], first: Sequence[int]
) -> list[tuple[special.Step, Sequence[int]]]:
    """The most likely step of each effect, and the columns of others beside which it was found."""
    edges = [int(k) for k in f.prepared[0].edges[1:-1]]

    def steps(given: Sequence[int]) -> list[tuple[special.Step, Sequence[int]]]:
        found = special.find_best_steps(f.r_factors, edges, f.n_base, given, owned, f.to_nominal)
        return [(step, given) for step in found]

    # Alone, unless it explains far more next to the first choice.
    return [
        ways[-1] if ways[-1][0].test.log_p < ways[0][0].test.log_p - BESIDE else ways[0]
        for ways in zip(*map(steps, [[], first] if first else [[]]), strict=True)
    ]


def _begun(
    f: Fitted,
    edges: Sequence[int] | NDArray[np.intp],
    samples: Mapping[str, int],
    places: Mapping[str, Sequence[int]],
) -> Fitted:
    """The same with R factors and sums in which the columns of steps are zero in blocks of time that begin before them."""
    sums = tuple(own.copy() for own in f.sums)
    r_factors = tuple(tuple(t.copy() for t in own) for own in f.r_factors)
    for e, sample in samples.items():
        for block in np.flatnonzero(np.asarray(edges)[:-1] < sample):
            for own, factors in zip(sums, r_factors, strict=True):
                own[block, places[e]] = 0.0
                factors[block][:, places[e]] = 0.0
    return replace(f, r_factors=r_factors, sums=sums)


def _root(
    f: Fitted,
    edges: Sequence[int] | NDArray[np.intp],
    samples: Mapping[str, int],
    places: Mapping[str, Sequence[int]],
) -> Array:
    """R factor of a flight, the prior in it, whose last columns are those of the steps from their instants on."""
    n, m = f.size + 1, sum(len(places[e]) for e in samples)
    blocks = []
    for own in f.r_factors:
        for T, start in zip(own, edges[:-1], strict=True):
            begun = [T[:, list(places[e])] * float(start >= samples[e]) for e in samples]
            blocks.append(np.hstack([T, *begun]))
    sheet = np.hstack([prior(range(f.n_base), n, f.to_nominal), np.zeros((f.n_base, m))])
    return fold([*blocks, sheet])


def _picked(root: Array, f: Fitted, steps: Sequence[str], places: Mapping[str, Sequence[int]]) -> Array:
    """Of :func:`_root` the R factor (n, n) in which some steps begin at their instants."""
    column = list(range(f.n_base, f.size + 1))
    first = f.size + 1
    for e, own in places.items():
        for n, k in enumerate(own):
            if e in steps:
                column[k - f.n_base] = first + n
        first += len(own)
    return pick_columns(root, f.n_base, column)


def _with_penalty(
    f: Fitted, effects: Sequence[str], T: Array | None = None, within: Field | None = None
) -> Field:
    """The field of effects, steps among them charged for the choice of their instant; on another R factor if one is given."""
    steps = [e.id for e in f.model.candidates if e.kind == "step"]
    return replace(make_field(f, effects, T, within), penalty=dict.fromkeys(steps, float(np.log(2 * BLOCKS))))
