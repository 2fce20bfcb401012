"""Gravity of attracting masses near the instrument, relative to its value at the disc centre, a_g(r) - a_g(0).

It is ten orders below a_g and never computed by subtracting two attractions. Positions are in the measurement frame, m,
from the disc centre; the gradient tensor has the order of ``COMPONENTS``, in s^-2.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError

Array = NDArray[np.float64]

G = 6.6743e-11  # Newton's constant, m^3 kg^-1 s^-2 (CODATA 2018)
COMPONENTS = ("xx", "xy", "xz", "yy", "yz", "zz")  # order of the six components of a gradient tensor
Track = Callable[[Array], Array]  # position as a function of time: (N,) s -> (3, N) m


class Gravity(Protocol):
    """Anything that attracts."""

    def difference(self, time: Array, r: Array) -> Array:
        """a_g(r) - a_g(0) in m/s^2, (3, N), at instants (N,) s and positions (3, N) m."""
        ...

    def gradient(self, time: Array) -> Array:
        """Gradient tensor at the disc centre in s^-2, (6, N), in the order of ``COMPONENTS``."""
        ...


def contract(tensor: Array, r: Array) -> Array:
    """Gamma r: components (6,) or (6, N) times (3, N)."""
    xx, xy, xz, yy, yz, zz = tensor
    x, y, z = r
    return np.stack([xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z])


@dataclass(frozen=True)
class Gradient:
    """A uniform gradient field, (6,) in s^-2 or a function of time (N,) s -> (6, N): a_g(r) - a_g(0) = Gamma r (Eq. 10)."""

    tensor: Array | Callable[[Array], Array]

    def gradient(self, time: Array) -> Array:
        """Gamma, (6, N) s^-2."""
        if callable(self.tensor):
            return self.tensor(time)
        return np.repeat(np.reshape(self.tensor, (6, 1)), time.size, axis=1)

    def difference(self, time: Array, r: Array) -> Array:
        """Gamma r, (3, N) m/s^2."""
        return contract(self.gradient(time), r)


@dataclass(frozen=True)
class PointMass:
    """Newton's law for one point mass, kg (Eq. 49); ``position``: (3,) or (3, N) m, or a function of time (N,) s -> (3, N)."""

    mass: float
    position: Sequence[float] | Array | Track

    def _at(self, time: Array) -> Array:
        if callable(self.position):
            return np.asarray(self.position(time), dtype=np.float64)
        return np.broadcast_to(np.reshape(self.position, (3, -1)), (3, time.size))

    def difference(self, time: Array, r: Array) -> Array:
        """a_g(r) - a_g(0), (3, N) m/s^2, to full relative precision."""
        s = self._at(time)
        d = s - r
        far, near = np.linalg.norm(s, axis=0), np.linalg.norm(d, axis=0)
        if not np.all((far > 0) & (near > 0)):
            raise UserError("a point mass sits on the disc centre or on an accelerometer", found=self.mass)
        # |s| - |d| from the difference of their squares, whose leading part cancels by hand.
        gap = np.sum((2 * s - r) * r, axis=0) / (far + near)
        cubes = gap * (far * far + far * near + near * near) / (far**3 * near**3)
        difference: Array = G * self.mass * (s * cubes - r / near**3)
        return difference

    def gradient(self, time: Array) -> Array:
        """3 G m s s / s^5 - G m I / s^3, (6, N) s^-2."""
        s = self._at(time)
        distance = np.linalg.norm(s, axis=0)
        u = s / distance
        i, j = np.triu_indices(3)
        tensor: Array = G * self.mass / distance**3 * (3 * u[i] * u[j] - (i == j)[:, None])
        return tensor
