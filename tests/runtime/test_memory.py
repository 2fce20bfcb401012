"""What an instrument remembers, and bodies that attract it."""

from __future__ import annotations

from dataclasses import replace
from decimal import Decimal, getcontext
from functools import partial
from types import MappingProxyType

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.observation import observe
from ragg_runtime.identification.search import Evidence, Outcome
from ragg_runtime.identification.strong import AddedEffect, Stage
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.model import derive
from ragg_runtime.model import model as load
from ragg_runtime.model.memory import add_responses, first_memories, stop
from ragg_runtime.model.record import record
from ragg_runtime.reference.effects import EffectValues
from ragg_runtime.reference.gravity import G, PointMass
from ragg_runtime.reference.motion import Sinusoids
from ragg_runtime.reference.scenario import scenario
from tests.rate import RATE


def resonance(effect: str, f_0: float, Q: float, share: float) -> EffectValues:
    """A mount, or a mode of the first accelerometer, that carries so much of it."""
    w = 2 * np.pi * f_0
    own: dict[str, object] = {"share": share}
    if effect == "accelerometer-resonance":
        own = {"u": [share / (w * Q), 0, 0, 0], "v": [share / w**2, 0, 0, 0]}
    return {effect: {"f_0": f_0, "Q": Q, **own}}  # type: ignore[dict-item]


def of_first(effect: str, name: str, size: float, **shape: float) -> EffectValues:
    """One coefficient, in the first accelerometer."""
    return {effect: {name: [size, 0, 0, 0], **shape}}


@pytest.mark.parametrize(
    "hidden",
    [
        resonance("mount-resonance", 1.3, 4.0, 1.0),
        resonance("accelerometer-resonance", 3.0, 15.0, 1e-5),
        of_first("bias-hysteresis", "h_p", 1e-8, w=0.2),
        of_first("mount-hysteresis", "e_zx", 1e-7, w=0.03),
        of_first("inner-temperature", "s", 3e-6, tau=120.0),
        of_first("bias-creep", "c_p", 1e-6, tau=30.0),
        of_first("mount-creep", "e_yx", 1e-6, tau=3.0),
        of_first("thermal-hysteresis", "h", 1e-7, w=0.05),
    ],
    ids=str,
)
def test_what_describes_a_memory_is_fitted_down_to_noise(hidden: EffectValues) -> None:
    s = scenario(72, duration=240.0, rate=RATE)
    sim = s.simulate(hidden)
    ((effect, values),) = hidden.items()
    model = derive.with_effects(s.sheet, load.load_packaged(), [effect])
    f = fitted.fit(model, s.sheet, [observe(sim.flight(), s.sheet)], candidates=False)
    kept = f.observations[0].record.valid
    noise = float(np.std(sim.G_out - sim.G_out_noise_free))
    assert np.std(f.residuals()[0][kept]) < 1.02 * noise
    c = f.calibration
    found = {
        q.name.split(".")[1]: (c.p[k], q.scale * np.sqrt(v))
        for q, k, v in zip(c.columns, c.index, np.diag(c.covariance), strict=True)
        if q.effect
    }
    for name in {"f_0", "Q", "w", "tau"} & {*values}:
        (value, std), true = found[name], float(np.asarray(values[name]))
        assert std < 0.2 * true
        assert abs(value - true) < 4 * std + 0.01 * true


@pytest.mark.parametrize(
    ("hidden", "better"),
    [
        (resonance("accelerometer-resonance", 3.0, 10.0, 5e-7), True),
        (of_first("arm-stretch", "c_r", 1e-9), False),
    ],
)
def test_a_resonance_is_compared_with_what_it_looks_like(hidden: EffectValues, better: bool) -> None:
    """From 5 Hz, Q 10 its fit would end in a narrow minimum."""
    s = scenario(76, duration=60.0)
    extend = partial(derive.with_effects, s.sheet)
    flight = observe(s.simulate(hidden).flight(), s.sheet)
    first = Stage.of(fitted.fit(load.load_packaged(), s.sheet, [flight]))
    model = extend(first.fitted.model, ["arm-stretch"])
    target = fitted.fit(model, s.sheet, [flight], first.fitted.calibration.noise, candidates=False)
    test = first.problem.tests()["arm-stretch"]
    step = AddedEffect("arm-stretch", test, before=first.fitted, after=target, alternatives=(), instant=None)
    outcome = Outcome.of(target, ["arm-stretch"], ())
    found = Evidence(first, [step], first.without_choice(), outcome, extend, spent=False)
    ahead = found.weigh_instead(outcome, "accelerometer-resonance")
    assert ahead > 10.0 if better else ahead < -5.0


def test_what_slips_follows_the_force_within_its_width() -> None:
    x = np.cumsum(np.random.default_rng(0).standard_normal(500))
    expected, now = np.zeros(500), x[0]
    for n in range(500):
        now = min(max(now, x[n] - 3.0), x[n] + 3.0)
        expected[n] = (x[n] - now) / 3.0
    np.testing.assert_allclose(stop(x, 3.0), expected, atol=1e-12)


def test_a_part_of_a_record_hears_what_the_whole_one_does() -> None:
    s = scenario(72, duration=120.0)
    r = record(s.simulate().flight(), s.sheet)
    known = [m for _, m in first_memories(load.load_packaged().candidates, r)]
    names = (
        *("mount_a_x", "curvature_tangential", "rate_radial_by_f_0", "rate_radial_by_Q"),
        *("slip_radial", "play_axial", "play_axial_by_w", "heat_rt", "heat_start_by_tau"),
    )
    whole, part = (add_responses(x, known, names) for x in (r, r.part(slice(900, 1000))))
    for name in names:
        expected, got = whole.series(name), part.series(name)
        assert expected is not None and got is not None
        assert np.max(np.abs(got - expected[900:1000])) < 1e-4 * np.std(expected)


T0 = np.zeros(1)


def _column(v: object) -> np.ndarray:
    return np.asarray(v, dtype=float).reshape(3, 1)


@pytest.mark.parametrize("site", [[1.2, 0.0, 0.0], [0.3, -0.9, 0.5], [-2000.0, 500.0, 900.0]])
def test_difference_keeps_full_precision(site: list[float]) -> None:
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


def test_bad_sources_are_refused() -> None:
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
    model = derive.with_effects(sheet, load.load_packaged(), [body])
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
