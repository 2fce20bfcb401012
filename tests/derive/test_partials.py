"""Derivatives in one pass over an expression, against SymPy's own."""

from __future__ import annotations

import pytest
import sympy as sp

from derive.tape import Tape, partials

X, Y, Z = sp.symbols("x y z", real=True)


@pytest.mark.parametrize(
    "e",
    [
        sp.Integer(3),
        X,
        3 * X * Y**2 - Z / 7,
        (X + Y) * (X - Z) ** 3 * (Y * Z + 2),
        X / (1 + Y) ** 2 + sp.sqrt(1 + Z**2),
        sp.sin(X * Y) * sp.cos(Z) + Y * sp.Abs(Y),
        X**Y + sp.exp(X * Z),
        sp.pi * X * sp.Heaviside(Y, 1),
    ],
    ids=str,
)
def test_partials_are_derivatives(e: sp.Expr) -> None:
    found = partials(e)
    assert list(found) == sorted(found, key=lambda s: s.name)
    assert 0 not in found.values()
    for s in (X, Y, Z):
        assert (
            sp.simplify(
                found.get(s, sp.Integer(0)) - sp.diff(e, s).replace(sp.DiracDelta, lambda *_: sp.Integer(0))
            )
            == 0
        )


@pytest.mark.parametrize(
    "e",
    [
        X / sp.sin(sp.sign(X / Y)),
        sp.sin(sp.Abs(sp.sqrt(X)) * Y),
        Z * sp.exp(sp.sign(sp.sqrt(X) - Y)),
        sp.tanh(sp.Abs(X / Y) * Z),
    ],
    ids=str,
)
def test_no_derivative_is_left_open(e: sp.Expr) -> None:
    """Of functions of signs and moduli whose argument SymPy does not know to be real; against differences."""
    at, h = {X: 0.7, Y: 1.3, Z: -0.4}, 1e-6
    found = partials(e)
    for s in at:
        ends = [e.subs(at | {s: at[s] + d}).evalf() for d in (h, -h)]
        slope = found.get(s, sp.Integer(0)).subs(at).evalf()
        assert float(slope) == pytest.approx(float(ends[0] - ends[1]) / (2 * h), abs=1e-6)


def test_what_cancels_is_left_out() -> None:
    assert partials((X + Y) * 2 - 2 * X + Z) == {Y: 2, Z: 1}


def test_a_name_holds_one_value() -> None:
    tape = Tape()
    first = tape.let("product", X * Y)
    assert tape.let("product", Y * X) is first
    assert len(tape.assignments) == 1
    other = tape.let("product", X + Y)
    assert other != first
    assert tape.let("product", X + Y) is other
    assert [v for _, v in tape.assignments] == [X * Y, X + Y]
    assert tape.let("a_x", X**2).name != "a_x", "a channel has this name"
