"""Numbers of the fast sine and cosine in C, from exact ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

BLOCK = 128
"""Samples that are evaluated together in C: few, so that arithmetic and memory traffic overlap."""


def constants() -> Mapping[str, object]:
    """What ``fast.c.j2`` wants: Taylor terms (power, coefficient as C), and multiples of pi in two parts."""
    return {
        "block": BLOCK,
        "sine": [_term(n) for n in range(1, 18, 2)],
        "cosine": [_term(n) for n in range(0, 17, 2)],
        "horner": _horner,
        "two_pi": _two_parts(2 * sp.pi),
        "quarter": _two_parts(sp.pi / 2),
        "per_quarter": repr(float(2 / sp.pi)),
    }


def _term(n: int) -> tuple[int, str]:
    """The power n of a Taylor series of sine or cosine; the compiler divides exactly once."""
    return n, f"({'-' if n % 4 > 1 else ''}1.0 / {int(sp.factorial(n))}.0)"


def _horner(terms: Sequence[tuple[int, str]]) -> str:
    """Of the tail of a series, in z, the square of the angle."""
    text = terms[-1][1]
    for _, coefficient in reversed(terms[:-1]):
        text = f"FMA(z, {text}, {coefficient})"
    return text


def _two_parts(x: sp.Expr) -> tuple[str, str]:
    high = float(x.evalf(40))
    return repr(high), repr(float((x - sp.Rational(high)).evalf(40)))
