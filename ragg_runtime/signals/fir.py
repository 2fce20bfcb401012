"""FIR filters of long series."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ragg_runtime.base.threads import stretches

Array = NDArray[np.float64]
Floats = TypeVar("Floats", NDArray[np.float64], NDArray[np.float32])

PERIOD = 6
"""Length of the transforms of :func:`convolved` over that of the filter: about there a sample costs least."""

GROUP = 4
"""Columns that are transformed at a time: more leave the cache."""

AT_A_TIME = 1 << 18
"""Points of short ones that are: so many that a call costs little besides."""


SPARSE = 0.5
"""Share of columns that are not zero below which the others are left out, which takes a copy: of a voltage most are those of other
accelerometers.
"""


def not_zero(columns: Floats) -> NDArray[np.bool_]:
    """(n,): which of the columns (n, rows) are not zero: those of channels that were not recorded, and of other outputs, are."""
    begins = np.asarray(columns[:, :1].any(axis=1))
    return np.array([bool(begins[k] or x.any()) for k, x in enumerate(columns)], dtype=np.bool_)


def filtered(columns: Floats, taps: Array, tail: Floats | None = None, lead: int = 0) -> Floats:
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
    own = not_zero(columns) if tail is None else not_zero(columns) | not_zero(tail)
    if np.count_nonzero(own) < SPARSE * len(columns):
        result = np.zeros((len(columns), n - lead), dtype=columns.dtype)
        result[own] = filtered(columns[own], taps, None if tail is None else tail[own], lead)
        return result
    # What goes round in the transform may fall on samples that are not wanted.
    size = fft.next_fast_len(before + n + max(0, reach - 1 - before - lead), real=True)
    gain = fft.rfft(taps[:reach].astype(columns.dtype), size)
    result = np.empty((len(columns), n - lead), dtype=columns.dtype)
    for some in stretches(len(columns), GROUP * max(1, AT_A_TIME // (GROUP * size))):
        if not own[some].any():
            result[some] = 0.0
            continue
        part = columns[some]
        if tail is not None:
            part = np.concatenate([tail[some], part], axis=1)
        waves = fft.rfft(part, size, axis=1)
        waves *= gain
        result[some] = fft.irfft(waves, size, axis=1)[:, before + lead : before + n]
    return result


TOGETHER = 8
"""Blocks of :func:`convolved` that are transformed together: two of them in one go of the processor, all in cache."""

Series = TypeVar("Series", NDArray[np.float64], NDArray[np.complex64], NDArray[np.complex128])


def convolved(x: Series, taps: Array, mode: Literal["valid", "same", "full"] = "valid") -> Series:
    """Series x (..., N), real or complex, convolved with taps (k,) along the last axis, by overlap and save.

    In the series' own precision. ``valid``: N - k + 1 samples, where the filter has seen nothing but the series;
    ``same`` and ``full`` as NumPy's ``convolve``, the series continued by zeros.
    """
    k = len(taps)
    if mode != "valid":
        before = k - 1 - (k - 1) // 2 if mode == "same" else k - 1
        after = (k - 1) // 2 if mode == "same" else k - 1
        x = np.pad(x, [(0, 0)] * (x.ndim - 1) + [(before, after)])
    n = x.shape[-1] - k + 1
    if n < 1:
        return np.empty((*x.shape[:-1], 0), dtype=x.dtype)
    real = not np.iscomplexobj(x)
    forward: Callable[..., Any] = fft.rfft if real else fft.fft
    backward: Callable[..., Any] = fft.irfft if real else fft.ifft
    size = fft.next_fast_len(min(x.shape[-1], max(PERIOD * k, 4096)), real=real)
    gain = forward(taps.astype(x.real.dtype), size)
    found = np.empty((*x.shape[:-1], n), dtype=x.dtype)
    step = size - k + 1
    whole = (n // step) * step
    for some in stretches(n // step, TOGETHER):
        blocks = np.lib.stride_tricks.sliding_window_view(x, size, axis=-1)[..., ::step, :]
        y = backward(forward(blocks[..., some, :], size) * gain, size)[..., k - 1 :]
        found[..., some.start * step : some.stop * step] = y.reshape(*x.shape[:-1], -1)
    if whole < n:
        y = backward(forward(x[..., whole:], size) * gain, size)
        found[..., whole:] = y[..., k - 1 : k - 1 + n - whole]
    return found
