"""The loop, end to end, on flights of the independent reference; what a verdict needs, and what speaks for a claim or against it."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from ragg_runtime.api import example
from ragg_runtime.estimation.fitted import FITTED_BLOCKS, estimate_variance, fit
from ragg_runtime.estimation.observation import BLOCKS, observe, observe_flights
from ragg_runtime.estimation.scores import DISTINGUISHABLE
from ragg_runtime.identification import claims, selection, strong
from ragg_runtime.identification.claims import Regression
from ragg_runtime.identification.comparison import compare
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.ranking import list_not_testable
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.model import load_packaged
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.signals.demodulators import demodulate
from ragg_runtime.simulate import simulate_flight
from tests.simulated import RATE, diagnosed

Array = NDArray[np.float64]


def claimed(d: Diagnosis) -> set[str]:
    """What is found, and what the record cannot tell from it."""
    return set(d.found) | {o for r in d.ranking if r.effect in d.found for o in r.indistinguishable_from}


def test_a_flight_without_hidden_effect_is_adequate_and_its_error_is_the_noise() -> None:
    s = scenario(42, duration=200.0, rate=RATE, trim="table-v")
    run = s.simulate({})
    d = diagnosed(s, run.flight())
    assert (d.verdict, d.found) == ("adequate", ())
    truth = np.std(run.G_out - run.G_out_noise_free) / d.fitted.k_ggi
    assert d.before.rms_Eo == pytest.approx(truth, rel=0.01)
    assert d.noise_floor == pytest.approx(truth, rel=0.04)
    c = compare(load_packaged(), s.sheet, [run.flight()])
    assert c.adequate and 0.999 < c.explained.share < 1.0
    assert c.nominal.rms_Eo > 100 * truth  # the test sheet alone is far off


THERMAL = {"thermal-scale": {"dK1_dT": [0, 0, 2e-7, 0]}}


def test_an_unknown_gradient_is_no_effect_and_hides_none() -> None:
    s = scenario(45, duration=100.0, rate=RATE, gradient_rms=20e-9)
    assert diagnosed(s, s.simulate({}, record_gradient=False).flight()).verdict == "adequate"
    hidden = s.simulate(THERMAL, record_gradient=False).flight()
    assert "thermal-scale" in claimed(diagnosed(s, hidden))


def test_demodulated_channels_alone_tell_as_much_as_they_can() -> None:
    s = scenario(73, duration=500.0, rate=RATE)
    whole = s.simulate({"thermal-scale": {"dK1_dT": [0, 0, 1e-6, 0]}}).flight()
    phi = 2 * np.pi * s.sheet.spin_frequency * whole.time
    c = demodulate(whole.outputs["G_out"], phi, whole.rate, s.sheet.scale_factor)
    inline, cross = np.full(len(phi), np.nan), np.full(len(phi), np.nan)
    inline[c.valid], cross[c.valid] = c.inline, c.cross
    outputs = {"inline": inline, "cross": cross}
    d = diagnosed(s, replace(whole, outputs=outputs, valid=np.isfinite(inline), units={}))
    assert d.verdict == "missing-effect"
    assert "thermal-scale" in claimed(d)
    assert d.before.inline_Eo > 30 * d.after.inline_Eo


def test_saturation_of_the_output_is_recognised() -> None:
    s = scenario(47, duration=200.0, rate=RATE)
    limit = float(np.quantile(np.abs(s.simulate({}).G_out), 0.98))
    d = diagnosed(s, s.simulate({"saturation": {"V_max": limit}}).flight())
    assert d.found == ("saturation",)
    first = json.loads(json.dumps(d.as_json(), allow_nan=False))["ranking"][0]  # certain: no infinity in JSON
    assert (first["effect"], first["p_value"], first["log10_p"]) == ("saturation", 0.0, None)
    assert "10⁻¹⁶" in d._repr_html_()


def named_flight(s: Scenario, name: str, hidden: dict[str, Any] | None = None) -> Flight:
    return replace(s.simulate(hidden or {}).flight(), name=name)


def test_flights_of_two_instruments_are_told_apart_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(strong, "score_fit", lambda *arguments: pytest.fail("no effect is to be tried"))
    one, other, third = (scenario(k, duration=100.0, rate=RATE) for k in (57, 58, 59))
    again = replace(third, instrument=one.instrument)
    d = diagnosed(
        one, named_flight(one, "monday"), named_flight(other, "tuesday"), named_flight(again, "friday")
    )
    assert (d.verdict, d.found) == ("unexplained", ())
    assert d.remark is not None
    assert "inconsistent" in d.remark
    assert "monday, friday; tuesday" in d.remark


def test_a_strong_effect_between_flights_is_no_contradiction() -> None:
    one, other = (scenario(k, duration=100.0, rate=RATE) for k in (57, 58))
    other = replace(other, instrument=one.instrument)
    hidden = {"pressure-bias": {"dK0_dp": [1e-8, 0.0, 0.0, -2e-9]}}
    d = diagnosed(one, named_flight(one, "low", hidden), named_flight(other, "high", hidden))
    assert (d.verdict, d.found) == ("missing-effect", ("pressure-bias",))


def test_what_each_flight_alone_lacks_is_said_where_all_together_are_not_explained() -> None:
    one, other = (scenario(k, duration=100.0, rate=RATE) for k in (57, 58))
    other = replace(other, instrument=one.instrument)
    hidden = {"cubic-input": {"K_iii": [4e-8, 0.0, 0.0, 0.0]}}
    d = diagnosed(one, named_flight(one, "monday", hidden), named_flight(other, "tuesday"))
    assert (d.verdict, d.found) == ("unexplained", ())
    groups = [(x["flights"], x["found"], x["explained"]) for x in d.as_json()["disagree"]]
    assert groups == [(["monday"], ["cubic-input"], True), (["tuesday"], [], True)]
    assert "cubic-input in monday; nothing in tuesday" in str(d.as_json()["reason"])


SIGNS = np.array([1.0, 1.0, -1.0, -1.0])


def test_an_effect_is_found_beside_a_shake_that_all_accelerometers_share() -> None:
    i = example()
    x = simulate_flight(
        i, ["cubic-input:K_iii=0/3/0/0"], seed=4, duration=60.0, rate=RATE, voltages=True, no_gradient=False
    )
    G = sum(s * x.outputs[f"V_{j}"] for j, s in enumerate(SIGNS, 1))
    shake = 30.0 * np.std(np.diff(G)) * np.random.default_rng(5).standard_normal(len(G))
    volts = {f"V_{j}": x.outputs[f"V_{j}"] + shake for j in range(1, 5)}  # cancels in G_out
    d = diagnosed(i, replace(x, outputs=volts))
    assert d.found == ("cubic-input",)
    assert d.final is not None
    (prepared,) = d.final.prepared
    assert np.sqrt(estimate_variance(prepared)) < 0.1 * np.std(shake)


def test_of_a_constant_gradient_it_leaves_nothing_and_the_report_says_why() -> None:
    """What it leaves is small before the calibration: to say that this absorbs the rest would be wrong."""
    s = scenario(62, duration=200.0, noise_density=1e-8)
    f = fit(load_packaged(), s.sheet, [observe(s.simulate(record_gradient=False).flight(), s.sheet)])
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


ROWS = 200


def regression(sizes: Array, *, further: int = 0) -> Regression:
    """An effect's column of so many sigma in each block (BLOCKS,), ``further`` that nothing excites, and one of the instrument."""
    rng = np.random.default_rng(1)
    blocks = []
    for size in sizes:
        X = np.column_stack([rng.normal(size=(ROWS, 2)), 1e-9 * rng.normal(size=(ROWS, further))])
        y = rng.normal(size=ROWS) + X[:, 1] * size / np.sqrt(ROWS)
        blocks.append(np.linalg.qr(np.column_stack([X, y]), mode="r"))
    effects = (None, *(["e"] * (1 + further)))
    return Regression((tuple(blocks),), np.zeros(2 + further), np.zeros(2 + further), effects)


def test_held_out_blocks_speak_for_what_is_there_and_against_what_is_not() -> None:
    fitted = np.isin(np.arange(BLOCKS), FITTED_BLOCKS)
    assert claims.weigh_held_out(regression(np.full(BLOCKS, 2.0)), "e") > 5.0
    assert claims.weigh_held_out(regression(np.where(fitted, 2.0, -2.0)), "e") < -20.0
    assert abs(claims.weigh_held_out(regression(np.zeros(BLOCKS)), "e")) < DISTINGUISHABLE
    # coefficients that nothing excites cost a claim nothing
    few, many = (claims.weigh_held_out(regression(np.full(BLOCKS, 2.0), further=n), "e") for n in (0, 12))
    assert many == pytest.approx(few, abs=3.0)
