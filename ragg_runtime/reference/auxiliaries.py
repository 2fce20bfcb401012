"""Plausible auxiliary channels: temperature, pressure, magnetic field, roll and pitch of the platform."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.reference.chain import Auxiliary
from ragg_runtime.reference.effects.transducer import REFERENCE_PRESSURE, REFERENCE_TEMPERATURE
from ragg_runtime.reference.motion import Sinusoids

Array = NDArray[np.float64]


_EARTH_FIELD = (1.5e-5, 1.0e-5, -4.5e-5)
"""Magnetic flux density in the measurement frame, T."""


def plausible(rng: np.random.Generator) -> Mapping[str, Auxiliary]:
    """Temperature, roll, pitch, pressure and magnetic field of a survey line.

    It warms by 2 K with a time constant of 20 minutes, and swings slowly by 0.1 K.
    """
    swings = Sinusoids(0.0, 0.1 * np.array([0.7, 0.3]), 1 / rng.uniform(200, 900, 2), rng.uniform(0, 6.28, 2))

    def warming(time: Array) -> Array:
        return REFERENCE_TEMPERATURE + 2.0 * -np.expm1(-time / 1200.0) + swings.value(time)

    return {
        "temperature": warming,
        "roll": _attitude(rng).value,
        "pitch": _attitude(rng).value,
        "pressure": _slow(rng, REFERENCE_PRESSURE - 3000.0, 300.0).value,
        **{f"B_{k}": _slow(rng, mean, 2e-6).value for k, mean in zip("xyz", _EARTH_FIELD, strict=True)},
    }


def further(rng: np.random.Generator) -> Mapping[str, Auxiliary]:
    """What only some carriers record: heading, fuel on board, levels of vibration above the recorder's bandwidth, loops' currents."""
    burning = rng.uniform(0.02, 0.06)  # kg/s
    return {
        "yaw": _slow(rng, float(rng.uniform(-3.0, 3.0)), 0.5).value,
        "fuel_mass": lambda time: np.asarray(500.0 - burning * time),
        "vibration_rms": _slow(rng, 0.5, 0.1).value,
        "angular_vibration_rms": _slow(rng, 1e-4, 2e-5).value,
        "balance_current": lambda time: np.asarray(-1e-3 * np.expm1(-time / 400.0)),  # a loop that settles
        "second_order_current": lambda time: np.asarray(-1e-3 * np.expm1(-time / 250.0)),
    }


def _slow(rng: np.random.Generator, mean: float, amplitude: float) -> Sinusoids:
    """A mean and three slow sinusoids, SI."""
    return Sinusoids(mean, amplitude * np.ones(3), 1 / rng.uniform(100, 900, 3), rng.uniform(0, 6.28, 3))


def _attitude(rng: np.random.Generator) -> Sinusoids:
    """Twelve sinusoids of 0.02 rad rms, slow ones larger."""
    frequency = np.sort(np.exp(rng.uniform(np.log(1 / 900), np.log(0.2), 12)))
    amplitude = frequency**-0.5
    amplitude *= 0.02 / np.sqrt(np.sum(amplitude**2) / 2)
    return Sinusoids(0.0, amplitude, frequency, rng.uniform(0, 2 * np.pi, 12))
