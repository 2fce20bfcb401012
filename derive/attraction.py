"""Gravity of a body beside the instrument, derived from its potential."""

from __future__ import annotations

from itertools import product

import sympy as sp

from derive.context import Context
from derive.effect import EffectParameter, Values
from derive.symbols import symbol

G = sp.Float("6.6743e-11")
"""Newton's constant, m^3 kg^-1 s^-2 (CODATA 2018)."""

CHANNELS = ("mass_x", "mass_y", "mass_z")
"""How far the body has moved, m, along the measurement axes."""

MASS = EffectParameter("M", "M", "kg", "mass of the body", 100.0, shared=True)
PLACE = tuple(
    EffectParameter(
        k, k, "m", f"{k} of its centre where mass_{k} is 0", 0.05, shared=True, neutral=1.0, shape=True
    )
    for k in "xyz"
)

_AT = sp.Matrix([symbol(f"body_{k}") for k in "xyz"])
_POTENTIAL = 1 / sp.sqrt(_AT.dot(_AT))
"""Of a point for a unit of G M, by its place."""


def place(p: Values, c: Context) -> sp.Matrix:
    """(3,) m: the body's centre, from that of the disc along the measurement axes."""
    return sp.Matrix([c.tape.let(f"body_{k}", p[k] + c.channel(f"mass_{k}")) for k in "xyz"])


def of_point(p: Values, c: Context, r: sp.Matrix) -> sp.Matrix:
    """(3,) m/s^2: what a point attracts at r more than at the disc's centre; of a sphere outside it is the same."""
    away, centre = place(p, c) - r, place(p, c)
    slope = -_POTENTIAL.diff(_AT)  # by where it is felt
    there, here = (slope.xreplace(dict(zip(_AT, v, strict=True))) for v in (away, centre))
    return G * p["M"] * (there - here)


def gradient_of_point(p: Values, c: Context) -> sp.Matrix:
    """(3, 3) s^-2, at the disc's centre."""
    return G * p["M"] * sp.hessian(_POTENTIAL, list(_AT)).xreplace(dict(zip(_AT, place(p, c), strict=True)))


def gradient_of_cuboid(p: Values, c: Context) -> sp.Matrix:
    """(3, 3) s^-2, at the disc's centre, of a homogeneous body with edges l_x, l_y, l_z along the measurement axes.

    The potential is the integral of G rho/s over the body. A derivative by where it is felt is, but for its sign, one by where the
    mass is, which undoes an integration: two by different axes leave the integral of 1/s along the four edges of the third, two by the
    same one that of x/s^3 over two faces, the solid angles at which they are seen.
    """
    at, edges = place(p, c), [p[f"l_{k}"] for k in "xyz"]
    corners = {
        ends: sp.Matrix([at[n] + edges[n] * sp.Rational(e, 2) for n, e in enumerate(ends)])
        for ends in product((-1, 1), repeat=3)
    }
    far = {ends: c.tape.let(f"corner_{n}", sp.sqrt(v.dot(v))) for n, (ends, v) in enumerate(corners.items())}

    def face(axis: int, side: int) -> sp.Expr:
        """Solid angle, negative of what is on the other side: that of two triangles (A. van Oosterom and J. Strackee, 1983)."""
        ring = [_ends({axis: side, (axis + 1) % 3: a, (axis + 2) % 3: b}) for a, b in _AROUND]
        total = []
        for triangle in ((ring[0], ring[1], ring[2]), (ring[0], ring[2], ring[3])):
            (u, v, w), (a, b, d) = ([of[ends] for ends in triangle] for of in (corners, far))
            volume, cosine = u.dot(v.cross(w)), a * b * d + a * v.dot(w) + b * u.dot(w) + d * u.dot(v)
            total.append(2 * sp.atan2(c.tape.let("face_volume", volume), c.tape.let("face_cosine", cosine)))
        return sp.Add(*total)

    def edge(axis: int, others: dict[int, int]) -> sp.Expr:
        """Integral of 1/s along it."""
        both = sp.Add(*(far[_ends({axis: e, **others})] for e in (-1, 1)))
        return sp.log((both + edges[axis]) / (both - edges[axis]))

    def component(i: int, k: int) -> sp.Expr:
        if i == k:
            return face(i, -1) - face(i, 1)
        return sp.Add(*(a * b * edge(3 - i - k, {i: a, k: b}) for a, b in product((-1, 1), repeat=2)))

    density = G * p["M"] / sp.prod(edges)
    of = {(i, k): component(i, k) for i, k in ((0, 0), (1, 1), (0, 1), (0, 2), (1, 2))}
    of[2, 2] = -of[0, 0] - of[1, 1]  # outside of masses
    return sp.Matrix(3, 3, lambda i, k: density * of[min(i, k), max(i, k)])


_AROUND = ((-1, -1), (1, -1), (1, 1), (-1, 1))


def _ends(by_axis: dict[int, int]) -> tuple[int, ...]:
    return tuple(by_axis[n] for n in range(3))
