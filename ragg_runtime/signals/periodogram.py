"""Hann windows and periodograms: of ``scipy.signal``, which takes half a second to import, this is all that fits need."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import fft

Array = NDArray[np.float64]


def hann(n: int) -> Array:
    """(n,): the periodic Hann window."""
    return np.asarray(0.5 + 0.5 * np.cos(np.linspace(-np.pi, np.pi, n + 1))[:-1])


def periodogram(x: Array, rate: float) -> tuple[Array, Array]:
    """Frequencies, Hz, and one-sided density of x (..., N) less its mean, seen through a Hann window."""
    n = x.shape[-1]
    window = hann(n)
    wave = fft.rfft((x - np.mean(x, axis=-1, keepdims=True)) * window)
    power = (wave.real**2 + wave.imag**2) * (1.0 / (rate * np.sum(window**2)))
    power[..., 1 : n // 2 + 1 - (n % 2 == 0)] *= 2.0
    return fft.rfftfreq(n, 1.0 / rate), power
