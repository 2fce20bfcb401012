"""Attracting masses: Newton's law without cancellation, and its limits."""

from __future__ import annotations

from decimal import Decimal, getcontext

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference.gravity import (
    G,
    Gradient,
    PointMass,
    components,
    contract,
    gradient_series,
)

T0 = np.zeros(1)
SITES = np.array([[1.2, 0.0, 0.0], [0.3, -0.9, 0.5], [20.0, 10.0, -30.0], [-2000.0, 500.0, 900.0]])


def _column(v: object) -> np.ndarray:
    return np.asarray(v, dtype=float).reshape(3, 1)


@pytest.mark.parametrize("site", SITES)
def test_difference_keeps_full_precision(site: np.ndarray) -> None:
    getcontext().prec = 60
    r = np.array([0.07, -0.05, 1e-3])
    m = 486.0

    def attraction(d: list[Decimal]) -> list[Decimal]:
        cube = sum(v * v for v in d).sqrt() ** 3
        return [Decimal(G) * Decimal(m) * v / cube for v in d]

    s = [Decimal(float(v)) for v in site]
    at_r = attraction([v - Decimal(float(w)) for v, w in zip(s, r, strict=True)])
    exact = np.array([float(a - b) for a, b in zip(at_r, attraction(s), strict=True)])
    computed = PointMass(m, site).difference(T0, _column(r))[:, 0]
    assert np.linalg.norm(computed - exact) < 1e-15 * np.linalg.norm(exact)


def test_gradient_is_what_a_small_step_sees() -> None:
    mass = PointMass(486.0, SITES[1])
    h = 1e-5
    for k in range(3):
        step = np.zeros((3, 1))
        step[k] = h
        slope = (mass.difference(T0, step) - mass.difference(T0, -step)) / (2 * h)
        np.testing.assert_allclose(slope, contract(mass.gradient(T0), step) / h, rtol=1e-8, atol=1e-16)


def test_gradient_is_traceless_outside() -> None:
    xx, _, _, yy, _, zz = PointMass(486.0, SITES[1]).gradient(T0)[:, 0]
    assert abs(xx + yy + zz) < 1e-12 * (abs(xx) + abs(yy) + abs(zz))


def test_newton_approaches_the_gradient_as_the_mass_recedes() -> None:
    r = _column([0.1, 0.02, -0.03])
    errors = []
    for distance in (10.0, 20.0, 40.0):
        mass = PointMass(distance**3, [0.8 * distance, 0.6 * distance, 0.0])
        linear = Gradient(mass.gradient(T0)[:, 0]).difference(T0, r)
        errors.append(np.linalg.norm(mass.difference(T0, r) - linear) / np.linalg.norm(linear))
    # What the linear field misses is of relative order r / s.
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.05)
    assert errors[1] / errors[2] == pytest.approx(2, rel=0.05)
    assert errors[0] < 0.03


def test_rotating_mass_of_the_paper() -> None:
    # Fig. 4: 486 kg at 1.2 m. Gamma_xx - Gamma_yy there is 3 G m / s^3, about 56 Eo.
    def circle(t: np.ndarray) -> np.ndarray:
        return np.stack([1.2 * np.cos(t), 1.2 * np.sin(t), 0 * t])

    gradient = PointMass(486.0, circle).gradient(np.array([0.0, np.pi / 4, np.pi / 2]))
    expected = 3 * G * 486 / 1.2**3
    np.testing.assert_allclose(gradient[0] - gradient[3], [expected, 0, -expected], atol=1e-16)
    np.testing.assert_allclose(gradient[1], [0, expected / 2, 0], atol=1e-16)


def test_a_series_is_interpolated() -> None:
    t = np.linspace(0, 10, 41)
    series = gradient_series(t, np.outer(np.arange(1, 7), np.sin(t)))
    np.testing.assert_allclose(
        series.gradient(np.array([3.3]))[:, 0], np.arange(1, 7) * np.sin(3.3), rtol=1e-4
    )


def test_bad_sources_are_refused() -> None:
    with pytest.raises(UserError, match="symmetric"):
        components([[1, 2, 3], [0, 1, 0], [3, 0, 1]])
    with pytest.raises(UserError, match="six components"):
        Gradient(np.zeros(5)).gradient(T0)
    with pytest.raises(UserError, match="sits on"):
        PointMass(1.0, [0, 0, 0]).difference(T0, _column([0.1, 0, 0]))
