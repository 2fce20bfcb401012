"""What an order of counting leaves out of the exact instrument at most, with proof: exact rational arithmetic.

The proof. An accelerometer is known by the numbers of its place (``derive.output_harmonics``): where it is, where its axes
point, its second-order terms by the disc's directions. Its output is a polynomial in them and in the motion numbers, the same
at any order. With sin x = x - s, 0 <= s <= x^3/6, and cos x = 1 - x^2/2 + c, 0 <= c <= x^4/24, each number differs from what the
order keeps of it by a polynomial whose terms are bounded one by one: by d at most, where what is kept is at most u. A product of
such numbers then differs by at most prod(u + d) - prod(u). Four accelerometers at quarter turns, none of whose coefficients
exceeds C and S, make of C cos n psi + S sin n psi at most 4 sqrt(C^2 + S^2); of odd n, where |cos| and |sin| alternate from
one pair to the other, 2 sqrt 2 (C + S).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cache

import sympy as sp
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement, PolyRing

from derive.layout import PAPER as FOUR
from derive.output_harmonics import generic_polynomials, numbers_of_place
from derive.propagation import MOTION_NUMBERS
from derive.simplify.bound import Certificate
from derive.simplify.envelope import EOTVOS, Envelope
from derive.stages import EXACT, PAPER, Order
from derive.symbols import ANGLES, SECOND_ORDER, symbol
from derive.tape import variables

_R = symbol("R")

_BITS = 256
"""Bounds are whole multiples of 2^-256, rounded up: fractions would spend their time on common factors."""


def order_bound(envelope: Envelope, order: Order = PAPER) -> Certificate:
    """What a model of this order may miss of the exact instrument (all powers of all angles, in all terms)."""
    kept, most = _numbers(envelope, order)
    motions = {n: _up(b) for n, b in envelope.motion().items()}
    sizes: dict[tuple[int, Monomial], list[int]] = {}
    for (n, motion), terms in _everything():
        gap = sum(_multiple(c, _product(m, most) - _product(m, kept), _degree(m)) for m, c in terms)
        sizes.setdefault((n, motion), []).append(gap)
    harmonics: dict[int, int] = {}
    for (n, motion), parts in sizes.items():
        of_four = _root_up(8 * sum(parts) ** 2 if n % 2 else 16 * sum(x**2 for x in parts))
        size = _multiple(Fraction(1), of_four * _product(motion, motions), 1 + _degree(motion))
        harmonics[n] = harmonics.get(n, 0) + size
    unit = envelope.least_scale_factor * EOTVOS * 2**_BITS
    return Certificate({n: size / unit for n, size in sorted(harmonics.items())})


Monomial = tuple[tuple[str, int], ...]
"""Names with their powers."""

Terms = tuple[tuple[Monomial, Fraction], ...]


def _up(x: Fraction) -> int:
    return math.ceil(x * 2**_BITS)


def _root_up(square: int) -> int:
    root = math.isqrt(square)
    return root + (root * root != square)


def _product(m: Monomial, bounds: Mapping[str, int]) -> int:
    """Of bounds to their powers, exactly: a multiple of 2^-256 to the power of its degree."""
    return math.prod(bounds[n] ** power for n, power in m)


def _degree(m: Monomial) -> int:
    return sum(power for _, power in m)


def _multiple(c: Fraction, product: int, degree: int) -> int:
    """|c| times a product of ``degree`` bounds, rounded up to a multiple of 2^-256."""
    return -((-abs(c.numerator) * product << _BITS) // (c.denominator << _BITS * degree))


def _size(terms: Terms, bounds: Mapping[str, int]) -> int:
    """Bound of a polynomial."""
    return sum(_multiple(c, _product(m, bounds), _degree(m)) for m, c in terms)


def _terms(p: PolyElement) -> Terms:
    names = [s.name for s in p.ring.symbols]
    return tuple(
        (_monomial(names, powers), Fraction(int(c.numerator), int(c.denominator))) for powers, c in p.terms()
    )


def _monomial(names: Iterable[str], powers: Iterable[int]) -> Monomial:
    return tuple((n, k) for n, k in zip(names, powers, strict=True) if k)


@cache
def _everything() -> tuple[tuple[tuple[int, Monomial], Terms], ...]:
    """(harmonic, motion numbers) and the coefficient there, of cosine and sine apart."""
    return tuple(
        ((n, _monomial(MOTION_NUMBERS, motion)), _terms(p))
        for (n, _), of_phase in generic_polynomials((), one_place=False).items()
        for motion, p in of_phase.items()
    )


def _numbers(envelope: Envelope, order: Order) -> tuple[dict[str, int], dict[str, int]]:
    """Of every number of a place: bounds of what the order keeps, and with what it leaves out; k1 in units of its nominal value."""
    largest = {_R.name: _up(envelope.parameter("R"))}
    for name in ANGLES:
        x = Fraction(envelope.parameter(name))
        largest |= {name: _up(x), _rest("s", name).name: _up(x**3 / 6), _rest("c", name).name: _up(x**4 / 24)}
    counted = _counted(order)
    kept = {n: _size(terms, largest) for n, (terms, _) in counted.items()}
    most = {n: kept[n] + _size(left_out, largest) for n, (_, left_out) in counted.items()}
    own = {n: _up(envelope.parameter(n)) for n in ("k1", "K0", *SECOND_ORDER)}
    kept, most = kept | own, most | own
    for n, terms in _second_order_terms().items():
        kept[n], most[n] = _size(terms, kept), _size(terms, most)
    return kept, most


@cache
def _counted(order: Order) -> Mapping[str, tuple[Terms, Terms]]:
    """What an order keeps of each number of place and axes, and what it leaves out."""
    exact = _in_angles(EXACT)
    return {n: (_terms(p), _terms(exact[n] - p)) for n, p in _in_angles(order).items()}


@cache
def _second_order_terms() -> Mapping[str, Terms]:
    """Q by the axes that second-order terms see."""
    return {
        n: tuple((tuple((_second(name), k) for name, k in m), c) for m, c in _terms(_multiplied_out(e)))
        for n, e in numbers_of_place(EXACT, FOUR).items()
        if n[0] == "Q"
    }


def _multiplied_out(e: sp.Expr) -> PolyElement:
    return PolyRing(variables(e), QQ, lex).from_expr(e)


def _rest(letter: str, name: str) -> sp.Symbol:
    return symbol(f"{letter}_{name}")


def _second(name: str) -> str:
    """The name of an axis' component where second-order terms see it; of a coefficient its own."""
    return f"second_{name}" if name[0] in "iop" else name


_RESTS = tuple(_rest(letter, name) for letter in "sc" for name in ANGLES)
_RING = PolyRing((_R, *map(symbol, ANGLES), *_RESTS), QQ, lex)


@cache
def _in_angles(order: Order) -> Mapping[str, PolyElement]:
    """Place and axes, as the linear and as second-order terms see them, by angles and what sine and cosine have beyond."""
    found = numbers_of_place(order, FOUR)
    known: dict[sp.Expr, sp.Expr] = {symbol("dR"): sp.Integer(0), symbol("radius"): _R}
    for name in ANGLES:
        x = symbol(name)
        known |= {sp.sin(x): x - _rest("s", name), sp.cos(x): 1 - x**2 / 2 + _rest("c", name)}
    level = {symbol(n): sp.Integer(0) for n in ANGLES}  # second-order terms of such an order see no angle

    def written(e: sp.Expr) -> PolyElement:
        return _RING.from_expr(e.xreplace(known))  # multiplied out in the ring: much faster

    every = {n: written(found[n]) for n in _names("ri")}
    axes = found
    if not order.second_order_angles:
        axes = {n: e.xreplace(level) for n, e in numbers_of_place(EXACT, FOUR).items()}
    every |= {_second(n): written(axes[n]) for n in _names("iop")}
    return every | {n.replace("r", "q", 1): written(axes[n]) for n in _names("r")}


def _names(letters: str) -> list[str]:
    return [f"{n}_{d}" for n in letters for d in "rtz"]
