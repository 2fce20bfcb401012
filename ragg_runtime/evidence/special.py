"""Effects that no fixed column can express: steps at an unknown instant, random ones, and what the
recorder does to the output channel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from ragg_runtime import design
from ragg_runtime.design import Column
from ragg_runtime.evidence import likelihood
from ragg_runtime.evidence.likelihood import Test
from ragg_runtime.evidence.work import Flown
from ragg_runtime.passes import Piece
from ragg_runtime.segments import BLOCKS

Array = NDArray[np.float64]

CLIPPED = 5
"""Samples at one and the same extreme value that make a saturated output."""

ENOUGH = 1 << 20
"""Samples that show a lattice, if there is one."""

COARSE = 0.5
"""Quantisation step, in standard deviations of the noise, from which it is reported."""


@dataclass(frozen=True)
class Step:
    """The first sample after the most likely instant of a step, and its test, chosen from so many variants."""

    sample: int
    test: Test
    variants: int


def best_step(
    triangles: Sequence[Array],
    edges: Sequence[int],
    n_base: int,
    given: Sequence[int],
    columns: Sequence[tuple[int, Column]],
    prior: Array,
) -> Step:
    """The edge between two stretches of time, of which each has a triangle, where a step explains most.

    ``columns`` are those of the effect acting all the time (positions after the base); ``given`` those of
    effects already chosen; ``prior`` (n_base,) the prior's centre; ``edges`` the samples between the stretches.
    """
    fixed = [*range(n_base), *(n_base + n for n in given)]
    moving = [n_base + n for n, _ in columns]
    k, m = len(fixed), len(moving)
    picked = [t[:, [*fixed, *moving, t.shape[1] - 1]] for t in triangles]
    # The stretches after an edge count with the step's columns, those before it without.
    after: list[Array] = [np.zeros((0, k + m + 1))]
    for t in reversed(picked[1:]):
        after.append(design.join([after[-1], t]))
    before = np.zeros((0, k + m + 1))
    best: Step | None = None
    own = [(n, c) for n, (_, c) in enumerate(columns)]
    floor = np.full(m + 1, likelihood.TESTABLE)
    for n, edge in enumerate(edges):
        off = picked[n].copy()
        off[:, k : k + m] = 0.0
        before = design.join([before, off])
        T = likelihood.with_prior(np.vstack([before, after[len(edges) - n]]), n_base, prior)
        test = likelihood.test(likelihood.project(T, k), own, floor, float(np.log(2 * BLOCKS)))
        if best is None or test.log_p < best.test.log_p:
            best = Step(edge, test, 2 * BLOCKS)
    assert best is not None
    return best


FINE = 192
"""Stretches into which the neighbourhood of a step is divided in each round that looks for its instant."""


def refined(
    flown: Flown,
    step: Step,
    n_base: int,
    given: Sequence[int],
    columns: Sequence[tuple[int, Column]],
    prior: Array,
) -> Step:
    """Move the instant of a step to the sample where it explains most."""
    length = len(flown.observation.record.time)
    reach = max(1, length // BLOCKS)
    places = [*range(n_base), *(n_base + n for n in given), *(n_base + n for n, _ in columns)]
    moved = list(range(n_base + len(given), len(places)))
    named = [(n - n_base, c) for n, (_, c) in zip(moved, columns, strict=True)]
    while reach > 1:
        low, high = max(1, step.sample - reach), min(length - 1, step.sample + reach)
        edges = np.unique(np.linspace(low, high, FINE + 1).astype(np.intp))
        cuts = np.array([0, *edges, length])
        triangles: list[Array | None] = [None] * (len(cuts) - 1)

        def cut(piece: Piece, cuts: NDArray[np.intp] = cuts) -> list[tuple[int, Array]]:
            X = piece.white[[*places, -1]]
            which = np.searchsorted(cuts, piece.sample, side="right") - 1
            return [(int(k), design.triangle(X[:, which == k])) for k in np.unique(which)]

        for own in flown.each(cut):
            for k, T in own:
                before = triangles[k]
                triangles[k] = T if before is None else design.join([before, T])
        empty = np.zeros((len(places) + 1, len(places) + 1))
        known = [empty if t is None else t for t in triangles]
        step = best_step(known, [int(e) for e in edges], n_base, range(len(given)), named, prior)
        reach = int(np.max(np.diff(edges), initial=1))
    return step


@dataclass(frozen=True)
class Variance:
    """Sums over samples for a score test of a random effect: is the residual larger where it would show?"""

    count: int
    sums: Array

    @staticmethod
    def of(piece: Piece, place: int, residual: Array) -> Variance:
        """Of a segment; ``place`` is the effect's column, ``residual`` (rows,) is whitened and projected."""
        s2, e2 = piece.white[place] ** 2, residual**2
        return Variance(len(e2), np.array([np.sum(s2), np.sum(e2), s2 @ s2, e2 @ e2, s2 @ e2]))

    def test(self) -> Test:
        """Score test of the variance, with the residual's own fourth moment, so that heavy tails raise no alarm."""
        s2, e2, s4, e4, s2e2 = self.sums / max(self.count, 1)
        spread, ratio = s4 - s2**2, e4 / e2**2 - 1.0
        if spread <= 0.0 or ratio <= 0.0:
            return Test(0.0, 0, 0.0, (0,))
        z = float(np.sqrt(self.count) * (s2e2 / e2 - s2) / np.sqrt(spread * ratio))
        return Test(max(z, 0.0) ** 2, 1, float(stats.norm.logsf(z)), (0,))


def pooled(parts: Sequence[Variance]) -> Variance:
    """The sums of several segments or flights together."""
    return Variance(sum(p.count for p in parts), np.sum([p.sums for p in parts], axis=0))


def saturation(G: Array, valid: NDArray[np.bool_]) -> tuple[float, NDArray[np.bool_]] | None:
    """(V_max, samples at it) if many samples share the extreme value of an output; else ``None``."""
    g = np.where(valid, G, 0.0)
    top = float(np.max(np.abs(g)))
    if top == 0.0:
        return None
    at = np.abs(g) >= top * (1 - 1e-12)
    # a short record at coarse quantisation may repeat its maximum: neighbours at the top tell a clip
    neighbours = int(np.sum(at[1:] & at[:-1]))
    if np.sum(at) < CLIPPED or neighbours < 2:
        return None
    return top, at


def quantisation(G: Array, valid: NDArray[np.bool_], noise: float) -> float | None:
    """Step of the lattice on which all values of an output lie, V, if it matters beside the noise."""
    values = np.unique(G[:ENOUGH][valid[:ENOUGH]])
    if len(values) < 3:
        return None
    steps = np.diff(values)
    q = float(np.min(steps))
    if q < COARSE * noise:
        return None
    # all values multiples of one step, to the rounding of the file
    q = float(np.median(steps / np.rint(steps / q)))
    if np.max(np.abs(values / q - np.rint(values / q))) > 1e-3:
        return None
    return q
