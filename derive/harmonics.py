"""From the chain to its Fourier series in the disc angle, in exact rational arithmetic.

A quantity that turns with the disc is a Laurent polynomial in exp(i psi) whose coefficients are
polynomials in the instrument's parameters and the motion numbers, over the Gaussian rationals. Expanding
in that ring costs a hundredth of what expanding SymPy expressions does.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any, TypeVar

import sympy as sp
from sympy.polys.domains import QQ_I
from sympy.polys.rings import PolyElement, PolyRing

from derive.tape import live

T = TypeVar("T", bound=Any)


@dataclass(frozen=True)
class Series:
    """sum_n c_n exp(i n psi); coefficients c_n in the ring, those that vanish left out."""

    ring: PolyRing
    coefficients: Mapping[int, PolyElement]

    def __add__(self, other: Series) -> Series:
        c = dict(self.coefficients)
        for n, v in other.coefficients.items():
            c[n] = c[n] + v if n in c else v
        return self._drop_zeros(c)

    def __mul__(self, other: Series) -> Series:
        c: dict[int, PolyElement] = {}
        for n, v in self.coefficients.items():
            for m, w in other.coefficients.items():
                c[n + m] = c[n + m] + v * w if n + m in c else v * w
        return self._drop_zeros(c)

    def _drop_zeros(self, c: dict[int, PolyElement]) -> Series:
        return Series(self.ring, {n: v for n, v in c.items() if v})

    def cosine(self, n: int) -> PolyElement:
        """Coefficient of cos(n psi); of 1 for n = 0."""
        zero = self.ring.zero
        if n == 0:
            return self.coefficients.get(0, zero)
        return self.coefficients.get(n, zero) + self.coefficients.get(-n, zero)

    def sine(self, n: int) -> PolyElement:
        """Coefficient of sin(n psi)."""
        zero = self.ring.zero
        difference = self.coefficients.get(n, zero) - self.coefficients.get(-n, zero)
        return difference * QQ_I(0, 1)

    @property
    def highest(self) -> int:
        return max((abs(n) for n in self.coefficients), default=0)


def constant(ring: PolyRing, value: PolyElement) -> Series:
    return Series(ring, {0: value} if value else {})


def rotating(ring: PolyRing) -> tuple[Series, Series]:
    """cos psi and sin psi."""
    half, i_half = ring(QQ_I(1, 0) / 2), ring(QQ_I(0, 1) / 2)
    return Series(ring, {1: half, -1: half}), Series(ring, {1: -i_half, -1: i_half})


class NotHarmonic(ValueError):
    """The expression is no polynomial in the motion numbers (|f_i|, a step ...): it has no finite series."""


def converted(e: sp.Expr, of_symbol: Callable[[sp.Symbol], T], of_other: Callable[[sp.Expr], T]) -> T:
    """An expression by elements that add and multiply; ``of_other`` makes those of numbers and functions."""
    if e.is_Symbol:
        return of_symbol(e)
    if e.is_Add or e.is_Mul:
        terms = (converted(a, of_symbol, of_other) for a in e.args)
        return reduce(operator.add if e.is_Add else operator.mul, terms)
    if e.is_Pow and e.exp.is_Integer and e.exp > 0:
        return reduce(operator.mul, [converted(e.base, of_symbol, of_other)] * int(e.exp))
    return of_other(e)


def series(
    assignments: Iterable[tuple[sp.Symbol, sp.Expr]],
    output: sp.Expr,
    ring: PolyRing,
    known: Mapping[sp.Symbol, Series],
) -> Series:
    """Fourier series of ``output`` of a tape.

    ``known`` gives the series of symbols that are not generators of the ring (the rotating cosine and
    sine) and of those to be overridden (the entries of M by the paper's T and S).
    """
    values = dict(known)
    generators = {s: constant(ring, ring.gens[n]) for n, s in enumerate(ring.symbols)}

    def of_symbol(s: sp.Symbol) -> Series:
        if s in values:
            return values[s]
        if s in generators:
            return generators[s]
        raise NotHarmonic(f"{s} is neither a parameter nor a motion number")

    def of_other(e: sp.Expr) -> Series:
        if e.is_Rational:
            return constant(ring, ring(QQ_I(int(e.p), 0) / int(e.q)))
        raise NotHarmonic(f"{e} has no finite Fourier series in the disc angle")

    # Only what the output needs: an unused branch may hold symbols outside the ring.
    for s, e in live([(s, e) for s, e in assignments if s not in known], [("", output)]):
        values[s] = converted(e, of_symbol, of_other)
    return converted(output, of_symbol, of_other)


def split(
    p: PolyElement, outer: Sequence[int], inner_ring: PolyRing, inner: Sequence[int]
) -> dict[tuple[int, ...], PolyElement]:
    """Collect a polynomial by the monomials in some generators (their indices ``outer``).

    The coefficients become elements of ``inner_ring`` (over the rationals), whose generators are those of
    the indices ``inner``.
    """
    collected: dict[tuple[int, ...], dict[tuple[int, ...], object]] = {}
    for monomial, c in p.terms():
        if c.y != 0:
            raise ValueError("imaginary coefficient in a real series")
        key = tuple(monomial[n] for n in outer)
        collected.setdefault(key, {})[tuple(monomial[n] for n in inner)] = c.x
    return {key: inner_ring.from_dict(value) for key, value in collected.items()}
