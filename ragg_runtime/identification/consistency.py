"""Whether one model, with one set of parameters, holds throughout: from flight to flight, and from block to block of time.

Flights contradict each other where each is explained by itself, and no one set of parameters explains all (G. Chow, Econometrica 28,
1960, 591). Within flights a sequential test has a bounded false-alarm rate: block after block, the residual is predicted from those
before (recursive residuals: R. Brown, J. Durbin, J. Evans, J. R. Stat. Soc. B 37, 1975); e-values E_b of the innovations are joined by
the e-detector of Shin, Ramdas and Rinaldo (New Engl. J. Stat. Data Sci. 2, 2024), M_b = E_b max(1, M_(b-1)), which exceeds c in B
blocks with probability at most B / c if nothing changes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular
from scipy.special import logsumexp

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation.calibration import QUIET
from ragg_runtime.estimation.fitted import Fitted, calibrate, fit
from ragg_runtime.estimation.least_squares import add_prior, compute_r_factor
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.identification.result import ChangePoint, Disagreement
from ragg_runtime.identification.search import search
from ragg_runtime.identification.selection import ProjectedProblem, choose, make_problem
from ragg_runtime.identification.strong import Extend, Stage, derive_with
from ragg_runtime.identification.verdict import Conclusion

Array = NDArray[np.float64]


# --- from flight to flight


def are_far_apart(first: Stage) -> bool:
    """Whether flights leave far more together than each by itself, by fits that are linear in all effects that a linear test chooses of
    all of them, or of any; ``first`` is the stage without effects.
    """
    f = first.fitted
    problems = [first.problem, *(_make_flight_problem(f, places) for places in _group_by_flight(f).values())]
    chosen = {*first.chosen, *(e for x in problems[1:] for e in choose(x))}
    together, *alone = (
        x.chi2 - x.joint([[n for n, _ in columns] for e, columns in x.candidates.items() if e in chosen])[0]
        for x in problems
    )
    return together > QUIET * max(sum(alone), f.calibration.rows)


def find_disagreement(first: Stage, extend: Extend | None) -> tuple[Disagreement, ...]:
    """Groups of flights that agree, and the effects that each group lacks; none where all flights agree."""
    f = first.fitted
    groups: list[_Group] = []
    for places in _group_by_flight(f).values():
        one = _Group.of(fit(f.model, f.instrument, [f.observations[n] for n in places]), extend)
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
        alone = Conclusion.of(search(Stage.of(f), extend, apart=False), (), apart=False)
        c = alone.outcome.target.calibration
        return _Group(f.observations, alone.claims, c.noise, c.excess * c.rows, c.rows, not alone.remains, f)

    def join(self, other: _Group, extend: Extend | None) -> _Group | None:
        """Both as one group, or ``None`` if one set of parameters explains them plainly worse (far worse, unless both are explained)."""
        f, effects = self.base, tuple(sorted({*self.effects, *other.effects}))
        kinds = {e.id: e.kind for e in f.model.candidates}
        if effects and (extend is None or any(kinds[e] == "step" for e in effects)):
            return None  # a step has an instant in one flight only
        ids = [e for e in effects if kinds[e] == "deterministic"]
        model, sheet = derive_with(f, ids, {}, extend) if ids and extend else (f.model, f.instrument)
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


def _make_flight_problem(f: Fitted, places: Sequence[int]) -> ProjectedProblem:
    """The problem of one flight, which has the observations at these places."""
    noise = tuple(f.calibration.noise[n] for n in places)
    single = replace(
        f,
        observations=tuple(f.observations[n] for n in places),
        calibration=replace(f.calibration, noise=noise),
        r_factors=tuple(f.r_factors[n] for n in places),
    )
    return make_problem(single)


# --- from block to block of time

# prior standard deviation of the parameters before the first block, in those of the sheet: that the sheet was wrong is no change
WIDE = 100.0
# variance that a change adds to innovations, in that of the noise: averaged over
SIZES = np.logspace(-1.0, 8.0, 19)
KNOWN = 200  # samples that the noise of the whole flight counts as where a block tells its own level


def find_change(f: Fitted) -> ChangePoint | None:
    """Follow the model through its flights; ``None`` where it holds to the end, or never held."""
    blocks = list(_compute_innovations(f))
    limit = np.log(max(1, len(blocks)) / false_alarms.CHANGE)
    log_m, since = 0.0, 0
    for n, (_, *innovations) in enumerate(blocks):
        if log_m <= 0.0:
            since = n
        log_m = max(0.0, log_m) + log_e(*innovations)
        if log_m > limit and since:
            return blocks[since][0]
    return None


def log_e(*parts: Array) -> float:
    """ln of the e-value of independent unit normal innovations, given in parts (n,): averages of likelihood ratios."""
    logs = []
    shrink, factor = 0.5 * SIZES / (1.0 + SIZES), 0.5 * np.log1p(SIZES)
    for z in parts:
        if len(z):
            square = z**2
            logs.append(logsumexp(np.sum(square) * shrink - len(z) * factor) - np.log(len(SIZES)))
            one = square[:, None] * shrink - factor
            logs.append(logsumexp(one) - np.log(one.size))
    return float(logsumexp(logs) - np.log(len(logs))) if logs else 0.0


def _compute_innovations(f: Fitted) -> Iterator[tuple[ChangePoint, Array, Array]]:
    """The beginning of each block of time, its innovations along the base columns, and those along candidates beyond these."""
    n = f.n_base
    nothing = np.zeros((n + 1, n + 1))
    prior = add_prior(nothing, range(n), f.to_nominal / WIDE)
    prior[:, :n] /= WIDE  # it holds the prior's rows alone: WIDE times as wide
    for x, r_factors in zip(f.prepared, f.r_factors, strict=True):
        r = x.observation.record
        for T, (first, last) in zip(r_factors, pairwise(x.edges), strict=True):
            samples = int(np.sum(r.valid[first:last])) * len(x.observation.series)
            if not samples:
                continue
            free = max(0, samples - T.shape[1])
            level = float(np.sqrt((T[-1, -1] ** 2 + KNOWN) / (free + KNOWN)))
            block = np.column_stack([T[:n, :n], T[:n, -1]]) / level
            base = _standardise(prior, block)
            prior = compute_r_factor(np.vstack([prior, block]).T)
            further = T[n:-1, -1][np.diag(T)[n:-1] != 0.0] / level
            yield ChangePoint(x.observation.name, float(r.time[first])), base, further


def _standardise(prior: Array, block: Array) -> Array:
    """(n,): the difference of a block's rotated data from the prior's prediction, standardised by both uncertainties."""
    n = block.shape[1] - 1
    S = prior[:n, :n]
    expected = solve_triangular(S, prior[:n, n])
    V = solve_triangular(S, block[:, :n].T, trans="T")
    R = np.linalg.qr(np.vstack([np.eye(len(block)), V]), mode="r")  # R'R = 1 + V'V, without squaring V
    return np.asarray(solve_triangular(R, block[:, n] - block[:, :n] @ expected, trans="T"))
