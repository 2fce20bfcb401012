"""The search: which effects together explain the residual of the model, derived into it and fitted jointly."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import calibration, regressors
from ragg_runtime.estimation import fitted as fitted_
from ragg_runtime.estimation.calibration import measure_deviance
from ragg_runtime.estimation.fitted import Fitted, Scored, calibrate, fit
from ragg_runtime.estimation.likelihood_ratio import Test, weigh
from ragg_runtime.estimation.regressors import group_by_effect
from ragg_runtime.identification import comparison, omnibus, selection, strong
from ragg_runtime.identification.claims import Regression
from ragg_runtime.identification.comparison import Explained, measure_explained
from ragg_runtime.identification.omnibus import Remainder
from ragg_runtime.identification.strong import AddedEffect, Extend, Stage
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model, make_vector

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Outcome:
    """Flights with some ``effects`` in the model, and what they leave.

    Effects that are not derived into the model of ``target`` are in its candidate columns ``extra``.
    """

    effects: tuple[str, ...]
    target: Fitted
    extra: tuple[int, ...]
    coefficients: Array
    scored: Scored
    remainder: Remainder
    random: Mapping[str, Test]

    @staticmethod
    def of(f: Fitted, effects: Sequence[str], extra: Sequence[int]) -> Outcome:
        v = f.vector(f.coefficients(extra)[0], extra) if extra else np.zeros(f.size)
        left, random = omnibus.search(f, extra, _find_random_columns(f))
        return Outcome(tuple(effects), f, tuple(extra), v, f.score([v])[0], left, random)

    @cached_property
    def regression(self) -> Regression:
        return Regression.of(self.target, self.extra)

    @cached_property
    def noise_floor(self) -> float:
        return fitted_.measure_noise_floor(self.target)

    @cached_property
    def explained(self) -> Explained:
        return measure_explained(self.target, self.scored)

    @property
    def complaint(self) -> str | None:
        """What speaks against the fit, in words."""
        return self.target.calibration.complaint

    @property
    def widened(self) -> bool:
        """Whether the sheet is taken to be less sure than it says, beside effects that are derived into the model."""
        widths = self.target.instrument.widths
        sheet = (c.name for c in self.target.calibration.columns if c.effect is None)
        return not self.extra and any(name in widths for name in sheet)

    @property
    def remains(self) -> bool:
        """Whether the discrepancy is significant."""
        return self.remainder.significant or self.exceeds_noise

    @cached_property
    def exceeds_noise(self) -> bool:
        return comparison.exceeds_noise(self.target, self.scored, self.noise_floor)


@dataclass(frozen=True, eq=False)
class Evidence:
    """What the search has found: strong effects in ``steps``, the ``last`` stage with them in the model, and the ``outcome`` of all chosen.

    ``first`` is the stage without any effect; ``spent``: the budget of fits did not suffice.
    """

    first: Stage
    steps: Sequence[AddedEffect]
    last: Stage
    outcome: Outcome
    extend: Extend | None
    spent: bool

    @property
    def instants(self) -> dict[str, float]:
        """Of the steps among the effects, s."""
        return {t.effect: t.instant for t in self.steps if t.instant is not None} | dict(self.last.instants)

    def test(self, effect: str) -> Test:
        """The test by which an effect was chosen: a strong one by itself, any other beside all that were chosen."""
        strong_ones = {t.effect: t.test for t in self.steps}
        if effect in strong_ones:
            return strong_ones[effect]
        return self.last.problem.tests([e for e in self.last.chosen if e != effect])[effect]

    def measure_chi2(self, o: Outcome) -> tuple[float, int]:
        """Chi-square that an outcome's effects explain of what the model leaves without them, and with how many coefficients."""
        first, last, rank = self.first, self.last, self._count_coefficients(o)
        # beside a strong effect a step begins at an instant of its own
        beside = [e for e in o.effects if e in last.chosen] if self.steps and o.extra else []
        more, _ = last.problem.joint([last.chosen[e] for e in beside])
        derived = [e for e in o.effects if e not in beside]
        testable = [e for e in derived if e in first.problem.candidates]
        # the columns of each that are needed, by a linear test of the first stage
        chosen, tests = {} if self.steps else last.chosen, first.problem.tests()
        linear, _ = first.problem.joint([chosen.get(e) or tests[e].which for e in testable])
        remembers = any(e.memory is not None and e.id in o.effects for e in o.target.model.effects)
        weak = linear < strong.STRONG and len(testable) == len(derived) and not remembers
        if weak or (o.extra and not self.steps):
            return linear + more, rank
        # second orders of strong effects: what is left once they are derived into the model, by the noise of the model without them
        f, noise = o.target, first.fitted.calibration.noise
        left = calibration.fit(f.model, f.instrument, f.observations, noise=noise, start=f.calibration.p).chi2
        return max(linear, first.problem.chi2 - left) + more, rank

    def _count_coefficients(self, o: Outcome) -> int:
        """How many coefficients of an outcome's effects their tests need."""
        chosen, problem = self.last.chosen, self.last.problem
        return sum(problem.joint([chosen[e]])[1] if e in chosen else self.test(e).rank for e in o.effects)

    def charge(self, o: Outcome) -> float:
        """Logarithm of the number of ways in which an outcome's effects may be present."""
        return sum(self.test(e).charge for e in o.effects)

    def alternatives(self) -> Mapping[str, tuple[str, ...]]:
        """For every chosen effect those that would explain as much in its place."""
        return {t.effect: t.alternatives for t in self.steps} or self.first.alternatives

    def without(self, o: Outcome, effects: Sequence[str]) -> Outcome:
        """An outcome without some of its effects, fitted again."""
        first, last = self.first, self.last
        kept = [e for e in o.effects if e not in effects]
        if not kept:
            return Outcome.of(first.fitted, (), ())
        if not self._is_derived(o):
            return Outcome.of(last.fitted, kept, _list_given(last, kept))
        return Outcome.of(fit(*self._model_with(kept), first.fitted.observations), kept, ())

    def gain(self, o: Outcome, effect: str) -> float:
        """Chi-square that one of an outcome's effects explains given the others, by a fit without it, whose sheet may be less sure, at the
        price of its volume; 0 if it is not derived.
        """
        if not self._is_derived(o):
            return 0.0
        model, instrument = self._model_with([e for e in o.effects if e != effect])
        f = o.target  # by its noise, from its priors
        instrument = replace(instrument, widths=f.instrument.widths)
        without = calibrate(model, instrument, f.observations, noise=f.calibration.noise)
        return measure_deviance(*without) - measure_deviance(f.instrument, f.calibration)

    def weigh_instead(self, o: Outcome, effect: str) -> float:
        """Log evidence by which an effect that is not searched for is ahead of an outcome's effects, fitted to the same samples."""
        if self.extend is None:
            return -np.inf
        f, noise = self.first.fitted, self.first.fitted.calibration.noise
        model, sheet = strong.derive_with(f, [effect], {}, self.extend)
        sheet = strong.choose_start(f, model, sheet, effect)
        kept, sheet, instead = fitted_.calibrate_certain(model, sheet, o.target.observations, noise=noise)
        places = [n for n, q in enumerate(instead.columns) if q.effect == effect]
        rank = len(places) - float(np.trace(instead.covariance[np.ix_(places, places)]))
        chosen_sheet, chosen = calibrate(*self._model_with(o.effects), kept, noise=noise)
        without = calibration.fit(f.model, f.instrument, kept, noise=noise, start=f.calibration.p).chi2
        more, less = (
            max(0.0, without - measure_deviance(*fitted))
            for fitted in ((sheet, instead), (chosen_sheet, chosen))
        )
        charge = self.charge(o) + (len(o.effects) - 1) * float(np.log(self.first.problem.count))
        return weigh(more, rank) - weigh(less, self._count_coefficients(o), charge)

    def _is_derived(self, o: Outcome) -> bool:
        return self.extend is not None and bool(self.steps or o.target is not self.last.fitted)

    def _model_with(self, kept: Sequence[str]) -> tuple[Model, Instrument]:
        """The model with some of the effects, and its sheet."""
        first, last = self.first.fitted, self.last
        if not kept or self.extend is None:
            return first.model, first.instrument
        held = last.fitted.instrument.held | _list_held(last, [e for e in kept if e in last.chosen])
        return strong.derive_with(first, kept, self.instants, self.extend, held=held)


def _list_held(last: Stage, chosen: Iterable[str]) -> frozenset[str]:
    """Coefficients of the chosen effects that their tests do not need: free, those that a record does not determine would wander."""
    return frozenset[str]().union(*(strong.list_unneeded(last.problem, e, last.chosen[e]) for e in chosen))


def _list_given(last: Stage, chosen: Iterable[str]) -> list[int]:
    """The candidate columns that the tests of the chosen effects need."""
    return [n for e in chosen for n in last.chosen[e]]


def search(
    first: Stage, extend: Extend | None, *, apart: bool, mistakes: Sequence[Sequence[str]] = ()
) -> Evidence:
    """Search forward, and fit what is chosen in the model, without effects that then have an impossible size.

    Nothing is searched in flights that are kept ``apart``, nor in an output of which the model explains nothing. ``mistakes``: for each
    that the record is said to hold the effects that describe it.
    """
    idle = apart or measure_explained(first.fitted, first.scored).complaint is not None
    steps, last, spent = (
        ([], first.without_choice(), False) if idle else strong.select_strong(first, extend, mistakes)
    )
    final = _derive_chosen(last, extend)
    while final is not None and (wrong := strong.find_impossible(final, last.chosen)):
        kept = {e: c for e, c in last.problem.candidates.items() if e not in wrong}
        problem = replace(last.problem, candidates=kept)
        last = replace(last, problem=problem, chosen=selection.choose(problem))
        final = _derive_chosen(last, extend)
    effects = [*(t.effect for t in steps), *last.chosen]
    outcome = Outcome.of(final or last.fitted, effects, () if final else _list_given(last, last.chosen))
    return Evidence(first, steps, last, outcome, extend, spent)


def _derive_chosen(last: Stage, extend: Extend | None) -> Fitted | None:
    """The chosen effects derived into the model and everything fitted again, if that can be done."""
    f, chosen = last.fitted, [*last.chosen]
    steps = {e.id for e in f.model.candidates if e.kind == "step"}
    if not chosen or extend is None or (steps & set(chosen)):
        return None
    extended = extend(f.model, chosen)
    instrument = replace(f.instrument, held=f.instrument.held | _list_held(last, chosen))
    start = _start_from_linear_fit(f, _list_given(last, chosen), extended, instrument)
    return fit(extended, instrument, f.observations, f.calibration.noise, start)


def _start_from_linear_fit(f: Fitted, extra: Sequence[int], extended: Model, instrument: Instrument) -> Array:
    """Parameter vector of the extended model as the linear fit has it, SI."""
    candidates = [f.candidates[n] for n in extra]
    fitted, _ = f.coefficients(extra)
    columns = (*f.calibration.columns, *candidates)
    before = (*f.calibration.p[f.calibration.index], *(0.0 for _ in candidates))
    value = {c.label: b + x * c.scale for c, b, x in zip(columns, before, fitted, strict=True)}
    p = make_vector(extended, f.instrument)
    for c, place in regressors.list_base_columns(extended, instrument):
        p[place] = value.get(c.label, p[place])  # what but shapes the others has no linear fit
    return p


def _find_random_columns(f: Fitted) -> dict[str, int]:
    """The place of every random effect's column."""
    if any(o.recorded.demodulated for o in f.observations):
        return {}  # neighbouring samples of a demodulated channel are not independent
    random = {e.id for e in f.model.candidates if e.kind == "random"}
    groups = group_by_effect(f.candidates)
    return {e: f.n_base + columns[0][0] for e, columns in groups.items() if e in random}
