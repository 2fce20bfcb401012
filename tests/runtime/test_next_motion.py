"""The motion to fly next: its promise held against flights in which it is flown."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.diagnosis import next_motion
from ragg_runtime.evidence import selection
from ragg_runtime.evidence.selection import field_of
from ragg_runtime.fit import fitted as fitted_
from ragg_runtime.fit import observation
from ragg_runtime.flight import Flight
from ragg_runtime.model import model
from ragg_runtime.reference.motion import Signal, Sinusoids
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.workflow import loop


@pytest.fixture(scope="module")
def flown() -> tuple[Scenario, Flight]:
    s = scenario(52, duration=600.0)
    return s, s.simulate({"lag": {"tau": [2e-9, 0, 0, 0]}}).flight()


def fitted(s: Scenario, *flights: Flight) -> fitted_.Fitted:
    return fitted_.fit(model.packaged(), s.sheet, [observation.observe(x, s.sheet) for x in flights])


def test_effects_that_act_alike_are_not_promised_apart(flown: tuple[Scenario, Flight]) -> None:
    """K_iii of one accelerometer and K_ooo of its neighbour weigh the same force: no motion splits them."""
    s = scenario(53, duration=600.0)
    f = fitted(s, s.simulate({"cubic-input": {"K_iii": [4e-8, 0, 0, 0]}}).flight())
    field = field_of(f, selection.testable_effects(f))
    for p in next_motion.proposals(f, field, [("cubic-input", "cubic-cross")]):
        assert not p.separates
        assert "act alike" in p.in_words()


def test_a_larger_motion_promises_more(flown: tuple[Scenario, Flight]) -> None:
    s, flight = flown
    f = fitted(s, flight)
    field = field_of(f, selection.testable_effects(f))
    pairs = [("lag", "time-offset")]
    small = next_motion.proposals(f, field, pairs, {"a": 0.05, "omega": 1e-4})
    (large,) = next_motion.proposals(f, field, pairs, {"a": 0.5, "omega": 1e-3})
    assert large.then > large.now
    assert all(large.then > p.then for p in small)


@dataclasses.dataclass(frozen=True)
class Shaken:
    """A component of motion with a sine upon it."""

    calm: Signal
    sine: Sinusoids

    def value(self, time: np.ndarray, shift: float = 0.0) -> np.ndarray:
        return self.calm.value(time, shift) + self.sine.value(time, shift)

    def rate(self, time: np.ndarray, shift: float = 0.0) -> np.ndarray:
        return self.calm.rate(time, shift) + self.sine.rate(time, shift)


def test_the_promise_is_kept_when_the_motion_is_flown(flown: tuple[Scenario, Flight]) -> None:
    """A flight of the independent reference with that motion, fitted together with the first one."""
    s, flight = flown
    f = fitted(s, flight)
    field = field_of(f, selection.testable_effects(f))
    (p,) = next_motion.proposals(f, field, [("lag", "time-offset")])
    sine = Sinusoids(0.0, (p.amplitude,), (p.frequency,), (0.0,))
    group, axis = p.axis.split("_")
    parts = list(getattr(s.motion, group))
    parts["xyz".index(axis)] = Shaken(parts["xyz".index(axis)], sine)
    moved = dataclasses.replace(s, motion=dataclasses.replace(s.motion, **{group: tuple(parts)}), seed=99)
    shaken = moved.simulate({"lag": {"tau": [2e-9, 0, 0, 0]}}).flight()
    both = fitted(s, flight, shaken)
    field = field_of(both, selection.testable_effects(both))
    signal = next_motion._signal(f, field_of(f, selection.testable_effects(f)), "lag")
    kept = next_motion._separation(both.whole, both.n_base, field, signal, "time-offset")
    # the turbulence that is there as well tells more
    assert p.then * 0.7 < kept < p.then * 3.0
    assert kept > 1.5 * p.now


def test_limits_are_read_with_units(tmp_path_factory: pytest.TempPathFactory) -> None:
    m = loop.new(tmp_path_factory.mktemp("limits") / "m")
    found = loop.motion_limits(m, ["a=100mg"])
    assert found["a"] == pytest.approx(0.98)
    assert found["omega"] == next_motion.LIMITS["omega"]
    for wrong in ("b=1mg", "a", "a=-1mg", "omega=1mg"):
        with pytest.raises(UserError):
            loop.motion_limits(m, [wrong])
