"""A random walk beneath white noise whose level changes: made white by a Kalman filter.

A drift does not become stronger where an amplifier's white noise does. Neither a level that multiplies all noise nor one of what is
new in each sample describes their sum; the innovations of a Kalman filter that knows both are white, of unit variance, sample by
sample (R. Kalman, J. Basic Eng. 82, 1960; A. Harvey, Forecasting, Structural Time Series Models, 1989, section 3.4).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from ragg_runtime.base.progress import split_range
from ragg_runtime.signals.fir import Floats

Array = NDArray[np.float64]

TOGETHER = 64  # columns that are filtered at a time


@dataclass(frozen=True)
class DriftingNoise:
    """A random walk, and the white noise upon it.

    Attributes
    ----------
    decay
        What is left of it after a sample: it forgets where it was after four times the length of the flight.
    power
        Variance of what is new in each sample, V^2.
    white
        Standard deviation of the white noise where its level is one, V.
    """

    decay: float
    power: float
    white: float

    def psd(self, f: Array, rate: float) -> Array:
        """One-sided density at frequencies f, Hz, with white noise of level one, V^2/Hz."""
        wave = np.exp(-2j * np.pi * f / rate)
        return np.asarray(2.0 / rate * (self.white**2 + self.power / np.abs(1.0 - self.decay * wave) ** 2))

    def whiten(
        self, columns: Floats, level: Array, valid: NDArray[np.bool_], past: Past | None, lead: int
    ) -> tuple[Array, Past]:
        """Columns (n, N) less what is predicted from the samples before, over its standard deviation: (n, N - lead), and what the filter
        needs to go on. What is not ``valid`` (N,) is not looked at; ``level`` (N,) is that of the white noise.
        """
        gain, size, variance = self._compute_gains(level, valid, past)
        bands = self._make_bands(gain)
        white, states = np.empty((len(columns), len(gain) - lead)), np.empty(len(columns))
        for rows in split_range(len(columns), TOGETHER):
            y = columns[rows].astype(np.float64)
            driven = np.zeros_like(y)
            driven[:, 0] = 0.0 if past is None else past.states[rows]
            driven[:, 1:] = self.decay * gain[:-1] * y[:, :-1]
            predicted = lapack.dtbtrs(bands, driven.T, uplo="L", overwrite_b=1)[0].T
            new = y - predicted
            white[rows] = (new / size)[:, lead:]
            states[rows] = self.decay * (predicted[:, -1] + gain[-1] * new[:, -1])
        return white, Past(states, variance)

    def whiten_back(self, white: Array, level: Array, valid: NDArray[np.bool_]) -> Array:
        """(N,): whitened samples (N,) through the transposed filter: its product with a column is that of the whitened column."""
        gain, size, _ = self._compute_gains(level, valid, None)
        total = white / size
        x = lapack.dtbtrs(self._make_bands(gain), -total[:, None], uplo="L", trans="T")[0][:, 0]
        total[:-1] += self.decay * gain[:-1] * x[1:]
        return total

    def measure_log_size(self, level: Array, valid: NDArray[np.bool_]) -> float:
        """Sum of the logarithms of the standard deviations, V, of what is new in each valid sample (N,)."""
        return float(np.sum(np.log(self._compute_gains(level, valid, None)[1][valid])))

    def _compute_gains(
        self, level: Array, valid: NDArray[np.bool_], past: Past | None
    ) -> tuple[Array, Array, float]:
        """(N,) each: how far what is new in a sample moves the walk, and the standard deviation of that; the walk's variance at the end."""
        P = self.power / (1.0 - self.decay**2) if past is None else past.variance
        gain, variance = [], []
        for d in np.where(valid, (self.white * level) ** 2, np.inf).tolist():
            variance.append(P + d)
            gain.append(P / (P + d))
            P = self.decay**2 * (1.0 - gain[-1]) * P + self.power
        return np.array(gain), np.sqrt(variance), P

    def _make_bands(self, gain: Array) -> Array:
        """(2, N), lower: x_(n+1) - decay (1 - gain_n) x_n."""
        return np.stack([np.ones_like(gain), self.decay * (gain - 1.0)])


@dataclass(frozen=True)
class Past:
    """Where a Kalman filter is after a segment: ``states`` (n,) of the columns, predicted, and their ``variance``."""

    states: Array
    variance: float
