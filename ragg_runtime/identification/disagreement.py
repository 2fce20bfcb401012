"""Flights that contradict each other: each is explained by itself, and no one set of parameters explains all (G. Chow, Econometrica 28,
1960, 591).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation.calibration import QUIET
from ragg_runtime.estimation.fitted import Fitted, calibrate, fit
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.identification.result import Disagreement
from ragg_runtime.identification.search import search
from ragg_runtime.identification.selection import ProjectedProblem, choose, make_problem
from ragg_runtime.identification.strong import Extend, Stage, derive_with
from ragg_runtime.identification.verdict import Conclusion


def are_far_apart(first: Stage) -> bool:
    """Whether flights leave far more together than each by itself, by fits that are linear in all effects that a linear test chooses of
    all of them, or of any; ``first`` is the stage without effects.
    """
    f = first.fitted
    problems = [first.problem, *(_make_own_problem(f, own) for own in _group_by_flight(f).values())]
    chosen = {*first.chosen, *(e for x in problems[1:] for e in choose(x))}
    together, *alone = (
        x.chi2 - x.joint([[n for n, _ in own] for e, own in x.candidates.items() if e in chosen])[0]
        for x in problems
    )
    return together > QUIET * max(sum(alone), f.calibration.rows)


def find_disagreement(first: Stage, extend: Extend | None) -> tuple[Disagreement, ...]:
    """The flights that agree, and what these lack; nothing where all do."""
    f = first.fitted
    groups: list[_Group] = []
    for own in _group_by_flight(f).values():
        one = _Group.of(fit(f.model, f.instrument, [f.observations[n] for n in own]), extend)
        joined = ((n, g.join(one, extend)) for n, g in enumerate(groups))
        n, group = next(((n, g) for n, g in joined if g is not None), (len(groups), one))
        groups[n : n + 1] = [group]
    if len(groups) == 1:
        return ()
    names = (tuple(dict.fromkeys(o.flight_name for o in g.observations)) for g in groups)
    return tuple(Disagreement(n, g.effects, g.explained) for n, g in zip(names, groups, strict=True))


@dataclass(frozen=True)
class _Group:
    """Flights that agree: their effects, and what is left beside these: a chi-square of so many rows, by noise that is each flight's own.

    ``explained``: that is noise. ``base``: the fit of the first without effects.
    """

    observations: tuple[Observation, ...]
    effects: tuple[str, ...]
    noise: tuple[NoiseModel, ...]
    chi2: float
    rows: int
    explained: bool
    base: Fitted

    @staticmethod
    def of(f: Fitted, extend: Extend | None) -> _Group:
        """One flight by itself."""
        found = Conclusion.of(search(Stage.of(f), extend, apart=False), (), apart=False)
        c = found.outcome.target.calibration
        return _Group(f.observations, found.claims, c.noise, c.excess * c.rows, c.rows, not found.remains, f)

    def join(self, other: _Group, extend: Extend | None) -> _Group | None:
        """Both, unless one set of parameters explains them plainly worse; where more than noise is left of each, far worse."""
        f, effects = self.base, tuple(sorted({*self.effects, *other.effects}))
        kinds = {e.id: e.kind for e in f.model.candidates}
        if effects and (extend is None or any(kinds[e] == "step" for e in effects)):
            return None  # a step has an instant in one flight only
        own = [e for e in effects if kinds[e] == "deterministic"]
        model, sheet = derive_with(f, own, {}, extend) if own and extend else (f.model, f.instrument)
        observations, noise = (*self.observations, *other.observations), (*self.noise, *other.noise)
        c = calibrate(model, sheet, observations, noise=noise)[1]
        alone, together = self.chi2 + other.chi2, c.excess * c.rows
        explained = self.explained and other.explained
        worse = log_sf(together - alone, len(c.columns)) < np.log(false_alarms.CATALOGUE)
        if worse and (explained or together > QUIET * alone):
            return None
        return _Group(observations, effects, noise, together, c.rows, explained, f)


def _group_by_flight(f: Fitted) -> dict[int, list[int]]:
    """The places of the observations of each flight."""
    flights: dict[int, list[int]] = {}
    for n, o in enumerate(f.observations):
        flights.setdefault(o.flight, []).append(n)
    return flights


def _make_own_problem(f: Fitted, own: Sequence[int]) -> ProjectedProblem:
    """The problem of one flight, whose observations have these places."""
    noise = tuple(f.calibration.noise[n] for n in own)
    some = replace(
        f,
        observations=tuple(f.observations[n] for n in own),
        calibration=replace(f.calibration, noise=noise),
        r_factors=tuple(f.r_factors[n] for n in own),
    )
    return make_problem(some)
