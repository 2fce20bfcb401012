"""A quantity with its first two time derivatives: arithmetic on series in time, broken off after the second power."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Taylor:
    """Value, first and second derivative with respect to time; arrays that broadcast against each other."""

    value: Array
    first: Array
    second: Array

    @classmethod
    def constant(cls, value: Array | float) -> Taylor:
        """What does not change."""
        here = np.asarray(value, dtype=np.float64)
        return cls(here, np.zeros_like(here), np.zeros_like(here))

    def __add__(self, other: Taylor | Array | float) -> Taylor:
        if not isinstance(other, Taylor):
            return Taylor(self.value + other, self.first, self.second)
        return Taylor(self.value + other.value, self.first + other.first, self.second + other.second)

    def __mul__(self, other: Taylor | Array | float) -> Taylor:
        if not isinstance(other, Taylor):
            return Taylor(self.value * other, self.first * other, self.second * other)
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

    def turned(self, matrix: Array) -> Taylor:
        """A vector (3, N) after a constant rotation (3, 3)."""
        return Taylor(matrix @ self.value, matrix @ self.first, matrix @ self.second)


def stacked(parts: tuple[Taylor, Taylor, Taylor]) -> Taylor:
    """Three components as one vector, (3, N)."""
    shape = np.broadcast_shapes(*(p.value.shape for p in parts))
    return Taylor(
        np.stack([np.broadcast_to(p.value, shape) for p in parts]),
        np.stack([np.broadcast_to(p.first, shape) for p in parts]),
        np.stack([np.broadcast_to(p.second, shape) for p in parts]),
    )


def spun(vectors: Array, angle: Taylor) -> list[Taylor]:
    """Vectors (n, 3) fixed to the disc, seen from the platform while the disc angle (N,) runs on, (3, N) each."""
    c, s = angle.cosine(), angle.sine()
    shape = angle.value.shape
    return [
        stacked((c * x + s * -y, s * x + c * y, Taylor.constant(np.full(shape, z))))
        for x, y, z in vectors.tolist()
    ]


def carried(vector: Taylor, omega: Array, omegadot: Array) -> Array:
    """Second derivative in inertial space of a vector (3, N) given by the platform's axes, along these axes: 1 + W s +
    (W W + W') s^2/2, with W u = omega x u, times the vector's own series.
    """
    once = np.cross(omega, vector.value, axis=0)
    twice = np.cross(omega, once, axis=0) + np.cross(omegadot, vector.value, axis=0)
    return np.asarray(twice + 2 * np.cross(omega, vector.first, axis=0) + vector.second)
