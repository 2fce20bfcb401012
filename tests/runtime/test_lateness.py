"""Samples that a fit leaves out: motion that stands late in a record, and sides of a switch that the sheet leaves open."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import observe
from ragg_runtime.estimation.thinning import leave_out_uncertain
from ragg_runtime.estimation.unknown_gradient import make_windows
from ragg_runtime.model import derive
from ragg_runtime.model import model as load
from ragg_runtime.model.memory import list_late, move_record
from ragg_runtime.model.model import evaluate_voltages, make_vector
from ragg_runtime.model.record import record
from ragg_runtime.reference.scenario import Scenario, scenario


@pytest.fixture(scope="module")
def world() -> tuple[Scenario, load.Model]:
    s = scenario(71, duration=200.0)
    return s, derive.with_effects(s.sheet, load.load_packaged(), ["clock-drift", "time-offset"])


def _parameters(s: Scenario, model: load.Model, values: dict[str, float]) -> np.ndarray:
    p = make_vector(model, s.sheet)
    for k, q in list_late(model):
        p[k] = values[q.name]
    return p


def test_motion_is_moved_to_where_it_was_true(world: tuple[Scenario, load.Model]) -> None:
    s, model = world
    true = record(s.simulate().flight(), s.sheet)
    # half a sample at the end, and three more from the beginning on
    values = {"epsilon": 0.5 / true.rate / true.time[-1], "delta_t": 3 / true.rate}
    drift, offset = {"epsilon": values["epsilon"]}, {"delta_t": values["delta_t"]}
    r = record(s.simulate({"clock-drift": drift, "time-offset": offset}).flight(), s.sheet)
    moved, rest = move_record(model, r, _parameters(s, model, values))
    inner = slice(20, -20)
    for name in ("a_x", "omega_y", "omegadot_z", "d_a_z"):
        was, got = true.series(name), moved.series(name)
        assert was is not None and got is not None
        assert np.max(np.abs(got - was)[inner]) < 1e-3 * np.std(was)
    assert max(abs(rest[k]) for k, _ in list_late(model)) < 1e-12
    part, whole = r.part(slice(1000, 1400)), moved.series("d2_a_x")
    of_part = move_record(model, part, _parameters(s, model, values))[0].series("d2_a_x")
    assert whole is not None and of_part is not None
    assert np.max(np.abs(of_part - whole[1000:1400])) < 1e-6 * np.std(whole)


def test_noise_of_the_motion_makes_no_jumps(world: tuple[Scenario, load.Model]) -> None:
    s, model = world
    r = record(s.simulate().flight(), s.sheet)
    noise = np.random.default_rng(1).normal(size=len(r.wide["a_x"]))
    r = replace(r, wide={**r.wide, "a_x": noise})
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


def test_a_drift_of_half_a_sample_and_more_is_fitted_down_to_noise() -> None:
    s = scenario(72, duration=200.0)
    sim = s.simulate({"clock-drift": {"epsilon": 4e-4}})  # 1.3 samples
    model = derive.with_effects(s.sheet, load.load_packaged(), ["clock-drift"])
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
    assert leave_out_uncertain(load.load_packaged(), s.sheet, [o])[0] is o
    (kept,) = leave_out_uncertain(model, s.sheet, [o])
    assert np.flatnonzero(~kept.record.valid).tolist() == [0, len(o.record.time) - 1]
    short = o.part(slice(0, 8))
    assert leave_out_uncertain(model, s.sheet, [short])[0] is short


@pytest.fixture(scope="module")
def switching_world() -> tuple[Scenario, load.Model]:
    s = scenario(61, duration=300.0)
    return s, derive.with_effects(s.sheet, load.load_packaged(), ["adc-nonlinearity"])


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
        changed |= (np.sign(evaluate_voltages(model.chain, o.record, make_vector(model, other))) != side).any(
            axis=0
        )
    assert changed.any()
    assert not np.any(changed & kept.record.valid)


def test_what_was_found_for_all_samples_does_not_serve_those_that_are_kept(switching_world) -> None:
    s, model = switching_world
    o = observe(s.simulate(record_gradient=False).flight(), s.sheet)
    noise, every = NoiseModel.white(o.record.rate, 1), slice(0, len(o.record.time))
    assert len(make_windows(o, every, noise)[0].places) == np.sum(o.record.valid)
    (kept,) = leave_out_uncertain(model, s.sheet, [o])
    assert len(make_windows(kept, every, noise)[0].places) == np.sum(kept.record.valid)


def test_every_sample_is_kept_where_nothing_switches_or_the_sheet_knows_nothing_of_the_side(
    switching_world,
) -> None:
    s, model = switching_world
    o = observe(s.simulate().flight(), s.sheet)
    assert leave_out_uncertain(load.load_packaged(), s.sheet, [o]) == [o]
    unsure = replace(s.sheet, sigmas={**s.sheet.sigmas, "K0": np.full(4, 0.2)})
    (kept,) = leave_out_uncertain(model, unsure, [o])
    assert np.array_equal(kept.record.valid, o.record.valid)
