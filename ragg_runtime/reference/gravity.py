"""Gravity of attracting masses near the instrument, relative to its value at the disc centre.

The attraction at the centre belongs to the specific force a = f_cmm (Eq. 11), so an accelerometer at r
sees the difference a_g(r) - a_g(0). It is ten orders below a_g itself and is never computed by subtracting
two attractions: each source has a form free of that cancellation.

All positions are in the measurement frame (m), from the disc centre; a mass may move in it. The gradient
tensor has the order of ``COMPONENTS``, in s^-2 (1 Eo = 1e-9 s^-2).
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from ragg_runtime.base.errors import UserError

Array = NDArray[np.float64]

G = 6.6743e-11
"""Newton's constant, m^3 kg^-1 s^-2 (CODATA 2018)."""

COMPONENTS = ("xx", "xy", "xz", "yy", "yz", "zz")
"""Order of the six components of a gradient tensor."""

Track = Callable[[Array], Array]
"""Position as a function of time: (N,) s -> (3, N) m."""


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


def components(matrix: ArrayLike) -> Array:
    """The six components of a symmetric (3, 3) tensor."""
    m = np.asarray(matrix, dtype=np.float64)
    if m.shape != (3, 3) or not np.allclose(m, m.T, rtol=1e-12, atol=0):
        raise UserError("a gravity gradient tensor is a symmetric 3 x 3 matrix", found=m.tolist())
    return m[np.triu_indices(3)]


@dataclass(frozen=True)
class Gradient:
    """A uniform gradient field: a_g(r) - a_g(0) = Gamma r (Eq. 10).

    Attributes
    ----------
    tensor
        (6,) in s^-2, or a function of time (N,) s -> (6, N).
    """

    tensor: Array | Callable[[Array], Array]

    def gradient(self, time: Array) -> Array:
        """Gamma, (6, N) s^-2."""
        if callable(self.tensor):
            return self.tensor(time)
        values = np.asarray(self.tensor, dtype=np.float64)
        if values.shape != (6,):
            raise UserError(
                "a constant gradient has six components", found=f"shape {values.shape}", expected=COMPONENTS
            )
        return np.repeat(values[:, None], time.size, axis=1)

    def difference(self, time: Array, r: Array) -> Array:
        """Gamma r, (3, N) m/s^2."""
        return contract(self.gradient(time), r)


def gradient_series(time: ArrayLike, tensor: ArrayLike) -> Gradient:
    """A gradient known at instants (M,) s as (6, M) s^-2, interpolated by cubic splines."""
    spline = CubicSpline(np.asarray(time, dtype=np.float64), np.asarray(tensor, dtype=np.float64), axis=1)
    return Gradient(lambda t: np.asarray(spline(t), dtype=np.float64))


@dataclass(frozen=True)
class PointMass:
    """Newton's law for one point mass (Eq. 49), or a sphere seen from outside.

    Attributes
    ----------
    mass
        kg.
    position
        (3,) m, or a function of time (N,) s -> (3, N).
    """

    mass: float
    position: Sequence[float] | Array | Track

    def _at(self, time: Array) -> Array:
        if callable(self.position):
            return np.asarray(self.position(time), dtype=np.float64)
        return np.repeat(np.asarray(self.position, dtype=np.float64)[:, None], time.size, axis=1)

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


# Gauss-Legendre on [0, 1]: the gradient of a body outside the disc is smooth along an arm.
_NODES, _WEIGHTS = (v / 2 for v in np.polynomial.legendre.leggauss(5))
_NODES = _NODES + 0.5


@dataclass(frozen=True)
class Prisms:
    """Homogeneous rectangular bodies with edges along the measurement frame's axes, by choclo.

    The difference a_g(r) - a_g(0) is the gradient integrated along the arm, which does not cancel.

    Attributes
    ----------
    bounds
        (P, 6) m: x from, x to, y from, y to, z from, z to.
    density
        (P,) kg/m^3.
    offset
        Displacement of all bodies as a function of time, (N,) s -> (3, N) m; ``None``: at rest.
    """

    bounds: ArrayLike
    density: ArrayLike
    offset: Track | None = None

    def _tensor(self, points: Array) -> Array:
        bounds = np.atleast_2d(np.asarray(self.bounds, dtype=np.float64))
        density = np.atleast_1d(np.asarray(self.density, dtype=np.float64))
        if bounds.shape != (density.size, 6) or not np.all(bounds[:, 1::2] > bounds[:, ::2]):
            raise UserError(
                "each prism needs six bounds, from < to along x, y and z, and one density",
                found=f"bounds {bounds.tolist()}, {density.size} densities",
            )
        out = np.empty((6, points.shape[1]))
        _prism_kernel()(np.ascontiguousarray(points), bounds, density, out)
        if not np.all(np.isfinite(out)):
            raise UserError("a prism's edge or vertex touches the disc centre or an accelerometer's arm")
        return out

    def _seen_from(self, time: Array, r: Array) -> Array:
        return r if self.offset is None else r - self.offset(time)

    def difference(self, time: Array, r: Array) -> Array:
        """a_g(r) - a_g(0), (3, N) m/s^2."""
        total = np.zeros(r.shape)
        for node, weight in zip(_NODES, _WEIGHTS, strict=True):
            total += weight * contract(self._tensor(self._seen_from(time, node * r)), r)
        return total

    def gradient(self, time: Array) -> Array:
        """Gradient tensor at the disc centre, (6, N) s^-2."""
        return self._tensor(self._seen_from(time, np.zeros((3, time.size))))


@dataclass(frozen=True)
class Together:
    """Several sources at once."""

    parts: tuple[Gravity, ...]

    def difference(self, time: Array, r: Array) -> Array:
        """Sum of the parts, (3, N) m/s^2."""
        return sum((p.difference(time, r) for p in self.parts), np.zeros(r.shape))

    def gradient(self, time: Array) -> Array:
        """Sum of the parts, (6, N) s^-2."""
        return sum((p.gradient(time) for p in self.parts), np.zeros((6, time.size)))


@functools.cache
def _prism_kernel() -> Callable[[Array, Array, Array, Array], None]:
    """The compiled loop over points and prisms, built once."""
    try:
        prism: Any = importlib.import_module("choclo.prism")
        numba: Any = importlib.import_module("numba")
    except ImportError as error:
        raise UserError(
            "extended bodies need the library choclo, which is not installed",
            remedy="pip install 'ragg[bodies]', or use point masses",
        ) from error
    ee, en, eu = prism.gravity_ee, prism.gravity_en, prism.gravity_eu
    nn, nu, uu = prism.gravity_nn, prism.gravity_nu, prism.gravity_uu

    @numba.njit  # type: ignore[untyped-decorator]
    def loop(points: Array, bounds: Array, density: Array, out: Array) -> None:  # pragma: no cover
        for n in range(points.shape[1]):
            x, y, z = points[0, n], points[1, n], points[2, n]
            for k in range(6):
                out[k, n] = 0.0
            for p in range(bounds.shape[0]):
                w, e, s, t, b, u = bounds[p]
                rho = density[p]
                out[0, n] += ee(x, y, z, w, e, s, t, b, u, rho)
                out[1, n] += en(x, y, z, w, e, s, t, b, u, rho)
                out[2, n] += eu(x, y, z, w, e, s, t, b, u, rho)
                out[3, n] += nn(x, y, z, w, e, s, t, b, u, rho)
                out[4, n] += nu(x, y, z, w, e, s, t, b, u, rho)
                out[5, n] += uu(x, y, z, w, e, s, t, b, u, rho)

    kernel: Callable[[Array, Array, Array, Array], None] = loop
    return kernel
