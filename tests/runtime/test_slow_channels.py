"""Auxiliary channels of a lower rate are interpolated or left out, said; a record that lacks half of itself is none."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.io.assemble import BRIDGED_STEPS, interpolate_slow
from ragg_runtime.simulate import simulate_flight

G0 = 9.8


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> api.Loaded:
    return api.new(tmp_path_factory.mktemp("slow") / "model")


@pytest.fixture(scope="module")
def hot(model: api.Loaded) -> Flight:
    return simulate_flight(model.instrument, [], seed=4, duration=400.0, rate=8.0)


def rarely(flight: Flight, every: int, names: tuple[str, ...], path: Path) -> Path:
    """The flight with some channels recorded at a lower rate."""
    kept = np.arange(len(flight)) % every == 0
    channels = {n: np.where(kept, v, np.nan) if n in names else v for n, v in flight.channels.items()}
    write_flight(dataclasses.replace(flight, channels=channels), path)
    return path


def test_a_thermometer_read_every_ten_seconds_is_interpolated(model, hot, tmp_path) -> None:
    """It dropped all samples but one in eighty, and acquitted the model."""
    path = rarely(hot, 80, ("temperature",), tmp_path / "slow.parquet")
    (read,) = api.read_flights(model, [path])
    assert np.flatnonzero(~read.valid).tolist() == list(range(3121, 3200)), "after the last value"
    assert any("temperature: recorded every 10 s; interpolated" in n for n in read.notes)
    known = hot.channels["temperature"]
    assert np.max(np.abs(read.channels["temperature"] - known)[:3121]) < 0.01 * np.ptp(known)


@pytest.mark.parametrize("noise", [0.0, 0.05])
def test_a_thermometer_of_coarse_steps_is_interpolated_between_them(noise, hot, tmp_path) -> None:
    """thermal-scale of 54 sigma was gain-drift and gain-step where temperatures had steps of 0.1 K."""
    known, rng = hot.channels["temperature"], np.random.default_rng(2)
    read = 0.0625 * np.round((known + 0.0625 * noise * rng.standard_normal(len(hot))) / 0.0625)
    switch = np.where(hot.time > 200.0, 1.0, 0.0)
    channels = {**hot.channels, "temperature": read, "pressure": switch}
    write_flight(dataclasses.replace(hot, channels=channels), tmp_path / "coarse.csv")
    found = read_flight(tmp_path / "coarse.csv", G0)
    assert "temperature: recorded in steps of 0.0625 K; interpolated between them" in found.notes
    assert np.std(found.channels["temperature"] - known) < 0.55 * np.std(read - known)
    assert np.array_equal(found.channels["pressure"], switch)


def test_what_changes_faster_than_it_was_recorded_is_left_out(hot: Flight, tmp_path: Path) -> None:
    fast = {**hot.channels, "B_x": np.random.default_rng(1).normal(size=len(hot)), "pressure": hot.time * 0.0}
    flight = dataclasses.replace(hot, channels=fast)
    read = read_flight(rarely(flight, 40, ("B_x", "pressure"), tmp_path / "fast.parquet"), G0)
    assert np.flatnonzero(~read.valid).tolist() == list(range(3161, 3200))
    assert "B_x" not in read.channels
    assert np.all(read.channels["pressure"] == 0.0)
    assert any("B_x" in n and "left out: it changes too fast" in n for n in read.notes)


@pytest.mark.parametrize("name", ["omega_z", "G_out"])
def test_a_record_that_lacks_half_of_its_samples_is_refused(name: str, hot: Flight, tmp_path: Path) -> None:
    kept = np.arange(len(hot)) % 3 == 0
    channels = {n: np.where(kept, v, np.nan) if n == name else v for n, v in hot.channels.items()}
    outputs = {n: np.where(kept, v, np.nan) if n == name else v for n, v in hot.outputs.items()}
    path = tmp_path / "half.parquet"
    write_flight(dataclasses.replace(hot, channels=channels, outputs=outputs), path)
    with pytest.raises(UserError, match="most samples of the flight are incomplete") as refused:
        read_flight(path, G0)
    assert f"{name}: without a value" in refused.value.message


def test_judgement() -> None:
    t = np.arange(0.0, 1000.0, 10.0)
    fine = np.arange(0.0, 989.0, 0.5)
    slow = interpolate_slow(t, 290 + np.sin(2 * np.pi * t / 400), fine)
    assert np.max(np.abs(slow - 290 - np.sin(2 * np.pi * fine / 400))) < 0.01
    assert "fast" in str(interpolate_slow(t, np.sin(2 * np.pi * t / 30), fine))
    assert "3 values" in str(interpolate_slow(t[:3], t[:3], fine))
    holes = np.r_[t[:40], t[44:]]  # one gap of five steps
    at = np.array([-1.0, 0.0, 390.0, 395.0, 400.0, 425.0, 440.0, 990.0, 991.0])
    slow = interpolate_slow(holes, 290 + holes / 1e3, at)
    assert np.isnan(slow).tolist() == [True, False, False, True, True, True, False, False, True]
    assert BRIDGED_STEPS < 5


def test_a_slow_channel_that_ends_early_does_not_take_the_record_with_it(hot: Flight, tmp_path: Path) -> None:
    short = np.where(hot.time < 150.0, hot.channels["temperature"], np.nan)
    flight = dataclasses.replace(hot, channels={**hot.channels, "temperature": short})
    read = read_flight(rarely(flight, 80, ("temperature",), tmp_path / "short.parquet"), G0)
    assert read.valid.all()
    assert any("temperature" in n and "cover 140 s of 399.9 s" in n for n in read.notes)
