"""Signals: the derivative in its band, at the ends and beside gaps; our demodulator, and another that the sheet or a mapping states."""

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
from ragg_runtime.identification.comparison import Comparison, compare
from ragg_runtime.instrument.demodulation import Demodulation, read_demodulation
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.io.mapping import parse_mapping
from ragg_runtime.model.model import load_packaged, make_vector, scale_factor
from ragg_runtime.model.record import make_kernel, record
from ragg_runtime.reference import disc_angle, simulate, still
from ragg_runtime.reference.gravity import Gradient
from ragg_runtime.reference.scenario import Scenario, perfect, scenario
from ragg_runtime.signals.demodulators import demodulate, low_pass
from ragg_runtime.signals.derivative import WINDOW, differentiate, interpolate_even

RATE = 16.0


def band_limited(rng: np.random.Generator, t: np.ndarray, top: float) -> tuple[np.ndarray, np.ndarray]:
    """A sum of sines up to ``top`` Hz and its exact derivative."""
    f = rng.uniform(0.01, top, 40) * 2 * np.pi
    phase = rng.uniform(0, 2 * np.pi, 40)
    size = rng.normal(size=40)
    argument = np.outer(t, f) + phase
    return np.sin(argument) @ size, np.cos(argument) @ (size * f)


@pytest.mark.parametrize("share", [0.01, 0.1, 0.2, 0.3, 0.4, 0.65])
def test_accuracy_on_sines(share: float) -> None:
    """The figures of the docstring, at every phase."""
    w = share * np.pi * RATE
    t = np.arange(200) / RATE
    phase = np.linspace(0, 2 * np.pi, 33)[:, None]
    error = np.abs(differentiate(np.sin(w * t + phase), RATE) - w * np.cos(w * t + phase)).max(axis=0) / w
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
    rng = np.random.default_rng(2)
    x, _ = band_limited(rng, np.arange(300) / RATE, 3.0)
    valid = np.ones(300, dtype=bool)
    valid[100:110] = False
    valid[200] = False
    spoilt = x.copy()
    spoilt[~valid] = 1e6
    result = differentiate(spoilt, RATE, valid)
    for run in (slice(0, 100), slice(110, 200), slice(201, 300)):
        assert np.array_equal(result[run], differentiate(x[run], RATE))
    assert np.isnan(result[~valid]).all()
    spoilt[~valid] = np.nan
    assert np.array_equal(differentiate(spoilt, RATE), result, equal_nan=True)


def test_noise_is_not_blown_up() -> None:
    x = np.random.default_rng(5).normal(size=(4000, 2 * WINDOW))
    gain = np.std(differentiate(x, 1.0), axis=0)
    assert gain[12:-12].max() < 1.6
    assert gain[6:-6].max() < 3.3
    assert max(gain[1], gain[-2]) < 6.5
    assert gain.max() < 33


@pytest.mark.parametrize(("share", "most"), [(0.1, 1e-11), (0.2, 2e-9), (0.42, 1e-5)])
def test_a_series_is_interpolated_between_its_samples(share: float, most: float) -> None:
    n, w = np.arange(400), share * np.pi
    at = n + 0.43
    found = interpolate_even([9.8 + np.sin(w * n), np.cos(w * n)], at)
    error = np.abs(found - [9.8 + np.sin(w * at), np.cos(w * at)])
    assert error[:, 40:-40].max() < most
    assert interpolate_even([np.arange(5.0)], np.array([2.5]))[0] == pytest.approx([2.5])


def test_the_page_gives_the_formulas_of_the_code() -> None:
    """docs/reference/flight-file.md, evaluated: what it says of a pure gradient and of its demodulation is so."""
    page = (Path(__file__).parents[2] / "docs" / "reference" / "flight-file.md").read_text("utf-8")
    said = dict(re.findall(r"^    (G_out|inline|cross) = (.+)$", page, flags=re.MULTILINE))
    assert {*said} == {"G_out", "inline", "cross"}
    tensor, instrument = np.array([300, 120, 50, 200, -80, -500]) * 1e-9, perfect()
    flight = simulate(instrument, still(), 300, RATE, gravity=Gradient(tensor))
    known = {
        "sin": np.sin,
        "cos": np.cos,
        "phi": disc_angle(0.25, flight.time),
        "k_ggi": instrument.scale_factor,
    }
    G_out = eval(said["G_out"], {**known, "inline": tensor[0] - tensor[3], "cross": tensor[1]})
    np.testing.assert_allclose(flight.G_out, G_out, rtol=0, atol=1e-5 * np.max(np.abs(G_out)))
    known |= {"G_out": flight.G_out, "LP": lambda x: np.convolve(x, low_pass(RATE), "valid")}
    out = demodulate(flight.G_out, known["phi"], RATE, instrument.scale_factor)
    for name, true in (("inline", tensor[0] - tensor[3]), ("cross", tensor[1])):
        by_page = eval(said[name], dict(known))
        np.testing.assert_allclose(by_page, getattr(out, name), rtol=0, atol=1e-15)
        np.testing.assert_allclose(by_page, true, rtol=0, atol=1e-14)


def test_neighbouring_harmonics_are_stopped() -> None:
    t = np.arange(0, 600, 1 / RATE)
    phi = disc_angle(0.25, t)
    for harmonic in (0, 1, 3, 4, 5):
        out = demodulate(np.cos(harmonic * phi + 0.3), phi, RATE, 1.0)
        assert max(np.abs(out.inline).max(), np.abs(out.cross).max()) < 4e-5


def test_filter_is_symmetric_with_half_amplitude_at_the_cutoff() -> None:
    taps = low_pass(RATE)
    np.testing.assert_allclose(taps, taps[::-1], rtol=0, atol=1e-17)
    assert taps.size % 2 == 1
    _, response = freqz(taps, worN=[0.0, 0.1, 0.15, 0.2, 0.25, 1.0], fs=RATE)
    gain = np.abs(response)
    assert gain[:3] == pytest.approx(1, abs=2e-5)
    assert gain[3] == pytest.approx(0.5, abs=2e-3)
    assert np.all(gain[4:] < 2e-5)
    # The equivalent noise bandwidth is the paper's 0.2 Hz.
    assert np.sum(taps**2) * RATE / 2 == pytest.approx(0.2, rel=0.1)


def test_a_low_pass_above_half_the_rate_is_refused() -> None:
    with pytest.raises(UserError, match="sampling rate"):
        demodulate(np.zeros(100), np.zeros(100), 0.4, 1.0)


Array = NDArray[np.float64]

CAUSAL = signal.butter(3, 0.15, fs=RATE, output="sos")
BOTH = signal.butter(2, 0.12, fs=RATE, output="sos")

MADE: dict[str, tuple[Callable[[Array], Array], Demodulation]] = {
    "causal": (lambda z: signal.sosfilt(CAUSAL, z), Demodulation(kind="causal", order=3, cutoff=0.15)),
    "both ways": (
        lambda z: signal.sosfiltfilt(BOTH, z),
        Demodulation(kind="butterworth", order=2, cutoff=0.12),
    ),
    "late": (
        lambda z: np.concatenate([np.zeros(8), signal.sosfilt(CAUSAL, z)[:-8]]),
        Demodulation(kind="causal", order=3, cutoff=0.15, delay=0.5),
    ),
    "fir": (lambda z: signal.oaconvolve(z, low_pass(RATE), mode="same"), Demodulation()),
}


@cache
def flown(trim: str = "table-v") -> tuple[Scenario, Flight]:
    s = scenario(61, duration=480.0, trim=trim)
    return s, s.simulate().flight()


def channels(low: Callable[[Array], Array], every: int = 1, trim: str = "table-v") -> Flight:
    """Inline and cross alone, every so many samples of them and of the motion."""
    s, x = flown(trim)
    phi, k = (
        2 * np.pi * 0.25 * x.time,
        scale_factor(load_packaged(), make_vector(load_packaged(), s.sheet)) * 1e9,
    )
    found = {
        "inline": low(4 * x.outputs["G_out"] * np.sin(2 * phi)) / k,
        "cross": low(-2 * x.outputs["G_out"] * np.cos(2 * phi)) / k,
    }
    kept = slice(None, None, every)
    return Flight(
        time=x.time[kept],
        channels={n: v[kept] for n, v in x.channels.items()},
        outputs={n: v[kept] for n, v in found.items()},
    )


def compared(x: Flight, trim: str = "table-v") -> Comparison:
    return compare(load_packaged(), flown(trim)[0].sheet, [x])


@pytest.mark.parametrize("name", ["both ways", "late"])
def test_the_fit_goes_by_the_demodulator_that_is_declared(name: str) -> None:
    """The output is ten million eotvos, the noise one: a low-pass that is off by 1e-6 would show."""
    low, how = MADE[name]
    c = compared(replace(channels(low), demodulation=how))
    assert c.adequate and 0.4 < c.calibrated.rms_Eo < 1.2


def test_the_sheet_counts_where_the_flight_says_nothing() -> None:
    how, other = MADE["causal"][1], Demodulation(kind="average", length=4.0)
    s, x = flown()
    assert record(x, s.sheet).demodulation == Demodulation()
    assert record(x, replace(s.sheet, demodulation=how)).demodulation == how
    assert record(replace(x, demodulation=how), replace(s.sheet, demodulation=other)).demodulation == how


def test_channels_that_were_made_at_the_records_own_rate_are_adequate() -> None:
    s, x = flown("matched")
    every = slice(None, None, 4)
    G, time = x.outputs["G_out"][every], x.time[every]
    phi, k = (
        2 * np.pi * 0.25 * time,
        scale_factor(load_packaged(), make_vector(load_packaged(), s.sheet)) * 1e9,
    )
    low = low_pass(RATE / 4)
    made = {
        "inline": signal.oaconvolve(4 * G * np.sin(2 * phi), low, mode="same") / k,
        "cross": signal.oaconvolve(-2 * G * np.cos(2 * phi), low, mode="same") / k,
    }
    motion = {n: v[every] for n, v in x.channels.items()}
    c = compared(
        Flight(time=time, channels=motion, outputs=made, demodulation=Demodulation(rate=4.0)), "matched"
    )
    assert c.adequate


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
    s, x = flown()
    for _, how in MADE.values():
        text = model_text(replace(s.sheet, demodulation=how))
        assert parse_instrument(text).demodulation == how
    path = tmp_path / "flight.csv"
    write_flight(channels(MADE["causal"][0]).part(slice(0, 400)), path)
    names = [*x.channels, "inline", "cross"]
    mapping = "\n".join(
        [
            "[time]",
            'column = "time"',
            'unit = "s"',
            "[columns]",
            *(f'{n} = {{ column = "{n}" }}' for n in names),
        ]
    )
    mapping += '\n[demodulator]\nkind = "causal"\norder = 3\ncutoff = "150 mHz"\n'
    read = read_flight(path, 9.8, mapping=parse_mapping(mapping, tmp_path / "mapping.toml"))
    assert read.demodulation == MADE["causal"][1]
    assert any("a causal Butterworth low-pass of order 3 at 0.15 Hz" in n for n in read.notes)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"kind": "chebyshev"}, "there is no such demodulator"),
        ({"kind": "causal", "cutoff": "0.2 Hz"}, "no order"),
        ({"kind": "average", "length": "4 s", "order": 2}, "order, which average does not have"),
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


def test_a_rate_that_is_no_multiple_is_told() -> None:
    with pytest.raises(UserError, match="not a multiple of the record's"):
        make_kernel(Demodulation(rate=10.0), 4.0)
