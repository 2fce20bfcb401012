"""The loop, end to end, on flights of the independent reference: compare, diagnose, add, remove; flights that contradict each other."""

from __future__ import annotations

import dataclasses
import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from ragg_runtime.api import example
from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.fitted import estimate_variance
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import observe
from ragg_runtime.estimation.regressors import LinearisationPoint, linearise
from ragg_runtime.estimation.unknown_gradient import take_out, windows
from ragg_runtime.identification import contenders, selection
from ragg_runtime.identification.comparison import compare, compute_nominal_residual
from ragg_runtime.identification.ranking import list_not_testable
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io import Flight
from ragg_runtime.model import model as load
from ragg_runtime.model.evaluate import vector
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.signals.demodulate import demodulate
from ragg_runtime.simulate import simulate_flight
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed

G0 = 9.8
DURATION = 300.0


def flown(seed: int, effects: dict[str, Any] | None = None, **options: Any) -> tuple[Scenario, Flight]:
    s = scenario(seed, **({"duration": DURATION, "rate": RATE} | options))
    return s, s.simulate(effects or {}).flight()


def noise_of(s: Scenario) -> float:
    """Size of what is drawn as noise of the output, V."""
    run = s.simulate({})
    return float(np.std(run.G_out - run.G_out_noise_free))


def claimed(d: Diagnosis) -> set[str]:
    """What is found, and what the record cannot tell from it."""
    return set(d.found) | {o for r in d.ranking if r.effect in d.found for o in r.indistinguishable_from}


def test_a_flight_without_hidden_effect_is_adequate_and_its_error_is_the_noise() -> None:
    floors = []
    for seed in (41, 42):  # of a single flight the floor is known to 1.4 %
        s, flight = flown(seed, trim="table-v")
        c = compare(load.packaged(), s.sheet, [flight])
        assert c.adequate
        truth = noise_of(s) / c.fitted.k_ggi
        assert c.calibrated.rms_Eo == pytest.approx(truth, rel=0.01)
        assert c.nominal.rms_Eo > 100 * truth  # the test sheet alone is far off
        floors.append(c.noise_floor / truth)
    assert np.mean(floors) == pytest.approx(1.0, rel=0.02)
    d = diagnosed(s, flight)
    assert (d.verdict, d.found) == ("adequate", ())


HIDDEN: dict[str, dict[str, Any]] = {
    "cubic-input": {"K_iii": [4e-6 / G0**2, 0, 0, 0]},
    "thermal-scale": {"dK1_dT": [0, 0, 2e-7, 0]},
    "imu-lever-arm": {"l_x": 3e-3, "l_y": -2e-3},
    "bias-drift": {"dK0_dt": [2e-9 * G0, 0, 0, 0]},
}


def test_a_hidden_effect_is_found_and_the_error_falls_to_the_noise() -> None:
    hidden = {"imu-lever-arm": HIDDEN["imu-lever-arm"]}
    s, flight = flown(42, hidden, duration=640.0)  # its noise is known to less than a per cent
    d = diagnosed(s, flight)
    assert d.verdict == "missing-effect"
    assert "imu-lever-arm" in claimed(d)
    assert d.after.rms_Eo < d.before.rms_Eo
    assert d.after.rms_Eo == pytest.approx(d.noise_floor, rel=0.02)
    truth = noise_of(s) / d.fitted.k_ggi
    assert d.noise_floor == pytest.approx(truth, rel=0.02)  # the effect is no part of the noise


def test_an_unknown_gradient_is_no_effect_and_hides_none() -> None:
    s = scenario(45, duration=200.0, rate=RATE, gradient_rms=20e-9)
    clean = s.simulate({}, record_gradient=False).flight()
    d = diagnosed(s, clean)
    assert d.verdict == "adequate"
    # as `ragg add` scores the values it has written: no linearised residual is asked for
    at = d.fitted.calibration.p
    (scored,) = d.fitted.score((), lambda x: compute_nominal_residual(d.fitted, at, x)[None], 1)
    assert scored.whole.rms_Eo == pytest.approx(d.before.rms_Eo, rel=1e-3)
    hidden = s.simulate({"thermal-scale": HIDDEN["thermal-scale"]}, record_gradient=False).flight()
    assert "thermal-scale" in claimed(diagnosed(s, hidden))


def test_demodulated_channels_alone_tell_as_much_as_they_can() -> None:
    s = scenario(73, duration=500.0, rate=RATE)
    whole = s.simulate({"thermal-scale": {"dK1_dT": [0, 0, 1e-6, 0]}}).flight()
    a = s.sheet.accelerometers
    k_ggi = float(np.sum(a["k_VI"] * a["K1"] * (s.sheet.radius + a["dR"])))
    phi = 2 * np.pi * s.sheet.spin_frequency * whole.time
    c = demodulate(whole.outputs["G_out"], phi, whole.rate, k_ggi)
    inline, cross = np.full(len(phi), np.nan), np.full(len(phi), np.nan)
    inline[c.valid], cross[c.valid] = c.inline, c.cross
    channels = dataclasses.replace(
        whole, outputs={"inline": inline, "cross": cross}, valid=np.isfinite(inline), units={}
    )
    d = diagnosed(s, channels)
    assert d.verdict == "missing-effect"
    assert "thermal-scale" in claimed(d)
    assert d.before.inline_Eo > 30 * d.after.inline_Eo


def test_saturation_of_the_output_is_recognised() -> None:
    s = scenario(47, duration=DURATION, rate=RATE)
    G = s.simulate({}).G_out
    limit = float(np.quantile(np.abs(G), 0.98))
    flight = s.simulate({"saturation": {"V_max": limit}}).flight()
    d = diagnosed(s, flight)
    assert d.found == ("saturation",)
    first = json.loads(json.dumps(d.as_json(), allow_nan=False))["ranking"][0]  # certain: no infinity in JSON
    assert (first["effect"], first["p_value"], first["log10_p"]) == ("saturation", 0.0, None)
    assert "10⁻¹⁶" in d._repr_html_()


def named_flight(s: Scenario, name: str, hidden: dict[str, Any] | None = None) -> Flight:
    return dataclasses.replace(s.simulate(hidden or {}).flight(), name=name)


def test_flights_of_two_instruments_are_told_apart_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        contenders, "fit_contender", lambda *arguments: pytest.fail("no effect is to be tried")
    )
    one, other, third = (scenario(k, duration=100.0, rate=RATE) for k in (57, 58, 59))
    again = dataclasses.replace(third, instrument=one.instrument)
    d = diagnosed(
        one, named_flight(one, "monday"), named_flight(other, "tuesday"), named_flight(again, "friday")
    )
    assert (d.verdict, d.found) == ("unexplained", ())
    assert d.remark is not None
    assert "inconsistent" in d.remark
    assert "monday, friday; tuesday" in d.remark


def test_a_strong_effect_between_flights_is_no_contradiction() -> None:
    one, other = (scenario(k, duration=100.0, rate=RATE) for k in (57, 58))
    other = dataclasses.replace(other, instrument=one.instrument)
    hidden = {"pressure-bias": {"dK0_dp": [1e-8, 0.0, 0.0, -2e-9]}}
    d = diagnosed(one, named_flight(one, "low", hidden), named_flight(other, "high", hidden))
    assert (d.verdict, d.found) == ("missing-effect", ("pressure-bias",))


def test_what_each_flight_alone_lacks_is_said_where_all_together_are_not_explained() -> None:
    one, other = (scenario(k, duration=100.0, rate=RATE) for k in (57, 58))
    other = dataclasses.replace(other, instrument=one.instrument)
    hidden = {"cubic-input": {"K_iii": [4e-8, 0.0, 0.0, 0.0]}}
    d = diagnosed(one, named_flight(one, "monday", hidden), named_flight(other, "tuesday"))
    assert (d.verdict, d.found) == ("unexplained", ())
    said = d.as_json()["disagree"]
    assert said == [
        {"flights": ["monday"], "found": ["cubic-input"]},
        {"flights": ["tuesday"], "found": []},
    ]
    assert "cubic-input in monday; nothing in tuesday" in str(d.as_json()["reason"])


SIGNS = np.array([1.0, 1.0, -1.0, -1.0])


def test_an_effect_is_found_beside_a_shake_that_all_accelerometers_share() -> None:
    i = example()
    x = simulate_flight(
        i, ["cubic-input:K_iii=0/3/0/0"], seed=4, duration=100.0, rate=RATE, voltages=True, no_gradient=False
    )
    G = sum(s * x.outputs[f"V_{j}"] for j, s in enumerate(SIGNS, 1))
    shake = 30.0 * np.std(np.diff(G)) * np.random.default_rng(5).standard_normal(len(G))
    volts = {f"V_{j}": x.outputs[f"V_{j}"] + shake for j in range(1, 5)}  # cancels in G_out
    d = diagnosed(i, replace(x, outputs=volts))
    assert d.found == ("cubic-input",)
    assert d.final is not None
    (prepared,) = d.final.prepared
    assert np.sqrt(estimate_variance(prepared)) < 0.1 * np.std(shake)


def test_an_unknown_gradient_is_taken_out_of_each_voltage_by_its_scale_factor() -> None:
    s = scenario(62, trim="table-v", duration=200.0, noise_density=0.0)  # 10 to 12 mA/g
    flight = s.simulate(record_gradient=False).flight(voltages=True)
    o = observe(flight, s.sheet)
    model = load.packaged()
    true = s.sheet.replace(**s.instrument.accelerometers)
    e = linearise(LinearisationPoint(model, s.sheet, vector(model, true), with_candidates=False), o)[-1:]
    n = len(o.record.time)
    left = take_out(e, windows(o, slice(0, n), NoiseModel.white(o.record.rate, 4)), o.record.valid)
    assert np.std(e) > 1e-3
    assert np.std(left) < 0.01 * np.std(e)


def test_of_a_constant_gradient_it_leaves_nothing_and_the_report_says_why() -> None:
    """What it leaves is small before the calibration: to say that this absorbs the rest would be wrong."""
    s = scenario(62, duration=200.0, noise_density=1e-8)
    f = fitted.fit(load.packaged(), s.sheet, [observe(s.simulate(record_gradient=False).flight(), s.sheet)])
    why = {x.effect: x.why for x in list_not_testable(f, selection.make_field(f, selection.list_testable(f)))}
    assert "a gradient that is not recorded" in why["gradient-offset"]
