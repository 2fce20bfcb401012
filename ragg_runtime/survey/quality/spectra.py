"""Densities, bands and filters of short, perhaps interrupted lines."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, detrend, sosfilt, sosfiltfilt, welch

from ragg_runtime.flight.record import Array

BRIDGED = 0.05
"""Share of a line's samples that may be missing and interpolated; with more there is no figure."""

SEGMENT = 128.0
"""Length of a segment of Welch's method, s: 8 of them fit a line of ten minutes with overlap, and a band from 0.03 Hz
has several bins."""

_AT_ONCE = 1 << 16  # windows whose samples are copied out at once


def filled(values: Array) -> Array | None:
    """Without gaps: short ones are interpolated; ``None`` if too much is missing."""
    there = np.isfinite(values)
    if there.all():
        return values
    if np.mean(~there) > BRIDGED:
        return None
    return np.interp(np.arange(len(values)), np.flatnonzero(there), values[there])


def density(values: Array, rate: float) -> tuple[Array, Array]:
    """Frequencies (Hz) and one-sided power density per Hz by Welch's method; empty if too much is missing."""
    whole = filled(values)
    if whole is None:
        return np.empty(0), np.empty(0)
    size = min(len(whole), max(16, round(SEGMENT * rate)))
    f, p = welch(detrend(whole), fs=rate, nperseg=size)
    return np.asarray(f[1:]), np.asarray(p[1:])


def in_band(values: Array, rate: float, band: tuple[float, float]) -> float:
    """Root of the mean density in a band, unit/sqrt(Hz); NaN where the record has nothing there."""
    f, p = density(values, rate)
    inside = (f >= band[0]) & (f <= band[1])
    return float(np.sqrt(np.mean(p[inside]))) if inside.any() else float("nan")


def band_pass(values: Array, rate: float, low: float, high: float) -> Array | None:
    """Butterworth of fourth order, forward and backward; ``None`` where the band does not fit the rate."""
    whole = filled(values)
    high = min(high, 0.45 * rate)
    if whole is None or high <= 1.2 * low or len(whole) < 64:
        return None
    return np.asarray(sosfiltfilt(_sections(4, low, high, rate), whole - np.mean(whole)))


def causal_band(values: Array, rate: float, low: float, high: float, order: int) -> Array | None:
    """Butterworth run forward alone from rest; ``None`` where the band does not fit the rate."""
    if not 0 < low < high < rate / 2:
        return None
    # In sections: of one polynomial of twelfth order rounding makes 1e15 times the figure at 16 Hz, and at 1 Hz 1e-8 of it.
    return np.asarray(sosfilt(_sections(order, low, high, rate), values))


@lru_cache(maxsize=256)  # of every line the same: to make it takes ten times as long as to use it
def _sections(order: int, low: float, high: float, rate: float) -> Array:
    return np.asarray(butter(order, (low, high), "band", fs=rate, output="sos"))


def rolling_std(values: Array, window: int) -> Array:
    """(N - window,): the standard deviation of each window of samples."""
    if len(values) <= window:
        return np.empty(0)
    windows: NDArray[np.float64] = np.lib.stride_tricks.sliding_window_view(values, window)[:-1]
    stretches = range(0, len(windows), _AT_ONCE)
    return np.concatenate([np.std(windows[s : s + _AT_ONCE], axis=1) for s in stretches])
