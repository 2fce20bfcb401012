"""Plausible auxiliary channels: a slow temperature, small roll and pitch of the platform."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.reference.chain import Auxiliary
from ragg_runtime.reference.effects.transducer import REFERENCE_TEMPERATURE
from ragg_runtime.reference.motion import Sinusoids

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Warming:
    """Temperature that settles exponentially from one value to another, with slow swings, K."""

    change: float
    constant: float
    swing: Sinusoids

    def __call__(self, time: Array) -> Array:
        """Temperature at (N,) s."""
        settled = -np.expm1(-time / self.constant)
        return REFERENCE_TEMPERATURE + self.change * settled + self.swing.value(time)


def plausible(
    rng: np.random.Generator,
    *,
    warming: float = 2.0,
    swing: float = 0.1,
    roll: float = 0.02,
    pitch: float = 0.02,
) -> Mapping[str, Auxiliary]:
    """Temperature, roll and pitch of a survey line.

    Parameters
    ----------
    rng
        Draws periods and phases.
    warming
        Total change of temperature, K, with a time constant of 20 minutes.
    swing
        Amplitude of the temperature's slow swings, K.
    roll, pitch
        Standard deviation of what the stabilised platform leaves, rad.
    """
    swings = Sinusoids(
        0.0, swing * np.array([0.7, 0.3]), 1 / rng.uniform(200, 900, 2), rng.uniform(0, 6.28, 2)
    )
    return {
        "temperature": Warming(warming, 1200.0, swings),
        "roll": _attitude(rng, roll).value,
        "pitch": _attitude(rng, pitch).value,
    }


def _attitude(rng: np.random.Generator, spread: float, terms: int = 12) -> Sinusoids:
    frequency = np.sort(np.exp(rng.uniform(np.log(1 / 900), np.log(0.2), terms)))
    amplitude = frequency**-0.5
    amplitude *= spread / np.sqrt(np.sum(amplitude**2) / 2)
    return Sinusoids(0.0, amplitude, frequency, rng.uniform(0, 2 * np.pi, terms))
