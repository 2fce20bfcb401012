"""Numbers of the fast sine and cosine in C, from exact ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import mpmath
import sympy as sp

BLOCK = 128
"""Samples that are evaluated together in C: what is between two loops stays in the first cache."""

PIECE = 16
"""Samples of the folded model that are evaluated together: few, so that the arithmetic of the disc angle and the memory traffic
of the channels overlap, and two vectors at least."""

DIGITS = 40
"""Of what is rounded to a float64 at the end."""

TERMS = 7
"""Terms of each polynomial: it is then within 3e-18 of sine and cosine, an eightieth of the last bit of one."""


@cache
def constants() -> Mapping[str, object]:
    """What ``fast.c.j2`` wants: the polynomials as C, and multiples of pi."""
    sine, cosine = _polynomials()
    return {
        "block": BLOCK,
        "piece": PIECE,
        "sine": _horner(sine),
        "cosine": _horner(cosine[1:]),
        "cosine_first": repr(cosine[0]),
        "two_pi": repr(float(2 * sp.pi)),
        "per_turn": _two_parts(1 / (2 * sp.pi)),
    }


def _polynomials() -> tuple[Sequence[float], Sequence[float]]:
    """Of S(z) = sin(2 pi r) / r - 2 pi, with 2 pi as a float64, and C(z) = (cos(2 pi r) - 1) / z, with z = r^2, lowest power first.

    Interpolated at Chebyshev's nodes for |r| up to an eighth of a turn, which is all but minimax (Muller, Elementary Functions,
    3.2). The first coefficient of C is exact but for its rounding, as what it leaves is divided by z.
    """
    context = mpmath.mp.clone()
    context.dps = DIGITS
    turn, end = 2 * context.pi, context.mpf(1) / 64
    known = context.mpf(float(turn))

    def sine(z: Any) -> Any:
        r = context.sqrt(z)
        return context.sin(turn * r) / r - known

    def cosine(z: Any) -> Any:
        return ((context.cos(turn * context.sqrt(z)) - 1) / z + turn**2 / 2) / z

    def fitted(f: Callable[[Any], Any], terms: int) -> list[float]:
        return [float(c) for c in reversed(context.chebyfit(f, [0, end], terms))]

    return fitted(sine, TERMS), [float(-(turn**2) / 2), *fitted(cosine, TERMS - 1)]


def _horner(coefficients: Sequence[float]) -> str:
    """In z, the square of the angle."""
    text = repr(coefficients[-1])
    for c in reversed(coefficients[:-1]):
        text = f"FMA(z, {text}, {c!r})"
    return text


def _two_parts(x: sp.Expr) -> tuple[str, str]:
    high = float(x.evalf(DIGITS))
    return repr(high), repr(float((x - sp.Rational(high)).evalf(DIGITS)))
