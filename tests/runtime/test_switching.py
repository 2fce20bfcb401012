"""Samples of which the sheet leaves open on which side of a switch an accelerometer is are left out of a fit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import observe
from ragg_runtime.estimation.thinning import leave_out_uncertain
from ragg_runtime.estimation.unknown_gradient import windows
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model import derive
from ragg_runtime.model import model as load
from ragg_runtime.model.evaluate import vector, voltages
from ragg_runtime.reference.scenario import Scenario, scenario


@pytest.fixture(scope="module")
def world() -> tuple[Scenario, load.Model]:
    s = scenario(61, duration=300.0)
    return s, derive.with_effects(s.sheet, load.packaged(), ["adc-nonlinearity"])


def test_what_is_kept_is_on_the_same_side_for_every_instrument_that_the_sheet_allows(
    world: tuple[Scenario, load.Model],
) -> None:
    s, model = world
    o = observe(s.simulate().flight(), s.sheet)
    (kept,) = leave_out_uncertain(model, s.sheet, [o])
    left_out = o.record.valid & ~kept.record.valid
    assert 0 < np.sum(left_out) < 0.1 * np.sum(o.record.valid)
    side = np.sign(voltages(model.chain, o.record, vector(model, s.sheet)))
    rng, changed = np.random.default_rng(4), np.zeros(len(left_out), dtype=bool)
    for _ in range(20):
        a = s.sheet.accelerometers
        drawn = {n: a[n] + s.sheet.sigma(n) * rng.standard_normal(4) for n in ("K0", "dR", "beta_z", "K2")}
        other = Instrument.build(
            radius=s.sheet.radius,
            spin_frequency=s.sheet.spin_frequency,
            g0=9.8,
            accelerometers={**a, **drawn},
        )
        changed |= (np.sign(voltages(model.chain, o.record, vector(model, other))) != side).any(axis=0)
    assert changed.any()
    assert not np.any(changed & kept.record.valid)


def test_what_was_found_for_all_samples_does_not_serve_those_that_are_kept(
    world: tuple[Scenario, load.Model],
) -> None:
    s, model = world
    o = observe(s.simulate(record_gradient=False).flight(), s.sheet)
    noise, every = NoiseModel.white(o.record.rate, 1), slice(0, len(o.record.time))
    assert len(windows(o, every, noise)[0].places) == np.sum(o.record.valid)
    (kept,) = leave_out_uncertain(model, s.sheet, [o])
    assert len(windows(kept, every, noise)[0].places) == np.sum(kept.record.valid)


def test_a_model_that_does_not_switch_keeps_every_sample(world: tuple[Scenario, load.Model]) -> None:
    s, _ = world
    o = observe(s.simulate().flight(), s.sheet)
    assert leave_out_uncertain(load.packaged(), s.sheet, [o]) == [o]


def test_a_sheet_that_knows_nothing_of_the_side_leaves_nothing_out(
    world: tuple[Scenario, load.Model],
) -> None:
    s, model = world
    o = observe(s.simulate().flight(), s.sheet)
    unsure = replace(s.sheet, sigmas={**s.sheet.sigmas, "K0": np.full(4, 0.2)})
    (kept,) = leave_out_uncertain(model, unsure, [o])
    assert np.array_equal(kept.record.valid, o.record.valid)
