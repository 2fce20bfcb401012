"""FIR filters of long series."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ragg_runtime.base.threads import count

Array = NDArray[np.float64]
Floats = TypeVar("Floats", NDArray[np.float64], NDArray[np.float32])

GROUP = 8
"""Columns that are filtered at a time: enough for the threads, few enough for the cache's and memory's sake."""


def filtered(columns: Floats, taps: Array, tail: Floats | None = None, lead: int = 0) -> Floats:
    """Columns (n, N) through a causal FIR filter, in their own precision: (n, N - lead).

    ``tail`` (n, T) holds the samples before them (none: the filter starts from rest); of the result the first
    ``lead`` samples are not wanted.
    """
    n = columns.shape[1]
    before = 0 if tail is None else tail.shape[1]
    if len(taps) == 1:
        return np.asarray(columns[:, lead:] * columns.dtype.type(taps[0]))
    reach = min(before + n, len(taps))
    # What goes round in the transform may fall on samples that are not wanted.
    size = fft.next_fast_len(before + n + max(0, reach - 1 - before - lead), real=True)
    gain = fft.rfft(taps[:reach].astype(columns.dtype), size)
    result = np.empty((len(columns), n - lead), dtype=columns.dtype)
    threads = count()
    for start in range(0, len(columns), GROUP):
        part = columns[start : start + GROUP]
        if tail is not None:
            part = np.concatenate([tail[start : start + GROUP], part], axis=1)
        y = fft.irfft(fft.rfft(part, size, axis=1, workers=threads) * gain, size, axis=1, workers=threads)
        result[start : start + GROUP] = y[:, before + lead : before + n]
    return result
