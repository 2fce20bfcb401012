"""The true motion of the disc centre as smooth functions of time, with derivatives, at any instant; how a disc turns.

A signal takes time and shift apart, so that nanoseconds survive.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import PPoly, make_interp_spline

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference.geometry import Taylor

Array = NDArray[np.float64]

_SPLITTER = float(2**27 + 1)


def _halves(x: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Veltkamp's split of a double into two that carry at most 26 bits each."""
    scaled = _SPLITTER * x
    high = scaled - (scaled - x)
    return high, x - high


def turns(frequency: ArrayLike, time: ArrayLike) -> NDArray[np.float64]:
    """Fractional part of frequency (Hz) * time (s), between -0.5 and 0.5, to one rounding.

    The rounding error of the product is recovered (Dekker 1971) before whole turns are dropped.
    """
    f = np.asarray(frequency, dtype=np.float64)
    t = np.asarray(time, dtype=np.float64)
    product = f * t
    f_high, f_low = _halves(f)
    t_high, t_low = _halves(t)
    error = ((f_high * t_high - product) + f_high * t_low + f_low * t_high) + f_low * t_low
    return np.asarray((product - np.rint(product)) + error, dtype=np.float64)


def disc_angle(frequency: float, time: ArrayLike, shift: float = 0.0) -> NDArray[np.float64]:
    """Angle 2 pi f (time - shift), (N,) rad, of the disc from A1's position on the x axis; ``time`` (N,) s,
    ``frequency`` Hz.

    The ``shift``, s, is kept separate: added to thousands of seconds, nanoseconds would be lost.
    """
    return 2 * np.pi * (turns(frequency, time) - turns(frequency, shift))


class Signal(Protocol):
    """A smooth scalar function of time."""

    def __call__(self, time: Array, shift: float = 0.0, derivative: int = 0) -> Array:
        """Value at ``time - shift``, (N,) s, or a derivative of this order, per s, s^2 ..."""
        ...


@dataclass(frozen=True)
class Sinusoids:
    """mean + sum of amplitude * sin(2 pi frequency t + phase); (K,) each: SI unit, Hz, rad."""

    mean: float = 0.0
    amplitude: Sequence[float] | Array = ()
    frequency: Sequence[float] | Array = ()
    phase: Sequence[float] | Array = ()

    def __call__(self, time: Array, shift: float = 0.0, derivative: int = 0) -> Array:
        """Value or derivative at ``time - shift``, (N,)."""
        A, f, phase = (np.asarray(v, dtype=np.float64) for v in (self.amplitude, self.frequency, self.phase))
        mean = 0.0 if derivative else self.mean
        if A.size == 0:
            return np.full(time.shape, mean)
        A = (2 * np.pi * f) ** derivative * A
        phase = phase - 2 * np.pi * turns(f, shift) + derivative * np.pi / 2
        waves = np.sin(2 * np.pi * turns(f[:, None], time) + phase[:, None])
        return np.asarray(mean + A @ waves)


@dataclass(frozen=True)
class RecordedSignal:
    """A record, ``time`` (M,) s, M >= 6, ``samples`` (M,) SI, interpolated by a quintic spline. The spline *is* the motion."""

    time: Array
    samples: Array

    @cached_property
    def _pieces(self) -> tuple[Array, Array]:
        """Knots (n + 1,) and coefficients (6, n); the spline repeats its end knots, and those pieces are empty."""
        pieces = PPoly.from_spline(make_interp_spline(self.time, self.samples, k=5).tck)
        nonempty = np.diff(pieces.x) > 0
        return np.append(pieces.x[:-1][nonempty], pieces.x[-1]), pieces.c[:, nonempty]

    def __call__(self, time: Array, shift: float = 0.0, derivative: int = 0) -> Array:
        """Value or derivative at ``time - shift``, (N,)."""
        knots, c = self._pieces
        reach = (self.time[-1] - self.time[0]) / (self.time.size - 1)
        if time.size and (time.min() < knots[0] - reach or time.max() > knots[-1] + reach):
            raise UserError(
                "the recorded motion does not cover the simulated time",
                found=f"{time.min():g} to {time.max():g} s",
                expected=f"within {knots[0]:g} to {knots[-1]:g} s",
                remedy="simulate a shorter flight, or another start",
            )
        piece = np.clip(np.searchsorted(knots, time - shift, side="right") - 1, 0, knots.size - 2)
        # The difference to the knot is exact, so a shift of nanoseconds is not rounded away.
        x = (time - knots[piece]) - shift
        powers = np.arange(c.shape[0] - 1, derivative - 1, -1)
        total = np.zeros(time.shape)
        for n, row in zip(powers, c, strict=False):
            total = total * x + math.perm(int(n), derivative) * row[piece]
        return total


@dataclass(frozen=True)
class MotionState:
    """Motion of the disc centre, all (3, N): a in m/s^2, omega in rad/s, omegadot in rad/s^2."""

    a: Array
    omega: Array
    omegadot: Array


@dataclass(frozen=True)
class MotionSignals:
    """Specific force of the disc centre (f_cmm) and angular rate of the measurement frame, by axis."""

    a: tuple[Signal, Signal, Signal]
    omega: tuple[Signal, Signal, Signal]

    def at(self, time: ArrayLike, shift: float = 0.0) -> MotionState:
        """The motion at ``time - shift``; omegadot is the derivative of omega."""
        t = np.atleast_1d(np.asarray(time, dtype=np.float64))
        return MotionState(
            np.stack([s(t, shift) for s in self.a]),
            np.stack([s(t, shift) for s in self.omega]),
            np.stack([s(t, shift, 1) for s in self.omega]),
        )


def still(a: Sequence[float] = (0.0, 0.0, 0.0)) -> MotionSignals:
    """Constant specific force, m/s^2, without rotation."""
    ax, ay, az = (Sinusoids(float(v)) for v in a)
    return MotionSignals((ax, ay, az), (Sinusoids(), Sinusoids(), Sinusoids()))


def recorded_motion(time: ArrayLike, a: ArrayLike, omega: ArrayLike) -> MotionSignals:
    """Motion through a record: time (M,) s, a (3, M) m/s^2, omega (3, M) rad/s."""
    t = np.asarray(time, dtype=np.float64)
    ax, ay, az = (RecordedSignal(t, v) for v in np.asarray(a, dtype=np.float64))
    wx, wy, wz = (RecordedSignal(t, v) for v in np.asarray(omega, dtype=np.float64))
    return MotionSignals((ax, ay, az), (wx, wy, wz))


@dataclass(frozen=True)
class Turning:
    """Angle 2 pi frequency t + start + swing, rad.

    ``frequency``: Hz; negative: backwards; 0 with a swing: to and fro. ``swing``: rad, what a disc does beyond turning steadily.
    """

    frequency: float
    swing: Signal | None = None
    start: float = 0.0

    @classmethod
    def of_record(cls, time: Array, angle: Array) -> Turning:
        """As an encoder saw it: ``angle`` (N,) rad, in which whole turns may be missing, at ``time`` (N,) s."""
        unwrapped = np.unwrap(angle)
        frequency = float((unwrapped[-1] - unwrapped[0]) / (time[-1] - time[0]) / (2 * np.pi))
        steady = 2 * np.pi * frequency * (time - time[0])
        rest = RecordedSignal(time, unwrapped - unwrapped[0] - steady)
        return cls(frequency, rest, float(angle[0] - 2 * np.pi * turns(frequency, time[0])))

    def at(self, time: Array, delay: float = 0.0) -> Taylor:
        """The angle and its rates at ``time - delay``, (N,) s; whole turns of the steady part are dropped."""
        phi = disc_angle(self.frequency, time, delay)
        steady = np.full(time.shape, 2 * np.pi * self.frequency)
        angle = Taylor(phi + self.start if self.start else phi, steady, np.zeros(time.shape))
        if self.swing is None:
            return angle
        value, rate, acceleration = (self.swing(time, delay, n) for n in range(3))
        return angle + Taylor(value, rate, acceleration)

    def encoder(self, time: Array) -> Array:
        """What an encoder reads, (N,) rad, between -pi and pi."""
        return np.asarray(np.angle(np.exp(1j * self.at(time).value)))
