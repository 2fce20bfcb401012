"""Effects that begin at an unknown instant: candidates like all others, whose columns begin at the most likely one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import likelihood_ratio, unknown_gradient, whitening
from ragg_runtime.estimation.fitted import Fitted, fit
from ragg_runtime.estimation.least_squares import compute_r_factor, join
from ragg_runtime.estimation.noise_estimate import estimate_noise
from ragg_runtime.estimation.observation import BLOCKS, ROWS
from ragg_runtime.estimation.regressors import Column, group_by_effect
from ragg_runtime.estimation.whitening import Piece, PreparedFlight
from ragg_runtime.identification import selection
from ragg_runtime.identification.selection import ProjectedProblem, list_testable, make_problem

Array = NDArray[np.float64]

# the columns of every step, with their places among the candidates
Columns = Mapping[str, Sequence[tuple[int, Column]]]
Steps = Mapping[str, int]  # the first sample after each step


def add_steps(
    f: Fitted, starts: Steps = MappingProxyType({})
) -> tuple[ProjectedProblem, Fitted, dict[str, float]]:
    """The problem of all candidates, the fit in which the columns of each step begin at its most likely instant, and these instants by
    effect, s.

    Of significant steps the first samples are in ``starts``: with each of these the noise is estimated again, and everything with it.
    """
    available = list_testable(f)
    kinds = [e.id for e in f.model.candidates if e.kind == "step"]
    columns = {e: group for e, group in group_by_effect(f.candidates).items() if e in kinds}
    if len(f.flights) != 1 or not columns:
        return make_problem(f), f, {}
    starts = {e: _sharpen(f, sample, columns[e]) for e, sample in starts.items()}
    if starts:  # made anew from these samples on, and put through the filter
        prepared = tuple(x.with_steps(_list_instants(f, starts)) for x in f.prepared)
        r_factors, sums = zip(*(whitening.factor_blocks(x) for x in prepared), strict=True)
        f = replace(f, prepared=prepared, r_factors=r_factors, sums=sums)
    edges = [int(k) for k in f.prepared[0].edges[1:-1]]
    unplaced = {e: c for e, c in columns.items() if e not in starts}
    best = likelihood_ratio.find_best_edges(f.r_factors, f.to_nominal, unplaced)
    likeliest = {e: edges[n] for e, (_, n) in best.items()}
    begun = _zero_before(f, likeliest, columns)
    problem = make_problem(begun, [*available, *columns])
    # samples do not judge a step yet: one that is in the noise makes it uneven
    effects = [e for e in selection.choose(replace(problem, flights=())) if e in likeliest]
    if effects:
        refined = {e: _refine(f, likeliest[e], columns[e]) for e in effects}
        starts = {**starts, **{e: _sharpen(f, sample, columns[e]) for e, sample in refined.items()}}
        instants = _list_instants(f, starts)
        noise = [estimate_noise(replace(x.at, instants=instants), x.observation) for x in f.prepared]
        return add_steps(fit(f.model, f.instrument, f.observations, noise, f.calibration.p), starts)
    instants = _list_instants(f, {**starts, **likeliest})
    prepared = tuple(x.with_steps(instants) for x in f.prepared)
    tests = replace(problem, flights=prepared if problem.flights else ())
    return tests, replace(begun, prepared=prepared), instants


def _list_instants(f: Fitted, steps: Steps) -> dict[str, float]:
    """By effect, s."""
    return {e: float(f.observations[0].record.time[sample]) for e, sample in steps.items()}


def _zero_before(f: Fitted, steps: Steps, columns: Columns) -> Fitted:
    """The fit with R factors and sums in which the columns of steps are zero in the blocks of time before them."""
    sums = tuple(total.copy() for total in f.sums)
    r_factors = tuple(tuple(t.copy() for t in factors) for factors in f.r_factors)
    for e, sample in steps.items():
        places = [f.n_base + n for n, _ in columns[e]]
        for block in np.flatnonzero(f.prepared[0].edges[:-1] < sample):
            for total, factors in zip(sums, r_factors, strict=True):
                total[block, places] = 0.0
                factors[block][:, places] = 0.0
    return replace(f, r_factors=r_factors, sums=sums)


# segments into which the neighbourhood of a step is divided in each round that looks for its instant
FINE = 192


def _refine(f: Fitted, sample: int, columns: Sequence[tuple[int, Column]]) -> int:
    """Move the instant of a step to the sample where it explains most, of all outputs of the flight."""
    length = len(f.observations[0].record.time)
    reach = max(1, length // BLOCKS)
    places = [*range(f.n_base), *(f.n_base + n for n, _ in columns)]
    moved = {"": [*enumerate(c for _, c in columns)]}
    flights = [x.lean(places) for x in f.prepared]
    while reach > 1:
        low, high = _limit_search(sample, reach, length)
        edges = np.unique(np.linspace(low, high, FINE + 1).astype(np.intp))
        cuts = np.array([0, *edges, length])
        r_factors: list[Array] = [np.zeros((len(places) + 1, len(places) + 1))] * (len(cuts) - 1)

        def cut(piece: Piece, rows: Sequence[int], cuts: NDArray[np.intp] = cuts) -> list[tuple[int, Array]]:
            X = piece.white[[*rows, -1]]
            which = np.searchsorted(cuts, piece.sample, side="right") - 1
            return [(int(k), compute_r_factor(X[:, which == k])) for k in np.unique(which)]

        for x, rows in flights:
            for parts in x.each(partial(cut, rows=rows)):
                for k, T in parts:
                    r_factors[k] = join([r_factors[k], T])
        sample = int(edges[likelihood_ratio.find_best_edges([r_factors], f.to_nominal, moved)[""][1]])
        reach = int(np.max(np.diff(edges), initial=1))
    return sample


def _limit_search(sample: int, reach: int, length: int) -> tuple[int, int]:
    """First and last sample about one at which a step may be: none in the first or last block of time."""
    block = max(1, length // BLOCKS)
    return max(block, sample - reach), min(length - block, sample + reach)


POINTS = 16  # instants on either side that are tried in each round that looks for the sample


def _sharpen(f: Fitted, sample: int, columns: Sequence[tuple[int, Column]]) -> int:
    """Move the first sample of a step to where its own columns, put through the filter from there on, explain most.

    Only of a flight of one segment.
    """
    length = len(f.observations[0].record.time)
    if length > ROWS:
        return sample
    everything = [t for factors in f.r_factors for t in factors]
    projector = whitening.make_projector(everything, f.n_base, ())
    places = [f.n_base + n for n, _ in columns]
    pieces = [p for x in f.prepared for p in x.each(lambda p: p)]
    bases = [projector.basis(p) for p in pieces]
    y = np.concatenate([projector.project_residual(p, Q) for p, Q in zip(pieces, bases, strict=True)])
    Q = np.concatenate(bases)

    def measure_gain(at: int) -> float:
        X = np.concatenate(
            [_begin_columns(p, x, at, places) for p, x in zip(pieces, f.prepared, strict=True)], axis=1
        )
        whole = np.linalg.norm(X, axis=1)
        X = X - (X @ Q) @ Q.T
        seen = np.linalg.norm(X, axis=1) > likelihood_ratio.find_floor(whole)
        if not seen.any():
            return 0.0
        U, s, _ = np.linalg.svd(X[seen].T, full_matrices=False)
        return float(np.sum((U[:, s > 1e-6 * s[0]].T @ y) ** 2))

    reach = max(1, length // BLOCKS)
    # the filter of a noise that has the step in it makes a spike of its edge, which a coarse search passes by
    low, high = _limit_search(sample, POINTS, length)
    gains = {at: measure_gain(at) for at in range(low, high + 1)}
    while True:
        spacing = max(1, reach // POINTS)
        low, high = _limit_search(sample, reach, length)
        for at in range(low, high + 1, spacing):
            gains.setdefault(at, measure_gain(at))
        sample = max(gains, key=lambda at: (gains[at], -at))
        if spacing == 1:
            return sample
        reach = spacing


def _begin_columns(piece: Piece, prepared: PreparedFlight, at: int, places: Sequence[int]) -> Array:
    """(places, rows): columns of a whole flight from a sample on, whitened; those of other outputs' accelerometers are zero."""
    columns = piece.columns[list(places)]
    columns[:, :, :at] = 0.0
    nonzero = columns.any(axis=(1, 2))
    r, noise = piece.observation.record, prepared.noise
    X = noise.whiten(columns[nonzero], r.valid, noise.level.of(r.quantity))
    unknown_gradient.project(X, piece.windows)
    whitened = np.zeros((len(columns), X.shape[1]))
    whitened[nonzero] = X
    return whitened
