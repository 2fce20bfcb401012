"""Attracting masses: Newton's law without cancellation, and its limits."""

from __future__ import annotations

from dataclasses import replace
from decimal import Decimal, getcontext
from types import MappingProxyType

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.observation import observe
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.model import derive
from ragg_runtime.model import model as load
from ragg_runtime.reference.gravity import (
    G,
    Gradient,
    PointMass,
    components,
    contract,
    gradient_series,
)
from ragg_runtime.reference.motion import Sinusoids
from ragg_runtime.reference.scenario import scenario
from tests.rate import RATE

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


MOVED = (("x", 0.1, 90.0), ("y", 0.6, 50.0), ("z", 0.2, 70.0))
"""How far, m, and how often, s, along each axis."""

EDGES = {"l_x": 0.8, "l_y": 0.3, "l_z": 0.5}


@pytest.mark.parametrize(
    ("body", "M", "known"),
    [
        pytest.param("near-sphere", 60.0, True, id="point, place known"),
        pytest.param("near-cuboid", 600.0, False, id="cuboid, place fitted"),
    ],
)
def test_a_body_that_moves_is_weighed_and_placed(body: str, M: float, known: bool) -> None:
    s = scenario(7, duration=200.0, rate=RATE)
    moving = {f"mass_{k}": Sinusoids(0.0, [a], [1 / T], [0.3]).value for k, a, T in MOVED}
    s = replace(s, auxiliaries={**s.auxiliaries, **moving})
    true = {"x": 1.0, "y": 0.7, "z": -0.4} | (EDGES if body == "near-cuboid" else {})
    flight = s.simulate({body: true | {"M": M}}).flight()
    stated = {n: RawQuantity(v + (0.0 if known or n in EDGES else 0.15), "m") for n, v in true.items()}
    setting = EffectSetting(body, MappingProxyType(stated), fixed=frozenset(stated if known else ()))
    sheet = replace(s.sheet, effects=(setting,))
    model = derive.with_effects(sheet, load.packaged(), [body])
    f = fitted.fit(model, sheet, [observe(flight, sheet)], candidates=False)
    c = f.calibration
    found = {
        q.name.split(".")[1]: (c.p[k], q.scale * np.sqrt(v))
        for q, k, v in zip(c.columns, c.index, np.diag(c.covariance), strict=True)
        if q.effect
    }
    assert set(found) == {"M"} if known else {"M", "x", "y", "z"}
    assert 20.0 < found["M"][0] / found["M"][1] < 40.0 if known else found["x"][1] < 0.02
    for name, (value, std) in found.items():
        assert abs(value - ({"M": M} | true)[name]) < 4 * std
