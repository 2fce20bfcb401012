"""From when on a model no longer holds: a sequential test with bounded false-alarm rate.

Block after block, the residual is predicted from those before (recursive residuals: R. Brown, J. Durbin, J. Evans, J. R. Stat. Soc.
B 37, 1975); e-values E_b of the innovations are joined by the e-detector of Shin, Ramdas and Rinaldo (New Engl. J. Stat. Data Sci.
2, 2024), M_b = E_b max(1, M_(b-1)), which exceeds c in B blocks with probability at most B / c if nothing changes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular
from scipy.special import logsumexp

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.least_squares import add_prior, compute_r_factor

Array = NDArray[np.float64]

WIDE = 100.0
"""Prior standard deviation of the parameters before the first block, in those of the sheet: that the sheet was wrong is no change."""

SIZES = np.logspace(-1.0, 8.0, 19)
"""Variance that a change adds to innovations, in that of the noise: averaged over."""

KNOWN = 200
"""Samples that the noise of the whole flight counts as where a block tells its own level."""


@dataclass(frozen=True)
class ChangePoint:
    """Where the model ceased to hold: ``until`` the end of the last block of time in which it held, s of the flight's ``time``."""

    flight: str
    until: float


def find_change(f: Fitted) -> ChangePoint | None:
    """Follow the model through its flights; ``None`` where it holds to the end, or never held."""
    blocks = list(_blocks(f))
    limit = np.log(max(1, len(blocks)) / false_alarms.CHANGE)
    log_m, since = 0.0, 0
    for n, b in enumerate(blocks):
        if log_m <= 0.0:
            since = n
        log_m = max(0.0, log_m) + log_e(b.base, b.further)
        if log_m > limit and since:
            return ChangePoint(blocks[since].flight, blocks[since].start)
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


@dataclass(frozen=True)
class _TimeBlock:
    """Innovations of a block of time, from ``start`` on, s: along the base columns, and along candidates beyond them."""

    flight: str
    start: float
    base: Array
    further: Array


def _blocks(f: Fitted) -> Iterator[_TimeBlock]:
    n = f.n_base
    nothing = np.zeros((n + 1, n + 1))
    known = add_prior(nothing, range(n), f.to_nominal / WIDE)
    known[:, :n] /= WIDE  # it holds the prior's rows alone: WIDE times as wide
    for x, r_factors in zip(f.prepared, f.r_factors, strict=True):
        r = x.observation.record
        for T, (first, last) in zip(r_factors, pairwise(x.edges), strict=True):
            samples = int(np.sum(r.valid[first:last])) * len(x.observation.series)
            if not samples:
                continue
            free = max(0, samples - T.shape[1])
            level = float(np.sqrt((T[-1, -1] ** 2 + KNOWN) / (free + KNOWN)))
            own = np.column_stack([T[:n, :n], T[:n, -1]]) / level
            z = _compute_innovations(known, own)
            known = compute_r_factor(np.vstack([known, own]).T)
            further = T[n:-1, -1][np.diag(T)[n:-1] != 0.0] / level
            yield _TimeBlock(x.observation.name, float(r.time[first]), base=z, further=further)


def _compute_innovations(known: Array, own: Array) -> Array:
    """(n,): what a block's rotated data differ by from what is known, standardised by both uncertainties."""
    n = own.shape[1] - 1
    S = known[:n, :n]
    expected = solve_triangular(S, known[:n, n])
    V = solve_triangular(S, own[:, :n].T, trans="T")
    R = np.linalg.qr(np.vstack([np.eye(len(own)), V]), mode="r")  # R'R = 1 + V'V, without squaring V
    return np.asarray(solve_triangular(R, own[:, n] - own[:, :n] @ expected, trans="T"))
