"""Accelerometer noise with the power spectral density of Eq. 53."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.fft import irfft, next_fast_len, rfftfreq

from ragg_runtime.base.errors import UserError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Noise:
    """Red and white noise of one accelerometer: Phi(f) = alpha f^-b + omega_T (Eq. 53).

    ``alpha``: one-sided density of the red part at 1 Hz, ``omega_T`` of the white one, (m/s^2)^2/Hz; 0 <= b < 4, else
    UserError.
    """

    alpha: float = 0.0
    b: float = 0.0
    omega_T: float = 0.0

    def __post_init__(self) -> None:
        for name in ("alpha", "omega_T"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise UserError(f"the noise density {name} must not be negative", found=value)
        if not 0 <= self.b < 4:
            raise UserError(
                "the exponent b of the noise density is out of range", found=self.b, expected="0 <= b < 4"
            )

    def psd(self, frequency: ArrayLike) -> Array:
        """One-sided density at frequencies > 0 Hz, (m/s^2)^2/Hz."""
        f = np.asarray(frequency, dtype=np.float64)
        return np.asarray(self.alpha * f**-self.b + self.omega_T, dtype=np.float64)

    def sample(self, rng: np.random.Generator, size: int, rate: float) -> Array:
        """Draw a record, (size,) m/s^2, at ``rate`` Hz.

        The red part is half of a periodic record twice as long; it holds no power below rate/(2 size).
        """
        record: Array = np.sqrt(self.omega_T * rate / 2) * rng.standard_normal(size)
        if self.alpha == 0 or size == 0:
            return record
        period = next_fast_len(2 * size, real=True)
        f = rfftfreq(period, 1 / rate)
        density = np.zeros(f.size)
        density[1:] = self.alpha * f[1:] ** -self.b
        # A one-sided density S is E|X_k|^2 = S rate period / 2 for the unnormalised transform.
        scale = np.sqrt(density * rate * period / 4)
        spectrum = scale * (rng.standard_normal(f.size) + 1j * rng.standard_normal(f.size))
        if period % 2 == 0:
            # Nyquist has no imaginary part; its real part carries all of the power.
            spectrum[-1] = np.sqrt(2) * spectrum[-1].real
        record += irfft(spectrum, period)[:size]
        return record


def eotvos_noise(density: float, radius: float, red_corner: float = 0.0) -> Noise:
    """White accelerometer noise that gives the demodulated cross channel a ``density`` in s^-2/sqrt(Hz), ``radius`` in
    m, and below ``red_corner``, Hz, stronger 1/f noise.

    n = sqrt(2) R density, m/s^2/sqrt(Hz). The inline channel, a difference, has twice the cross channel's.
    """
    white = 2 * (radius * density) ** 2
    return Noise(alpha=red_corner * white, b=1.0, omega_T=white)
