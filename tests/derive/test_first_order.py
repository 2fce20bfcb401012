"""Signatures keep the first order in their parameters alone: that must be all that a derivative at zero asks for."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from derive import ir
from derive.effects import catalogue
from derive.stages import Kinematics
from derive.tape import About, Tape
from tests.derive.evaluated import evaluated, neutral_values

# those that differentiate by time, and some whose parameters stand under their derivatives
NESTED = (
    "encoder-harmonic",
    "spin-phase-offset",
    "gyro-delay",
    "time-offset",
    "arm-stretch",
    "lag",
    "output-filter",
)


@pytest.mark.parametrize("kinematics", ["platform", "full"])
def test_signatures_are_the_derivatives_of_the_whole_model_at_neutral_values(kinematics: Kinematics) -> None:
    effects = [e for e in catalogue() if e.id in NESTED]
    assert len(effects) == len(NESTED)
    short = ir.chain((), "s", "", candidates=effects, kinematics=kinematics).derivatives
    whole = ir.chain(effects, "w", "", kinematics=kinematics).derivatives
    rng = np.random.default_rng(1)
    names = sorted({s.name for program in (short, whole) for s in program.inputs})
    values = {n: rng.normal(size=5) for n in names}
    values |= {s.name: np.full(5, float(v)) for s, v in neutral_values(effects).items()}
    found, expected = evaluated(short)(values), evaluated(whole)(values)
    rows = [n for n in found if n in expected]
    assert len(rows) == len(found) >= 12
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
