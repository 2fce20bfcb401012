"""What columns leave of a record's output, and how much of the noise they have taken with them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import linalg, signal

from ragg_runtime.fit.disturbances import Disturbance, disturbances
from ragg_runtime.fit.square_root import triangle

Array = NDArray[np.float64]

ROUNDS = 3
"""Most times that lines and jumps are looked for in what is left beside those before."""


@dataclass(frozen=True)
class Left:
    """What columns leave of the last one.

    Attributes
    ----------
    rest
        (rows,): at the valid samples.
    rank
        How many degrees of freedom the columns count as.
    kept
        Share of white noise that they leave at each frequency of the periodogram; empty where that is not asked for.
    found
        Lines and jumps that were fitted beside them.
    """

    rest: Array
    rank: float
    kept: Array
    found: list[Disturbance]


def left_over(
    flat: Array, valid: NDArray[np.bool_], rate: float | None, band: tuple[float, float] | None
) -> Left:
    """What columns leave of the last of flat (n + 1, rows), with lines and jumps in it fitted beside them.

    No line is looked for in ``band``. Without ``rate`` (of a demodulated channel) neither they nor ``kept`` are looked for.
    """
    found: list[Disturbance] = []
    time = np.flatnonzero(valid) / (rate or 1.0)
    wide = flat
    for n in range(ROUNDS + 1):
        fit = _least_squares(wide)
        rest = flat[-1] - fit.solution @ wide[:-1]
        e = np.zeros(len(valid))
        e[valid] = rest
        more = disturbances(e, valid, rate, band) if rate and n < ROUNDS else []
        if not more:
            break
        found += more
        wide = np.vstack([*(d.columns(time) for d in found), flat])
    kept = _kept(wide[:-1], fit.directions, valid) if rate else np.empty(0)
    return Left(rest=rest, rank=fit.rank, kept=kept, found=found)


EVERY = 1024
"""Bins of a periodogram for which the share that columns leave is computed; it is interpolated in between."""


def _kept(columns: Array, directions: Array, valid: NDArray[np.bool_]) -> Array:
    """Share of white noise that is left at each frequency once columns (n, rows) are fitted, gaps counted as lost.

    A fit leaves |v|^2 - |Q'v|^2 of the power along any direction v, with Q what the columns span (their leverage); here v
    is a windowed wave. Without it the noise would look quietest where the columns are: on a record of a minute by three
    times. ``directions`` (n, k): columns times it are Q.
    """
    window = signal.get_window("hann", len(valid))
    bins = len(valid) // 2 + 1
    some = np.unique(np.r_[0 : min(bins, EVERY // 2), np.geomspace(1, bins, EVERY).astype(np.intp) - 1])
    waves = np.empty((len(columns), len(some)), dtype=np.complex128)
    x = np.zeros(len(valid))
    for k, column in enumerate(columns):
        x[valid] = column * window[valid]
        waves[k] = np.fft.rfft(x)[some]
    taken = np.sum(np.abs(directions.T @ waves) ** 2, axis=0)
    left = (np.sum(window[valid] ** 2) - taken) / np.sum(window**2)
    return np.asarray(np.interp(np.arange(bins), some, np.maximum(left, 0.0)))


ABSENT = 1e-11
"""Relative size of a direction of (normalised) columns that is rounding rather than physics."""


@dataclass(frozen=True)
class _Fit:
    """Coefficients (n,), how many they count as, and ``directions`` (n, n): columns times it are orthonormal (or fade)."""

    solution: Array
    rank: float
    directions: Array


def _least_squares(columns: Array) -> _Fit:
    """The fit of columns (n + 1, rows) to the last of them.

    Directions that are numerically absent must not be amplified; they are faded out, not cut off, lest rounding decide
    on which side of an edge one is.
    """
    R = triangle(columns)
    n = len(R) - 1
    norms = np.linalg.norm(R[:, :n], axis=0)
    norms[norms == 0.0] = 1.0
    U, s, Vt = linalg.svd(R[:n, :n] / norms, lapack_driver="gesvd")
    faded = s**2 / (s**2 + (ABSENT * s[0]) ** 2)
    inverse = Vt.T / np.maximum(s, 1e-300) / norms[:, None]
    solution = inverse @ (faded * (U.T @ R[:n, n]))
    lost = np.sqrt(faded * (2.0 - faded))  # what a faded fit takes of the noise's power
    return _Fit(solution=solution, rank=float(np.sum(faded)), directions=inverse * lost)
