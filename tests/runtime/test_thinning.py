"""Long flights: thinned, the same findings from a twelfth of the samples; in segments, with the figures of the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from ragg_runtime.estimation import fitted, noise_estimate, observation, scores, thinning
from ragg_runtime.estimation.noise import Level, LevelFactor, NoiseModel
from ragg_runtime.estimation.observation import (
    BLOCKS,
    Observation,
    divide_into_segments,
    split_at_blocks,
)
from ragg_runtime.estimation.regressors import (
    LinearisationPoint,
    linearise,
    list_candidate_columns,
    make_point,
)
from ragg_runtime.identification import formula, omnibus, selection
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.selection import make_problem
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model import derive, model
from ragg_runtime.model.model import evaluate_output, make_vector
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.report import panels
from ragg_runtime.signals.demodulators import find_demodulator
from tests.rate import RATE as SLOW

RATE, EVERY = 100.0, 12


@pytest.fixture(scope="module")
def flown() -> tuple[Scenario, Flight]:
    s = scenario(77, duration=320.0, rate=RATE)
    return s, s.simulate({"thermal-scale": {"dK1_dT": [0, 0, 2e-8, 0]}}).flight()


@pytest.fixture(scope="module")
def whole(flown: tuple[Scenario, Flight]) -> Observation:
    s, flight = flown
    return observation.observe(flight, s.sheet)


@pytest.fixture(scope="module")
def thin(flown: tuple[Scenario, Flight], whole: Observation) -> Observation:
    (found,) = thinning.thin_observations(model.load_packaged(), flown[0].sheet, [whole])
    return found


def thinned(sheet: Instrument, flight: Flight) -> Observation:
    (found,) = thinning.thin_observations(model.load_packaged(), sheet, [observation.observe(flight, sheet)])
    return found


def at_sheet(sheet: Instrument, *, with_candidates: bool = False) -> LinearisationPoint:
    m = model.load_packaged()
    candidates = list_candidate_columns(m, sheet) if with_candidates else ()
    return make_point(m, sheet, make_vector(m, sheet), candidates)


def with_output(flight: Flight, further: NDArray[np.float64]) -> Flight:
    return replace(flight, outputs={n: x + further for n, x in flight.outputs.items()})


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
        taps = thinning.make_low_pass(every)
        f = np.linspace(0, 0.5, 4001)  # of the sampling rate
        middle = np.arange(len(taps)) - len(taps) // 2
        gain = np.abs(np.cos(2 * np.pi * np.outer(f, middle)) @ taps)
        half = 0.5 / every
        assert np.max(np.abs(gain[f <= thinning.PASSED * half] - 1)) < 2e-5
        assert np.max(gain[f >= thinning.STOPPED * half]) < 2e-5


def test_the_residual_is_that_of_the_whole_record_thinned(flown, whole, thin) -> None:
    """Against the NumPy model along the recorded motion, and a sum over the taps for a few samples."""
    s, _ = flown
    m = model.load_packaged()
    p = make_vector(m, s.sheet)
    at = at_sheet(s.sheet)
    found = linearise(at, thin)[-1, 0]
    assert thin.thin is not None
    full = whole.data[0] - evaluate_output(m.chain, whole.record, p, whole.output)
    taps = thin.thin.taps
    for k in (0, 1, 1777, len(found) - 1):
        expected = float(full[k * EVERY : k * EVERY + len(taps)] @ taps[::-1])
        assert found[k] == pytest.approx(expected, rel=1e-9, abs=1e-9)
    parts = [linearise(at, thin.part(rows))[-1, 0] for rows in (slice(0, 1000), slice(1000, len(found)))]
    np.testing.assert_allclose(np.concatenate(parts), found, atol=1e-10)


def test_the_diagnosis_is_that_of_the_whole_record(flown, whole) -> None:
    s, flight = flown
    d = diagnose(model.load_packaged(), s.sheet, [flight])
    assert len(d.fitted.observations[0].record.time) * EVERY < len(flight.time)
    assert "thinned to 8.333 Hz" in dict(panels.describe_record(d.fitted))["samples"]
    assert (d.verdict, d.found) == ("missing-effect", ("thermal-scale",))
    (v,) = (q for q in d.ranking[0].combinations if q.name == "D34 dK1_dT")
    assert abs(abs(v.value) - 2e-8) < 4 * v.std
    f = fitted.fit(model.load_packaged(), s.sheet, [whole])
    (before,) = f.score([np.zeros(f.size)])
    assert d.noise_floor == pytest.approx(fitted.measure_noise_floor(f), rel=5e-3)
    assert d.before.rms_V == pytest.approx(before.whole.rms_V, rel=1e-3)
    assert d.before.rms_Eo == pytest.approx(before.whole.rms_Eo, rel=1e-3)
    assert d.before.inline_Eo == pytest.approx(before.whole.inline_Eo, rel=0.03)
    chi2 = make_problem(f, ["thermal-scale"]).tests()["thermal-scale"].chi2
    assert d.ranking[0].test.chi2 == pytest.approx(chi2, rel=0.1)  # the slow noise is known to some per cent


def test_what_thinning_takes_is_counted_as_noise(flown: tuple[Scenario, Flight], thin: Observation) -> None:
    """White noise of known size on top of what the instrument makes: the floor is its root mean square over the whole band."""
    s, flight = flown
    loud = 3e-2
    noisy = with_output(flight, loud * np.random.default_rng(5).standard_normal(len(flight.time)))
    f = fitted.fit(model.load_packaged(), s.sheet, [thinned(s.sheet, noisy)], candidates=False)
    (fast,) = f.beyond
    assert fast == pytest.approx((1 - 1 / EVERY) * loud**2, rel=0.03)
    assert fitted.measure_noise_floor(f) * f.k_ggi == pytest.approx(loud, rel=0.03)
    (scored,) = f.score([np.zeros(f.size)])
    assert scored.whole.rms_V == pytest.approx(loud, rel=0.03)


def test_what_must_not_be_thinned_stays_as_it_is(flown: tuple[Scenario, Flight]) -> None:
    """Short and slow flights; a vibration at 30 Hz that comes and goes, which K2 rectifies into the band; a line beyond the band."""
    s, flight = flown
    t = flight.time
    shake = 0.5 * np.sin(2 * np.pi * 30.0 * t) * (1 + np.sin(2 * np.pi * 0.2 * t))
    shaking = replace(flight, channels={**flight.channels, "a_x": flight.channels["a_x"] + shake})
    line = with_output(flight, 2e-3 * np.sin(2 * np.pi * 27.3 * t))
    slow = scenario(78, duration=2200.0, rate=16.0).simulate().flight()
    for kept in (flight.part(slice(0, 25_000)), slow, shaking, line):
        assert thinned(s.sheet, kept).thin is None


def test_spikes_cost_a_sample_and_a_gap_what_is_beside_it(flown: tuple[Scenario, Flight]) -> None:
    s, flight = flown
    valid = np.ones(len(flight.time), dtype=np.bool_)
    valid[np.random.default_rng(2).choice(len(valid), 200, replace=False)] = False
    valid[20_000:20_300] = False
    outputs = {n: np.where(valid, x, np.nan) for n, x in flight.outputs.items()}
    there = (flight.time < 200.0) | (flight.time >= 203.0)  # of single samples the reader knows the motion
    channels = {n: np.where(there, x, np.nan) for n, x in flight.channels.items()}
    o = thinned(s.sheet, replace(flight, channels=channels, outputs=outputs, valid=valid))
    assert o.thin is not None
    missing = np.flatnonzero(~o.record.valid)
    gap = (o.record.time[missing] > 199.5) & (o.record.time[missing] < 203.5)
    assert 3.0 * RATE / EVERY <= np.sum(gap) <= 3.8 * RATE / EVERY and np.sum(~gap) <= 2
    at = at_sheet(s.sheet)
    found = linearise(at, o)[-1, 0]
    expected = linearise(at, thinned(s.sheet, flight))[-1, 0]
    used = o.record.valid
    # beside a bridge the residual is off by less than a tenth of what it is
    assert np.max(np.abs((found - expected)[used])) < 0.1 * np.std(expected)
    assert np.std((found - expected)[used]) < 0.01 * np.std(expected)


def test_an_encoder_that_counts_from_zero_at_every_turn_is_thinned_as_one_that_does_not(flown) -> None:
    s, flight = flown
    spin = 2 * np.pi * s.sheet.spin_frequency
    found = []
    for angle in (spin * flight.time, np.mod(spin * flight.time, 2 * np.pi)):
        channels = {**flight.channels, "spin_angle": angle}
        o = thinned(s.sheet, replace(flight, channels=channels))
        assert o.thin is not None
        found.append(np.exp(1j * o.record.phi))
    np.testing.assert_allclose(found[0], found[1], atol=1e-9)
    np.testing.assert_allclose(found[0], np.exp(1j * spin * o.record.time), atol=1e-9)


G0 = 9.8


@pytest.fixture(scope="module")
def long_flight() -> tuple[Scenario, Flight]:
    s = scenario(61, duration=600.0)
    return s, s.simulate({"thermal-scale": {"dK1_dT": [0, 0, 2e-7, 0]}}).flight()


def test_ends_whose_derivative_does_not_fit_are_not_fitted(flown, whole) -> None:
    n, packaged = len(whole.record.time), model.load_packaged()
    with_lag = derive.with_effects(flown[0].sheet, packaged, ["lag"])
    p = make_vector(with_lag, flown[0].instrument)
    off = replace(whole, series=tuple(y + 0.1 * (np.arange(n) == n - 2) for y in whole.series))
    for m, o, left_out in ((packaged, off, []), (with_lag, whole, []), (with_lag, off, [0, 1, n - 2, n - 1])):
        (kept,) = thinning.leave_out_extrapolated(m, p, [o])
        assert np.flatnonzero(~kept.record.valid).tolist() == left_out


@pytest.mark.parametrize("samples", [24, 1000, 30000, 40000, 360_000, 8_640_000])
def test_segments_and_their_blocks_cover_a_flight_once(samples: int) -> None:
    found = divide_into_segments(samples)
    assert [s.start for s in found] == [0, *(s.stop for s in found[:-1])]
    assert found[-1].stop == samples
    assert max(s.stop - s.start for s in found) <= 30000
    blocks = [b for s in found for b in split_at_blocks(s, samples)]
    assert [rows.start for _, rows in blocks] == [0, *(rows.stop for _, rows in blocks[:-1])]
    assert sorted({b for b, _ in blocks}) == list(range(BLOCKS))


def test_the_division_leaves_no_trace(long_flight, monkeypatch) -> None:
    """The same calibration and evidence, from one segment and from many, to rounding; with a gap, and a level that changes."""
    s, flight = long_flight
    valid = np.ones(len(flight.time), dtype=bool)
    valid[4000:4130] = False
    flight = replace(flight, valid=valid)
    o = observation.observe(flight, s.sheet)
    louder = Level((LevelFactor("time", np.array([0.0, 300.0, 600.0]), np.array([1.0, 3.0, 1.0])),))
    estimated = fitted.fit(model.load_packaged(), s.sheet, [o]).calibration.noise
    noise = [replace(n, level=louder, level_first=True) for n in estimated]
    whole = fitted.fit(model.load_packaged(), s.sheet, [o], noise)
    monkeypatch.setattr(observation, "ROWS", 1700)
    assert len(o.segments) > 5
    parts = fitted.fit(model.load_packaged(), s.sheet, [o], noise)
    scale = np.array([c.scale for c in whole.calibration.columns])
    moved = (parts.calibration.p - whole.calibration.p)[whole.calibration.index] / scale
    assert np.max(np.abs(moved)) < 1e-5  # along what the record hardly sees; nothing in the figures
    effects = selection.list_testable(whole)
    expected, found = (make_problem(f, effects).tests() for f in (whole, parts))
    for e in effects:
        # of an effect that the calibration absorbs nearly whole rounding leaves seven digits at one place, six between two
        assert found[e].chi2 == pytest.approx(expected[e].chi2, rel=1e-5, abs=1e-6)
    zero = np.zeros(whole.size)
    for a, b in zip(whole.score([zero]), parts.score([zero]), strict=True):
        for name in ("rms_V", "rms_Eo", "inline_Eo", "cross_Eo"):
            assert getattr(b.whole, name) == pytest.approx(getattr(a.whole, name), rel=1e-8)
            assert getattr(b.held_out, name) == pytest.approx(getattr(a.held_out, name), rel=1e-8)
    np.testing.assert_allclose(parts.residuals()[0], whole.residuals()[0], atol=1e-9)
    a, b = (formula.propose_formulas(f, (), omnibus.search_residual(f)) for f in (whole, parts))
    assert b.searches[0].terms[0].term == a.searches[0].terms[0].term
    assert b.searches[0].terms[0].z == pytest.approx(a.searches[0].terms[0].z, rel=1e-4)  # single precision


def test_single_missing_samples_do_not_silence_the_demodulator(long_flight: tuple[Scenario, Flight]) -> None:
    """One sample in a hundred missing: the demodulated error is still there, and much the same; a long gap stays out."""
    s, flight = long_flight
    rng = np.random.default_rng(3)
    scattered = rng.random(len(flight.time)) > 0.01
    found = {}
    for name, valid in (("whole", np.ones(len(flight.time), dtype=bool)), ("scattered", scattered)):
        x = replace(flight, valid=valid)
        f = fitted.fit(
            model.load_packaged(), s.sheet, observation.observe_flights([x], s.sheet), candidates=False
        )
        (found[name],) = f.score([np.zeros(f.size)])
    for part in ("whole", "held_out"):
        a, b = getattr(found["whole"], part), getattr(found["scattered"], part)
        assert b.inline_Eo == pytest.approx(a.inline_Eo, rel=0.1)
        assert b.cross_Eo == pytest.approx(a.cross_Eo, rel=0.1)
    gap = np.ones(1000, dtype=bool)
    gap[500:560] = False
    d = replace(find_demodulator("fir", RATE), taps=np.full(101, 1 / 101), ahead=50)
    there = scores.find_whole(np.ones(1000, dtype=bool), gap, d)
    assert not there[510:550].any()  # windows with more than half of the gap
    assert there[50:450].all() and there[610:950].all()


def test_a_long_flight_with_gaps_everywhere_has_no_means(long_flight, monkeypatch) -> None:
    """One output sample of three, or part of the flight: the density is that of the segments, or of the means that are left."""
    s, flight = long_flight
    monkeypatch.setattr(observation, "ROWS", 1700)
    monkeypatch.setattr(noise_estimate, "MEANS", 2400)
    every, third = np.zeros((2, len(flight.time)), dtype=bool)
    every[::3] = third[2400:6400] = True
    for valid, there in ((every, False), (third, True), (np.ones_like(third), True)):
        x = replace(flight, valid=valid)
        o = observation.observe(x, s.sheet)
        at = at_sheet(s.sheet, with_candidates=True)
        found = noise_estimate.average_residuals(at, o, NoiseModel.white(o.record.rate, len(o.series)))
        assert (found is not None) == there
        if found is not None:
            assert np.array_equal(found[0].rest != 0.0, valid.reshape(-1, 4).all(axis=1))
        assert noise_estimate.estimate_noise(at, o).spectra[0].rms > 0.0


def test_noise_slower_than_a_segment_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """1/f noise of a flight of sixteen segments: its density came out three to twelve times too small below one over their
    length, and three of five effect-free flights had an effect or something left.
    """
    s = scenario(73, duration=1700.0, rate=SLOW, red_corner=0.3)
    flight = s.simulate().flight()
    monkeypatch.setattr(observation, "ROWS", 850)
    o = observation.observe(flight, s.sheet)
    (x,) = fitted.fit(model.load_packaged(), s.sheet, [o], candidates=False).prepared
    f = np.geomspace(4.0 / 1700.0, 3.0, 40)
    assert s.noise is not None
    slope = s.instrument.accelerometers["k_VI"] * s.instrument.accelerometers["K1"]
    true = s.noise.psd(f) * np.sum(slope**2)
    ratio = x.noise_psd(f) / true
    assert np.exp(np.mean(np.log(ratio[:15]))) == pytest.approx(1.0, rel=0.25)  # slower than a segment shows
    assert np.max(np.abs(np.log(ratio))) < np.log(2.0)
