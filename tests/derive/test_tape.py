"""The tape: derivatives, degrees, rates; Eq. 5b and Eq. 30 as they follow from it."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from derive import ir
from derive.chain import recorded_motion
from derive.context import Context
from derive.effects import catalogue
from derive.propagation import MOTION_NUMBERS, collect, ideal
from derive.rotation import small_rotation
from derive.tape import About, Tape, partials
from tests.derive.evaluated import Evaluated, neutral_values

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


# those that differentiate by time, and some whose parameters stand under their derivatives
NESTED = ("encoder-harmonic", "gyro-delay", "time-offset", "lag")


def test_signatures_are_the_derivatives_of_the_whole_model_at_neutral_values() -> None:
    effects = [e for e in catalogue() if e.id in NESTED]
    assert len(effects) == len(NESTED)
    short = ir.chain((), "s", "", candidates=effects, kinematics="full").derivatives
    whole = ir.chain(effects, "w", "", kinematics="full").derivatives
    rng = np.random.default_rng(1)
    names = sorted({s.name for program in (short, whole) for s in program.inputs})
    values = {n: rng.normal(size=5) for n in names}
    values |= {s.name: np.full(5, float(v)) for s, v in neutral_values(effects).items()}
    found, expected = Evaluated(short)(values), Evaluated(whole)(values)
    rows = [n for n in found if n in expected]
    assert len(rows) == len(found) >= 8
    for n in rows:
        np.testing.assert_allclose(
            found[n], expected[n], rtol=1e-12, atol=1e-12 * np.max(np.abs(expected[n])), err_msg=n
        )


def test_degrees_and_rates_up_to_them() -> None:
    x, a, b, t = sp.symbols("x a b t", real=True)
    small = frozenset({a, b})
    tape = Tape()
    first = tape.let("first", x + a * t)
    second = tape.let("second", first**2 + sp.sin(b * t) * first)
    degrees = {
        e: tape.degree(e, small) for e in (x, a * b, first, second, sp.sin(a), sp.cos(a), a**3, a * first + x)
    }
    assert list(degrees.values()) == [0, 2, 0, 0, 1, 0, 3, 0]

    def base(s: sp.Symbol) -> sp.Expr:
        return {x: sp.Symbol("v", real=True), t: sp.Integer(1)}.get(s, sp.Integer(0))

    def plain(e: sp.Expr) -> sp.Expr:
        return e.subs(dict(reversed(tape.assignments))).subs(dict(reversed(tape.assignments)))

    v = base(x)
    exact = plain(tape.rate(second, base))
    linear = plain(tape.rate(second, base, About(small, 1)))
    none = plain(tape.rate(second, base, About(small, 0)))
    zero = {a: 0, b: 0}
    assert sp.expand(none.subs(zero) - 2 * x * v) == 0
    for s in (a, b):
        assert sp.expand(sp.diff(exact - linear, s).subs(zero)) == 0


def test_a_perfect_instrument_sees_two_gradients_at_twice_the_spin_rate() -> None:
    found = {
        (
            name,
            tuple(n for n, k in zip(MOTION_NUMBERS, t.motion, strict=True) if k),
            str(t.coefficient.as_expr()),
        )
        for name, terms in ideal(collect()).items()
        for t in terms
    }
    assert found == {("A_2s", ("T_1",), "R*k1"), ("A_2c", ("T_2",), "R*k1")}


def test_small_rotations_are_rotations_to_second_order() -> None:
    e = sp.symbols("e_x e_y e_z", real=True)
    scale = sp.Symbol("scale", positive=True)
    c = Context(Tape(), recorded_motion())
    turn = small_rotation(scale * sp.Matrix(e), "turn", c)
    named = dict(c.tape.assignments)
    excess = (turn * turn.T).applyfunc(lambda v: sp.expand(v.xreplace(named))) - sp.eye(3)
    assert all(sp.Poly(v, scale).monoms()[-1][0] >= 4 for v in excess if v != 0)
