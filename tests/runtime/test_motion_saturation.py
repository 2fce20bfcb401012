"""Motion sensors at the end of their range: recognised by the values, believed where the model fails, left out."""

from __future__ import annotations

import numpy as np
import pytest

from ragg_runtime.diagnosis import motion_saturation
from ragg_runtime.diagnosis.diagnose import diagnose
from ragg_runtime.fit.fitted import fit
from ragg_runtime.fit.observation import observations_of
from ragg_runtime.flight.range_end import CHUNK, at_the_end
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.model.model import packaged
from ragg_runtime.plausibility.checks import remarks
from ragg_runtime.reference.scenario import scenario

N = 6000
T = np.arange(N) / 16.0
RNG = np.random.default_rng(0)
HAND = 10 * np.sin(0.7 * T) * np.sin(0.11 * T) + 0.1 * RNG.normal(size=N)


@pytest.mark.parametrize("low", [-20.0, -8.0])
def test_the_end_of_a_range_is_where_values_pile_up(low: float) -> None:
    x = np.clip(HAND, low, 8.0)
    mask = at_the_end(x, np.ones(N, dtype=bool))
    assert mask is not None
    assert np.array_equal(mask, (x == 8.0) | (x == low))


@pytest.mark.parametrize(
    "x",
    [
        HAND,
        np.full(N, 9.81),
        np.zeros(N),
        np.sin(2 * np.pi * (np.arange(N) + 0.5) / 16),  # its two highest values are equal, turn after turn
        np.round(3 * np.sin(0.02 * T) + 0.02 * RNG.normal(size=N), 1),  # the lattice of a converter
        np.round(30 * np.sin(0.02 * T)),
        np.clip(np.abs(T - 180.0) - 50.0, 0.0, 30.0)
        * np.sign(T - 180.0),  # a table, turned once to each side
    ],
    ids=["noise", "constant", "zero", "tops", "lattice", "coarse", "plateaus"],
)
def test_what_is_no_end_of_a_range(x: np.ndarray) -> None:
    assert at_the_end(x, np.ones(N, dtype=bool)) is None


def test_samples_that_do_not_count_and_long_records() -> None:
    x = np.tile(np.clip(HAND, -8.0, 8.0), 1 + 2 * CHUNK // N)
    there = np.ones(len(x), dtype=bool)
    there[::7] = False
    x[::7] = np.where(np.arange(len(x[::7])) % 2, np.nan, 1e9)
    mask = at_the_end(x, there)
    assert mask is not None
    assert np.array_equal(mask, there & (np.abs(x) == 8.0))


def test_clipped_rates_are_found_and_left_out() -> None:
    s = scenario(47, duration=300.0)
    plain = s.simulate({})
    limit = float(np.quantile(np.abs([plain.channels[f"omega_{k}"] for k in "xyz"]), 0.97))
    flight = s.simulate({"motion-saturation": {"omega_max": limit}}).flight()
    d = diagnose(packaged(), s.instrument, [flight])
    assert (d.verdict, d.found) == ("missing-effect", ("motion-saturation",))
    first = d.ranking[0]
    assert first.after.rms_Eo < 0.05 * first.before.rms_Eo
    # with the effect in the model the samples are no part of the record, and the remark says so
    i = s.instrument.with_effects((EffectSetting("motion-saturation"),))
    (o,) = observations_of([flight], i)
    at = np.any([np.abs(flight.channels[f"omega_{k}"]) == limit for k in "xyz"], axis=0)
    assert not np.any(~o.record.valid & ~at)
    assert np.sum(~o.record.valid) > 0.9 * np.sum(
        at
    )  # an axis that came there once or twice is not recognised
    assert any("saturated sensor; not used" in x for x in remarks(i, flight))
    assert any("ragg diagnose" in x for x in remarks(s.instrument, flight))


def test_a_motion_that_really_stands_at_one_value_is_believed() -> None:
    s = scenario(47, duration=300.0)
    flight = s.simulate({}).flight()
    f = fit(packaged(), s.instrument, observations_of([flight], s.instrument))
    there = np.zeros(len(flight), dtype=bool)
    there[1000:1100] = there[3000:3100] = True
    assert not motion_saturation._loud(f, [flight], [there])
    assert motion_saturation.without(f, [flight]) is None
