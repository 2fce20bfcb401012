"""Parameters that drift, smoothed over the blocks of a flight."""

from __future__ import annotations

import dataclasses
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest

from ragg_runtime.compensation import drift
from ragg_runtime.compensation.compensate import make_channel, prepare
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.scenario import scenario
from tests.rate import RATE
from tests.runtime.flown_twice import truth


def test_the_walk_is_the_sum_of_its_steps() -> None:
    """Against dense least squares of two states of three parameters, one of which walks."""
    rng = np.random.default_rng(1)
    prior, first, second = (np.linalg.qr(rng.standard_normal((6, 4)), mode="r") for _ in range(3))
    walk = np.array([0.0, 0.5, 0.0])
    forward, _ = drift._filter(prior, [first, second], np.array([1.0]), walk)
    A = np.zeros((3 + 4 + 4 + 1, 5))  # x0, x1, x2 and x1 after its step at the end
    b = np.zeros(12)
    A[:3, :3], b[:3] = prior[:3, :3], prior[:3, 3]
    A[3:7, :3], b[3:7] = first[:, :3], first[:, 3]
    A[7:11, [0, 3, 2]], b[7:11] = second[:, :3], second[:, 3]
    A[11, [1, 3]] = -1 / 0.5, 1 / 0.5
    x = np.linalg.lstsq(A, b, rcond=None)[0]
    R = forward[-1]
    assert np.linalg.solve(R[:, :3], R[:, 3]) == pytest.approx(x[[0, 3, 2]])
    C = np.linalg.inv(A[:, :4].T @ A[:, :4])
    assert np.linalg.inv(R[:, :3].T @ R[:, :3])[1, 1] == pytest.approx(C[3, 3])


def test_gaps_between_flights_are_those_of_their_stamps() -> None:
    """Of dates, in any order; of times of a day unless two flights overlap; of seconds nothing is known."""
    x = scenario(3, duration=60.0, rate=RATE).simulate({}).flight()
    late = dataclasses.replace(x, time=x.time + 7200.0)
    for instants, other, expected in ((True, late, 7200.0), (True, x, 60.0), (False, late, 60.0)):
        both = [dataclasses.replace(y, instants=instants) for y in (x, other)]
        (first, second), timed = drift.find_starts(both)
        assert second - first == pytest.approx(expected, abs=1.0)
        assert timed == (expected == 7200.0)
    days = [dataclasses.replace(x, origin=datetime(2026, 3, n, tzinfo=UTC)) for n in (2, 1)]
    assert drift.find_starts(days) == ([86400.0, 0.0], True)


def test_parameters_walk_on_between_flights(monkeypatch: pytest.MonkeyPatch) -> None:
    """A gain that changed from one flight to the next, an hour later; given in the wrong order."""
    s = scenario(3, duration=60.0, rate=RATE)
    i, day = s.instrument, datetime(2026, 3, 1, tzinfo=UTC)
    later = i.replace(K1=i.accelerometers["K1"] * (1 + 1e-7 * np.array([1.0, -1.0, 1.0, 0.0])))
    flights = [
        dataclasses.replace(dataclasses.replace(s, instrument=k).simulate({}).flight(), origin=at)
        for k, at in ((later, day + timedelta(hours=1)), (i, day))
    ]
    f = fit(packaged(), s.sheet, observe_flights(flights, s.sheet), candidates=False)
    monkeypatch.setattr(drift, "_find_rates", lambda *_: {"K1": 1e-4})  # the search takes most of the time
    d = drift.smooth_drift(f, flights)
    assert [e.flight for e in d.epochs] == [1] * 24 + [0] * 24
    assert d.epochs[24].elapsed - d.epochs[0].elapsed == pytest.approx(3600.0)
    assert d.timed
    jump = np.linalg.norm(np.diff(d.steps, axis=0), axis=1)
    assert np.argmax(jump) == 23


def test_drifting_gains_are_followed_and_constant_ones_left_alone() -> None:
    """What is compensated with them is as sure as it says; with constant parameters it is not."""
    s = scenario(3, duration=600.0, rate=RATE, gradient_rms=50e-9)
    still = s.simulate({}).flight()
    f = fit(packaged(), s.sheet, observe_flights([still], s.sheet), candidates=False)
    assert drift.smooth_drift(f, [still]).rates == {}
    x = s.simulate(
        {"gain-drift": {"dK1_dt": [2e-10, -2e-10, 4e-11, -4e-11]}}
    ).flight()  # 1/s: 1e-7 over the flight
    rms = {}
    for kind in ("self", "smoothed"):
        c = make_channel(prepare(packaged(), s.sheet, [x], kind), 0, "fir")  # type: ignore[arg-type]
        found = c.compensate()
        z = ((found.gradient - truth(x, c.demodulator)).real / found.std[0])[:: int(2 * RATE)]
        rms[kind] = np.sqrt(np.nanmean(z**2))
    assert 0.7 < rms["smoothed"] < 1.4
    assert rms["self"] > 2.0
