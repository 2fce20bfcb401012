"""The instrument evaluated directly, in rational numbers: vectors, cross products, four accelerometers.

This is the proof behind the errata, so it imports nothing of the derivation: no symbol, no ring, no
expansion. It evaluates Eq. 1-15 at given numbers, with the order of counting of Eq. 18 and 19:
first-order rotations multiplied out, second-order terms without angles, and beta_z to the first power.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

Vector = tuple[Fraction, Fraction, Fraction]

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
    Gamma: tuple[Vector, Vector, Vector]
    cosine: Fraction
    sine: Fraction


def points(count: int, seed: int) -> tuple[NumericPoint, ...]:
    """Random rational points; the gradient is symmetric and free of trace, the disc angle exact."""
    draw = random.Random(seed)

    def number() -> Fraction:
        return Fraction(draw.choice((-1, 1)) * draw.randint(1, 9), draw.randint(1, 5))

    def vector() -> Vector:
        return number(), number(), number()

    made = []
    for _ in range(count):
        (xx, xy, xz), (yy, yz, _) = vector(), vector()
        half = number()  # tangent of half the disc angle
        made.append(
            NumericPoint(
                {n: tuple(number() for _ in range(4)) for n in ACCELEROMETER_NUMBERS},
                vector(),
                vector(),
                vector(),
                ((xx, xy, xz), (xy, yy, yz), (xz, yz, -xx - yy)),
                (1 - half**2) / (1 + half**2),
                2 * half / (1 + half**2),
            )
        )
    return tuple(made)


def cross(u: Sequence[Fraction], v: Sequence[Fraction]) -> Vector:
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def dot(u: Sequence[Fraction], v: Sequence[Fraction]) -> Fraction:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def combine(*terms: tuple[Fraction | int, Sequence[Fraction]]) -> Vector:
    """Sum of numbers times vectors."""
    x, y, z = (sum((c * v[n] for c, v in terms), Fraction(0)) for n in range(3))
    return x, y, z


_PLACES = ((1, 0), (-1, 0), (0, 1), (0, -1))
"""Cosine and sine of the angles at which A1, A2, A3, A4 sit on the disc."""


def output(p: NumericPoint) -> Fraction:
    """G_out = V_1 + V_2 - V_3 - V_4 (Eq. 15)."""
    V = [_voltage(p, j) for j in range(4)]
    return V[0] + V[1] - V[2] - V[3]


def _voltage(p: NumericPoint, j: int) -> Fraction:
    """V_j with beta_z to the first power: it is of the second degree, so a central difference is exact."""
    b = p.accelerometers["beta_z"][j]
    at_zero = _linear(p, j, Fraction(0))
    first_power = at_zero + (_linear(p, j, b) - _linear(p, j, -b)) / 2
    k = {n: v[j] for n, v in p.accelerometers.items()}
    x, y, z = _force(p, j, Fraction(0), Fraction(0))
    second = k["K2"] * x * x + k["K5"] * y * y + k["K7"] * z * z + k["K4"] * x * z + k["K6"] * x * y
    return first_power + k["k1"] * (k["K0"] + second + k["K8"] * y * z)


def _linear(p: NumericPoint, j: int, beta_z: Fraction) -> Fraction:
    """k1 times f_i of Eq. 3."""
    k = {n: v[j] for n, v in p.accelerometers.items()}
    x, y, z = _force(p, j, k["beta_x"], beta_z)
    return k["k1"] * (x + y * k["vartheta_z"] - z * k["vartheta_y"])


def _force(p: NumericPoint, j: int, beta_x: Fraction, beta_z: Fraction) -> Vector:
    """f_jx, f_jy, f_jz (Eq. 11 and 12)."""
    c, s = _PLACES[j]
    cosine, sine = p.cosine * c - p.sine * s, p.sine * c + p.cosine * s
    up = (Fraction(0), Fraction(0), Fraction(1))
    radial, tangential = (cosine, sine, Fraction(0)), (-sine, cosine, Fraction(0))
    along, around = combine((1, radial), (beta_z, tangential)), combine((1, tangential), (-beta_z, radial))
    r = combine((p.accelerometers["R"][j], combine((1, along), (beta_x, up))))
    attraction = tuple(dot(row, r) for row in p.Gamma)
    f = combine((1, p.a), (1, cross(p.omegadot, r)), (1, cross(p.omega, cross(p.omega, r))), (-1, attraction))
    dipped, down = combine((1, along), (-beta_x, up)), combine((-1, up), (-beta_x, along))
    return dot(f, around), dot(f, dipped), dot(f, down)


def current(p: NumericPoint, j: int, f: Vector) -> Fraction:
    """I_j / K_j1 - K_j0 of Eq. 1 for a force in the nominal frame, its first-order rotations one by one."""
    k = {n: v[j] for n, v in p.accelerometers.items()}
    x, y, z = f
    x, y, z = x, y + k["vartheta_x"] * z, z - k["vartheta_x"] * y
    x, y, z = x - k["vartheta_y"] * z, y, z + k["vartheta_y"] * x
    x, y, z = x + k["vartheta_z"] * y, y - k["vartheta_z"] * x, z
    second = k["K2"] * x * x + k["K5"] * y * y + k["K7"] * z * z + k["K4"] * x * z + k["K6"] * x * y
    return x + second + k["K8"] * y * z


def rates(p: NumericPoint) -> dict[str, Fraction]:
    """The numbers of Eq. 16 by name: omega_x ..., omegadot_x ..., Gamma_xx ..., and omega_im^2."""
    vectors = {"omega": p.omega, "omegadot": p.omegadot}
    named = {f"{n}_{'xyz'[k]}": u[k] for n, u in vectors.items() for k in range(3)}
    named |= {f"Gamma_{'xyz'[i]}{'xyz'[k]}": p.Gamma[i][k] for i in range(3) for k in range(i, 3)}
    return named | {"omega_im^2": dot(p.omega, p.omega)}
