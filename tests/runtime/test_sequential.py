"""From when on a model no longer holds."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import trapezoid

from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification.sequential import SequentialTest, follow_model, log_e
from ragg_runtime.model import model
from ragg_runtime.reference.scenario import scenario


def test_an_e_value_has_mean_one_under_the_null() -> None:
    """By quadrature, to 2e-5: rare, huge values carry much of the mean, which no sample would show."""
    z = np.concatenate([[0.0], np.logspace(-3, 6, 2001)])
    logs = np.array([log_e(np.array([x])) for x in z])
    density = np.exp(logs - z**2 / 2) / np.sqrt(2 * np.pi)
    assert 2 * trapezoid(density, z) == pytest.approx(1.0, abs=1e-3)


def followed(*hidden: dict[str, dict[str, list[float]]]) -> SequentialTest:
    s = scenario(3, duration=480.0)
    flights = [s.simulate(h).flight(f"leg {n}") for n, h in enumerate(hidden)]
    return follow_model(fitted.fit(model.packaged(), s.sheet, observe_flights(flights, s.sheet)))


def test_a_model_that_holds_is_let_be() -> None:
    found = followed({})
    assert found.change is None
    assert found.log_m.max() < found.limit
    assert len(found.time) == 24


def test_the_block_in_which_a_scale_factor_jumps_is_named() -> None:
    found = followed({"gain-step": {"dK1": [0, 0, 3e-6, 0], "t_step": [250.0]}})
    assert found.change is not None
    assert found.change.until == pytest.approx(240.0, abs=20.0)


def test_a_change_between_two_flights_is_named_with_its_flight() -> None:
    # Within the second flight the scale factor is constant: the two do not agree on it.
    found = followed({}, {"gain-step": {"dK1": [0, 0, 3e-6, 0], "t_step": [-10.0]}})
    assert found.change is not None
    assert (found.change.flight, found.change.until) == ("leg 1", 0.0)


def test_a_model_that_never_held_has_not_changed() -> None:
    found = followed({"lag": {"tau": [1e-7, 0, 0, 0]}})
    assert found.log_m[0] > found.limit
    assert found.change is None
