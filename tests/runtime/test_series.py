"""Series: the derivative, demodulators, ours and others; long flights, thinned to a twelfth of the samples, or in segments."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy import signal
from scipy.signal import freqz

from benchmarks.diagnosis.plan import model_text
from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation import fitted, observation, thinning
from ragg_runtime.estimation.noise import Level, LevelFactor
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.estimation.regressors import (
    LinearisationPoint,
    linearise,
    list_candidate_columns,
    make_point,
)
from ragg_runtime.identification import formula, omnibus, selection, strong
from ragg_runtime.identification.comparison import Comparison, compare
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.selection import make_problem
from ragg_runtime.instrument.instrument import Demodulation, Instrument, read_demodulation
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.io.mapping import parse_mapping
from ragg_runtime.model import derive, model
from ragg_runtime.model.model import make_vector, scale_factor
from ragg_runtime.model.record import record
from ragg_runtime.reference.gravity import Gradient
from ragg_runtime.reference.motion import disc_angle, still
from ragg_runtime.reference.scenario import Scenario, perfect, scenario
from ragg_runtime.reference.simulate import simulate
from ragg_runtime.signals.demodulators import demodulate, low_pass
from ragg_runtime.signals.derivative import differentiate
from tests.simulated import RATE as SLOW

Array = NDArray[np.float64]

FAST = 16.0


@pytest.mark.parametrize("share", [0.01, 0.1, 0.2, 0.3, 0.4, 0.65])
def test_accuracy_on_sines(share: float) -> None:
    """The figures of the docstring, at every phase."""
    w = share * np.pi * FAST
    t = np.arange(200) / FAST
    phase = np.linspace(0, 2 * np.pi, 33)[:, None]
    error = np.abs(differentiate(np.sin(w * t + phase), FAST) - w * np.cos(w * t + phase)).max(axis=0) / w
    assert error[6:-6].max() < (3e-6 if share < 0.5 else 2e-5)
    if share < 0.5:
        assert max(error[2:6].max(), error[-6:-2].max()) < 5.5e-5
        assert max(error[1], error[-2]) < 1.5e-4
        assert error.max() < 1.2e-3


@settings(deadline=None)
@given(st.integers(2, 80), st.floats(0.1, 1000.0), st.integers(0, 2**32 - 1))
def test_polynomials_are_exact(n: int, rate: float, seed: int) -> None:
    """Whatever the length: as many degrees as the samples allow, up to four."""
    p = np.polynomial.Polynomial(np.random.default_rng(seed).normal(size=min(n, 5)))
    u = np.arange(n) / n
    assert differentiate(p(u), rate) == pytest.approx(p.deriv()(u) * rate / n, abs=3e-11 * rate)


def test_nothing_crosses_a_gap() -> None:
    """Beside a gap the derivative is that of the run alone, whatever the other side holds."""
    x = np.cumsum(np.random.default_rng(2).normal(size=300))
    valid = np.ones(300, dtype=bool)
    valid[[*range(100, 110), 200]] = False
    result = differentiate(np.where(valid, x, np.nan), FAST)
    for run in (slice(0, 100), slice(110, 200), slice(201, 300)):
        assert np.array_equal(result[run], differentiate(x[run], FAST))
    assert np.isnan(result[~valid]).all()


def test_the_page_gives_the_formulas_of_the_code() -> None:
    """docs/reference/flight-file.md, evaluated: what it says of a pure gradient and of its demodulation is so."""
    page = (Path(__file__).parents[2] / "docs" / "reference" / "flight-file.md").read_text("utf-8")
    formulas = dict(re.findall(r"^    (G_out|inline|cross) = (.+)$", page, flags=re.MULTILINE))
    assert {*formulas} == {"G_out", "inline", "cross"}
    tensor, instrument = np.array([300, 120, 50, 200, -80, -500]) * 1e-9, perfect()
    flight = simulate(instrument, still(), 300, FAST, gravity=Gradient(tensor))
    names = {
        "sin": np.sin,
        "cos": np.cos,
        "phi": disc_angle(0.25, flight.time),
        "k_ggi": instrument.scale_factor,
    }
    G_out = eval(formulas["G_out"], {**names, "inline": tensor[0] - tensor[3], "cross": tensor[1]})
    np.testing.assert_allclose(flight.G_out, G_out, rtol=0, atol=1e-5 * np.max(np.abs(G_out)))
    names |= {"G_out": flight.G_out, "LP": lambda x: np.convolve(x, low_pass(FAST), "valid")}
    out = demodulate(flight.G_out, names["phi"], FAST, instrument.scale_factor)
    for name, true in (("inline", tensor[0] - tensor[3]), ("cross", tensor[1])):
        by_page = eval(formulas[name], dict(names))
        np.testing.assert_allclose(by_page, getattr(out, name), rtol=0, atol=1e-15)
        np.testing.assert_allclose(by_page, true, rtol=0, atol=1e-14)


def test_the_low_pass_has_half_amplitude_at_the_cutoff() -> None:
    taps = low_pass(FAST)
    _, response = freqz(taps, worN=[0.0, 0.1, 0.15, 0.2, 0.25, 1.0], fs=FAST)
    gain = np.abs(response)
    assert gain[:3] == pytest.approx(1, abs=2e-5)
    assert gain[3] == pytest.approx(0.5, abs=2e-3)
    assert np.all(gain[4:] < 2e-5)
    # the equivalent noise bandwidth is the paper's 0.2 Hz
    assert np.sum(taps**2) * FAST / 2 == pytest.approx(0.2, rel=0.1)


CAUSAL = signal.butter(3, 0.15, fs=FAST, output="sos")
BOTH = signal.butter(2, 0.12, fs=FAST, output="sos")

MADE: dict[str, tuple[Callable[[Array], Array], Demodulation]] = {
    "causal": (lambda z: signal.sosfilt(CAUSAL, z), Demodulation(kind="causal", order=3, cutoff=0.15)),
    "both ways": (
        lambda z: signal.sosfiltfilt(BOTH, z),
        Demodulation(kind="butterworth", order=2, cutoff=0.12),
    ),
    "fir": (lambda z: signal.oaconvolve(z, low_pass(FAST), mode="same"), Demodulation()),
}


@cache
def channels_flown(trim: str = "table-v") -> tuple[Scenario, Flight]:
    s = scenario(61, duration=480.0, trim=trim)
    return s, s.simulate().flight()


def channels(low: Callable[[Array], Array], every: int = 1, trim: str = "table-v") -> Flight:
    """Inline and cross alone, of every so many samples."""
    s, x = channels_flown(trim)
    G, time = x.outputs["G_out"][::every], x.time[::every]
    phi, packaged = 2 * np.pi * 0.25 * time, model.load_packaged()
    k = scale_factor(packaged, make_vector(packaged, s.sheet)) * 1e9
    outputs = {"inline": low(4 * G * np.sin(2 * phi)) / k, "cross": low(-2 * G * np.cos(2 * phi)) / k}
    return Flight(time=time, channels={n: v[::every] for n, v in x.channels.items()}, outputs=outputs)


def compared(x: Flight, trim: str = "table-v") -> Comparison:
    return compare(model.load_packaged(), channels_flown(trim)[0].sheet, [x])


@pytest.mark.parametrize("name", ["both ways", "causal"])
def test_the_fit_goes_by_the_demodulator_that_is_declared(name: str) -> None:
    """The output is ten million eotvos, the noise one: a low-pass that is off by 1e-6 would show."""
    low, how = MADE[name]
    c = compared(replace(channels(low), demodulation=how))
    assert c.adequate and 0.4 < c.calibrated.rms_Eo < 1.2


def test_the_sheet_counts_where_the_flight_says_nothing() -> None:
    how, other = MADE["causal"][1], Demodulation(cutoff=0.1)
    s, x = channels_flown()
    assert record(x, s.sheet).demodulation == Demodulation()
    assert record(x, replace(s.sheet, demodulation=how)).demodulation == how
    assert record(replace(x, demodulation=how), replace(s.sheet, demodulation=other)).demodulation == how


def test_channels_that_were_made_at_the_records_own_rate_are_adequate() -> None:
    x = channels(lambda z: signal.oaconvolve(z, low_pass(FAST / 4), mode="same"), 4, "matched")
    assert compared(x, "matched").adequate


def test_channels_every_second_are_seen_both() -> None:
    """A disc at a quarter of a hertz has a carrier whose sine is zero at every full second: inline was not looked at."""
    x = channels(MADE["fir"][0], trim="matched")
    seldom = np.arange(len(x)) % 16 == 0
    right = {n: np.where(seldom, v, np.nan) for n, v in x.outputs.items()}
    c = compared(replace(x, outputs=right), "matched")
    # of 480 samples, of which the calibration explains some of the noise, the held-out error tells the noise
    assert c.adequate and c.noise_floor == pytest.approx(c.holdout.rms_Eo, rel=0.25)
    wrong = right | {"inline": right["inline"] * 1.001}
    assert compared(replace(x, outputs=wrong), "matched").calibrated.rms_Eo > 3 * c.calibrated.rms_Eo


def test_it_stands_in_model_toml_and_in_a_mapping(tmp_path: Path) -> None:
    s, x = channels_flown()
    for _, how in MADE.values():
        text = model_text(replace(s.sheet, demodulation=how))
        assert parse_instrument(text).demodulation == how
    path = tmp_path / "flight.csv"
    write_flight(channels(MADE["causal"][0]).part(slice(0, 400)), path)
    names = [*x.channels, "inline", "cross"]
    entries = [f'{n} = {{ column = "{n}" }}' for n in names]
    mapping = "\n".join(['[time]\ncolumn = "time"\nunit = "s"\n[columns]', *entries])
    mapping += '\n[demodulator]\nkind = "causal"\norder = 3\ncutoff = "150 mHz"\n'
    read = read_flight(path, 9.8, mapping=parse_mapping(mapping, tmp_path / "mapping.toml"))
    assert read.demodulation == MADE["causal"][1]
    assert any("a causal Butterworth low-pass of order 3 at 0.15 Hz" in n for n in read.notes)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"kind": "chebyshev"}, "there is no such demodulator"),
        ({"kind": "causal", "cutoff": "0.2 Hz"}, "no order"),
        ({"kind": "fir", "order": 2}, "unknown key"),
        ({"kind": "causal", "cutoff": "0.2 m", "order": 2}, "cutoff"),
        ({"kind": "causal", "cutoff": "-0.2 Hz", "order": 2}, "cutoff must be positive"),
        ({"kind": "causal", "cutoff": "0.2 Hz", "order": 0}, "no such order"),
        ({"kinds": "causal"}, "unknown key"),
        ("causal", "demodulator must be a table"),
    ],
)
def test_what_cannot_be_a_demodulator_is_told(table: object, words: str) -> None:
    with pytest.raises(UserError, match=words):
        read_demodulation(table, "model.toml: [demodulator]")


def test_a_rate_that_is_too_low_is_told() -> None:
    with pytest.raises(UserError, match="sampling rate"):
        demodulate(np.zeros(100), np.zeros(100), 0.4, 1.0)


# --- long flights ---

RATE, EVERY = 100.0, 12


@pytest.fixture(scope="module")
def flown() -> tuple[Scenario, Flight]:
    s = scenario(77, duration=320.0, rate=RATE)
    return s, s.simulate({"thermal-scale": {"dK1_dT": [0, 0, 2e-8, 0]}}).flight()


@pytest.fixture(scope="module")
def whole(flown: tuple[Scenario, Flight]) -> Observation:
    s, flight = flown
    return observation.observe(flight, s.sheet)


def thinned(sheet: Instrument, flight: Flight) -> Observation:
    (o,) = thinning.thin_observations(model.load_packaged(), sheet, [observation.observe(flight, sheet)])
    return o


def at_sheet(sheet: Instrument, *, with_candidates: bool = False) -> LinearisationPoint:
    m = model.load_packaged()
    candidates = list_candidate_columns(m, sheet) if with_candidates else ()
    return make_point(m, sheet, make_vector(m, sheet), candidates)


def with_output(flight: Flight, further: NDArray[np.float64]) -> Flight:
    return replace(flight, outputs={n: x + further for n, x in flight.outputs.items()})


def test_the_diagnosis_is_that_of_the_whole_record(flown, whole) -> None:
    s, flight = flown
    d = diagnose(model.load_packaged(), s.sheet, [flight])
    assert len(d.fitted.observations[0].record.time) * EVERY < len(flight.time)
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


def test_what_thinning_takes_is_counted_as_noise(flown: tuple[Scenario, Flight]) -> None:
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
    present = (flight.time < 200.0) | (flight.time >= 203.0)  # of single samples the reader knows the motion
    channels = {n: np.where(present, x, np.nan) for n, x in flight.channels.items()}
    o = thinned(s.sheet, replace(flight, channels=channels, outputs=outputs, valid=valid))
    missing = o.record.time[~o.record.valid]
    gap = (missing > 199.5) & (missing < 203.5)
    assert 3.0 * RATE / EVERY <= np.sum(gap) <= 3.8 * RATE / EVERY and np.sum(~gap) <= 2
    found, expected = (linearise(at_sheet(s.sheet), x)[-1, 0] for x in (o, thinned(s.sheet, flight)))
    off = (found - expected)[o.record.valid]
    # beside a bridge the residual is off by less than a tenth of what it is
    assert np.max(np.abs(off)) < 0.1 * np.std(expected)
    assert np.std(off) < 0.01 * np.std(expected)


def test_an_encoder_that_counts_from_zero_at_every_turn_is_thinned_as_one_that_does_not(flown) -> None:
    s, flight = flown
    spin = 2 * np.pi * s.sheet.spin_frequency
    residuals = []
    for angle in (spin * flight.time, np.mod(spin * flight.time, 2 * np.pi)):
        channels = {**flight.channels, "spin_angle": angle}
        o = thinned(s.sheet, replace(flight, channels=channels))
        assert o.thin is not None
        residuals.append(np.exp(1j * o.record.phi))
    np.testing.assert_allclose(residuals[0], residuals[1], atol=1e-9)
    np.testing.assert_allclose(residuals[0], np.exp(1j * spin * o.record.time), atol=1e-9)


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


def test_beside_a_long_gap_motion_that_does_not_fit_is_not_fitted(flown, whole) -> None:
    """Three samples on either side, up to 36 standard deviations off, were taken for noise that changes over the record."""
    late = derive.with_effects(flown[0].sheet, model.load_packaged(), ["time-offset"])
    n = len(whole.record.time)
    valid = np.ones(n, dtype=bool)
    valid[200:300] = valid[400:403] = False
    series = tuple(y + 0.1 * (np.arange(n) == 199) for y in whole.series)
    off = replace(whole, series=series, record=replace(whole.record, valid=valid))
    (kept,) = thinning.leave_out_extrapolated(late, make_vector(late, flown[0].instrument), [off])
    left_out = [0, 1, *range(188, 200), *range(300, 312), n - 2, n - 1]
    assert np.flatnonzero(valid & ~kept.record.valid).tolist() == left_out


def test_the_division_leaves_no_trace(long_flight, monkeypatch) -> None:
    """The same calibration and evidence, from one segment and from many, to rounding; with a gap, and a level that changes."""
    s, flight = long_flight
    valid = np.ones(len(flight.time), dtype=bool)
    valid[4000:4130] = False
    o = observation.observe(replace(flight, valid=valid), s.sheet)
    louder = Level((LevelFactor("time", np.array([0.0, 300.0, 600.0]), np.array([1.0, 3.0, 1.0])),))
    estimated = fitted.fit(model.load_packaged(), s.sheet, [o]).calibration.noise
    noise = [replace(n, level=louder) for n in estimated]
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
    some = strong.take_parts(parts)  # on which contenders are tried first
    assert some.calibration.rows < strong.score_fit(some, parts.model, s.sheet)[0] < parts.calibration.chi2
    a, b = (formula.propose_formulas(f, (), omnibus.search_residual(f)) for f in (whole, parts))
    assert b.searches[0].terms[0].term == a.searches[0].terms[0].term
    assert b.searches[0].terms[0].z == pytest.approx(a.searches[0].terms[0].z, rel=1e-4)  # single precision


def test_single_missing_samples_do_not_silence_the_demodulator(long_flight: tuple[Scenario, Flight]) -> None:
    """One sample in a hundred missing: the demodulated error is still there, and much the same."""
    s, flight = long_flight
    scores = []
    for missing in (0.0, 0.01):
        x = replace(flight, valid=np.random.default_rng(3).random(len(flight.time)) >= missing)
        o = observation.observe_flights([x], s.sheet)
        f = fitted.fit(model.load_packaged(), s.sheet, o, candidates=False)
        scores += f.score([np.zeros(f.size)])
    for part in ("whole", "held_out"):
        a, b = (getattr(x, part) for x in scores)
        assert b.inline_Eo == pytest.approx(a.inline_Eo, rel=0.1)
        assert b.cross_Eo == pytest.approx(a.cross_Eo, rel=0.1)


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
