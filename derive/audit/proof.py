"""Evaluation of printed and derived equations: exactly, at the points of :mod:`derive.audit.direct`, or over series.

Where everything is rational, equal means equal: a right equation leaves 0, a misprint leaves a number.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import Any

from sympy.polys.rings import PolyElement

from derive.audit import direct
from derive.audit.compare import MOTION, expand_rate, read
from derive.audit.reading import motion_reader

WEIGHTS = {"D12": (1, -1, 0, 0), "D34": (0, 0, 1, -1), "D1234": (1, 1, -1, -1), "Sigma": (1, 1, 1, 1)}
"""Weights of A_1 ... A_4 as the paper defines its combinations below Eq. 19."""


def value(p: PolyElement, numbers: Mapping[str, Any], of: Callable[[Fraction], Any] = Fraction) -> Any:
    """A polynomial at named numbers, or series; ``of`` makes numbers of their kind of its coefficients."""
    total = of(Fraction(0))
    names = [s.name for s in p.ring.symbols]
    for powers, c in p.terms():
        factors = (numbers[n] ** k for n, k in zip(names, powers, strict=True) if k)
        total = total + math.prod(factors, start=of(Fraction(int(c.numerator), int(c.denominator))))
    return total


def amplitude_value(
    p: PolyElement,
    accelerometers: Mapping[str, Sequence[Any]],
    motion: Mapping[str, Any],
    of: Callable[[Fraction], Any] = Fraction,
) -> Any:
    """An amplitude of Eq. 18 or 19 (independent motion numbers only), four values each of the accelerometers' parameters."""
    four = {**accelerometers, **WEIGHTS}
    return sum(value(p, {n: v[j] for n, v in four.items()} | dict(motion), of) for j in range(4))


@cache
def _printed_motion() -> Mapping[str, PolyElement]:
    """The printed Eq. 16 as it is read, omega_im^2 by its components."""
    return {e.left: read(e, motion_reader(), expand_rate).total for e in MOTION}


def motion_numbers(point: direct.NumericPoint) -> dict[str, Fraction]:
    """T_1 ... S_5 by the *printed* Eq. 16, and everything else that Eq. 18 and 19 name."""
    rates = direct.rates(point)
    numbers = {f"a_{k}": v for k, v in zip("xyz", point.a, strict=True)}
    numbers |= {left: value(p, rates) for left, p in _printed_motion().items()}
    return numbers | {n: rates[n] for n in ("omegadot_x", "omegadot_y")}


def wave(name: str, point: direct.NumericPoint) -> Fraction:
    """cos or sin of n times the disc angle, for an amplitude's name."""
    real, imaginary = Fraction(1), Fraction(0)
    for _ in range(int(name[2])):
        c, s = point.cosine, point.sine
        real, imaginary = real * c - imaginary * s, real * s + imaginary * c
    return imaginary if name.endswith("s") else real


def output(amplitudes: Mapping[str, PolyElement], point: direct.NumericPoint) -> Fraction:
    """G_out of Eq. 17 with these amplitudes."""
    motion = motion_numbers(point)
    terms = (amplitude_value(p, point.accelerometers, motion) * wave(n, point) for n, p in amplitudes.items())
    return sum(terms, Fraction(0))


def current(rows: Mapping[str, PolyElement], point: direct.NumericPoint, j: int) -> Fraction:
    """I_j / K_j1 - K_j0 of Eq. 5a with these coefficients, for the force a of the point."""
    x, y, z = point.a
    k = {left: value(p, {n: v[j] for n, v in point.accelerometers.items()}) for left, p in rows.items()}
    linear = x + y * k[r"\vartheta_{jz}^*"] - z * k[r"\vartheta_{jy}^*"]
    squares = k["K_{j2}^*"] * x * x + k["K_{j5}^*"] * y * y + k["K_{j7}^*"] * z * z
    return Fraction(linear + squares + k["K_{j6}^*"] * x * y + k["K_{j4}^*"] * x * z + k["K_{j8}^*"] * y * z)
