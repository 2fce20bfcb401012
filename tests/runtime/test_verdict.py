"""Verdicts: strong effects, calibrations that arrive or do not, and what screening found, which is part of the verdict."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import commands
import numpy as np
import pytest
from scipy.linalg import toeplitz
from scipy.signal import lfilter

from generated.output_effects import imu_saturation
from ragg_runtime import api
from ragg_runtime.compensation.calibrate import calibrate, compare_frozen, make_saved
from ragg_runtime.estimation import calibration
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe, observe_flights
from ragg_runtime.identification.comparison import compare
from ragg_runtime.identification.diagnose import SAME, diagnose
from ragg_runtime.identification.result import Diagnosis, Reason, heed_flags
from ragg_runtime.identification.steps import add_steps
from ragg_runtime.identification.strong import Stage
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.io.files import write_flight
from ragg_runtime.io.record import GRADIENT, Flag
from ragg_runtime.model.model import load_packaged
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.screening import motion_noise, screen
from ragg_runtime.screening.screen import AT_REST, list_remarks
from ragg_runtime.wording import describe
from tests.simulated import RATE, diagnosed

G0 = 9.8


def told(effects: dict[str, Any], seed: int = 5, duration: float = 200.0, rate: float = 4.0) -> Diagnosis:
    """The diagnosis of a flight with these effects."""
    s = scenario(seed, duration=duration, rate=rate)
    return diagnosed(s, s.simulate(effects).flight())


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
    d = told({"spin-phase-offset": {"phi_0": 2e-3}}, duration=250.0)
    assert (d.verdict, d.found) == ("missing-effect", ("spin-phase-offset",))


@pytest.mark.parametrize(("size", "claimed"), [(0.002, True), (0.1, False)])
def test_a_size_that_anybody_would_see_is_not_claimed(size: float, *, claimed: bool) -> None:
    d = told({"imu-acceleration-scale": {"s_y": size}}, duration=250.0)
    assert ("imu-acceleration-scale" in d.found) is claimed


def test_a_size_that_is_unheard_of_is_not_claimed() -> None:
    s = scenario(3, duration=150.0, rate=4.0)
    run = s.simulate({})
    x, noise = run.flight(), float(np.std(run.G_out - run.G_out_noise_free))
    wz = x.channels["omega_z"]
    further = 2.0 * noise * wz / np.std(wz)
    d = diagnosed(s, replace(x, outputs={"G_out": x.outputs["G_out"] + further}))
    assert (d.verdict, d.found) == ("unexplained", ()), "a gyro-bias of thousands of deg/h does the same"
    assert d.terms()[0]["term"] == "omega_z"


def test_a_strong_effect_keeps_no_coefficients_that_its_second_order_seemed_to_need() -> None:
    d = told({"gain-drift": {"dK1_dt": [0.0, 0.0, 0.0, 3e-9]}}, rate=RATE)
    assert d.found == ("gain-drift",)
    assert len(d.outcome.target.instrument.held) == 3


def test_a_strong_effect_gets_the_coefficients_that_are_weak_beside_its_strongest() -> None:
    true = np.array([8.0, -3.0, 2.0, -5.0]) * 1e-6
    d = told({"thermal-misalignment": {"dvartheta_y_dT": true.tolist()}}, duration=300.0, rate=RATE)
    assert d.found == ("thermal-misalignment",)
    for p, right in zip(d.ranking[0].combinations, (8.0, 11.0, 7.0), strict=False):
        assert abs(p.value - right) < 3.0 * p.std < 4.0


ARCSEC = np.pi / 180 / 3600
MEMS = {
    "dR": 5e-4,
    "K0": 1e-3 * G0,
    "K1": 1e-2 * 1e-2 / G0,
    **dict.fromkeys(("beta_x", "beta_z", "vartheta_y", "vartheta_z"), 1800 * ARCSEC),
    **dict.fromkeys(("K2", "K4", "K5", "K6", "K7", "K8"), 1e-3 / G0),
}
"""Per cent of gain, milli-g of bias: how far off the sheet of such an instrument may be."""


@pytest.mark.parametrize("said", [True, False])
def test_a_sheet_that_is_far_off_is_calibrated_to_the_noise_and_nothing_is_missing(said: bool) -> None:
    """Whether it says so or not: each kind of parameter is as sure as the record says; what is not off keeps its sheet."""
    s = scenario(2, duration=250.0, rate=RATE)
    rng, a = np.random.default_rng(77), s.sheet.accelerometers
    true = s.sheet.replace(**{k: a[k] + v * rng.standard_normal(4) for k, v in MEMS.items()})
    sure = MappingProxyType({k: np.full(4, v) for k, v in MEMS.items()})
    run = replace(s, instrument=true).simulate()
    c = compare(load_packaged(), replace(s.sheet, sigmas=sure) if said else s.sheet, [run.flight()])
    truth = np.std(run.G_out - run.G_out_noise_free) / c.fitted.k_ggi
    assert c.nominal.rms_Eo > 1e3 * truth
    assert c.calibrated.rms_Eo == pytest.approx(truth, rel=0.01)
    assert c.noise_floor == pytest.approx(truth, rel=0.03)
    assert c.converged and c.adequate
    assert bool(c.off_sheet) is not said
    if not said:
        assert c.fitted.instrument.widths["K2"] > 3.0
        assert "K0" not in c.fitted.instrument.widths  # of which the record says nothing


def test_a_line_that_the_motion_does_not_make_is_said_and_bars_nothing() -> None:
    s = scenario(57, duration=150.0, rate=RATE)
    run = s.simulate({"thermal-scale": {"dK1_dT": [0, 0, 2e-6, 0]}})
    size = 5.0 * np.std(run.G_out - run.G_out_noise_free)
    x = run.flight()
    line = size * np.sin(2 * np.pi * 3.3 * x.time)
    d = diagnosed(s, replace(x, outputs={"G_out": x.outputs["G_out"] + line}))
    assert (d.verdict, d.found) == ("missing-effect", ("thermal-scale",))
    assert d.noise_floor == pytest.approx(size / d.outcome.target.k_ggi / 5.0, rel=0.03 + (SAME - 1.0))
    assert "the output has lines at 3.3 Hz" in str(d.remark)


def test_what_has_not_converged_says_so_and_adds_nothing(tmp_path: Path, monkeypatch) -> None:
    minimise = calibration.minimise

    def stopped(*arguments: Any, **options: Any) -> Any:
        return replace(minimise(*arguments, **options), converged=False, reason="stopped after")

    monkeypatch.setattr(calibration, "minimise", stopped)
    m = api.new(tmp_path / "m")
    s = scenario(6, duration=80.0, rate=RATE)
    flight = s.simulate({"cubic-input": {"K_iii": [4e-6 / G0**2, 0, 0, 0]}}).flight()
    c = api.compare(m, [flight])
    d = api.diagnose(m, [flight], compared=c)
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


def fitted_to(s: Scenario, effects: dict[str, Any], *, voltages: bool = False) -> Any:
    flight = s.simulate(effects).flight(voltages=voltages)
    return fit(load_packaged(), s.sheet, observe_flights([flight], s.sheet))


def test_steps_are_placed_to_the_sample() -> None:
    """In red noise, where whitened columns that are cut off before the step lack its edge; in one voltage, where the filter of a noise
    that has the step in it makes a spike of its edge.
    """
    s = scenario(33, duration=300.0, rate=RATE, red_corner=0.05, noise_density=5e-9)
    stage = Stage.of(fitted_to(s, {"bias-step": {"dK0": [1e-8, 0, 0, 0], "t_step": 141.2}}))
    assert [*stage.chosen] == ["bias-step"]
    assert stage.instants["bias-step"] == 141.25  # the first sample after it
    s = scenario(6, duration=120.0, rate=RATE, trim="table-v")
    step = {"gain-step": {"dK1": [0, 3e-6, 0, 0], "t_step": 65.3}}
    assert add_steps(fitted_to(s, step, voltages=True))[2]["gain-step"] == 65.375


# --- what screening found ---

STEP = 32 / 65536 * 9.8
"""m/s^2: 16 bits over +-16 g."""


def test_what_is_odd_about_the_motion_is_the_reason_and_not_an_effect() -> None:
    s, model = scenario(4, duration=150.0, rate=RATE, trim="table-v"), load_packaged()
    x = s.simulate().flight()
    rng, force = np.random.default_rng(1), ("a_x", "a_y", "a_z")

    def having(**channels: Any) -> Any:
        return replace(x, channels={**x.channels, **channels})

    steps = {n: np.round(x.channels[n] / STEP) * STEP for n in force}
    coarse, one = screen(model, s.sheet, having(**steps)), screen(model, s.sheet, having(a_x=steps["a_x"]))
    noisy = having(**{n: x.channels[n] + 1e-3 * rng.standard_normal(len(x)) for n in force})
    still = screen(model, s.sheet, having(a_x=np.full(len(x), float(np.mean(x.channels["a_x"])))))
    for flight, words in (
        (coarse, "in steps of"),
        (one, "in steps of"),
        (screen(model, s.sheet, noisy), "have a noise floor of"),
        (still, "a_x does not change at all"),
    ):
        assert any(words in note for note in flight.notes)
    for flight in (one, coarse):  # what steps leave follows the angle of the disc, or is as loud throughout
        d = diagnose(model, s.sheet, [flight])
        assert (d.verdict, d.found, d.remark) == ("adequate", (), None)
        assert d.noise_floor == pytest.approx(d.before.rms_Eo, rel=0.1)

    def heeded(flight: Any, **instead: Any) -> Diagnosis:
        return heed_flags(replace(d, **instead), [flight])

    missing = {"verdict": "missing-effect", "found": ("magnetic-scale",)}
    h = heeded(still, **missing)
    assert (h.verdict, h.found) == ("unexplained", ())
    assert "a_x does not change at all" in str(h.reason)
    odd = x.flagged([Flag((), "a spin rate of its own", open=True, effects=("spin-rate-offset",))])
    h = heeded(odd, verdict="missing-effect", found=("magnetic-scale", "spin-rate-offset"))
    assert (h.verdict, h.found) == ("partly-explained", ("spin-rate-offset",))
    assert "magnetic-scale would explain it, but" in " ".join(r.text for r in h.reasons)

    def remarked(**channels: Any) -> Any:
        return x.flagged(list_remarks(s.sheet, having(**channels)))

    for levels, said in ((1, False), (3, True), (40, False)):
        warm = remarked(temperature=290.0 + np.floor(levels * np.arange(len(x)) / len(x)))
        h = heeded(warm, verdict="missing-effect", found=("gain-drift",))
        assert (h.found, "may look like a drift" in str(h.reason)) == (("gain-drift",), said)
    h = heeded(remarked(**{n: np.full(len(x), np.mean(v)) for n, v in x.channels.items()}), reasons=())
    assert (h.verdict, h.reason) == ("adequate", AT_REST)
    louder = (Reason("the noise level changes over the record"),)
    h = heeded(remarked(a_z=np.full(len(x), 9.8)), reasons=louder)
    assert h.verdict == "unexplained"
    assert str(h.reason).startswith("a_z does not change at all")


def test_noise_is_smoothed_to_the_best_prediction_at_the_ends_and_beside_gaps_too() -> None:
    rng = np.random.default_rng(5)
    n, pole, std = 2000, 0.9, 2.0
    x = lfilter([1.0], [1.0, -pole], rng.standard_normal(n + 200))[200:]
    present = np.ones(n, dtype=np.bool_)
    present[1600:1620] = False
    present[rng.random(n) < 0.08] = False  # codes of missing values: no run of a hundred samples is whole
    measured = x + std * rng.standard_normal(n)
    C = toeplitz(pole ** np.arange(n) / (1 - pole**2))[np.ix_(present, present)]
    best = C @ np.linalg.solve(C + std**2 * np.eye(len(C)), measured[present])
    estimates = motion_noise.predict_true(measured, present, std)[present], best, measured[present]
    errors = [float(np.sqrt(np.mean((e - x[present]) ** 2))) for e in estimates]
    assert errors[0] < 1.15 * errors[1] < 0.7 * errors[2]


@pytest.mark.parametrize(("size", "used"), [(5.0, True), (50.0, False)])
def test_a_noisy_gradient_is_smoothed_or_not_used(monkeypatch, size: float, used: bool) -> None:
    s, model = scenario(3, duration=150.0, rate=RATE, trim="table-v"), load_packaged()
    x = s.simulate().flight()
    monkeypatch.setattr(motion_noise, "TRIED", len(x) // 2)  # of a long record a part decides
    rng = np.random.default_rng(1)
    noisy = {n: x.channels[n] + size * EOTVOS * rng.standard_normal(len(x)) for n in GRADIENT}
    flight = screen(model, s.sheet, replace(x, channels={**x.channels, **noisy}))
    assert ("Gamma_xx" in flight.channels) == used
    assert any("have a noise floor of" in note and "Eo" in note for note in flight.notes)
    assert compare(model, s.sheet, [flight]).adequate


SAMPLES = 4000
TIME = np.arange(SAMPLES) / 16.0
MOVING = np.sin(0.3 * TIME) + 0.2 * np.random.default_rng(1).standard_normal(SAMPLES)
ALL = np.ones(SAMPLES, dtype=bool)
NO_END = {
    "noise": MOVING,
    "zero": np.zeros(SAMPLES),
    "at rest": np.full(SAMPLES, 9.8),
    "coarsely quantised": np.round(MOVING * 8) / 8,
    "slow, so that it dwells at its largest values": np.round(np.sin(0.3 * TIME) * 100) / 100,
    "20 steps": np.r_[np.round(20 * np.sin(0.02 * TIME[:600])), np.round(20 * MOVING[600:]).clip(-18, 18)],
    "repeats itself, sample by sample": np.sin(2 * np.pi * TIME / 16),
}  # fmt: skip


def test_the_end_of_a_range_is_recognised_and_nothing_else() -> None:
    mask = imu_saturation.clipped(np.clip(MOVING, -0.9, 0.9), ALL)
    assert np.array_equal(mask, np.abs(MOVING) >= 0.9)
    assert imu_saturation.present(np.clip(MOVING, -0.9, 0.9), ALL, 0.0)
    for kind, x in NO_END.items():
        assert not imu_saturation.clipped(x, ALL).any(), kind


def test_a_flight_with_saturated_gyroscopes_is_diagnosed() -> None:
    s = scenario(47, duration=200.0, rate=RATE)
    rates = s.simulate().channels["omega_y"]
    limit = float(np.quantile(np.abs(rates), 0.98))
    flight = s.simulate({"imu-saturation": {"omega_max": limit}}).flight()
    assert float(np.max(np.abs(flight.channels["omega_y"]))) == limit
    assert not np.any(observe(flight, s.sheet).record.valid[np.abs(rates) >= limit])
    assert "imu-saturation" in diagnosed(s, flight).found


def test_a_record_of_two_lines_and_a_long_turn_is_judged_by_what_it_has() -> None:
    """With a gap as long as the record the noise floor came out half as large, and an adequate model was none."""
    s = scenario(5, duration=600.0)
    x = s.simulate({}).flight()
    outputs = {n: np.where((x.time > 150.0) & (x.time < 450.0), np.nan, v) for n, v in x.outputs.items()}
    m, y = load_packaged(), replace(x, outputs=outputs)
    saved = make_saved(calibrate(m, s.sheet, [x]), [x], "2026-03-01T00:00:00+00:00")
    whole = compare(m, s.sheet, [x])
    for parts in (compare(m, s.sheet, [y]), compare_frozen(m, s.sheet, [y], saved).comparison):
        assert parts.adequate, parts.grounds
        assert parts.noise_floor == pytest.approx(whole.noise_floor, rel=0.1)
