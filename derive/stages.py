"""The five stages of the paper's instrument, as SymPy expressions (Eq. 1-3 and 7-15).

Exact in the angles when asked; otherwise truncated by an explicit :class:`Order`. Nothing here is
expanded: a stage takes the numbers of the stage before and gives its own.

Axes and signs. Measurement frame x, y, z (z along the spin axis). Accelerometer j sits at
disc angle psi; e_r = (cos psi, sin psi, 0), e_t = (-sin psi, cos psi, 0). Its nominal frame has x along
e_t (sense of rotation) and y along e_r (outward, Section II.A.1), so that, being right-handed, its z
points *down*, along -e_z: this is what the a_z terms of Eq. 19 require. The altitude angle beta_x lifts
the *position* towards +z, while the *triad* is turned by +beta_x about its own x axis, which dips tau_y:
this, too, is what Eq. 19 requires (see the audit for the proof of both).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

import sympy as sp

Vector: TypeAlias = sp.Matrix


@dataclass(frozen=True)
class Order:
    """How small quantities are counted.

    Attributes
    ----------
    rotation
        Power of its own angle to which every elementary mounting rotation is expanded
        (1: sin x -> x, cos x -> 1, products of different angles are kept); ``None``: exact.
    misalignment
        Total power of the angles vartheta to which the matrix C is expanded (1 is Eq. 2);
        ``None``: exact, composed as in Section II.A.1.
    second_order_angles
        Whether mounting and misalignment angles are kept inside the second-order terms.
        The paper drops them below Eq. 5b, because K vartheta f^2 is of the order of 1e-12 g.
    """

    rotation: int | None = 1
    misalignment: int | None = 1
    second_order_angles: bool = False


PAPER = Order()
EXACT = Order(rotation=None, misalignment=None, second_order_angles=True)

Kinematics: TypeAlias = Literal["platform", "full"]
"""Whose rotation the accelerometers feel: ``platform``, that of the measurement frame alone (Eq. 9 and 49);
``full``, that of the disc on which they ride, which turns against it."""


class Motion(NamedTuple):
    """Stage 1, at the disc centre: a (3), omega (3), omegadot (3), Gamma (3 x 3, symmetric)."""

    a: Vector
    omega: Vector
    omegadot: Vector
    Gamma: sp.Matrix

    def with_each(self, f: Callable[[sp.Expr], sp.Expr]) -> Motion:
        """The motion with each component of a, omega and omegadot as ``f`` makes it."""
        return self._replace(
            a=self.a.applyfunc(f), omega=self.omega.applyfunc(f), omegadot=self.omegadot.applyfunc(f)
        )


class Spin(NamedTuple):
    """How the disc turns in the measurement frame, about its z axis: phi' and phi''."""

    rate: sp.Expr
    acceleration: sp.Expr


class Geometry(NamedTuple):
    """Stage 2, in the measurement frame: position r (3) and triad (rows tau_x, tau_y, tau_z)."""

    r: Vector
    tau: sp.Matrix


class Force(NamedTuple):
    """Stage 3: specific force in the accelerometer nominal frame of the actual position."""

    x: sp.Expr
    y: sp.Expr
    z: sp.Expr


class SensedForce(NamedTuple):
    """Specific force along the input, output and pendulous axes."""

    i: sp.Expr
    o: sp.Expr
    p: sp.Expr


def skew(v: Vector) -> sp.Matrix:
    """[v]x, so that skew(v) u = v x u."""
    x, y, z = v
    return sp.Matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def turn(axis: Vector, angle: sp.Expr, order: int | None) -> sp.Matrix:
    """Right-handed rotation by ``angle`` about a unit ``axis``, expanded to a power of the angle."""
    sine, one_minus_cosine = sp.sin(angle), 1 - sp.cos(angle)
    if order is not None:

        def series(first: int) -> sp.Expr:
            powers = range(first, order + 1, 2)
            return sp.Add(*(sp.Rational((-1) ** (n // 2), sp.factorial(n)) * angle**n for n in powers))

        sine, one_minus_cosine = series(1), -series(2)
    k = skew(axis)
    return sp.eye(3) + sine * k + one_minus_cosine * k * k


# Axes of the disc frame at the accelerometer: radial, tangential, axial.
_RADIAL, _TANGENTIAL, _AXIAL = sp.Matrix([1, 0, 0]), sp.Matrix([0, 1, 0]), sp.Matrix([0, 0, 1])
NOMINAL_TRIAD = sp.Matrix([[0, 1, 0], [1, 0, 0], [0, 0, -1]])


def mounting(
    R: sp.Expr,
    beta_x: sp.Expr,
    beta_z: sp.Expr,
    order: Order = PAPER,
    height: sp.Expr | int = 0,
    turn_of_triad: sp.Matrix | None = None,
) -> Geometry:
    """Position and triad in the disc frame (radial, tangential, axial) of the nominal position.

    ``height`` is along the axis; ``turn_of_triad`` turns the nominal triad of the paper (``None``: not at all).
    """
    about_axis = turn(_AXIAL, beta_z, order.rotation)
    lift = turn(_TANGENTIAL, -beta_x, order.rotation)
    dip = turn(_TANGENTIAL, beta_x, order.rotation)
    nominal = NOMINAL_TRIAD.T if turn_of_triad is None else turn_of_triad * NOMINAL_TRIAD.T
    position = R * about_axis * lift * _RADIAL
    return Geometry(position if height == 0 else position + height * _AXIAL, (about_axis * dip * nominal).T)


def in_frame(m: Motion, axes: sp.Matrix) -> Motion:
    """The motion by other axes: the columns of ``axes`` (3 x 3)."""
    to = axes.T
    return Motion(to * m.a, to * m.omega, to * m.omegadot, to * m.Gamma * axes)


def to_measurement_frame(g: Geometry, cosine: sp.Expr, sine: sp.Expr) -> Geometry:
    """Turn a geometry from the disc frame at angle psi (its cosine and sine) to the measurement frame."""
    spin = sp.Matrix([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    return Geometry(spin * g.r, (spin * g.tau.T).T)


def gradient(m: Motion) -> sp.Matrix:
    """M = [omegadot]x + [omega]x [omega]x - Gamma, so that f = a + M r (Eq. 9-11)."""
    w = skew(m.omega)
    return skew(m.omegadot) + w * w - m.Gamma


def of_disc(m: Motion, spin: Spin) -> Motion:
    """The motion of the disc itself, which is that of the accelerometers' cases, by measurement axes.

    Rates add. So do angular accelerations, but the spin axis is carried along by the platform: omega x Omega.
    Where the spin is at rest in the measurement frame, this is the motion of the platform.
    """
    return m._replace(
        omega=m.omega + spin.rate * _AXIAL,
        omegadot=m.omegadot + spin.acceleration * _AXIAL + m.omega.cross(spin.rate * _AXIAL),
    )


def spin_gradient(m: Motion, spin: Spin) -> sp.Matrix:
    """What the spin adds to M: Coriolis, centripetal and Euler terms that Eq. 9 leaves out, s^-2."""
    return (gradient(of_disc(m, spin)) - gradient(m)).applyfunc(sp.expand)


def of_growing_arm(case: Motion, arm: Vector, growth: sp.Expr, acceleration: sp.Expr) -> Vector:
    """Specific force at the end of an arm (unit vector) whose length changes: Coriolis, and its own acceleration.

    ``growth`` and ``acceleration`` are the first and second time derivative of the length, m/s and m/s^2.
    """
    return 2 * growth * case.omega.cross(arm) + acceleration * arm


def misalignment_matrix(x: sp.Expr, y: sp.Expr, z: sp.Expr, order: int | None = 1) -> sp.Matrix:
    """C of Eq. 2 (order 1), or composed about x, then y, then z (frame rotations), to a total power."""
    if order == 1:
        return sp.Matrix([[1, z, -y], [-z, 1, x], [y, -x, 1]])
    axes = (sp.Matrix([1, 0, 0]), sp.Matrix([0, 1, 0]), sp.Matrix([0, 0, 1]))
    rx, ry, rz = (turn(axis, -angle, order) for axis, angle in zip(axes, (x, y, z), strict=True))
    exact = rz * ry * rx
    if order is None:
        return exact
    scale = sp.Dummy("scale")
    scaled = {v: scale * v for v in (x, y, z)}
    return exact.applyfunc(
        lambda e: sum(sp.expand(e.xreplace(scaled)).coeff(scale, n) for n in range(order + 1))
    )


def sensed_force(f: Force, vartheta: tuple[sp.Expr, sp.Expr, sp.Expr], order: Order = PAPER) -> SensedForce:
    """Eq. 3: force along the input, output and pendulous axes."""
    C = misalignment_matrix(*vartheta, order=order.misalignment)
    return SensedForce(*(C * sp.Matrix(f)))


def transducer(f: SensedForce, q: SensedForce, k: dict[str, sp.Expr]) -> sp.Expr:
    """Eq. 1 in units of specific force: I_j / K_j1.

    ``f`` is the force in the linear term, ``q`` the force in the second-order terms (the two differ
    only when the order counting drops the angles in the latter).
    """
    return (
        f.i
        + k["K0"]
        + k["K2"] * q.i**2
        + k["K5"] * q.o**2
        + k["K7"] * q.p**2
        + k["K4"] * q.i * q.p
        + k["K6"] * q.i * q.o
        + k["K8"] * q.o * q.p
    )
