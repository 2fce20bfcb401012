"""Eq. 5b and Eq. 30 against direct evaluation in exact rationals."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import pytest
import sympy as sp

from derive.pipeline import STARRED, starred
from derive.propagation import MOTION_NUMBERS, collect, ideal


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
