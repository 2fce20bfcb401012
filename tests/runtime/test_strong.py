"""Strong effects: the calibration arrives, the right effect is named, and what has not arrived says so."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from types import MappingProxyType
from typing import Any

import commands
import numpy as np
import pytest

import ragg_runtime.api as ragg
from ragg_runtime.estimation import calibration
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification.comparison import compare
from ragg_runtime.identification.diagnose import SAME
from ragg_runtime.identification.steps import add_steps
from ragg_runtime.identification.strong import Stage
from ragg_runtime.io.files import write_flight
from ragg_runtime.model import model as load
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.wording import describe
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed

G0 = 9.8
DURATION = 250.0


def test_strong_effects_of_unequal_size_are_found_and_nothing_beside_them() -> None:
    s = scenario(57, duration=400.0, rate=RATE)
    scale, cubic = [0, 0, 2e-5, 0], [4e-6 / G0**2, 0, 0, 0]
    run = s.simulate({"thermal-scale": {"dK1_dT": scale}, "cubic-input": {"K_iii": cubic}})
    d = diagnosed(s, run.flight())
    assert d.final is not None
    assert d.converged
    assert (d.verdict, set(d.found)) == ("missing-effect", {"thermal-scale", "cubic-input"})
    assert [r.effect for r in d.ranking[:2]] == list(d.found)
    truth = np.std(run.G_out - run.G_out_noise_free) / d.outcome.target.k_ggi
    assert d.before.rms_Eo > 20 * truth
    assert d.after.rms_Eo == pytest.approx(truth, rel=0.02)
    assert d.noise_floor == pytest.approx(truth, rel=0.03 + (SAME - 1.0))


def test_an_effect_that_a_sheet_with_larger_errors_would_absorb_is_found() -> None:
    s = scenario(5, duration=250.0, rate=4.0)
    d = diagnosed(s, s.simulate({"spin-phase-offset": {"phi_0": 2e-3}}).flight())
    assert (d.verdict, d.found) == ("missing-effect", ("spin-phase-offset",))


@pytest.mark.parametrize(("size", "claimed"), [(0.002, True), (0.1, False)])
def test_a_size_that_anybody_would_see_is_not_claimed(size: float, *, claimed: bool) -> None:
    s = scenario(5, duration=250.0, rate=4.0)
    d = diagnosed(s, s.simulate({"imu-acceleration-scale": {"s_y": size}}).flight())
    assert ("imu-acceleration-scale" in d.found) is claimed


def test_a_size_that_is_unheard_of_is_not_claimed() -> None:
    s = scenario(3, duration=250.0, rate=4.0)
    run = s.simulate({})
    x, noise = run.flight(), float(np.std(run.G_out - run.G_out_noise_free))
    wz = x.channels["omega_z"]
    d = diagnosed(
        s, dataclasses.replace(x, outputs={"G_out": x.outputs["G_out"] + 2.0 * noise * wz / np.std(wz)})
    )
    assert (d.verdict, d.found) == ("unexplained", ()), "a gyro-bias of thousands of deg/h does the same"
    assert d.terms()[0]["term"] == "omega_z"


def test_a_strong_effect_keeps_no_coefficients_that_its_second_order_seemed_to_need() -> None:
    s = scenario(5, duration=200.0, rate=RATE)
    d = diagnosed(s, s.simulate({"gain-drift": {"dK1_dt": [0.0, 0.0, 0.0, 3e-9]}}).flight())
    assert d.found == ("gain-drift",)
    assert len(d.outcome.target.instrument.held) == 3


def test_a_strong_effect_gets_the_coefficients_that_are_weak_beside_its_strongest() -> None:
    s = scenario(5, duration=300.0, rate=RATE)
    true = np.array([8.0, -3.0, 2.0, -5.0]) * 1e-6
    d = diagnosed(s, s.simulate({"thermal-misalignment": {"dvartheta_y_dT": true.tolist()}}).flight())
    assert d.found == ("thermal-misalignment",)
    for p, right in zip(d.ranking[0].combinations, (8.0, 11.0, 7.0), strict=False):
        assert abs(p.value - right) < 3.0 * p.std < 4.0


def sheet_of_a_mems(s: Scenario) -> dict[str, Any]:
    arcsec = np.pi / 180 / 3600
    angles = dict.fromkeys(("beta_x", "beta_z", "vartheta_y", "vartheta_z"), 1800 * arcsec)
    squares = dict.fromkeys(("K2", "K4", "K5", "K6", "K7", "K8"), 1e-3 / G0)
    return {"dR": 5e-4, "K0": 1e-3 * G0, "K1": 1e-2 * 1e-2 / G0} | angles | squares


def test_an_instrument_of_per_cent_and_milli_g_is_calibrated_to_its_noise() -> None:
    s = scenario(1, duration=DURATION, rate=RATE, noise_density=2e-9)
    rng = np.random.default_rng(77)
    sigmas = sheet_of_a_mems(s)
    a = s.sheet.accelerometers
    true = s.sheet.replace(**{k: a[k] + v * rng.standard_normal(4) for k, v in sigmas.items()})
    sheet = dataclasses.replace(
        s.sheet, sigmas=MappingProxyType({k: np.full(4, v) for k, v in sigmas.items()})
    )
    run = dataclasses.replace(s, instrument=true).simulate()
    c = compare(load.load_packaged(), sheet, [run.flight()])
    truth = np.std(run.G_out - run.G_out_noise_free) / c.fitted.k_ggi
    assert c.nominal.rms_Eo > 1e3 * truth
    assert c.calibrated.rms_Eo == pytest.approx(truth, rel=0.01)
    assert c.noise_floor == pytest.approx(truth, rel=0.03)
    assert c.converged
    assert c.adequate
    assert not c.off_sheet  # by the sheet's own word


def test_nothing_is_missing_where_a_sheet_that_does_not_say_so_is_far_off() -> None:
    """Each kind of parameter is as sure as the record says; what is not off keeps its sheet."""
    s = scenario(2, duration=DURATION, rate=RATE)
    rng = np.random.default_rng(77)
    a = s.sheet.accelerometers
    true = s.sheet.replace(**{k: a[k] + v * rng.standard_normal(4) for k, v in sheet_of_a_mems(s).items()})
    run = dataclasses.replace(s, instrument=true).simulate()
    c = compare(load.load_packaged(), s.sheet, [run.flight()])
    truth = np.std(run.G_out - run.G_out_noise_free) / c.fitted.k_ggi
    assert c.calibrated.rms_Eo == pytest.approx(truth, rel=0.01)
    assert c.converged
    assert c.adequate
    assert c.off_sheet
    assert c.fitted.instrument.widths["K2"] > 3.0
    assert "K0" not in c.fitted.instrument.widths  # of which the record says nothing


GAIN_STEP = {"gain-step": {"dK1": [0, 1e-5, 0, 0], "t_step": 90.0}}


def test_a_line_that_the_motion_does_not_make_is_said_and_bars_nothing() -> None:
    s = scenario(57, duration=150.0, rate=RATE)
    run = s.simulate(GAIN_STEP)
    size = 5.0 * np.std(run.G_out - run.G_out_noise_free)
    x = run.flight()
    line = size * np.sin(2 * np.pi * 3.3 * x.time)
    d = diagnosed(s, dataclasses.replace(x, outputs={"G_out": x.outputs["G_out"] + line}))
    assert d.found == tuple(GAIN_STEP)
    instants = [p.value for p in d.ranking[0].parameters if p.name == "t_step"]
    assert instants == [pytest.approx(90.0, abs=0.1)]
    assert d.noise_floor == pytest.approx(size / d.outcome.target.k_ggi / 5.0, rel=0.03)
    assert d.verdict == "missing-effect"
    assert "the output has lines at 3.3 Hz" in str(d.remark)


def test_a_parameter_far_off_its_sheet_is_fitted_and_named() -> None:
    s = scenario(3, duration=DURATION, rate=RATE)
    K1 = s.instrument.accelerometers["K1"] * np.array([1.0, 1.04, 1.0, 1.0])
    c = compare(
        load.load_packaged(),
        s.sheet,
        [dataclasses.replace(s, instrument=s.instrument.replace(K1=K1)).simulate().flight()],
    )
    worst = c.off_sheet[0]
    assert worst.name == "K1"
    assert worst.sigmas == pytest.approx(40.0, rel=0.1)
    assert c.calibrated.rms_Eo < 1.05 * c.noise_floor
    assert c.as_json()["off_sheet"]


@pytest.fixture
def never_arrives(monkeypatch: pytest.MonkeyPatch) -> None:
    found = calibration.minimise

    def stopped(*arguments: Any, **options: Any) -> Any:
        return dataclasses.replace(found(*arguments, **options), converged=False, reason="stopped after")

    monkeypatch.setattr(calibration, "minimise", stopped)


def test_what_has_not_converged_says_so_and_adds_nothing(tmp_path: Path, never_arrives: None) -> None:
    m = ragg.new(tmp_path / "m")
    s = scenario(6, duration=150.0, rate=RATE)
    flight = s.simulate({"cubic-input": {"K_iii": [4e-6 / G0**2, 0, 0, 0]}}).flight()
    c = ragg.compare(m, [flight])
    d = ragg.diagnose(m, [flight], compared=c)
    for result in (c.as_json(), d.as_json()):
        assert result["converged"] is False
        assert "not converged: stopped after" in str(result["reason"])
    assert not c.adequate
    assert (d.verdict, d.found) == ("unexplained", ())
    assert "the calibration has not converged: stopped after" in describe.write_verdict(d.as_json())
    before = {p: p.read_bytes() for p in sorted((tmp_path / "m").rglob("*")) if p.is_file()}
    write_flight(flight, tmp_path / "f.parquet")
    done = commands.ragg(
        "add", tmp_path / "m", "cubic-input", tmp_path / "f.parquet", "--json", tmp_path / "a.json"
    )
    assert (done.returncode, "nothing was added" in done.stderr) == (2, True)
    added = json.loads((tmp_path / "a.json").read_text())
    assert added["converged"] is False
    assert "was NOT added" in describe.describe_addition(added, [])[0].sentences[0]
    assert {p: p.read_bytes() for p in sorted((tmp_path / "m").rglob("*")) if p.is_file()} == before


def test_a_step_in_red_noise_is_placed_to_the_sample() -> None:
    """Whitened columns that are cut off before the step lack its edge: they put it elsewhere."""
    s = scenario(33, duration=300.0, red_corner=0.05, noise_density=5e-9)
    flight = s.simulate({"bias-step": {"dK0": [1e-8, 0, 0, 0], "t_step": 141.2}}).flight()
    stage = Stage.of(fit(load.load_packaged(), s.sheet, observe_flights([flight], s.sheet)))
    assert [*stage.chosen] == ["bias-step"]
    # of samples a sixteenth of a second apart the first after it
    assert stage.instants["bias-step"] == 141.25


def test_a_step_in_one_voltage_is_placed_to_the_sample() -> None:
    """The filter of a noise that has the step in it makes a spike of its edge: one sample wide."""
    s = scenario(6, duration=120.0, rate=8.0, trim="table-v")
    effects = {"gain-step": {"dK1": [0, 3e-6, 0, 0], "t_step": 65.3}}
    flight = s.simulate(effects).flight(voltages=True)
    _, _, instants = add_steps(fit(load.load_packaged(), s.sheet, observe_flights([flight], s.sheet)))
    assert instants["gain-step"] == 65.375  # the first sample after it
