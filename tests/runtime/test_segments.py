"""Long flights: worked on in segments, with the figures of the whole."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from ragg_runtime.estimation import fitted, noise_estimate, observation, scores, whitening
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import BLOCKS, segments, spread, take_beginnings
from ragg_runtime.estimation.regressors import LinearisationPoint
from ragg_runtime.identification import contenders, omnibus, selection
from ragg_runtime.identification.contenders import ContenderFit
from ragg_runtime.identification.selection import make_field
from ragg_runtime.io import Flight
from ragg_runtime.model import model
from ragg_runtime.model.evaluate import vector
from ragg_runtime.reference.scenario import Scenario, scenario
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed

G0 = 9.8


@pytest.fixture(scope="module")
def flown() -> tuple[Scenario, Flight]:
    s = scenario(61, duration=600.0)
    return s, s.simulate({"thermal-scale": {"dK1_dT": [0, 0, 2e-7, 0]}}).flight()


@pytest.mark.parametrize("samples", [24, 1000, 30000, 40000, 360_000, 8_640_000])
def test_segments_and_their_blocks_cover_a_flight_once(samples: int) -> None:
    found = segments(samples)
    assert [s.rows.start for s in found] == [0, *(s.rows.stop for s in found[:-1])]
    assert found[-1].rows.stop == samples
    assert max(s.rows.stop - s.rows.start for s in found) <= 30000
    blocks = [b for s in found for b in s.blocks]
    assert [rows.start for _, rows in blocks] == [0, *(rows.stop for _, rows in blocks[:-1])]
    assert sorted({b for b, _ in blocks}) == list(range(BLOCKS))


def test_the_division_leaves_no_trace(
    flown: tuple[Scenario, Flight], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The same noise, calibration and evidence, from one segment and from many, to rounding; with a gap."""
    s, flight = flown
    valid = np.ones(len(flight.time), dtype=bool)
    valid[4000:4130] = False
    flight = Flight(flight.time, flight.channels, flight.outputs, valid=valid, units=flight.units)
    o = observation.observe(flight, s.sheet)
    noise = fitted.fit(model.packaged(), s.sheet, [o]).calibration.noise
    whole = fitted.fit(model.packaged(), s.sheet, [o], noise)
    monkeypatch.setattr(whitening, "ROWS", 1700)
    monkeypatch.setattr(whitening, "EXCERPT", 1000)
    assert len(whitening.flight_segments(o)) > 5
    parts = fitted.fit(model.packaged(), s.sheet, [o], noise)
    scale = np.array([c.scale for c in whole.calibration.columns])
    moved = (parts.calibration.p - whole.calibration.p)[whole.calibration.index] / scale
    assert np.max(np.abs(moved)) < 1e-5  # along what the record hardly sees; nothing in the figures
    effects = selection.list_testable(whole)
    expected, found = (make_field(f, effects).tests() for f in (whole, parts))
    for e in effects:
        # of an effect that the calibration absorbs nearly whole rounding leaves seven digits at one place, six between two
        assert found[e].chi2 == pytest.approx(expected[e].chi2, rel=1e-5, abs=1e-6)
    zero = np.zeros(whole.size)
    for a, b in zip(whole.score([zero]), parts.score([zero]), strict=True):
        for name in ("rms_V", "rms_Eo", "inline_Eo", "cross_Eo"):
            assert getattr(b.whole, name) == pytest.approx(getattr(a.whole, name), rel=1e-8)
            assert getattr(b.held_out, name) == pytest.approx(getattr(a.held_out, name), rel=1e-8)
    np.testing.assert_allclose(
        parts.residuals(np.zeros(parts.n_base))[0], whole.residuals(zero[: whole.n_base])[0], atol=1e-9
    )
    a, b = omnibus.remainder(whole), omnibus.remainder(parts)
    assert b.searches[0].terms[0].term == a.searches[0].terms[0].term
    assert b.searches[0].terms[0].z == pytest.approx(a.searches[0].terms[0].z, rel=1e-4)  # single precision


def test_single_missing_samples_do_not_silence_the_demodulator(flown: tuple[Scenario, Flight]) -> None:
    """One sample in a hundred missing: the demodulated error is still there, and much the same; a long gap stays out."""
    s, flight = flown
    rng = np.random.default_rng(3)
    scattered = rng.random(len(flight.time)) > 0.01
    found = {}
    for name, valid in (("whole", np.ones(len(flight.time), dtype=bool)), ("scattered", scattered)):
        x = Flight(flight.time, flight.channels, flight.outputs, valid=valid, units=flight.units)
        f = fitted.fit(model.packaged(), s.sheet, observation.observe_flights([x], s.sheet), candidates=False)
        (found[name],) = f.score([np.zeros(f.size)])
    for part in ("whole", "held_out"):
        a, b = getattr(found["whole"], part), getattr(found["scattered"], part)
        assert b.inline_Eo == pytest.approx(a.inline_Eo, rel=0.1)
        assert b.cross_Eo == pytest.approx(a.cross_Eo, rel=0.1)
    gap = np.ones(1000, dtype=bool)
    gap[500:560] = False
    found_segments = scores.find_supported(np.ones((1, 1000), dtype=bool), gap, 101)[0]
    assert not found_segments[460:500].any()  # windows with more than half of the gap
    assert found_segments[:400].all() and found_segments[560:].all()


def test_a_long_flight_with_gaps_everywhere_has_no_means(
    flown: tuple[Scenario, Flight], monkeypatch: pytest.MonkeyPatch
) -> None:
    """One output sample of three, or part of the flight: the density is that of the segments, or of the means that are left."""
    s, flight = flown
    monkeypatch.setattr(whitening, "ROWS", 1700)
    monkeypatch.setattr(noise_estimate, "MEANS", 2400)
    every, third = np.zeros((2, len(flight.time)), dtype=bool)
    every[::3] = third[2400:6400] = True
    for valid, there in ((every, False), (third, True), (np.ones_like(third), True)):
        x = Flight(flight.time, flight.channels, flight.outputs, valid=valid, units=flight.units)
        o = observation.observe(x, s.sheet)
        at = LinearisationPoint(
            model.packaged(), s.sheet, vector(model.packaged(), s.sheet), with_candidates=True
        )
        found = noise_estimate.averages(at, o, NoiseModel.white(o.record.rate, len(o.series)))
        assert (found is not None) == there
        if found is not None:
            assert np.array_equal(found[0].rest != 0.0, valid.reshape(-1, 4).all(axis=1))
        assert noise_estimate.estimate_noise(at, o).spectra[0].rms > 0.0


def test_contenders_of_a_long_flight_are_told_apart_on_an_excerpt(
    flown: tuple[Scenario, Flight], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The right effect, and only those fitted to everything that the excerpt left in the contest."""
    s, flight = flown
    monkeypatch.setattr(whitening, "ROWS", 1700)
    monkeypatch.setattr(whitening, "EXCERPT", 3)
    fitted_to: list[int] = []

    def left(f: Fitted, *given: Any) -> ContenderFit:
        fitted_to.append(int(np.sum(f.observations[0].record.valid)))
        return original(f, *given)

    original = contenders.fit_contender
    monkeypatch.setattr(contenders, "fit_contender", left)
    long = diagnosed(s, flight)
    assert long.staged and long.found == ("thermal-scale",)
    whole = fitted_to.count(int(np.sum(flight.valid)))
    assert 0 < whole < len(fitted_to) - whole


def test_noise_slower_than_a_segment_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """1/f noise of a flight of sixteen segments: its density came out three to twelve times too small below one over their
    length, and three of five effect-free flights had an effect or something left.
    """
    s = scenario(73, duration=1700.0, rate=RATE, red_corner=0.3)
    flight = s.simulate().flight()
    monkeypatch.setattr(whitening, "ROWS", 850)
    (x,) = fitted.fit(model.packaged(), s.sheet, [observation.observe(flight, s.sheet)]).prepared
    f = np.geomspace(4.0 / 1700.0, 3.0, 40)
    assert s.noise is not None
    slope = s.instrument.accelerometers["k_VI"] * s.instrument.accelerometers["K1"]
    true = s.noise.psd(f) * np.sum(slope**2)
    ratio = x.noise_psd(f) / true
    assert np.exp(np.mean(np.log(ratio[:15]))) == pytest.approx(1.0, rel=0.25)  # slower than a segment shows
    assert np.max(np.abs(np.log(ratio))) < np.log(2.0)


def test_of_long_flights_as_many_samples_are_taken_whatever_their_length() -> None:
    for samples in (1_000_000, 3_000_000, 16_000_000):
        found = spread(segments(samples), 4)
        found_segments = take_beginnings(found, 80_000)
        assert [s.rows.start for s in found_segments] == [s.rows.start for s in found]
        assert [s.rows.stop - s.rows.start for s in found_segments] == [20_000] * 4
    assert [s.rows for s in take_beginnings(segments(28_800), 80_000)] == [slice(0, 28_800)]
