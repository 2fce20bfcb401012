"""The instrument evaluated directly, in rational numbers: vectors, cross products, four accelerometers.

This is the proof behind the errata, so it imports nothing of the derivation: no symbol, no ring, no
expansion. It evaluates Eq. 1-15 at given numbers, with the order of counting of Eq. 18 and 19:
first-order rotations multiplied out, second-order terms without angles, and beta_z to the first power.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[Any]
"""(3,) or (3, 3) of :class:`Fraction`."""

ACCELEROMETER_NUMBERS = (
    "k1", "R", "beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z",
    "K0", "K2", "K4", "K5", "K6", "K7", "K8",
)  # fmt: skip


@dataclass(frozen=True)
class NumericPoint:
    """Numbers to evaluate at: an accelerometer's (four of each), the motion's, and a disc angle."""

    accelerometers: Mapping[str, tuple[Fraction, ...]]
    a: Vector
    omega: Vector
    omegadot: Vector
    Gamma: Vector
    cosine: Fraction
    sine: Fraction

    def of(self, j: int) -> dict[str, Fraction]:
        """The numbers of one accelerometer."""
        return {n: v[j] for n, v in self.accelerometers.items()}


def points(count: int, seed: int) -> tuple[NumericPoint, ...]:
    """Random rational points; the gradient is symmetric and free of trace, the disc angle exact."""
    draw = random.Random(seed)

    def number() -> Fraction:
        return Fraction(draw.choice((-1, 1)) * draw.randint(1, 9), draw.randint(1, 5))

    def vector() -> Vector:
        return np.array([number() for _ in range(3)])

    sample = []
    for _ in range(count):
        (xx, xy, xz), (yy, yz, _) = vector(), vector()
        half = number()  # tangent of half the disc angle
        sample.append(
            NumericPoint(
                {n: tuple(number() for _ in range(4)) for n in ACCELEROMETER_NUMBERS},
                vector(),
                vector(),
                vector(),
                np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, -xx - yy]]),
                (1 - half**2) / (1 + half**2),
                2 * half / (1 + half**2),
            )
        )
    return tuple(sample)


_PLACES = ((1, 0), (-1, 0), (0, 1), (0, -1))
"""Cosine and sine of the angles at which A1, A2, A3, A4 sit on the disc."""


def output(p: NumericPoint) -> Fraction:
    """G_out = V_1 + V_2 - V_3 - V_4 (Eq. 15)."""
    V = [_voltage(p, j) for j in range(4)]
    return V[0] + V[1] - V[2] - V[3]


def _voltage(p: NumericPoint, j: int) -> Fraction:
    """V_j with beta_z to the first power: it is of the second degree, so a central difference is exact."""
    k = p.of(j)
    b = k["beta_z"]
    first_power = _linear(p, j, Fraction(0)) + (_linear(p, j, b) - _linear(p, j, -b)) / 2
    return first_power + k["k1"] * (k["K0"] + _second_order(k, _force(p, j, Fraction(0), Fraction(0))))


def _linear(p: NumericPoint, j: int, beta_z: Fraction) -> Fraction:
    """k1 times f_i of Eq. 3."""
    k = p.of(j)
    x, y, z = _force(p, j, k["beta_x"], beta_z)
    return k["k1"] * (x + y * k["vartheta_z"] - z * k["vartheta_y"])


def _second_order(k: Mapping[str, Fraction], f: Vector) -> Fraction:
    x, y, z = f
    squares = k["K2"] * x * x + k["K5"] * y * y + k["K7"] * z * z
    return Fraction(squares + k["K4"] * x * z + k["K6"] * x * y + k["K8"] * y * z)


def _force(p: NumericPoint, j: int, beta_x: Fraction, beta_z: Fraction) -> Vector:
    """f_jx, f_jy, f_jz (Eq. 11 and 12)."""
    c, s = _PLACES[j]
    cosine, sine = p.cosine * c - p.sine * s, p.sine * c + p.cosine * s
    radial, tangential, up = np.array([cosine, sine, 0]), np.array([-sine, cosine, 0]), np.array([0, 0, 1])
    along, around = radial + beta_z * tangential, tangential - beta_z * radial
    r = p.accelerometers["R"][j] * (along + beta_x * up)
    f = p.a + np.cross(p.omegadot, r) + np.cross(p.omega, np.cross(p.omega, r)) - p.Gamma @ r
    return np.array([f @ around, f @ (along - beta_x * up), f @ (-up - beta_x * along)])


def current(p: NumericPoint, j: int, f: Vector) -> Fraction:
    """I_j / K_j1 - K_j0 of Eq. 1 for a force in the nominal frame, its first-order rotations one by one."""
    k = p.of(j)
    x, y, z = f
    x, y, z = x, y + k["vartheta_x"] * z, z - k["vartheta_x"] * y
    x, y, z = x - k["vartheta_y"] * z, y, z + k["vartheta_y"] * x
    x, y, z = x + k["vartheta_z"] * y, y - k["vartheta_z"] * x, z
    return Fraction(x + _second_order(k, np.array([x, y, z])))


def rates(p: NumericPoint) -> dict[str, Fraction]:
    """The numbers of Eq. 16 by name: omega_x ..., omegadot_x ..., Gamma_xx ..., and omega_im^2."""
    vectors = {"omega": p.omega, "omegadot": p.omegadot}
    named = {f"{n}_{'xyz'[k]}": u[k] for n, u in vectors.items() for k in range(3)}
    named |= {f"Gamma_{'xyz'[i]}{'xyz'[k]}": p.Gamma[i, k] for i in range(3) for k in range(i, 3)}
    return named | {"omega_im^2": p.omega @ p.omega}
