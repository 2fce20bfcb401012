"""Motion that is derived, or stands late in a record, and samples that a fit leaves out for it or for a switch."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.fitted import measure_noise_floor
from ragg_runtime.estimation.observation import observe
from ragg_runtime.estimation.thinning import leave_out_uncertain
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE
from ragg_runtime.model import derive
from ragg_runtime.model import model as load
from ragg_runtime.model.memory import allows_memories, list_late, move_record
from ragg_runtime.model.model import evaluate_voltages, load_packaged, make_vector
from ragg_runtime.model.record import record
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.screening import screen
from ragg_runtime.signals.derivative import (
    REACH,
    bridge_gaps,
    derive_accelerations,
    differentiate,
    differentiate_rate,
    predict_missing,
)


def test_what_a_wide_band_gives() -> None:
    t = np.arange(4000) / 16.0
    rng = np.random.default_rng(1)
    w, phase = 2 * np.pi * rng.uniform(0.01, 0.85 * 16.0 / 2, 60), rng.uniform(0, 2 * np.pi, 60)
    x, dx = np.sin(np.outer(t, w) + phase).sum(axis=1), (np.cos(np.outer(t, w) + phase) * w).sum(axis=1)
    derived, sure = differentiate_rate(x, 16.0)
    assert np.std((derived - dx)[sure]) < 3e-6 * np.std(dx)
    assert np.std((differentiate(x, 16.0) - dx)[sure]) > 0.02 * np.std(dx)
    assert np.flatnonzero(sure)[[0, -1]].tolist() == [REACH, len(t) - REACH - 1]
    x[::300] = np.nan
    derived, sure = differentiate_rate(x, 16.0)
    assert np.isnan(derived[::300]).all()
    assert np.nanstd((derived - dx)[sure]) < 0.4 * np.nanstd(derived - dx)  # not one-sided ends


def test_lost_rates_are_predicted_from_those_beside_them() -> None:
    """A spline errs by a fortieth of such motion."""
    rng, present = np.random.default_rng(3), np.ones(4800, dtype=np.bool_)
    x = np.convolve(rng.standard_normal(4900), np.convolve(np.hanning(9), np.hanning(9)), "same")[:4800]
    present[np.add.outer(np.arange(100, 4700, 150), range(3))] = False
    predictions = (predict_missing(x, present), bridge_gaps(x, present, smooth=True))
    off = np.std([(f - x)[~present] for f in predictions], axis=1)
    assert off[0] < off[1] / 10
    # nothing to learn from
    assert np.array_equal(predict_missing(x, ~present), bridge_gaps(x, ~present, smooth=True))
    assert np.all(bridge_gaps(x, np.arange(4800) == 0, turning=True) == x[0])


def test_the_error_of_a_derived_acceleration_is_part_of_the_noise_and_accuses_nothing() -> None:
    """Of an instrument off its sheet, sampled slowly: the error stands in a narrow band at the top, and beside the ends."""
    s = scenario(7000, trim="table-v", duration=450.0, rate=8.0)
    flight = s.simulate().flight()
    channels = {n: v for n, v in flight.channels.items() if n not in ANGULAR_ACCELERATION}
    slopes, valid = derive_accelerations([channels[n] for n in ANGULAR_RATE], flight.time)
    channels |= dict(zip(ANGULAR_ACCELERATION, slopes, strict=True))
    screened = screen(load_packaged(), s.sheet, replace(flight, channels=channels, valid=valid))
    d = diagnose(load_packaged(), s.sheet, [screened])
    assert d.verdict == "adequate"
    assert d.before.rms_Eo == pytest.approx(measure_noise_floor(d.fitted), rel=0.15)
    assert d.noise_floor > 3 * 2.8  # it is the largest part


@pytest.fixture(scope="module")
def world() -> tuple[Scenario, load.Model]:
    s = scenario(71, duration=200.0)
    return s, derive.with_effects(s.sheet, load_packaged(), ["clock-drift", "time-offset"])


def _parameters(s: Scenario, model: load.Model, values: dict[str, float]) -> np.ndarray:
    p = make_vector(model, s.sheet)
    for k, q in list_late(model):
        p[k] = values[q.name]
    return p


def test_noise_of_the_motion_makes_no_jumps(world: tuple[Scenario, load.Model]) -> None:
    s, model = world
    r = record(s.simulate().flight(), s.sheet)
    r = replace(r, wide={**r.wide, "a_x": np.random.default_rng(1).normal(size=len(r.wide["a_x"]))})
    (offset,) = (k for k, q in list_late(model) if q.name == "delta_t")

    def at(delta: float) -> np.ndarray:
        moved, rest = move_record(model, r, _parameters(s, model, {"epsilon": 0.0, "delta_t": delta}))
        assert rest[offset] == 0.0
        return moved.wide["a_x"][20:-20]

    tick = 1e-6 / r.rate
    for delta in np.arange(1.0, 33.0) / (64 * r.rate):
        assert np.max(np.abs(at(delta + tick) - at(delta - tick))) < 1e-4
    same, _ = move_record(model, r, _parameters(s, model, {"epsilon": 0.0, "delta_t": 0.0}))
    assert same is r


def test_no_resonance_has_a_frequency_below_zero() -> None:
    s = scenario(72, duration=60.0)
    model = derive.with_effects(s.sheet, load_packaged(), ["mount-resonance"])
    p, (e,) = make_vector(model, s.sheet), model.effects
    assert allows_memories(model, p)
    p[[model.chain.places[q.symbol].start for q in e.parameters if q.name == "f_0"]] *= -1.0
    assert not allows_memories(model, p)


def test_a_drift_of_half_a_sample_and_more_is_fitted_down_to_noise() -> None:
    s = scenario(72, duration=200.0)
    sim = s.simulate({"clock-drift": {"epsilon": 4e-4}})  # 1.3 samples
    model = derive.with_effects(s.sheet, load_packaged(), ["clock-drift"])
    o = observe(sim.flight(), s.sheet)
    f = fitted.fit(model, s.sheet, [o], candidates=False)
    noise = float(np.std(sim.G_out - sim.G_out_noise_free))
    kept = f.observations[0].record.valid
    assert 0 < np.sum(~kept) < 10
    assert np.std(f.residuals()[0][kept]) < 1.02 * noise
    ((k, _),) = list_late(model)
    assert f.calibration.p[k] == pytest.approx(4e-4, rel=1e-3)


def test_the_ends_are_left_out_where_motion_is_late(world: tuple[Scenario, load.Model]) -> None:
    s, model = world
    o = observe(s.simulate().flight(), s.sheet)
    assert leave_out_uncertain(load_packaged(), s.sheet, [o])[0] is o
    (kept,) = leave_out_uncertain(model, s.sheet, [o])
    assert np.flatnonzero(~kept.record.valid).tolist() == [0, len(o.record.time) - 1]
    assert leave_out_uncertain(model, s.sheet, [short := o.part(slice(0, 8))])[0] is short


@pytest.fixture(scope="module")
def switching_world() -> tuple[Scenario, load.Model]:
    s = scenario(61, duration=300.0)
    return s, derive.with_effects(s.sheet, load_packaged(), ["adc-nonlinearity"])


def test_what_is_kept_is_on_the_same_side_for_every_instrument_that_the_sheet_allows(switching_world) -> None:
    s, model = switching_world
    o = observe(s.simulate().flight(), s.sheet)
    (kept,) = leave_out_uncertain(model, s.sheet, [o])
    left_out = o.record.valid & ~kept.record.valid
    assert 0 < np.sum(left_out) < 0.1 * np.sum(o.record.valid)
    side = np.sign(evaluate_voltages(model.chain, o.record, make_vector(model, s.sheet)))
    rng, changed = np.random.default_rng(4), np.zeros(len(left_out), dtype=bool)
    for _ in range(20):
        a = s.sheet.accelerometers
        drawn = {n: a[n] + s.sheet.sigma(n) * rng.standard_normal(4) for n in ("K0", "dR", "beta_z", "K2")}
        other = s.sheet.replace(**drawn)
        now = np.sign(evaluate_voltages(model.chain, o.record, make_vector(model, other)))
        changed |= (now != side).any(axis=0)
    assert changed.any()
    assert not np.any(changed & kept.record.valid)


def test_every_sample_is_kept_where_nothing_switches_or_the_sheet_knows_no_side(switching_world) -> None:
    s, model = switching_world
    o = observe(s.simulate().flight(), s.sheet)
    assert leave_out_uncertain(load_packaged(), s.sheet, [o]) == [o]
    unsure = replace(s.sheet, sigmas={**s.sheet.sigmas, "K0": np.full(4, 0.2)})
    (kept,) = leave_out_uncertain(model, unsure, [o])
    assert np.array_equal(kept.record.valid, o.record.valid)
