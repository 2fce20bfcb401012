"""FIR filters of long series; and the resolution of a column: a converter's, of single precision or of decimal digits."""

from __future__ import annotations

from typing import Literal, TypeVar

import numpy as np
import scipy  # its parts are loaded when they are first used: commands without a flight need none
from numpy.typing import NDArray

from ragg_runtime.base.progress import split_range

Array = NDArray[np.float64]
Floats = TypeVar("Floats", NDArray[np.float64], NDArray[np.float32])

BLOCK = 1 << 18  # numbers that are transformed at a time; longer series are convolved by overlap and add
GROUP = 4  # columns that are transformed at a time: more leave the cache


def find_nonzero(columns: Floats) -> NDArray[np.bool_]:
    """(n,): which of the columns (n, rows) are not all zero; those of missing channels and of other outputs are."""
    begins = np.asarray(columns[:, :1].any(axis=1))
    return np.array([bool(begins[k] or x.any()) for k, x in enumerate(columns)], dtype=np.bool_)


def filter_columns(columns: Floats, taps: Array, tail: Floats | None = None, lead: int = 0) -> Floats:
    """Columns (n, N) through a causal FIR filter, in their own precision: (n, N - lead).

    ``tail`` (n, T) holds the samples before them (none: the filter starts from rest); of the result the first
    ``lead`` samples are not wanted. A filter that changes nothing gives the columns themselves.
    """
    n = columns.shape[1]
    before = 0 if tail is None else tail.shape[1]
    if len(taps) == 1 and taps[0] == 1.0 and lead == 0:
        return columns
    if len(taps) == 1:
        return np.asarray(columns[:, lead:] * columns.dtype.type(taps[0]))
    reach = min(before + n, len(taps))
    nonzero = find_nonzero(columns) if tail is None else find_nonzero(columns) | find_nonzero(tail)
    # What goes round in the transform may fall on samples that are not wanted.
    size = scipy.fft.next_fast_len(before + n + max(0, reach - 1 - before - lead), real=True)
    gain = scipy.fft.rfft(taps[:reach].astype(columns.dtype), size)
    result, places = np.zeros((len(columns), n - lead), dtype=columns.dtype), np.flatnonzero(nonzero)
    for group in split_range(len(places), max(GROUP, BLOCK // size)):
        index = places[group]
        part = columns[index] if tail is None else np.concatenate([tail[index], columns[index]], axis=1)
        waves = scipy.fft.rfft(part, size, axis=1) * gain
        result[index] = scipy.fft.irfft(waves, size, axis=1)[:, before + lead : before + n]
    return result


REACH = 256  # samples on either side from which one that is missing is interpolated
# relative white noise that is added to what is interpolated: the density of a noise may span more than single numbers do
ROUNDING = 1e-9


def place_valid(rest: Array, valid: NDArray[np.bool_]) -> Array:
    """(..., N): of valid samples (..., rows), zero where a sample is not valid."""
    e = np.zeros((*rest.shape[:-1], len(valid)))
    e[..., valid] = rest
    return e


def fill_gaps(columns: Floats, present: NDArray[np.bool_], taps: Array, rounding: float = ROUNDING) -> Floats:
    """Columns (n, N) whose samples that are not ``present`` (N,) are chosen for the least output of the filter.

    On entry they are zero, or a first guess. If the filter whitens a noise, this is its best linear interpolation, and the same as
    fitting each missing value as a parameter (M. Bartlett, J. R. Stat. Soc. Suppl. 4, 1937). Zeros instead would leave the
    noise next to a gap as large as before whitening.
    """
    missing = np.flatnonzero(~present)
    if not len(missing) or len(taps) == 1 or len(missing) == len(present):
        return columns
    w = np.append(taps[: REACH - 1], np.sum(taps[REACH - 1 :]))
    # inner products of the filter's response and itself, later: the noise's inverse covariance
    inverse = np.correlate(w, w, "full")[len(w) - 1 :]
    inverse[0] *= 1.0 + rounding
    apart = np.searchsorted(missing, missing + len(w)) - np.arange(len(missing))
    G = np.zeros((int(np.max(apart)), len(missing)))
    for k in range(len(G)):
        lag = missing[k:] - missing[: len(missing) - k]
        near = lag < len(w)
        G[k, : len(lag)][near] = inverse[lag[near]]
    b = convolve(columns, np.concatenate([inverse[:0:-1], inverse]), "same")[:, missing]
    filled = columns.copy()
    filled[:, missing] -= scipy.linalg.solveh_banded(G, b.T, lower=True).T
    return filled


Series = TypeVar(
    "Series", NDArray[np.float64], NDArray[np.float32], NDArray[np.complex64], NDArray[np.complex128]
)


def convolve(x: Series, taps: Array, mode: Literal["valid", "same", "full"] = "valid") -> Series:
    """Series x (..., N), real or complex, convolved with taps (k,) along the last axis, in the series' own precision.

    ``valid``: N - k + 1 samples, where the filter has seen nothing but the series; ``same`` and ``full``: the series continued
    by zeros.
    """
    from scipy.signal import fftconvolve, oaconvolve  # slow to import

    n, k = x.shape[-1], len(taps)
    if n < k and mode == "valid":
        return np.empty((*x.shape[:-1], 0), dtype=x.dtype)
    rows, kernel = x.reshape(-1, n), taps[None].astype(x.real.dtype)
    result = np.empty((len(rows), {"valid": n - k + 1, "same": n, "full": n + k - 1}[mode]), dtype=x.dtype)
    for group in split_range(len(rows), max(1, BLOCK // n)):
        result[group] = (oaconvolve if n > BLOCK else fftconvolve)(rows[group], kernel, mode, axes=-1)
    return result.reshape(*x.shape[:-1], -1)


LOOKED_AT = 1 << 15  # samples of a column from which its step is found
FEWEST = 8  # different values at least: that so many lie on a grid within OFF by chance has probability 2e-7
REPEATED = 20  # fewer values suffice if each occurs so often on average: no continuous column repeats itself
OFF = 0.1  # part of a step by which values may lie off its multiples, as decimal digits round them
FINEST = 1e-12  # smaller steps, over the range of the column, are rounding of floating-point numbers


def find_step(x: Array) -> float | None:
    """The step of which all values of a column are multiples, but for an offset.

    Parameters
    ----------
    x : (N,) array
        A column, in any unit; values that are not finite do not count.

    Returns
    -------
    float or None
        The step in the column's unit; ``None`` if the values lie on no grid, or are too few.
    """
    sample = x[np.isfinite(x)][:LOOKED_AT]
    values = np.unique(sample)
    if len(values) < 2 or (len(values) < FEWEST and len(sample) < REPEATED * len(values)):
        return None
    span = float(values[-1] - values[0])
    distances = np.sort(np.diff(values))
    distances = distances[distances > FINEST * span]
    step, reach = float(distances[0]), 1.5
    # The closest two give the step to the rounding of two values; wider distances, in whole steps, refine it.
    while True:
        near = distances[distances <= reach * step]
        step = float(np.sum(near) / np.sum(np.rint(near / step)))
        if len(near) == len(distances):
            break
        reach *= 4.0
    places = np.rint((values - values[0]) / step)
    slope, first = np.polyfit(places, values, 1)
    off = np.abs(values - first - slope * places) / slope
    return float(slope) if np.max(off) < OFF and places[-1] < 1 / FINEST else None
