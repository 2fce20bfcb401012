"""Rotations as matrices, exact or to a power of the angle; where an accelerometer sits on the disc and how it is turned;
quantities with their first two derivatives in time.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ragg_runtime.instrument.layout import TANGENTIAL, AccelerometerPosition, Disc

Array = NDArray[np.float64]

Rotations = Literal["first-order", "second-order", "exact"]


X, Y, Z = np.eye(3)


def cross_matrix(axis: ArrayLike) -> Array:
    """Matrix of u -> axis x u, shape (3, 3)."""
    x, y, z = np.asarray(axis, dtype=np.float64)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def about(axis: ArrayLike, angle: float, rotations: Rotations = "exact") -> Array:
    """Right-handed rotation of vectors by ``angle`` (rad) about the unit vector ``axis``, (3, 3)."""
    k = cross_matrix(axis)
    turn: Array = angle * k
    if rotations == "exact":
        # 2 sin^2(angle/2) keeps 1 - cos(angle) accurate for arc seconds.
        turn = np.sin(angle) * k + 2 * np.sin(angle / 2) ** 2 * (k @ k)
    elif rotations == "second-order":
        turn = turn + angle**2 / 2 * (k @ k)
    return np.eye(3) + turn


def by_vector(vector: ArrayLike) -> Array:
    """Exact rotation about the direction of ``vector`` by its length (rad), (3, 3)."""
    v = np.asarray(vector, dtype=np.float64)
    angle = float(np.linalg.norm(v))
    return np.eye(3) if angle == 0 else about(v / angle, angle)


def least_rotation(start: Array, end: Array, spare: Array) -> Array:
    """The smallest rotation that takes a unit vector to another, (3, 3); about ``spare`` if they are opposite."""
    axis = np.cross(start, end)
    sine = float(np.linalg.norm(axis))
    if sine < 1e-12:
        return np.eye(3) if start @ end > 0 else about(spare, np.pi)
    return about(axis / sine, float(np.arctan2(sine, start @ end)))


def frame_rotation(
    x: ArrayLike, y: ArrayLike, z: ArrayLike, rotations: Literal["first-order", "exact"] = "exact"
) -> Array:
    """Coordinates of a fixed vector after its frame turns about x, then its new y, then its new z, by angles in rad, ()
    or (N,).

    To first order this is the paper's C (Eq. 2). (3, 3) or (3, 3, N): row k gives the component along axis k of the
    turned frame.
    """
    x, y, z = np.broadcast_arrays(*(np.asarray(v, dtype=np.float64) for v in (x, y, z)))
    one, nil = np.ones_like(x), np.zeros_like(x)
    if rotations == "first-order":
        return np.array([[one, z, -y], [-z, one, x], [y, -x, one]])
    first = np.array([[one, nil, nil], [nil, np.cos(x), np.sin(x)], [nil, -np.sin(x), np.cos(x)]])
    second = np.array([[np.cos(y), nil, -np.sin(y)], [nil, one, nil], [np.sin(y), nil, np.cos(y)]])
    third = np.array([[np.cos(z), np.sin(z), nil], [-np.sin(z), np.cos(z), nil], [nil, nil, one]])
    return np.asarray(np.einsum("ij...,jk...,kl...->il...", third, second, first), dtype=np.float64)


# Columns: the nominal axes of an accelerometer at angle 0. x along the turn, y outward, hence z down.
_NOMINAL = np.column_stack([Y, X, -Z])


@dataclass(frozen=True)
class Mount:
    """One accelerometer, in the frame of the disc.

    ``arm`` (3,): from the disc centre, over its radius. ``triad`` (3, 3): rows tau_x, tau_y, tau_z, its nominal frame
    at its actual position. ``lift`` (3,) m: along the axis, from the plane of the disc's centre.
    """

    arm: Array
    triad: Array
    lift: Array


def mount(place: AccelerometerPosition, beta_x: float, beta_z: float, rotations: Rotations) -> Mount:
    """An accelerometer with altitude beta_x and initial phase angle beta_z (rad).

    The arm is y turned by -beta_x about x, the triad by +beta_x (the senses of the printed Eq. 19); both then turn by
    beta_z about the spin axis and move to the station. A direction of the input axis turns the triad before that.
    """
    c, s = place.cosine_sine
    station = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    axes = station @ about(Z, beta_z, rotations) @ _NOMINAL
    turned = axes @ about(X, beta_x, rotations)
    if place.direction != TANGENTIAL:
        turned = turned @ _NOMINAL.T @ least_rotation(Y, np.array(place.direction), Z) @ _NOMINAL
    return Mount(arm=axes @ about(X, -beta_x, rotations) @ Y, triad=turned.T, lift=place.height * Z)


def disc_attitude(disc: Disc) -> Array | None:
    """(3, 3): takes a disc from where z is its axis and x its angle 0 to where it is; ``None``: it is there."""
    if disc.level:
        return None
    axis, zero = np.array(disc.axis), np.array(disc.zero)
    leaning = least_rotation(Z, axis, X)
    x_axis = leaning @ X
    twist = float(np.arctan2(axis @ np.cross(x_axis, zero), x_axis @ zero))
    return about(axis, twist) @ leaning


@dataclass(frozen=True)
class Taylor:
    """Value, first and second derivative with respect to time; arrays that broadcast against each other."""

    value: Array
    first: Array
    second: Array

    def __iter__(self) -> Iterator[Array]:
        return iter((self.value, self.first, self.second))

    def __add__(self, other: Taylor | Array | float) -> Taylor:
        if not isinstance(other, Taylor):
            return Taylor(self.value + other, self.first, self.second)
        return Taylor(*(a + b for a, b in zip(self, other, strict=True)))

    def __mul__(self, other: Taylor | Array | float) -> Taylor:
        if not isinstance(other, Taylor):
            return Taylor(*(a * other for a in self))
        return Taylor(
            self.value * other.value,
            self.first * other.value + self.value * other.first,
            self.second * other.value + 2 * (self.first * other.first) + self.value * other.second,
        )

    __radd__ = __add__
    __rmul__ = __mul__

    def cosine(self) -> Taylor:
        """Its cosine."""
        c, s = np.cos(self.value), np.sin(self.value)
        return Taylor(c, -s * self.first, -c * self.first**2 - s * self.second)

    def sine(self) -> Taylor:
        """Its sine."""
        c, s = np.cos(self.value), np.sin(self.value)
        return Taylor(s, c * self.first, -s * self.first**2 + c * self.second)

    def turn(self, matrix: Array) -> Taylor:
        """A vector (3, N) after a constant rotation (3, 3)."""
        return Taylor(*(matrix @ a for a in self))


def stack(parts: tuple[Taylor, Taylor, Taylor]) -> Taylor:
    """Three components as one vector, (3, N)."""
    return Taylor(*(np.stack(np.broadcast_arrays(*same)) for same in zip(*parts, strict=True)))


def spin(vectors: Array, angle: Taylor) -> list[Taylor]:
    """Vectors (n, 3) fixed to the disc, seen from the platform while the disc angle (N,) runs on, (3, N) each."""
    c, s = angle.cosine(), angle.sine()
    return [stack((c * x + s * -y, s * x + c * y, 0.0 * c + z)) for x, y, z in vectors.tolist()]


def carry(vector: Taylor, omega: Array, omegadot: Array) -> Array:
    """Second derivative in inertial space of a vector (3, N) given by the platform's axes, along these axes: 1 + W s +
    (W W + W') s^2/2, with W u = omega x u, times the vector's own series.
    """
    turning = carry_rigidly(vector.value, omega, omegadot)
    return np.asarray(turning + 2 * np.cross(omega, vector.first, axis=0) + vector.second)


def carry_rigidly(vector: Array, omega: Array, omegadot: Array) -> Array:
    """The same of a vector (3, N) that does not move along these axes: W W + W'."""
    twice = np.cross(omega, np.cross(omega, vector, axis=0), axis=0)
    return np.asarray(np.cross(omegadot, vector, axis=0) + twice)
