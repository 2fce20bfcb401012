"""Random motion of an aircraft: continuous spectra of several shapes, steady or in bursts."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfftfreq

from ragg_runtime.base.errors import UserError, did_you_mean
from ragg_runtime.reference.motion import RecordedSignal

Array = NDArray[np.float64]


def _resonant(f: Array) -> Array:
    """A broad floor with the phugoid-like and short-period peaks of a light aircraft."""
    peaks = sum(a / (1 + ((f - f0) / width) ** 2) for a, f0, width in ((3.0, 0.12, 0.03), (2.0, 0.7, 0.12)))
    return 0.2 + np.asarray(peaks)


SHAPES: Mapping[str, Callable[[Array], Array]] = {
    "flat": np.ones_like,
    "dryden": lambda f: 1 / (1 + (f / 0.25) ** 2),
    "kolmogorov": lambda f: (0.03**2 + f**2) ** (-5 / 6),
    "resonant": _resonant,
}
"""Power spectral density over frequency (Hz) below the cutoff, up to a factor."""

CUTOFF = 1.2
"""Half-power frequency of the platform's low-pass (48 dB an octave), Hz."""

_NODES_PER_CYCLE = 13
_PAD = 10.0
_BURST_FREQUENCY = 0.015


def _gaussian(rng: np.random.Generator, size: int, rate: float, density: Callable[[Array], Array]) -> Array:
    """A stationary Gaussian record of some power spectral density, unit variance on average."""
    # Longer than needed, so that the end does not run into the beginning.
    period = next_fast_len(size + int(60 * rate), real=True)
    f = rfftfreq(period, 1 / rate)
    amplitude = np.sqrt(density(f))
    noise = rng.standard_normal(f.size) + 1j * rng.standard_normal(f.size)
    record: Array = irfft(amplitude * noise, period)[:size]
    record *= period / np.sqrt(4 * np.sum(amplitude**2))
    return record


def turbulence(
    rng: np.random.Generator,
    duration: float,
    rms: float,
    *,
    mean: float = 0.0,
    shape: str = "dryden",
    bursts: float = 0.0,
) -> RecordedSignal:
    """One component of a random motion, smooth in time.

    ``duration``: of the flight, s; the signal goes on for ten seconds at both ends. ``rms``, ``mean``: SI, met exactly.
    ``shape``: one of ``SHAPES``. ``bursts``: standard deviation of the logarithm of a slowly varying intensity; 0 is
    stationary.
    """
    if shape not in SHAPES:
        raise UserError(
            f"unknown shape of turbulence {shape!r}",
            expected=", ".join(SHAPES),
            remedy=did_you_mean(shape, SHAPES),
        )
    rate = _NODES_PER_CYCLE * CUTOFF
    nodes = -_PAD + np.arange(int((duration + 2 * _PAD) * rate) + 2) / rate
    record = _gaussian(rng, nodes.size, rate, lambda f: SHAPES[shape](f) / (1 + (f / CUTOFF) ** 16))
    if bursts > 0:
        slow = _gaussian(rng, nodes.size, rate, lambda f: 1 / (1 + (f / _BURST_FREQUENCY) ** 16))
        record = record * np.exp(bursts * slow)
    flight = (nodes >= 0.0) & (nodes <= duration)
    record = (record - record[flight].mean()) / record[flight].std()
    return RecordedSignal(nodes, mean + rms * record)
