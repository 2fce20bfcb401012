"""Effects that no fixed column can express: steps at an unknown instant, random ones, and what the
recorder does to the output channel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import count

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.least_squares import fold, join, pick_columns, r_factor
from ragg_runtime.estimation.least_squares import prior as prior_rows
from ragg_runtime.estimation.observation import BLOCKS, ROWS
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.estimation.whitening import Piece, PreparedFlight, Projector, whiten_columns
from ragg_runtime.identification import likelihood_ratio
from ragg_runtime.identification.likelihood_ratio import Test

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Step:
    """The first sample after the most likely instant of a step, and its test."""

    sample: int
    test: Test


def find_best_steps(
    r_factors: Sequence[Sequence[Array]],
    edges: Sequence[int],
    n_base: int,
    given: Sequence[int],
    owned: Sequence[Sequence[tuple[int, Column]]],
    prior: Array,
) -> list[Step]:
    """For each effect the edge between two segments of time, each with an R factor of every output, where its step explains most.

    ``owned`` are each effect's columns, ``given`` those of chosen ones (positions after the base); ``prior`` (n_base,) the centre.
    """
    columns = [c for own in owned for c in own]
    k, m = n_base + len(given), len(columns)
    others = [*(n_base + n for n in given), *(n_base + n for n, _ in columns), -1]
    picked = [fold([pick_columns(t, n_base, others) for t in each]) for each in zip(*r_factors, strict=True)]
    # The segments after an edge count with the steps' columns, those before it without; the prior in them.
    sheet = prior_rows(range(n_base), k + m + 1, prior)
    after: list[Array] = [np.pad(sheet, ((0, k + m + 1 - n_base), (0, 0)))]
    for t in reversed(picked[1:]):
        after.append(fold([after[-1], t]))
    before = np.zeros((k + m + 1, k + m + 1))
    place = count()
    named = [[(next(place), c) for _, c in own] for own in owned]
    floor = np.full(m + 1, likelihood_ratio.TESTABLE)
    tests = []
    for n in range(len(edges)):
        off = picked[n].copy()
        off[:, k : k + m] = 0.0
        before = fold([before, off])
        P = likelihood_ratio.project(fold([before, after[len(edges) - n]]), k)
        tests.append([likelihood_ratio.test(P, own, floor, float(np.log(2 * BLOCKS))) for own in named])
    best = [min(zip(edges, own, strict=True), key=lambda at: at[1].log_p) for own in zip(*tests, strict=True)]
    return [Step(edge, test) for edge, test in best]


FINE = 192
"""Segments into which the neighbourhood of a step is divided in each round that looks for its instant."""


def refine_step(
    prepared: Sequence[PreparedFlight],
    step: Step,
    n_base: int,
    given: Sequence[int],
    columns: Sequence[tuple[int, Column]],
    prior: Array,
) -> Step:
    """Move the instant of a step to the sample where it explains most, of all outputs of a flight."""
    length = len(prepared[0].observation.record.time)
    reach = max(1, length // BLOCKS)
    places = [*range(n_base), *(n_base + n for n in given), *(n_base + n for n, _ in columns)]
    moved = list(range(n_base + len(given), len(places)))
    flights = [x.lean(places) for x in prepared]
    named = [(n - n_base, c) for n, (_, c) in zip(moved, columns, strict=True)]
    while reach > 1:
        low, high = _near(step.sample, reach, length)
        edges = np.unique(np.linspace(low, high, FINE + 1).astype(np.intp))
        cuts = np.array([0, *edges, length])
        r_factors: list[Array | None] = [None] * (len(cuts) - 1)

        def cut(piece: Piece, own: Sequence[int], cuts: NDArray[np.intp] = cuts) -> list[tuple[int, Array]]:
            X = piece.white[[*own, -1]]
            which = np.searchsorted(cuts, piece.sample, side="right") - 1
            return [(int(k), r_factor(X[:, which == k])) for k in np.unique(which)]

        for x, own in flights:
            for parts in x.each(partial(cut, own=own)):
                for k, T in parts:
                    before = r_factors[k]
                    r_factors[k] = T if before is None else join([before, T])
        empty = np.zeros((len(places) + 1, len(places) + 1))
        known = [empty if t is None else t for t in r_factors]
        (step,) = find_best_steps([known], [int(e) for e in edges], n_base, range(len(given)), [named], prior)
        reach = int(np.max(np.diff(edges), initial=1))
    return step


def _near(sample: int, reach: int, length: int) -> tuple[int, int]:
    """First and last sample about one at which a step may be: none in the first or last block of time."""
    block = max(1, length // BLOCKS)
    return max(block, sample - reach), min(length - block, sample + reach)


POINTS = 16
"""Instants on either side that are tried in each round that looks for the sample."""


def sharpen_step(
    prepared: Sequence[PreparedFlight], sample: int, projector: Projector, places: Sequence[int]
) -> int:
    """Move the first sample of a step to where its own columns, put through the filter from there on, explain most.

    Only of a flight of one segment; ``places`` of the columns are those among all, ``projector`` is of all outputs together.
    """
    length = len(prepared[0].observation.record.time)
    if length > ROWS:
        return sample
    pieces = [p for x in prepared for p in x.each(lambda p: p)]
    bases = [projector.basis(p) for p in pieces]
    y = np.concatenate([projector.left(p, Q) for p, Q in zip(pieces, bases, strict=True)])
    Q = np.concatenate(bases)

    def explained(at: int) -> float:
        X = np.concatenate([_begun(p, x, at, places) for p, x in zip(pieces, prepared, strict=True)], axis=1)
        whole = np.linalg.norm(X, axis=1)
        X = X - (X @ Q) @ Q.T
        seen = np.linalg.norm(X, axis=1) > np.maximum(likelihood_ratio.TESTABLE, 1e-6 * whole)
        if not seen.any():
            return 0.0
        U, s, _ = np.linalg.svd(X[seen].T, full_matrices=False)
        return float(np.sum((U[:, s > 1e-6 * s[0]].T @ y) ** 2))

    reach = max(1, length // BLOCKS)
    # the filter of a noise that has the step in it makes a spike of its edge, which a coarse search passes by
    low, high = _near(sample, POINTS, length)
    known = {at: explained(at) for at in range(low, high + 1)}
    while True:
        spacing = max(1, reach // POINTS)
        low, high = _near(sample, reach, length)
        for at in range(low, high + 1, spacing):
            known.setdefault(at, explained(at))
        sample = max(known, key=lambda at: (known[at], -at))
        if spacing == 1:
            return sample
        reach = spacing


def _begun(piece: Piece, prepared: PreparedFlight, at: int, places: Sequence[int]) -> Array:
    """(places, rows): columns of a whole flight from a sample on, whitened; those of other outputs' accelerometers are zero."""
    columns = piece.columns[list(places)]
    columns[:, :, :at] = 0.0
    own = columns.any(axis=(1, 2))
    X = whiten_columns(columns[own], prepared.noise, None, piece.observation.record)
    unknown_gradient.project(X, piece.windows)
    found = np.zeros((len(columns), X.shape[1]))
    found[own] = X
    return found
