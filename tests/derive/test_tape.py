"""The tape: derivatives, degrees, rates; Eq. 5b and Eq. 30 as they follow from it."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import numpy as np
import pytest
import sympy as sp

from derive import ir
from derive.effects import catalogue
from derive.pipeline import STARRED, starred
from derive.propagation import MOTION_NUMBERS, collect, ideal
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


def draw(rng: Random) -> Fraction:
    return Fraction(rng.randint(-99, 99), 97)


@pytest.mark.parametrize("seed", range(5))
def test_starred_coefficients_give_the_transducer_of_turned_forces(seed: int) -> None:
    rng = Random(seed)
    fx, fy, fz, tx, ty, tz = (draw(rng) for _ in range(6))
    K = {n: draw(rng) for n in ("K2", "K4", "K5", "K6", "K7", "K8")}
    # about x, then y, then z, each rotation to first order, written out by hand on the components
    y, z = fy + tx * fz, fz - tx * fy
    x, z = fx - ty * z, z + ty * fx
    i, o, p = x + tz * y, y - tz * x, z
    direct = (
        i + K["K2"] * i * i + K["K5"] * o * o + K["K7"] * p * p
        + K["K4"] * i * p + K["K6"] * i * o + K["K8"] * o * p
    )  # fmt: skip
    values = {sp.Symbol(n, real=True): sp.Rational(v.numerator, v.denominator) for n, v in
              {**K, "vartheta_x": tx, "vartheta_y": ty, "vartheta_z": tz}.items()}  # fmt: skip
    star = {n: e.xreplace(values) for n, e in starred().items()}
    total = sp.Rational(fx.numerator, fx.denominator)
    for name, (a, b, c) in STARRED.items():
        sign = -1 if name == "vartheta_y" else 1
        powers = fx**a * fy**b * fz**c
        total += sign * star[name] * sp.Rational(powers.numerator, powers.denominator)
    assert total == sp.Rational(direct.numerator, direct.denominator)


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
