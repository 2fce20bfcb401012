"""What the noise of a record is in the demodulated channels, and their measured density."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.fit.observation import Observation
from ragg_runtime.fit.unknown_gradient import spin_frequency
from ragg_runtime.signals.demodulators import Demodulator
from ragg_runtime.signals.derivative import runs
from ragg_runtime.signals.noise_spectrum import Noise
from ragg_runtime.signals.periodogram import periodogram

Array = NDArray[np.float64]

BAND = (0.02, 0.15)
"""Frequencies, Hz, over which a density is averaged: below, the survey's own signal is larger; above, low-passes differ."""

WINDOW = 128.0
"""Length of the windows of a measured density, s."""

GRID = 4001
"""Frequencies at which the noise is integrated."""


def of_noise(o: Observation, noise: Noise, d: Demodulator, k_ggi: float) -> tuple[float, float]:
    """Standard deviations of inline and cross, Eo, that stationary noise of G_out causes; ``k_ggi`` in V/Eo."""
    f = np.linspace(-0.5, 0.5, GRID)
    carrier = 2 * spin_frequency(o)
    passed = np.abs(d.response(f)) ** 2 * noise.psd(np.abs(carrier + f), o.signs)
    cross = float(np.sqrt(np.sum(passed) * (f[1] - f[0]))) / k_ggi
    return 2 * cross, cross


class Density:
    """Mean density of a series over :data:`BAND`, from segment after segment."""

    def __init__(self, rate: float) -> None:
        self.rate = rate
        self.total, self.windows = np.zeros(2), 0.0

    def add(self, g: NDArray[np.complex128]) -> None:
        """Count in inline + i cross; NaN: none."""
        n = int(WINDOW * self.rate)
        for run in runs(np.isfinite(g.real)):
            x = g[run]
            if len(x) < n:
                continue
            count = len(x) // n
            parts = np.stack([x.real, x.imag])[:, : count * n].reshape(2 * count, n)
            slope = np.linspace(-1.0, 1.0, n)
            even = parts - np.outer((parts @ slope) / (slope @ slope), slope)  # what is left of a drift
            f, density = periodogram(even, self.rate)
            p = np.mean(density.reshape(2, count, -1), axis=1)
            inside = (f >= BAND[0]) & (f <= BAND[1])
            self.total += count * np.mean(p[:, inside], axis=1)
            self.windows += count

    def as_json(self) -> dict[str, float | None]:
        if not self.windows:
            return {"inline_Eo_per_rtHz": None, "cross_Eo_per_rtHz": None}
        inline, cross = np.sqrt(self.total / self.windows)
        return {"inline_Eo_per_rtHz": float(inline), "cross_Eo_per_rtHz": float(cross)}
