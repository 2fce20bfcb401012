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
from ragg_runtime.evidence.work import BLOCKS, Work
from ragg_runtime.whiten import whiten

Array = NDArray[np.float64]

CLIPPED = 5
"""Samples at one and the same extreme value that make a saturated output."""

COARSE = 0.5
"""Quantisation step, in standard deviations of the noise, from which it is reported."""


@dataclass(frozen=True)
class Step:
    """The most likely instant of a step, s since the first sample, and its test."""

    instant: float
    test: Test
    variants: int


def best_step(
    works: Sequence[Work],
    n_base: int,
    given: Sequence[int],
    columns: Sequence[tuple[int, Column]],
    prior: Array,
) -> Step | None:
    """Scan a step effect over the edges of the blocks of one flight.

    ``columns`` are those of the effect acting all the time (positions after the base); ``given`` those of
    effects already chosen; ``prior`` (n_base,) the prior's centre.
    """
    if len(works) != 1 or not columns:
        return None
    fixed = [*range(n_base), *(n_base + n for n in given)]
    moving = [n_base + n for n, _ in columns]
    picked = [design.triangle(t[:, [*fixed, *moving, t.shape[1] - 1]].T) for t in works[0].triangles]
    k = len(fixed)
    best: Step | None = None
    for edge in range(1, BLOCKS):
        stacked = []
        for b, t in enumerate(picked):
            if b < edge:
                t = t.copy()
                t[:, k : k + len(moving)] = 0.0
            stacked.append(t)
        T = likelihood.with_prior(np.vstack(stacked), n_base, prior)
        P = likelihood.project(T, k)
        own = [(n, c) for n, (_, c) in enumerate(columns)]
        floor = np.full(len(own) + 1, likelihood.TESTABLE)
        test = likelihood.test(P, own, floor, float(np.log(2 * BLOCKS)))
        if best is None or test.log_p < best.test.log_p:
            w = works[0]
            best = Step(float(w.observation.record.time[w.edges[edge]]), test, 2 * BLOCKS)
    return best


def refine_step(
    w: Work, Q: Array, residual: Array, rows: Array, instant: float, width: float, rounds: int = 4
) -> float:
    """Move the instant of a step to where it explains most.

    ``rows`` (n, N) are the effect's columns in volts acting all the time; ``Q`` and ``residual`` the
    projected-out basis and the whitened residual.
    """
    r = w.observation.record
    taps = w.noise.filters[0]

    def gain(t: float) -> float:
        X = whiten(np.where(r.time >= t, rows, 0.0), taps, r.valid)
        X = X - (X @ Q) @ Q.T
        U, s, _ = np.linalg.svd(X.T, full_matrices=False)
        U = U[:, s > 1e-6 * s[0]] if s[0] > 0 else U[:, :0]
        return float(np.sum((U.T @ residual) ** 2))

    for _ in range(rounds):
        grid = np.linspace(instant - width, instant + width, 13)
        instant = float(grid[int(np.argmax([gain(t) for t in grid]))])
        width /= 5.0
    return instant


def random_test(sensitivity: Array, residual: Array) -> Test:
    """Whether the residual is larger where ``sensitivity`` is: a score test of the variance.

    Both (rows,) whitened; ``residual`` with model and chosen effects projected out.
    """
    s2 = sensitivity**2
    s2 = s2 - np.mean(s2)
    e2 = residual**2 / np.mean(residual**2) - 1.0
    # the fourth moment of the residual itself, so that heavy tails raise no alarm
    z = float(np.sum(s2 * e2) / np.sqrt(np.sum(s2**2) * np.mean(e2**2)))
    log_p = float(stats.norm.logsf(z))
    return Test(max(z, 0.0) ** 2, 1, log_p, (0,))


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
    values = np.unique(G[valid])
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
