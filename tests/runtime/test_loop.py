"""The loop, end to end, on flights of the independent reference: compare, diagnose, add, remove."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import numpy as np
import pytest

from ragg_runtime.identification.comparison import compare, compute_nominal_residual
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io import Flight
from ragg_runtime.model import model as load
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.signals.demodulate import demodulate
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
