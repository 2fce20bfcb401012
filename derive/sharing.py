"""Common subexpressions of a list of expressions."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import count

import sympy as sp
from sympy.core.sorting import default_sort_key

from derive.matching import noted
from derive.symbols import symbol

Shared = list[tuple[sp.Symbol, sp.Expr]]


def common(expressions: Sequence[sp.Expr]) -> tuple[Shared, list[sp.Expr]]:
    """Common subexpressions x0, x1 ... in order of use, and what is left: ``sympy.cse`` in canonical order, to the letter.

    In half the time: our expressions are commuting scalars, and the order of what a sum or product is made of is looked up.
    """
    better = noted(expressions)
    seen: set[sp.Expr] = set()
    repeated: set[sp.Expr] = set()
    taken: set[str] = set()

    def find(e: sp.Expr) -> None:
        if isinstance(e, int) or not e.args:  # a quotient is noted with an exponent of Python's
            if isinstance(e, sp.Symbol):
                taken.add(e.name)
        elif e in seen:
            repeated.add(e)
        else:
            seen.add(e)
            for part in better.get(e, e).args:
                find(part)

    for e in expressions:
        find(e)
    names = (s for n in count() if (s := symbol(f"x{n}")).name not in taken)
    shared: Shared = []
    names_of: dict[sp.Expr, sp.Symbol] = {}

    def rebuilt(e: sp.Expr) -> sp.Expr:
        if isinstance(e, int) or not e.args:
            return e
        if e in names_of:
            return names_of[e]
        made = better.get(e, e)
        parts = _in_order(made)
        new = [rebuilt(part) for part in parts]
        same = isinstance(made, sp.Basic) and all(a is b for a, b in zip(new, parts, strict=True))
        value = made if same else made.func(*new)
        if e not in repeated:
            return value
        names_of[e] = next(names)
        shared.append((names_of[e], value))
        return names_of[e]

    return shared, [rebuilt(e) for e in expressions]


def _in_order(e: sp.Expr) -> Sequence[sp.Expr]:
    """What an expression is made of, in SymPy's canonical order, a sign of a product apart."""
    return _ordered(e) if isinstance(e, (sp.Add, sp.Mul)) else e.args


@cache
def _ordered(e: sp.Expr) -> tuple[sp.Expr, ...]:
    """As ``sympy.ordered``: by the number of nodes; the canonical key, which takes long to find, is for equal ones alone."""
    of_size: dict[int, list[sp.Expr]] = {}
    for part in e.args_cnc()[0] if e.is_Mul else e.args:
        of_size.setdefault(_nodes(part), []).append(part)
    groups = (of_size[n] for n in sorted(of_size))
    return tuple(part for g in groups for part in (sorted(g, key=default_sort_key) if len(g) > 1 else g))


@cache
def _nodes(e: sp.Expr) -> int:
    return 1 + sum(map(_nodes, e.args))
