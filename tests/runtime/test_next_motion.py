"""The motion to fly next: its promise held against flights in which it is flown."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation import fitted as fitted_
from ragg_runtime.estimation import observation
from ragg_runtime.identification import motion_design, next_motion, selection
from ragg_runtime.identification.selection import field_of
from ragg_runtime.io import Flight
from ragg_runtime.model import model
from ragg_runtime.reference.motion import Signal, Sinusoids
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.next_flight import NextFlight, next_flight, write_motion
from ragg_runtime.workflow.simulate import simulated


@pytest.fixture(scope="module")
def flown() -> tuple[Scenario, Flight]:
    s = scenario(52, duration=600.0)
    return s, s.simulate({"lag": {"tau": [2e-9, 0, 0, 0]}}).flight()


def fitted(s: Scenario, *flights: Flight) -> fitted_.Fitted:
    return fitted_.fit(model.packaged(), s.sheet, observation.observations_of(flights, s.sheet))


def separation(f: fitted_.Fitted, field: selection.Field, signal: np.ndarray, rival: str) -> float:
    """On flights as they are."""
    rows = np.column_stack([f.whole[:, :-1], f.whole[:, :-1] @ signal])
    return next_motion.separation(rows, f.n_base, [f.n_base + n for n, _ in field.candidates[rival]], f.size)


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
    signal = next_motion.signal_of(f, field_of(f, selection.testable_effects(f)), "lag")
    kept = separation(both, field, signal, "time-offset")
    # the turbulence that is there as well tells more
    assert p.then * 0.7 < kept < p.then * 3.0
    assert kept > 1.5 * p.now


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> tuple[loop.Loaded, list[str], Flight, NextFlight]:
    """A weak lag, its rivals, and the multisine that is to tell them apart, within a band and a limit of the jerk."""
    m = loop.new(tmp_path_factory.mktemp("next") / "m")
    hidden = ["lag:tau=2e-9/0/0/0"]
    x = simulated(m.instrument, hidden, seed=7, duration=600.0, no_gradient=False)
    limits = loop.motion_limits(m, ["a=30mg", "jerk=1m/s^3"])
    return m, hidden, x, next_flight(m, [x], limits, duration=300.0, band=(0.1, 2.0))


Found = tuple[loop.Loaded, list[str], Flight, NextFlight]


def test_the_multisine_keeps_to_its_limits(found: Found) -> None:
    *_, n = found
    assert n.separations
    assert "lag" in n.in_words()
    motion = n.motion()
    assert len(motion.time) == 300 * 16
    assert {round(f / 0.25, 6) for _, f, *_ in n.sinusoids} <= {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0}
    for axis in "xyz":
        a = motion.channels[f"a_{axis}"] - n.mean[f"a_{axis}"]
        assert np.max(np.abs(a)) < 0.03 * 9.81
        assert np.max(np.abs(np.gradient(a, motion.time))) < 1.0
        assert np.max(np.abs(motion.channels[f"omega_{axis}"] - n.mean[f"omega_{axis}"])) < 2.41e-3
    # and what the limits allow is used: the jerk of a, or the amplitude of omega
    used = [
        2 * np.pi * f * size if axis.startswith("a_") else size / 2.4e-3 for axis, f, size, _ in n.sinusoids
    ]
    assert max(used) > 0.5


def test_the_separation_is_what_the_reference_shows_when_it_is_flown(found: Found, tmp_path: Path) -> None:
    """Of effects that another motion tells apart, and of two that act alike; in both directions."""
    m, hidden, x, n = found
    pairs = [("lag", "time-offset"), ("lag", "arm-stretch")]
    f = fitted_.fit(m.model, m.instrument, [observation.observe(x, m.instrument)])
    made = motion_design.design(f, pairs, next_motion.LIMITS, duration=300.0, band=(0.0, 2.0))
    assert made is not None
    write_motion(
        dataclasses.replace(n, sinusoids=made.sinusoids, separations=made.separations),
        tmp_path / "motion.csv",
    )
    y = simulated(m.instrument, hidden, seed=7, motion=tmp_path / "motion.csv", no_gradient=False)
    both = fitted_.fit(m.model, m.instrument, observation.observations_of((x, y), m.instrument))
    one, field = (field_of(g, selection.testable_effects(g)) for g in (f, both))
    for p in made.separations:
        signal = next_motion.signal_of(f, one, p.effect)
        shown = separation(both, field, signal, p.rival)
        assert p.then == pytest.approx(shown, rel=0.4)
        assert p.then > p.now
    ruled_out = {(p.effect, p.rival): p.then for p in made.separations}
    assert list(ruled_out) == [*pairs, *((r, e) for e, r in pairs)]
    assert ruled_out["lag", "time-offset"] > 20.0


def test_the_multisine_is_better_than_the_best_sinusoid(flown: tuple[Scenario, Flight]) -> None:
    s, flight = flown
    f = fitted(s, flight)
    field = field_of(f, selection.testable_effects(f))
    pairs = [("lag", "time-offset"), ("lag", "arm-sag")]
    best = next_motion.proposals(f, field, pairs)
    made = motion_design.design(f, pairs, next_motion.LIMITS, duration=600.0, band=(0.0, 1.0))
    assert made is not None
    for p, x in zip(best, made.separations[:2], strict=True):
        assert (p.effect, p.rival) == (x.effect, x.rival)
        assert x.then > 1.1 * p.then
    assert motion_design.design(f, [], next_motion.LIMITS, duration=600.0, band=(0.0, 1.0)) is None


def test_where_nothing_is_left_to_tell_apart_everything_is_excited(found: Found) -> None:
    m, *_ = found
    x = simulated(m.instrument, [], seed=8, duration=120.0)
    n = next_flight(m, [x], next_motion.LIMITS, duration=60.0)
    assert n.separations == ()
    assert {axis for axis, *_ in n.sinusoids} == set(next_motion.AXES)
    assert "nothing is left" in n.in_words()
    with pytest.raises(UserError, match="no motion can be made"):
        next_flight(m, [x], next_motion.LIMITS, band=(0.3, 0.35))
    with pytest.raises(UserError, match="no motion can be made"):
        next_flight(m, [x], next_motion.LIMITS, band=(0.0, 5.0))


def test_limits_are_read_with_units(tmp_path_factory: pytest.TempPathFactory) -> None:
    m = loop.new(tmp_path_factory.mktemp("limits") / "m")
    found = loop.motion_limits(m, ["a=100mg"])
    assert found["a"] == pytest.approx(0.98)
    assert found["omega"] == next_motion.LIMITS["omega"]
    assert loop.motion_limits(m, ["alpha=1deg/s^2"])["alpha"] == pytest.approx(np.pi / 180)
    for wrong in ("b=1mg", "a", "a=-1mg", "omega=1mg", "jerk=1m/s^2"):
        with pytest.raises(UserError):
            loop.motion_limits(m, [wrong])
