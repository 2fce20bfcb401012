"""The loop, end to end, on flights of the independent reference; what a verdict needs, flights that contradict each other."""

from __future__ import annotations

import dataclasses
import json
import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ragg_runtime.api import example
from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.fitted import estimate_variance, fit
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import observe, observe_flights
from ragg_runtime.estimation.regressors import linearise, make_point
from ragg_runtime.estimation.unknown_gradient import make_windows, take_out
from ragg_runtime.identification import selection, strong
from ragg_runtime.identification.comparison import compare, compute_residuals
from ragg_runtime.identification.diagnose import complete_ranking, diagnose
from ragg_runtime.identification.dictionary import Term
from ragg_runtime.identification.ranking import list_not_testable
from ragg_runtime.identification.result import Diagnosis, group_findings
from ragg_runtime.identification.verdict import _find_common_kind
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model import model as load
from ragg_runtime.model.model import load_packaged, make_vector
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.signals.demodulators import demodulate
from ragg_runtime.simulate import simulate_flight
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed

DURATION = 200.0


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
        c = compare(load.load_packaged(), s.sheet, [flight])
        assert c.adequate
        assert 0.999 < c.explained.share < 1.0
        truth = noise_of(s) / c.fitted.k_ggi
        assert c.calibrated.rms_Eo == pytest.approx(truth, rel=0.01)
        assert c.nominal.rms_Eo > 100 * truth  # the test sheet alone is far off
        floors.append(c.noise_floor / truth)
    assert np.mean(floors) == pytest.approx(1.0, rel=0.02)
    d = diagnosed(s, flight)
    assert (d.verdict, d.found) == ("adequate", ())


THERMAL = {"thermal-scale": {"dK1_dT": [0, 0, 2e-7, 0]}}


def test_an_unknown_gradient_is_no_effect_and_hides_none() -> None:
    s = scenario(45, duration=200.0, rate=RATE, gradient_rms=20e-9)
    clean = s.simulate({}, record_gradient=False).flight()
    d = diagnosed(s, clean)
    assert d.verdict == "adequate"
    # as `ragg add` scores the values it has written: no linearised residual is asked for
    at = d.fitted.calibration.p
    scored = d.fitted.score_residuals(compute_residuals(d.fitted, at))
    assert scored.whole.rms_Eo == pytest.approx(d.before.rms_Eo, rel=1e-3)
    hidden = s.simulate(THERMAL, record_gradient=False).flight()
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
    monkeypatch.setattr(strong, "score_fit", lambda *arguments: pytest.fail("no effect is to be tried"))
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
        {"flights": ["monday"], "found": ["cubic-input"], "explained": True},
        {"flights": ["tuesday"], "found": [], "explained": True},
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
    model = load.load_packaged()
    true = s.sheet.replace(**s.instrument.accelerometers)
    e = linearise(make_point(model, s.sheet, make_vector(model, true)), o)[-1:]
    n = len(o.record.time)
    left = take_out(e, make_windows(o, slice(0, n), NoiseModel.white(o.record.rate, 4)), o.record.valid)
    assert np.std(e) > 1e-3
    assert np.std(left) < 0.01 * np.std(e)


def test_of_a_constant_gradient_it_leaves_nothing_and_the_report_says_why() -> None:
    """What it leaves is small before the calibration: to say that this absorbs the rest would be wrong."""
    s = scenario(62, duration=200.0, noise_density=1e-8)
    f = fitted.fit(
        load.load_packaged(), s.sheet, [observe(s.simulate(record_gradient=False).flight(), s.sheet)]
    )
    why = {x.effect: x.why for x in list_not_testable(f, selection.make_problem(f))}
    assert "a gradient that is not recorded" in why["gradient-offset"]


def good_flight(seed: int = 3, duration: float = 90.0) -> tuple[Instrument, Flight]:
    s = scenario(seed, duration=duration)
    return s.sheet, s.simulate().flight()


def test_an_output_in_which_nothing_follows_the_motion_is_not_adequate() -> None:
    sheet, x = good_flight()
    shuffled = np.random.default_rng(1).permutation(x.outputs["G_out"])
    d = diagnose(load_packaged(), sheet, [replace(x, outputs={"G_out": shuffled})])
    assert (d.verdict, d.found) == ("unexplained", ())
    assert "the output does not follow the motion" in str(d.as_json()["reason"])
    assert d.outcome.explained.share < 0.5


def test_noise_that_follows_the_motion_is_said_and_accuses_nothing() -> None:
    s = scenario(11, duration=300.0, rate=RATE)
    sim = s.simulate()
    x = sim.flight()
    a = np.abs(x.channels["a_x"])
    noise = (sim.G_out - sim.G_out_noise_free) * (0.2 + a / np.sqrt(np.mean(a**2)))
    d = diagnose(load_packaged(), s.sheet, [replace(x, outputs={"G_out": sim.G_out_noise_free + noise})])
    assert d.verdict == "adequate"
    assert "the noise level changes with abs(a_x)" in str(d.as_json()["reason"])


@pytest.mark.parametrize(("frequency", "own"), [(0.5003, False), (0.5, True)])
def test_a_line_beside_a_multiple_of_the_spin_rate_accuses_nothing(frequency: float, own: bool) -> None:
    """At 300 s it slips by a tenth of a turn. What keeps step with the disc is the disc's."""
    s = scenario(12, duration=300.0)
    sim = s.simulate()
    x = sim.flight()
    size = 1.4 * np.std(sim.G_out - sim.G_out_noise_free)
    G = sim.G_out + size * np.cos(2 * np.pi * frequency * x.time + 1.0)
    d = diagnose(load_packaged(), s.sheet, [replace(x, outputs={"G_out": G})])
    assert d.ranking[0].log_p < -20.0  # an effect alone would be beyond doubt
    if own:
        assert d.verdict == "missing-effect"
        said = str(d.as_json()["reason"])
        assert f"{d.found[0]} acts as a constant term at twice the spin rate" in said
        assert "gradient-offset" in said  # of those that would do as well
        (group,) = d.groups
        assert group.name == "a constant term at twice the spin rate"
        assert group.effects[0] == d.found[0] and "gradient-offset" in group.effects
        assert f"Missing: one of {d.found[0]}" in d._repr_html_()
        assert f"; {group.name} explains as much: they are one finding" in d._repr_html_()
        return
    assert (d.verdict, d.found) == ("unexplained", ())
    said = re.search(r"a line at about ([0-9.]+) Hz", str(d.as_json()["reason"]))
    assert said is not None
    assert abs(float(said[1]) - frequency) < 0.2 / 300.0
    assert [t.kind for r in d.remainder.searches for t in r.terms] == ["line"]


def test_effects_that_look_alike_are_named_by_what_they_share() -> None:
    alike: Any = [SimpleNamespace(effect="spin-axis-tilt", indistinguishable_from=("imu-misalignment",))]
    shared: Any = SimpleNamespace(term=Term("cos 1", ("a_z",)))
    (group,) = group_findings(("spin-axis-tilt",), alike, (), shared)
    assert group.as_json() == {
        "name": "a term proportional to a_z at the spin rate",
        "effects": ["spin-axis-tilt", "imu-misalignment"],
    }
    (alone,) = group_findings(("bias-drift",), alike, (), shared)
    assert alone.name is None


@pytest.mark.parametrize(
    ("lost", "testable"),
    [
        (("B_z", "pitch"), {"magnetic-bias", "self-gradient"}),
        (("roll",), {"magnetic-bias", "self-gradient"}),
        (("B_x", "B_y", "B_z"), {"self-gradient"}),
        (("roll", "pitch"), {"magnetic-bias"}),
    ],
)
def test_an_effect_is_tested_with_the_channels_that_are_there(lost, testable) -> None:
    sheet, x = good_flight(duration=40.0)
    x = replace(x, channels={n: v for n, v in x.channels.items() if n not in lost})
    found = selection.list_testable(fit(load_packaged(), sheet, observe_flights([x], sheet)))
    assert {"magnetic-bias", "self-gradient"} & set(found) == testable


def test_what_the_recorder_did_is_claimed_where_generic_terms_do_as_well_as_effects() -> None:
    """What remains is then that of the model without effects, which has other columns than the last fit."""
    evidence: Any = SimpleNamespace(steps=(), last=None)
    rival: Any = SimpleNamespace(
        verdict="partly-explained", rival=True, remains=True, claims=("saturation",), outcome=None
    )
    row: Any = SimpleNamespace(effect="saturation")
    assert complete_ranking([row], evidence, rival) == [row]


def test_the_low_frequencies_of_an_accelerometers_resonance_are_not_two_effects() -> None:
    fitted = SimpleNamespace(model=load_packaged())
    found: Any = SimpleNamespace(
        first=SimpleNamespace(fitted=fitted), alternatives=lambda: {"arm-sag": ("second-order-loop",)}
    )
    assert _find_common_kind(found, ("lag", "second-order-loop")) == "accelerometer-resonance"
    assert _find_common_kind(found, ("lag", "arm-sag")) == "accelerometer-resonance"
    assert _find_common_kind(found, ("lag", "thermal-scale")) is None
