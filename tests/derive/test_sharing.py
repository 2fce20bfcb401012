"""Common subexpressions are those that SymPy finds, by the same names in the same order; operations are counted as it counts them."""

from __future__ import annotations

import pytest
import sympy as sp

from derive import ir
from derive.chain import accelerometer
from derive.effect import Effect
from derive.effects import catalogue
from derive.sharing import common
from derive.symbols import symbol

EVERY = [e for e in catalogue() if e.kind in ("deterministic", "step")]


@pytest.mark.parametrize("effects", [EVERY[k::3] for k in range(3)], ids=lambda effects: effects[0].id)
def test_what_is_shared_is_what_sympy_shares(effects: list[Effect]) -> None:
    """Of the chains with a third of the catalogue each, and of what SymPy notes for them: signs, quotients, parts of sums."""
    expressions = [e for _, e in accelerometer(effects).tape.assignments]
    names = (symbol(f"x{n}") for n in range(10_000))
    shared, left = sp.cse(expressions, symbols=names, order="canonical")
    assert len(shared) > 50
    assert common(expressions) == (shared, left)


@pytest.mark.parametrize("effects", [EVERY[k::3] for k in range(3)], ids=lambda effects: effects[0].id)
def test_operations_are_counted_as_sympy_counts_them(effects: list[Effect]) -> None:
    """Of the chains before anything is shared, and of what is shared: signs, quotients, powers, functions."""
    expressions = [e for _, e in accelerometer(effects).tape.assignments]
    shared, left = common(expressions)
    for e in [*expressions, *(x for _, x in shared), *left]:
        assert ir._counted(e) == sp.count_ops(e)


def test_names_that_are_taken_are_passed_over() -> None:
    x0, y = symbol("x0"), symbol("y")
    shared, left = common([sp.sin(x0 + y), sp.cos(x0 + y), -(x0 + y) / y])
    x1 = symbol("x1")
    assert (shared, left) == ([(x1, x0 + y)], [sp.sin(x1), sp.cos(x1), -x1 / y])
