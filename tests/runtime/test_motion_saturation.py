"""Motion sensors that reach the end of their range: recognised, their samples left out, and nothing else taken for it."""

from __future__ import annotations

import numpy as np
import pytest

from generated.output_effects import imu_saturation
from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.observation import observe
from ragg_runtime.reference.scenario import scenario
from tests.runtime.diagnosed import diagnosed

N = 4000
T = np.arange(N) / 16.0
MOVING = np.sin(0.3 * T) + 0.2 * np.random.default_rng(1).standard_normal(N)
ALL = np.ones(N, dtype=bool)


def test_the_end_of_a_range_is_recognised() -> None:
    found = imu_saturation.clipped(np.clip(MOVING, -0.9, 0.9), ALL)
    assert np.array_equal(found, np.abs(MOVING) >= 0.9)
    assert imu_saturation.present(np.clip(MOVING, -0.9, 0.9), ALL, 0.0)
    assert "temperature" not in imu_saturation.CHANNELS


@pytest.mark.parametrize(
    "x",
    [
        MOVING,
        np.zeros(N),
        np.full(N, 9.8),  # at rest
        np.round(MOVING * 8) / 8,  # coarsely quantised
        np.round(np.sin(0.3 * T) * 100) / 100,  # and slow, so that it dwells at its largest values
        np.r_[np.round(20 * np.sin(0.02 * T[:600])), np.round(20 * MOVING[600:]).clip(-18, 18)],  # 20 steps
        np.sin(2 * np.pi * T / 16),  # repeats itself, sample by sample
    ],
    ids=["noise", "zero", "at rest", "coarse", "dwells", "few steps", "periodic"],
)
def test_what_is_no_end_of_a_range(x: np.ndarray) -> None:
    assert not imu_saturation.clipped(x, ALL).any()


def test_a_flight_with_saturated_gyroscopes_is_diagnosed() -> None:
    s = scenario(47, duration=300.0)
    rates = s.simulate().channels["omega_y"]
    limit = float(np.quantile(np.abs(rates), 0.98))
    flight = s.simulate({"imu-saturation": {"omega_max": limit}}).flight()
    assert float(np.max(np.abs(flight.channels["omega_y"]))) == limit
    assert not np.any(observe(flight, s.sheet).record.valid[np.abs(rates) >= limit])
    d = diagnosed(s, flight)
    assert "imu-saturation" in d.found
    with pytest.raises(UserError, match="must be positive"):
        s.simulate({"imu-saturation": {"a_max": -1.0}})
