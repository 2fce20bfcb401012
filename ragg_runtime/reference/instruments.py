"""Instruments to simulate: the paper's Table V, a trimmed and a perfect one, and draws about them; noise of accelerometers (Eq. 53)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.fft import irfft, next_fast_len, rfftfreq

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import paper

Array = NDArray[np.float64]

_ARCSEC = np.pi / 180 / 3600
_G0 = 9.8
_MICRO_G = 1e-6 * _G0
_PER_MICRO = 1e-6 / _G0

_SHEET: Mapping[str, tuple[float, Sequence[float], float]] = {
    "dR": (1e-6, (0, 30, 35, 25), 2e-6),
    "beta_x": (_ARCSEC, (21, 14, 17, 19), 2 * _ARCSEC),
    "beta_z": (_ARCSEC, (18, 8, 10, 20), 2 * _ARCSEC),
    "vartheta_x": (_ARCSEC, (0, 0, 0, 0), 2 * _ARCSEC),
    "vartheta_y": (_ARCSEC, (21, 10, 7, 19), 2 * _ARCSEC),
    "vartheta_z": (_ARCSEC, (30, 19, 20, 9), 2 * _ARCSEC),
    "K0": (_MICRO_G, (10, 2, 5, 8), _MICRO_G),
    "K1": (1e-3 / _G0, (10, 11, 11.5, 12), 1e-5 * 1e-2 / _G0),
    "K2": (_PER_MICRO, (5, 1, 8, 7), _PER_MICRO),
    "K4": (_PER_MICRO, (6, 12, 5, 16), _PER_MICRO),
    "K5": (_PER_MICRO, (4, 11, 9, 13), _PER_MICRO),
    "K6": (_PER_MICRO, (3, 12, 8, 10), _PER_MICRO),
    "K7": (_PER_MICRO, (5, 15, 7, 17), _PER_MICRO),
    "K8": (_PER_MICRO, (0, 7, 11, 20), _PER_MICRO),
    "k_VI": (1.0, (1e9, 1e9, 1e9, 1e9), 0.0),
}
"""Table V: unit of a row, its values, and the standard deviation, SI, of a true parameter about its test sheet. The paper gives no
vartheta_x; it leaves the linear terms alone."""


def _instrument(accelerometers: Mapping[str, Array]) -> Instrument:
    return Instrument.build(paper(0.1, 0.25), _G0, accelerometers)


def table_v() -> Instrument:
    """The paper's instrument (Table V): R = 0.1 m, 0.25 Hz, scale factors 10, 11, 11.5 and 12 mA/g."""
    return _instrument({name: unit * np.array(values, float) for name, (unit, values, _) in _SHEET.items()})


def trimmed() -> Instrument:
    """Table V with scale factors matched to 2e-4, as a feedback loop would leave them in flight."""
    return table_v().replace(K1=1e-3 / _G0 * np.array([10, 10.001, 10.0015, 10.002]))


def perfect() -> Instrument:
    """No errors at all: equal scale factors of 10 mA/g, everything else zero."""
    return _instrument({"K1": np.full(4, 1e-2 / _G0), "k_VI": np.full(4, 1e9)})


def perturbed(instrument: Instrument, rng: np.random.Generator, amount: float = 1.0) -> Instrument:
    """True parameters drawn about a test sheet, ``amount`` times as uncertain as such sheets are."""
    drawn = {
        name: values + amount * _SHEET[name][2] * rng.standard_normal(instrument.layout.size)
        for name, values in instrument.accelerometers.items()
    }
    return instrument.replace(**drawn)


@dataclass(frozen=True)
class Noise:
    """Red and white noise of one accelerometer: Phi(f) = alpha f^-b + omega_T (Eq. 53).

    ``alpha``: one-sided density of the red part at 1 Hz, ``omega_T`` of the white one, (m/s^2)^2/Hz; 0 <= b < 4.
    """

    alpha: float = 0.0
    b: float = 0.0
    omega_T: float = 0.0

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
