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

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cache

import sympy as sp
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from derive.layout import PAPER as FOUR
from derive.output_harmonics import Generic, generic_series, numbers_of_place
from derive.propagation import MOTION_NUMBERS
from derive.simplify.bound import Certificate, root_up
from derive.simplify.envelope import EOTVOS, Envelope, product
from derive.stages import EXACT, PAPER, Order
from derive.symbols import ANGLES, SECOND_ORDER, symbol
from derive.tape import variables

_R = symbol("R")


def order_bound(envelope: Envelope, order: Order = PAPER) -> Certificate:
    """What a model of this order may miss of the exact instrument (all powers of all angles, in all terms)."""
    kept, most = _numbers(envelope, order)
    motions = [envelope.motion()[n] for n in MOTION_NUMBERS]
    series = _everything()
    sizes: dict[tuple[int, tuple[int, ...]], list[Fraction]] = {}
    for (n, _), terms in series.items():
        for motion, coefficient in terms.items():
            every = _terms(coefficient)
            sizes.setdefault((n, motion), []).append(_size(every, most) - _size(every, kept))
    harmonics: dict[int, Fraction] = {}
    for (n, motion), parts in sizes.items():
        of_four = root_up(8 * _sum(parts) ** 2) if n % 2 else 4 * root_up(_sum(x**2 for x in parts))
        size = of_four * product(motions, motion)
        harmonics[n] = harmonics.get(n, Fraction(0)) + size / envelope.least_scale_factor / EOTVOS
    return Certificate(dict(sorted(harmonics.items())))


def _sum(sizes: Iterable[Fraction]) -> Fraction:
    return sum(sizes, Fraction(0))


@cache
def _everything() -> Generic:
    return generic_series((), one_place=False)


Monomial = tuple[tuple[sp.Symbol, int], ...]


@cache
def _terms(e: sp.Expr) -> tuple[tuple[Monomial, Fraction], ...]:
    if e.is_Number:
        return (((), Fraction(int(e.p), int(e.q))),) if e else ()
    gens = variables(e)
    whole = PolyRing(gens, QQ, lex).from_expr(e)  # multiplied out in the ring: much faster
    return tuple(
        (
            tuple((s, k) for s, k in zip(gens, powers, strict=True) if k),
            Fraction(int(c.numerator), int(c.denominator)),
        )
        for powers, c in whole.terms()
    )


def _numbers(envelope: Envelope, order: Order) -> tuple[dict[str, Fraction], dict[str, Fraction]]:
    """Of every number of a place: bounds of what the order keeps, and with what it leaves out; k1 in units of its nominal value."""
    largest = {_R.name: envelope.parameter("R")}
    for name in ANGLES:
        x = Fraction(envelope.parameter(name))
        largest |= {name: x, _rest("s", name).name: x**3 / 6, _rest("c", name).name: x**4 / 24}

    def bound(e: sp.Expr) -> Fraction:
        return _size(_terms(e), largest)

    exact, counted = _in_angles(EXACT), _in_angles(order)
    kept = {n: bound(e) for n, e in counted.items()}
    most = {n: u + bound(exact[n] - counted[n]) for n, u in kept.items()}
    own = {n: envelope.parameter(n) for n in ("k1", "K0", *SECOND_ORDER)}
    kept, most = kept | own, most | own
    for n, e in numbers_of_place(EXACT, FOUR).items():
        if n[0] == "Q":  # by the axes that second-order terms see
            of_axes = [(tuple((symbol(_second(s.name)), k) for s, k in m), c) for m, c in _terms(e)]
            kept[n], most[n] = _size(of_axes, kept), _size(of_axes, most)
    return kept, most


def _size(terms: Iterable[tuple[Monomial, Fraction]], largest: Mapping[str, Fraction]) -> Fraction:
    """Bound of a polynomial; in whole numbers, which common factors are taken from at the end alone: a third of the time."""
    parts: dict[int, int] = {}
    for m, c in terms:
        numerator, denominator = abs(c.numerator), c.denominator
        for s, power in m:
            numerator *= largest[s.name].numerator ** power
            denominator *= largest[s.name].denominator ** power
        parts[denominator] = parts.get(denominator, 0) + numerator
    return _sum(Fraction(numerator, denominator) for denominator, numerator in parts.items())


def _rest(letter: str, name: str) -> sp.Symbol:
    return symbol(f"{letter}_{name}")


def _second(name: str) -> str:
    """The name of an axis' component where second-order terms see it; of a coefficient its own."""
    return f"second_{name}" if name[0] in "iop" else name


@cache
def _in_angles(order: Order) -> Mapping[str, sp.Expr]:
    """Place and axes, as the linear and as second-order terms see them, by angles and what sine and cosine have beyond."""
    found = numbers_of_place(order, FOUR)
    known: dict[sp.Expr, sp.Expr] = {symbol("dR"): sp.Integer(0), symbol("radius"): _R}
    for name in ANGLES:
        x = symbol(name)
        known |= {sp.sin(x): x - _rest("s", name), sp.cos(x): 1 - x**2 / 2 + _rest("c", name)}
    level = {symbol(n): sp.Integer(0) for n in ANGLES}  # second-order terms of such an order see no angle

    def written(e: sp.Expr) -> sp.Expr:
        return e.xreplace(known)

    every = {n: written(found[n]) for n in _names("ri")}
    axes = found
    if not order.second_order_angles:
        axes = {n: e.xreplace(level) for n, e in numbers_of_place(EXACT, FOUR).items()}
    every |= {_second(n): written(axes[n]) for n in _names("iop")}
    return every | {n.replace("r", "q", 1): written(axes[n]) for n in _names("r")}


def _names(letters: str) -> list[str]:
    return [f"{n}_{d}" for n in letters for d in "rtz"]
