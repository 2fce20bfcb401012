"""Channels of another demodulator than ours: what the sheet or a mapping says of it is what the fit goes by."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import signal

from benchmarks.sheet import model_text
from ragg_runtime.base.errors import UserError
from ragg_runtime.identification.comparison import Comparison, compare
from ragg_runtime.instrument.demodulation import Demodulation, read_demodulation
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.io.mapping import parse_mapping
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.model.model import packaged
from ragg_runtime.model.record import kernel, record
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.signals.demodulate import low_pass

Array = NDArray[np.float64]
RATE = 16.0

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
    phi, k = 2 * np.pi * 0.25 * x.time, scale_factor(packaged(), vector(packaged(), s.sheet)) * 1e9
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
    return compare(packaged(), flown(trim)[0].sheet, [x])


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
    phi, k = 2 * np.pi * 0.25 * time, scale_factor(packaged(), vector(packaged(), s.sheet)) * 1e9
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
        kernel(Demodulation(rate=10.0), 4.0)
