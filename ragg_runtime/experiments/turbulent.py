"""The record of a turbulence experiment: Gaussian noise as the paper describes it, sample by sample.

Section III.C: "we approximate the turbulence with Gaussian noise"; "the random angular velocities are
produced with Gaussian noise; the angular accelerations are the derivative of the angular velocities". Noise
that is independent from sample to sample has no derivative but that of a difference formula, so sampling
rate and formula belong to the set-up, and the paper states neither.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.experiments import paper
from ragg_runtime.experiments.paper import Turbulent
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.reference import Motion, Simulation, instants, simulate
from ragg_runtime.reference.effects import EffectValues
from ragg_runtime.reference.instruments import table_v

Array = NDArray[np.float64]

Derivative = Literal["central", "backward"]

RATE = 20.0
DURATION = 600.0


@dataclass(frozen=True)
class Samples:
    """A signal known at the instants n/rate alone, with its derivative there."""

    frequency: float
    values: Array
    slopes: Array

    def _at(self, time: Array, shift: float) -> NDArray[np.intp]:
        n = np.rint(time * self.frequency).astype(np.intp)
        if shift != 0 or np.any(np.abs(time * self.frequency - n) > 1e-6) or np.any(n >= self.values.size):
            raise UserError(
                "a sampled signal is known at its own instants only", expected="an unshifted record"
            )
        return n

    def value(self, time: Array, shift: float = 0.0) -> Array:
        """Value at ``time``, (N,)."""
        return self.values[self._at(time, shift)]

    def rate(self, time: Array, shift: float = 0.0) -> Array:
        """Derivative at ``time``, (N,), 1/s."""
        return self.slopes[self._at(time, shift)]


def gaussian(
    rng: np.random.Generator, size: int, rate: float, mean: float, std: float, derivative: Derivative
) -> Samples:
    """Independent Gaussian samples; derivative (v[n+1] - v[n-1]) rate/2, or (v[n] - v[n-1]) rate."""
    v = mean + std * rng.standard_normal(size + 2)
    slopes = (v[2:] - v[:-2]) * rate / 2 if derivative == "central" else (v[1:-1] - v[:-2]) * rate
    return Samples(rate, v[1:-1], slopes)


def turbulent_motion(
    rng: np.random.Generator,
    row: Turbulent,
    duration: float,
    rate: float,
    derivative: Derivative = "central",
) -> Motion:
    """A row of Table VII. Components are independent of each other.

    The horizontal accelerations have 15 percent of the vertical one's mean and of its standard deviation.
    """
    size, milli_g = round(duration * rate), 1e-3 * table_v().g0

    def draw(mean: float, std: float, unit: float) -> Samples:
        return gaussian(rng, size, rate, mean * unit, std * unit, derivative)

    a_z = draw(row.a_mean, row.a_std, milli_g)
    mean, std = paper.HORIZONTAL * row.a_mean, paper.HORIZONTAL * row.a_std
    a_x, a_y = draw(mean, std, milli_g), draw(mean, std, milli_g)
    w_x, w_y, w_z = (draw(row.omega_mean, row.omega_std, paper.DEGREE_PER_HOUR) for _ in range(3))
    return Motion((a_x, a_y, a_z), (w_x, w_y, w_z))


def turbulent_run(
    experiment: int,
    seed: int,
    *,
    instrument: Instrument | None = None,
    duration: float = DURATION,
    rate: float = RATE,
    derivative: Derivative = "central",
    effects: EffectValues | None = None,
) -> Simulation:
    """The numerical model in turbulence experiment 1, 2 or 3.

    With one seed the three experiments have the same random numbers, so that only what Table VII changes
    changes.
    """
    if experiment not in (1, 2, 3):
        raise UserError("the paper has three turbulence experiments", found=experiment, expected="1, 2 or 3")
    instants(duration, rate)  # refuses what is no record, before numbers are drawn for it
    rng = np.random.default_rng(seed)
    motion = turbulent_motion(rng, paper.TABLE_VII[experiment - 1], duration, rate, derivative)
    return simulate(
        table_v() if instrument is None else instrument,
        motion,
        duration,
        rate,
        rotations="first-order",
        effects=effects,
        seed=seed,
        auxiliaries={},
    )
