"""The clocks of the chips: each samples by its own, and what is read of it is up to a millisecond old.

A chip converts every millisecond of its own clock; the board reads all eight every 16 ms of another one, and gets of each what
it converted last. So the age of a sample rises and falls back, a sawtooth of :data:`PERIOD`, as often as the two clocks slip
past each other: a few tenths of a hertz to a few hertz, steady, another one for each chip. The gyroscopes tell it, because all of
them should read the same; for the accelerometers of the same chip it is then known before anything of them is looked at.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from examples.mimu.record import CORNERS, HALF, RATE, Array

PERIOD = 1e-3
"""s between two conversions of a chip: its output rate of 1 kHz."""

SWIFT = 200.0
"""rad/s^2 from which an age can be told from what a gyroscope reads."""

HEAVIEST = 500.0
"""rad/s^2 from which all samples weigh the same in the fit of a clock."""

SLIPS = np.arange(0.02, 8.0, 0.002)
"""Rates at which clocks may slip past each other, Hz, that are tried."""

SEEN = 5
"""Samples about one without a value in which derivatives are guesses."""

JERK = 3e2
"""m/s^3: how large the jerk is, roughly; holds it where the four ages are nearly equal and say nothing of it."""

NOISE = 0.05
"""m/s^2: noise of an accelerometer at rest."""


@dataclass(frozen=True)
class Clock:
    """Of a chip: ``slip`` Hz, ``phase`` turns, ``sign`` of its age's slope; ``share`` of the ages' variance that it explains."""

    slip: float
    phase: float
    sign: float
    share: float

    def age(self, t: Array) -> Array:
        """(N,) s at t (N,) s, about its mean."""
        return self.sign * PERIOD * _saw(self.slip * t + self.phase)


def _saw(turns: Array) -> Array:
    return np.asarray(np.mod(turns, 1.0) - 0.5)


def slope(x: Array) -> Array:
    """Derivative by time of what is sampled at :data:`RATE`, along the first axis."""
    t = np.arange(len(x)) / RATE
    return np.asarray(make_interp_spline(t, x, k=5).derivative()(t))


def ages(rate: Array, good: NDArray[np.bool_]) -> tuple[Array, Array]:
    """(8, n) s: how old what each chip's gyroscopes read is, against the mean of all, at n swift samples; and these (n,).

    Of each chip first its own gains, axes, delay and bias are taken out.
    """
    omega = rate.mean(axis=1)
    alpha = slope(omega)
    swift = np.flatnonzero(good & (np.linalg.norm(alpha, axis=1) > SWIFT))
    found = np.empty((rate.shape[1], len(swift)))
    for k in range(rate.shape[1]):
        left = np.empty_like(omega)
        for i in range(3):
            X = np.column_stack([omega, alpha[:, i], np.ones(len(omega))])
            left[:, i] = rate[:, k, i] - X @ np.linalg.lstsq(X[good], rate[good, k, i], rcond=None)[0]
        found[k] = -np.sum(left * alpha, axis=1)[swift] / np.sum(alpha**2, axis=1)[swift]
    return found, swift


def clocks(rate: Array, good: NDArray[np.bool_]) -> list[Clock]:
    """The clock of each chip, from the rates (N, 8, 3) rad/s alone; ``good`` (N,): samples whose derivatives can be trusted."""
    found, swift = ages(rate, good)
    weight = np.minimum(np.linalg.norm(slope(rate.mean(axis=1))[swift], axis=1), HEAVIEST) ** 2
    return [_clock(swift / RATE, x, weight / np.sum(weight)) for x in found]


def _clock(t: Array, age: Array, weight: Array) -> Clock:
    """The sawtooth nearest to ages (n,) s at t (n,) s: the line of their spectrum, then slip and phase on a fine grid."""
    age = age - weight @ age
    line = np.abs(np.exp(-2j * np.pi * np.outer(SLIPS, t)) @ (weight * age))
    step = 0.1 / (t[-1] - t[0])
    slips = SLIPS[np.argmax(line)] + step * np.arange(-10, 11)
    tried = []
    for slip in slips:
        for phase in np.arange(0.0, 1.0, 0.02):
            saw = _saw(slip * t + phase)
            saw = saw - weight @ saw
            along = float(weight @ (saw * age))
            tried.append((along**2 / float(weight @ saw**2), slip, phase, np.sign(along)))
    best, slip, phase, sign = max(tried)
    return Clock(float(slip), float(phase), float(sign), float(best / (weight @ age**2)))


def at_one_instant(rate: Array, age: Array) -> Array:
    """Rates (N, 8, 3) brought to one instant, by their slopes; ``age`` (N, 8) s."""
    return np.asarray(rate + age[:, :, None] * slope(rate))


def of_back(force: Array, omega: Array, age: Array) -> tuple[Array, Array, Array]:
    """Specific force, angular acceleration and jerk, (N, 3) each, at one instant, by the four of the back and their ages.

    Sample by sample: twelve readings for nine numbers; no derivative of what is sampled too slowly for one. ``force`` (N, 8, 3)
    m/s^2, ``omega`` (N, 3) rad/s, ``age`` (N, 8) s.
    """
    places = HALF * np.array([(x, y, 0.0) for x, y in CORNERS])
    felt = force[:, 1::2] - np.cross(omega[:, None], np.cross(omega[:, None], places))
    rigid = np.concatenate([np.hstack([np.eye(3), -_cross(r)]) for r in places])  # (12, 6)
    late = -np.repeat(age[:, 1::2], 3, axis=1)[:, :, None] * rigid[:, :3]
    X = np.concatenate([np.broadcast_to(rigid, (len(force), 12, 6)), late], axis=2)
    held = np.diag([0.0] * 6 + [(NOISE / JERK) ** 2] * 3)
    normal = np.swapaxes(X, 1, 2) @ X + held
    right = np.einsum("nik,ni->nk", X, felt.reshape(len(force), 12))
    p = np.linalg.solve(normal, right[:, :, None])[:, :, 0]
    return p[:, :3], p[:, 3:6], p[:, 6:]


def _cross(r: Array) -> Array:
    """The matrix of r x."""
    x, y, z = r
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
