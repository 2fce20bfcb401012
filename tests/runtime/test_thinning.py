"""Long flights at a high rate, thinned: the same findings from a twelfth of the samples."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from ragg_runtime.estimation import fitted, observation, thinning
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.estimation.regressors import LinearisationPoint, linearise
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.selection import make_field
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model import model
from ragg_runtime.model.evaluate import output, vector
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.report import panels

pytestmark = pytest.mark.usefixtures("no_next_motion")

RATE, EVERY = 100.0, 12


@pytest.fixture(scope="module")
def flown() -> tuple[Scenario, Flight]:
    s = scenario(77, duration=420.0, rate=RATE)
    return s, s.simulate({"thermal-scale": {"dK1_dT": [0, 0, 2e-8, 0]}}).flight()


@pytest.fixture(scope="module")
def whole(flown: tuple[Scenario, Flight]) -> Observation:
    s, flight = flown
    return observation.observe(flight, s.sheet)


@pytest.fixture(scope="module")
def thin(flown: tuple[Scenario, Flight], whole: Observation) -> Observation:
    (found,) = thinning.thin_observations(model.packaged(), flown[0].sheet, [whole])
    return found


def thinned(sheet: Instrument, flight: Flight) -> Observation:
    (found,) = thinning.thin_observations(model.packaged(), sheet, [observation.observe(flight, sheet)])
    return found


def with_output(flight: Flight, further: NDArray[np.float64]) -> Flight:
    outputs = {n: x + further for n, x in flight.outputs.items()}
    return Flight(flight.time, flight.channels, outputs, valid=flight.valid, units=flight.units)


def test_one_sample_in_twelve_is_kept_at_its_own_instant(whole: Observation, thin: Observation) -> None:
    assert thin.thin is not None and thin.thin.every == EVERY
    r, first = thin.record, len(thin.thin.taps) // 2
    assert r.rate == RATE / EVERY and r.valid.all()
    np.testing.assert_array_equal(r.time, whole.record.time[first:-first:EVERY][: len(r.time)])
    # a sine of the motion's band comes through, in place
    t = whole.record.time
    slow = thin.thin.kept(np.sin(2 * np.pi * 1.3 * t))
    np.testing.assert_allclose(slow, np.sin(2 * np.pi * 1.3 * r.time), atol=2e-5)


def test_the_low_pass_passes_the_motion_and_stops_what_would_fold() -> None:
    for every in thinning.EVERY:
        taps = thinning.low_pass(every)
        f = np.linspace(0, 0.5, 4001)  # of the sampling rate
        middle = np.arange(len(taps)) - len(taps) // 2
        gain = np.abs(np.cos(2 * np.pi * np.outer(f, middle)) @ taps)
        half = 0.5 / every
        assert np.max(np.abs(gain[f <= thinning.PASSED * half] - 1)) < 2e-5
        assert np.max(gain[f >= thinning.STOPPED * half]) < 2e-5


def test_the_residual_is_that_of_the_whole_record_thinned(
    flown: tuple[Scenario, Flight], whole: Observation, thin: Observation
) -> None:
    """Against the NumPy model along the recorded motion, and a sum over the taps for a few samples."""
    s, _ = flown
    m = model.packaged()
    p = vector(m, s.sheet)
    at = LinearisationPoint(m, s.sheet, p, with_candidates=False)
    found = linearise(at, thin)[-1, 0]
    assert thin.thin is not None
    full = whole.data[0] - output(m.chain, whole.record, p, whole.output)
    taps = thin.thin.taps
    for k in (0, 1, 1777, len(found) - 1):
        expected = float(full[k * EVERY : k * EVERY + len(taps)] @ taps[::-1])
        assert found[k] == pytest.approx(expected, rel=1e-9, abs=1e-9)
    parts = [linearise(at, thin.part(rows))[-1, 0] for rows in (slice(0, 1000), slice(1000, len(found)))]
    np.testing.assert_allclose(np.concatenate(parts), found, atol=1e-10)


def test_the_diagnosis_is_that_of_the_whole_record(
    flown: tuple[Scenario, Flight], whole: Observation
) -> None:
    s, flight = flown
    d = diagnose(model.packaged(), s.sheet, [flight])
    assert len(d.fitted.observations[0].record.time) * EVERY < len(flight.time)
    assert "thinned to 8.333 Hz" in dict(panels.describe_record(d.fitted))["samples"]
    assert (d.verdict, d.found) == ("missing-effect", ("thermal-scale",))
    (v,) = (q for q in d.ranking[0].combinations if q.name == "D34 dK1_dT")
    assert abs(abs(v.value) - 2e-8) < 4 * v.std
    f = fitted.fit(model.packaged(), s.sheet, [whole])
    (before,) = f.score([np.zeros(f.size)])
    assert d.noise_floor == pytest.approx(fitted.noise_floor(f), rel=5e-3)
    assert d.before.rms_V == pytest.approx(before.whole.rms_V, rel=1e-3)
    assert d.before.rms_Eo == pytest.approx(before.whole.rms_Eo, rel=1e-3)
    assert d.before.inline_Eo == pytest.approx(before.whole.inline_Eo, rel=0.03)
    chi2 = make_field(f, ["thermal-scale"]).tests()["thermal-scale"].chi2
    assert d.ranking[0].test.chi2 == pytest.approx(chi2, rel=0.1)  # the slow noise is known to some per cent


def test_what_thinning_takes_is_counted_as_noise(flown: tuple[Scenario, Flight], thin: Observation) -> None:
    """White noise of known size on top of what the instrument makes: the floor is its root mean square over the whole band."""
    s, flight = flown
    loud = 3e-2
    noisy = with_output(flight, loud * np.random.default_rng(5).standard_normal(len(flight.time)))
    f = fitted.fit(model.packaged(), s.sheet, [thinned(s.sheet, noisy)], candidates=False)
    (fast,) = f.beyond
    assert fast == pytest.approx((1 - 1 / EVERY) * loud**2, rel=0.03)
    assert fitted.noise_floor(f) * f.k_ggi == pytest.approx(loud, rel=0.03)
    (scored,) = f.score([np.zeros(f.size)])
    assert scored.whole.rms_V == pytest.approx(loud, rel=0.03)


def test_short_flights_and_slow_ones_stay_as_they_are(flown: tuple[Scenario, Flight]) -> None:
    s, flight = flown
    m = model.packaged()
    short = observation.observe(_cut(flight, 25_000), s.sheet)
    assert thinning.thin_observations(m, s.sheet, [short]) == [short]
    slow = scenario(78, duration=2200.0, rate=16.0)
    o = observation.observe(slow.simulate().flight(), slow.sheet)
    assert len(o.record.time) > 30_000 and thinning.thin_observations(m, slow.sheet, [o]) == [o]


def _cut(flight: Flight, n: int) -> Flight:
    return Flight(
        flight.time[:n],
        {k: x[:n] for k, x in flight.channels.items()},
        {k: x[:n] for k, x in flight.outputs.items()},
        units=flight.units,
    )


def test_a_motion_that_shakes_is_not_thinned(flown: tuple[Scenario, Flight]) -> None:
    """A vibration at 30 Hz that comes and goes is rectified by K2 into the band: its square is slow, and must not be lost."""
    s, flight = flown
    t = flight.time
    shake = 0.5 * np.sin(2 * np.pi * 30.0 * t) * (1 + np.sin(2 * np.pi * 0.2 * t))
    channels = {**flight.channels, "a_x": flight.channels["a_x"] + shake}
    shaken = Flight(t, channels, flight.outputs, units=flight.units)
    assert thinned(s.sheet, shaken).thin is None


def test_a_flight_with_a_line_beyond_the_band_is_not_thinned(flown: tuple[Scenario, Flight]) -> None:
    s, flight = flown
    assert thinned(s.sheet, with_output(flight, 2e-3 * np.sin(2 * np.pi * 27.3 * flight.time))).thin is None


def test_spikes_cost_a_sample_and_a_gap_what_is_beside_it(flown: tuple[Scenario, Flight]) -> None:
    s, flight = flown
    valid = np.ones(len(flight.time), dtype=np.bool_)
    valid[np.random.default_rng(2).choice(len(valid), 200, replace=False)] = False
    valid[20_000:20_300] = False
    outputs = {n: np.where(valid, x, np.nan) for n, x in flight.outputs.items()}
    there = (flight.time < 200.0) | (flight.time >= 203.0)  # of single samples the reader knows the motion
    channels = {n: np.where(there, x, np.nan) for n, x in flight.channels.items()}
    o = thinned(s.sheet, Flight(flight.time, channels, outputs, valid=valid, units=flight.units))
    assert o.thin is not None
    missing = np.flatnonzero(~o.record.valid)
    gap = (o.record.time[missing] > 199.5) & (o.record.time[missing] < 203.5)
    assert 3.0 * RATE / EVERY <= np.sum(gap) <= 3.8 * RATE / EVERY and np.sum(~gap) <= 2
    at = LinearisationPoint(
        model.packaged(), s.sheet, vector(model.packaged(), s.sheet), with_candidates=False
    )
    found = linearise(at, o)[-1, 0]
    expected = linearise(at, thinned(s.sheet, flight))[-1, 0]
    used = o.record.valid
    # beside a bridge the residual is off by less than a tenth of what it is
    assert np.max(np.abs((found - expected)[used])) < 0.1 * np.std(expected)
    assert np.std((found - expected)[used]) < 0.01 * np.std(expected)


def test_an_encoder_that_counts_from_zero_at_every_turn_is_thinned_as_one_that_does_not(
    flown: tuple[Scenario, Flight],
) -> None:
    s, flight = flown
    spin = 2 * np.pi * s.sheet.spin_frequency
    found = []
    for angle in (spin * flight.time, np.mod(spin * flight.time, 2 * np.pi)):
        channels = {**flight.channels, "spin_angle": angle}
        o = thinned(s.sheet, Flight(flight.time, channels, flight.outputs, units=flight.units))
        assert o.thin is not None
        found.append(np.exp(1j * o.record.phi))
    np.testing.assert_allclose(found[0], found[1], atol=1e-9)
    np.testing.assert_allclose(found[0], np.exp(1j * spin * o.record.time), atol=1e-9)
