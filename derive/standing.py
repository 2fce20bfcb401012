"""V_j of an accelerometer at rest on the disc, at any order and place: a polynomial in the motion numbers of the disc.

Its coefficients are not written out in the parameters: at exact order that would be ten thousand terms. Each is a
small named expression on a tape, which is evaluated once for an instrument.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from derive.chain import accelerometer
from derive.harmonics import NotHarmonic
from derive.layout import AXES, Layout
from derive.stages import Order
from derive.symbols import COS_PHI, SIN_PHI, symbol
from derive.tape import Program, Tape, settled

Monomial = tuple[int, ...]
"""Powers of the motion numbers."""

Polynomial = Mapping[Monomial, sp.Expr]


@dataclass(frozen=True)
class Standing:
    """V_j by the motion numbers: the monomials that occur, and the program that gives their coefficients."""

    monomials: tuple[Monomial, ...]
    coefficients: Program


def standing(numbers: Sequence[str], order: Order, layout: Layout) -> Standing:
    """Derive V_j by ``numbers``: a (3) and M (3 x 3) along the directions r, t, z of the disc, in this order.

    Monomials that vanish for every place of the layout are left out.
    """
    on_disc = {s.name for s in AXES}
    chain = accelerometer(
        (),
        order,
        layout=replace(layout, constants={n: v for n, v in layout.constants.items() if n not in on_disc}),
    )
    tape, named = Tape(), chain.tape.assignments
    names = [*(f"a_{i}" for i in "xyz"), *(f"M_{i}{k}" for i in "xyz" for k in "xyz")]
    one: Monomial = (0,) * len(numbers)
    values: dict[sp.Symbol, Polynomial] = {
        symbol(n): {tuple(int(k == at) for k in range(len(numbers))): sp.Integer(1)}
        for at, n in enumerate(names)
    }
    values |= {COS_PHI: {one: sp.Integer(1)}, SIN_PHI: {}}  # the disc at its angle 0
    for s, e in named:
        if s not in values:
            found = _converted(e, values, one)
            values[s] = {
                m: tape.let(f"{s.name}_{''.join(map(str, m))}", c) for m, c in found.items() if c != 0
            }
    found = _converted(chain.voltage, values, one)
    outputs = [("".join(map(str, m)), c) for m, c in found.items()]
    kept = _occurring(tape, outputs, layout)
    monomials = sorted((m for m, (n, _) in zip(found, outputs, strict=True) if n in kept), key=_reading)
    at = dict(zip(found, outputs, strict=True))
    return Standing(
        tuple(monomials), settled(tape.assignments, dict(layout.common)).program([at[m] for m in monomials])
    )


def _reading(m: Monomial) -> tuple[object, ...]:
    """By degree, then by the first number."""
    return sum(m), tuple(-k for k in m)


def _converted(e: sp.Expr, values: Mapping[sp.Symbol, Polynomial], one: Monomial) -> Polynomial:
    if e.is_Symbol:
        return values.get(e, {one: e})
    if e.is_Add or e.is_Mul:
        first, *rest = (_converted(a, values, one) for a in e.args)
        for term in rest:
            first = _sum(first, term) if e.is_Add else _product(first, term)
        return first
    if e.is_Pow and e.exp.is_Integer and e.exp > 0:
        base = _converted(e.base, values, one)
        found = base
        for _ in range(int(e.exp) - 1):
            found = _product(found, base)
        return found
    inner = [_converted(a, values, one) for a in e.args]
    if any(m != one for p in inner for m in p):
        raise NotHarmonic(f"{e} is no polynomial in the motion numbers")
    return {one: e.func(*(p.get(one, sp.Integer(0)) for p in inner)) if e.args else e}


def _sum(p: Polynomial, q: Polynomial) -> Polynomial:
    found = dict(p)
    for m, c in q.items():
        found[m] = found[m] + c if m in found else c
    return found


def _product(p: Polynomial, q: Polynomial) -> Polynomial:
    found: dict[Monomial, list[sp.Expr]] = {}
    for m, c in p.items():
        for n, d in q.items():
            found.setdefault(tuple(a + b for a, b in zip(m, n, strict=True)), []).append(c * d)
    return {m: sp.Add(*terms) for m, terms in found.items()}


def _occurring(tape: Tape, outputs: Sequence[tuple[str, sp.Expr]], layout: Layout) -> set[str]:
    """Outputs that do not vanish at some place of the layout, by its constants that are 0, 1 or -1."""
    places = {
        tuple((n, int(v[j])) for n, v in layout.constants.items() if v[j] in (0.0, 1.0, -1.0))
        for j in range(layout.size)
    }
    found: set[str] = set()
    for place in places:
        known: dict[sp.Symbol, sp.Expr] = {symbol(n): sp.Integer(v) for n, v in place}
        for s, e in tape.assignments:
            changed = e.xreplace(known)
            if changed.is_Atom or (-changed).is_Atom:
                known[s] = changed
        found |= {n for n, e in outputs if e.xreplace(known) != 0}
    return found
