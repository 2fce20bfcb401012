"""Density over time and frequency: where in time a residual has which lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

COLUMNS = 240
"""Most instants of a spectrogram."""

ROWS = 160
"""Most frequencies of a spectrogram."""

RESOLUTION = 0.25
"""Width of a bin over the spin frequency, at most: neighbouring multiples must stay apart."""

LEAST = 0.9
"""Share of the samples under a window that must be valid."""


@dataclass(frozen=True)
class Spectrogram:
    """Amplitude densities, unit/sqrt(Hz), (frequencies, instants); NaN where too little is valid."""

    time: Array
    frequency: Array
    density: Array


def spectrogram(
    x: Array, valid: NDArray[np.bool_], rate: float, start: float, spin: float, highest: float
) -> Spectrogram | None:
    """Of samples from ``start`` (s) on, up to a frequency (Hz); ``None`` if they are too few for one window."""
    n = len(x)
    size = int(min(rate / (RESOLUTION * spin) * 2, n / 3)) if n else 0
    if size < 16:
        return None
    hop = max(1, size // 4, -(-(n - size) // COLUMNS))
    starts = np.arange(0, n - size + 1, hop)
    window = np.hanning(size)
    scale = 2.0 / (rate * float(np.sum(window**2)))
    f: Array = np.asarray(np.fft.rfftfreq(size, 1.0 / rate), dtype=np.float64)
    kept = (f > 0.0) & (f <= highest)
    density = np.full((int(np.sum(kept)), len(starts)), np.nan)
    for k, a in enumerate(starts):
        v = valid[a : a + size]
        share = float(np.mean(v))
        if share >= LEAST:
            y = np.where(v, x[a : a + size], 0.0)
            p = np.abs(np.fft.rfft((y - np.mean(y)) * window)[kept]) ** 2
            density[:, k] = p * scale / share
    f = f[kept]
    by = -(-len(f) // ROWS)
    if by > 1:
        edges = np.arange(0, len(f) - by + 1, by)
        density = np.add.reduceat(density, edges, axis=0)[: len(edges)] / by
        f = f[edges] + 0.5 * (by - 1) * (f[1] - f[0])
    return Spectrogram(
        time=np.asarray(start + (starts + 0.5 * size) / rate, dtype=np.float64),
        frequency=np.asarray(f, dtype=np.float64),
        density=np.sqrt(density),
    )
