"""Columns: what is no measurement (repeated values, spikes, glitches), resolution, stamps and their clock, slow channels."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.io.assemble import derive_acceleration
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, SPECIFIC_FORCE
from ragg_runtime.io.sampling import find_clock_steps, fit_even_clock, make_grid
from ragg_runtime.screening.readings import find_glitches, find_spikes, leave_out_glitches, leave_out_repeated
from ragg_runtime.signals.fir import find_step
from ragg_runtime.simulate import simulate_flight

N = 9600
RNG = np.random.default_rng(3)
NOISE = RNG.standard_normal(N)
ALL = np.ones(N, dtype=bool)
TIME = np.arange(N) / 16
PLACES = np.sort(RNG.choice(np.arange(20, N - 20, 3), 96, replace=False))
SMOOTH = np.sin(TIME) + 0.3 * np.sin(3.3 * TIME) + 0.05 * np.sin(2 * np.pi * 2.1 * TIME)
SLOPE = np.cos(TIME) + 0.99 * np.cos(3.3 * TIME) + 0.21 * np.pi * np.cos(2 * np.pi * 2.1 * TIME)


def screened(x: np.ndarray, name: str = "G_out") -> Flight:
    columns = {"outputs" if name == "G_out" else "channels": {name: x}}
    return leave_out_repeated(Flight(time=TIME[: len(x)], **{"channels": {}, "outputs": {}, **columns}))


@pytest.mark.parametrize(("every", "first"), [(2, 0), (160, 1)])
@pytest.mark.parametrize("how", ["repeated", "joined by straight lines"])
def test_values_between_the_recorded_ones_are_not_used(every: int, first: int, how: str) -> None:
    k = np.arange(first, N, every)
    x = SMOOTH[np.maximum((np.arange(N) - first) // every * every + first, 0)]
    if how != "repeated":
        x = np.round(np.interp(np.arange(N), k, SMOOTH[k]), 7)
    flight = screened(x)
    present = np.flatnonzero(np.isfinite(flight.outputs["G_out"]))
    assert set(present[1:-1]) <= set(k) and len(present) >= len(k) - 1
    assert flight.notes == (
        f"G_out: recorded every {every / 16:.4g} s and {how} in between; only recorded values are used",
    )


@pytest.mark.parametrize("every", [2, 3.2])
def test_rates_that_are_held_are_used_at_their_own_rate(every: float) -> None:
    """Where they do not come evenly their derivative is not known, and nothing is claimed of it."""
    k = np.rint(np.floor(np.arange(N) / every) * every).astype(int)
    columns = dict.fromkeys(ANGULAR_RATE, SMOOTH[k]) | dict.fromkeys(ANGULAR_ACCELERATION, SMOOTH[k])
    written, nowhere = dict.fromkeys(ANGULAR_RATE, "rad/s"), np.zeros(N, dtype=bool)
    valid = np.arange(N) % 500 != 250  # something else lacks
    flight = derive_acceleration(Flight(TIME, columns, {}, valid=valid, written=written, lacking=nowhere))
    thinned = leave_out_repeated(flight)
    (flag,) = thinned.flags
    wrong = thinned.channels["omegadot_x"] - np.interp(thinned.time, TIME, SLOPE)
    if every == 2:
        assert thinned.rate == pytest.approx(8) and thinned.valid.sum() == N // 2 - 2 * 64 - 19
        assert "recorded every 0.125 s" in flag.reason and not flag.open
        assert np.max(np.abs(wrong[thinned.valid])) < 1e-5
    else:
        assert "derived from it, is not known" in flag.reason and flag.open


def test_an_angular_acceleration_is_not_derived_across_a_gap() -> None:
    lacking = np.abs(TIME - 300) < 2
    x = np.interp(TIME, TIME[~lacking], SMOOTH[~lacking])
    channels = dict.fromkeys(ANGULAR_RATE, x) | dict.fromkeys(ANGULAR_ACCELERATION, x)
    written = dict.fromkeys(ANGULAR_RATE, "rad/s")
    flight = Flight(TIME, channels, {}, valid=~lacking, written=written, lacking=lacking)
    f = derive_acceleration(flight)
    wrong = (f.channels["omegadot_x"] - np.gradient(SMOOTH, TIME, edge_order=2))[1:-1][f.valid[1:-1]]
    near = np.abs(TIME[1:-1][f.valid[1:-1]] - 300) < 10
    assert np.max(np.abs(wrong[near])) < 1.1 * np.max(np.abs(wrong[~near]))


ANGLE = np.mod(2 * np.pi * 0.25 * TIME, 2 * np.pi)


@pytest.mark.parametrize(
    ("wrong", "lost"),
    [
        (ANGLE[np.arange(N) // 4 * 4], 0),
        (np.where((TIME > 100) & (TIME < 102), ANGLE[1601], ANGLE), 30),
        (np.where((TIME > 101) & (TIME < 102), 0.0, ANGLE), 15),
        (np.where(np.arange(N) % 97 == 5, 0.0, ANGLE), 99),
        (np.where(np.arange(N) == 5000, 1e4, ANGLE), 1),
        (np.round(ANGLE, 9), 0),
    ],
    ids=["held", "stuck", "zero", "zeros here and there", "spike", "as it is"],
)
def test_an_encoder_is_mended(wrong: np.ndarray, lost: int) -> None:
    flight = leave_out_glitches(screened(wrong, "spin_angle"))
    off = np.angle(np.exp(1j * (flight.channels["spin_angle"] - ANGLE)))
    assert np.max(np.abs(off)) <= 1e-9
    assert np.sum(~flight.valid) == pytest.approx(lost, abs=3)


@pytest.mark.parametrize("name", ["G_out", "a_x"])
@pytest.mark.parametrize(
    "x", [SMOOTH, np.round(SMOOTH, 2), NOISE, 2 + SMOOTH], ids=["smooth", "coarse", "noise", "at an end"]
)
def test_what_stands_still_is_left_out(name: str, x: np.ndarray) -> None:
    """A drop-out at an end of the range is no saturation, with a sample that lacks in it, too."""
    stuck = x.copy()
    stuck[1000:1032] = stuck[1000]
    stuck[5000:5006] = 0.0
    flight = screened(stuck, name)
    left_out = ~flight.valid if name == "a_x" else np.isnan(flight.outputs["G_out"])
    assert np.flatnonzero(left_out).tolist() == [*range(1000, 1032), *range(5000, 5006)]
    low = screened(np.where(TIME == 313, np.nan, np.where(np.abs(TIME - 313) < 2, 0.0, x - np.min(x) + 5)))
    assert np.sum(np.isnan(low.outputs["G_out"])) == 63
    assert "is stuck: 32 equal samples from 62.5 s, 6 equal samples from 312.5 s" in flight.notes[0]


def test_other_series_are_left_alone() -> None:
    for kind, x in {
        "smooth": SMOOTH,
        "coarse": np.round(SMOOTH, 1),
        "coarse and slow": np.round(np.sin(0.02 * TIME), 2),
        "coarse noise": np.round(NOISE),
        "saturated": np.clip(SMOOTH, -0.9, 0.9),
        "gaps": np.where(RNG.random(N) < 0.4, np.nan, SMOOTH),
        "still": np.zeros(N),
        "a ramp": np.arange(N) * 1.0,
    }.items():
        assert screened(x).flags == () and screened(x, "a_x").flags == (), kind


@pytest.mark.parametrize("step", [0.488e-3 * 9.80665, 1e-3, 3.3e-5])
def test_the_resolution_of_a_column_is_found_whatever_it_is(step: float) -> None:
    x = np.round(SMOOTH / step) * step + 0.013
    written = np.array([float(f"{v:.8g}") for v in x])
    for column in (x, written, np.where(ALL, x, np.nan)):
        assert find_step(column) == pytest.approx(step, rel=1e-4)
    for column in (SMOOTH, np.zeros(N), np.full(3, 1.0)):
        assert find_step(column) is None


def test_spikes_of_any_size_are_found_and_nothing_else() -> None:
    """Missing samples are none, and hide none."""
    valid = np.abs(np.arange(N) - 1250) > 250
    for size in (20.0, 1e9):
        e = np.where(valid, NOISE, np.nan)
        e[PLACES] += size * RNG.choice([-1.0, 1.0], len(PLACES))
        assert np.flatnonzero(find_spikes(e, valid)).tolist() == PLACES[valid[PLACES]].tolist()

    for kind, e in {
        "noise": NOISE,
        "burst": NOISE * (1 + 30 * (np.abs(TIME - 300) < 5)),
        "gain-step": NOISE + 50 * np.sin(np.pi * TIME / 2) * (TIME > 200),
        "red": np.cumsum(NOISE),
        "saturated": np.clip(10 * np.sin(TIME), -9, 9) + 1e-3 * NOISE,
        "often": np.where(RNG.random(N) < 0.1, 100.0, NOISE),
        "nothing": np.zeros(N),
    }.items():
        assert not find_spikes(e, ALL).any(), kind


def test_spikes_that_are_small_beside_the_motion_are_found_where_the_model_fails() -> None:
    """A bit of a converter that fell over: as far off its neighbours as the motion moves within a dozen samples."""
    suspects = np.isin(np.arange(N), PLACES)
    mask, mended = find_glitches(SMOOTH + 0.01 * suspects, ALL, suspects)
    assert np.array_equal(mask, suspects) and np.max(np.abs(mended - SMOOTH)) < 1e-4
    assert not find_glitches(SMOOTH, ALL, suspects)[0].any()


def test_spikes_are_found_beside_each_other_and_in_samples_that_are_not_used() -> None:
    """The angular acceleration is derived through them, and an effect of a slow channel would follow its spikes."""
    x = SMOOTH.copy()
    x[[500, 503, 507, 511, 2000, 2001]] += [30.0, 25.0, 20.0, -30.0, 28.0, 20.0]
    valid = ALL.copy()
    valid[[503, 3000]] = False
    channels = dict.fromkeys(ANGULAR_RATE, SMOOTH) | {
        "omega_x": x,
        "temperature": 290 + x,
        "vibration_rms": NOISE**2,
    }
    flight = Flight(TIME, channels, {}, valid=valid, written=dict.fromkeys(ANGULAR_RATE, "rad/s"))
    cleaned = leave_out_glitches(flight)
    assert [f.columns for f in cleaned.flags] == [("omega_x",), ("temperature",)]
    assert np.max(np.abs(cleaned.channels["omega_x"] - SMOOTH)) < 0.1
    assert np.max(np.abs(cleaned.channels["temperature"] - 290 - SMOOTH)) < 0.5
    slope = np.gradient(SMOOTH, TIME)
    assert np.max(np.abs(cleaned.channels["omegadot_x"] - slope)[cleaned.valid]) < 0.1 * np.max(np.abs(slope))


def test_readings_that_did_not_arrive_are_left_out() -> None:
    """All axes of a sensor, or one, repeat their values, or are zero; coarse axes do so by chance."""
    rng, lost = np.random.default_rng(8), np.arange(9, N, 50)
    for zero, at in ((0.0, lost), (1.0, lost), (0.0, np.r_[100:140, 300, 301, 600])):
        motion = rng.standard_normal((3, N))
        motion[:, at] = zero * motion[:, at - 1]
        flight = leave_out_repeated(Flight(TIME, dict(zip(SPECIFIC_FORCE, motion, strict=True)), {}))
        assert np.flatnonzero(~flight.valid).tolist() == at.tolist()
        assert at is not lost or "samples (t = 0.5625" in flight.flags[0].reason
    # two within as few samples as tell the usual, a part that is held at half the rate, a gap that was filled
    x, held = SMOOTH + 0.1 * NOISE, np.r_[100, 101, 130, 900, 3101:4001:2]
    x[held] = x[held - 1 - (held == 101)]
    x[[500, 3000, 3001]] = 0.0
    x[1000:3000:400] = 0.7  # a code within the range
    x[4999:5051] = np.linspace(x[4999], x[5050], 52).round(9)
    kept, gap = np.r_[5900:6000, 6040:6140], np.arange(6000, 6040)
    x[gap] = CubicSpline(kept, x[kept])(gap).round(9)
    flight = leave_out_repeated(Flight(TIME, {"a_y": x}, {}))
    lost = np.r_[500, 1000:3000:400, 3000, 3001, 5000:5050, gap]
    assert np.array_equal(np.flatnonzero(~flight.valid), np.union1d(held, lost))
    coarse = np.round(rng.standard_normal((3, N)))
    knots = np.r_[0, np.sort(rng.random(90)) * 599, 600]
    ramps = [np.interp(TIME, knots, rng.random(92)).round(9) for _ in "xyz"]
    ramps[0] = np.sin(np.pi / 4 * np.arange(N))  # planned, without noise
    for x in (coarse, 400 * coarse + np.arange(N) % 3 * 100, ramps):  # of the second no neighbours are equal
        assert leave_out_repeated(Flight(TIME, dict(zip(SPECIFIC_FORCE, x, strict=True)), {})).valid.all()


@pytest.mark.parametrize(
    ("rate", "start", "unit"),
    [(16, 12.0625, 0.001), (30, 0.0, 0.001), (128, 1.7e9, 0.001), (16, 0.0, 0.02), (16, 0.0, 1 / 60)],
)
def test_rounded_stamps_are_put_on_their_grid(rate: float, start: float, unit: float) -> None:
    true = start + np.arange(N) / rate
    for stamps in (np.round(true / unit) * unit, np.floor(np.round(true / unit, 6)) * unit):
        g = make_grid(stamps, None)
        assert np.max(np.abs(g.time - true)) < 1e-6
        assert f"rounded to {unit:g} s" in g.notes[0]


def test_stamps_rounded_to_most_of_a_step_are_no_gaps() -> None:
    bursts = (TIME // size * size + (TIME % size) * share for size, share in ((0.125, 0.48), (1.0, 0.02)))
    for stamps in (np.round(TIME / 0.05) * 0.05, *bursts):
        with pytest.raises(UserError, match=r"too coarse[^$]*16 Hz were rounded[^$]*rate = .16 Hz"):
            make_grid(stamps, None)
    lost = np.random.default_rng(4).random(N) > 0.1
    assert len(make_grid(TIME[lost], None).index) == np.sum(lost)


def test_stamps_that_are_too_coarse_are_no_doubled_rows() -> None:
    single = (1.77e9 + TIME).astype(np.float32).astype(float)
    for stamps, words in ((np.floor(TIME), "whole seconds"), (single, "single precision")):
        with pytest.raises(UserError, match="too coarse for the sampling rate") as caught:
            make_grid(stamps, None)
        message = str(caught.value)
        assert words in message and "count the rows: rate = " in message and "remove" not in message


@pytest.mark.parametrize(("size", "digits"), [(0.025, 3), (0.7, 9), (3.013, 3), (-0.025, 9)])
def test_a_step_of_the_clock_is_found_with_its_time(size: float, digits: int) -> None:
    g = make_grid(np.round(TIME + size * (TIME > 125), digits), None)
    valid = np.isin(np.arange(len(g.time)), g.index)
    (step,) = find_clock_steps(g.time, valid)
    assert step.size == pytest.approx(size, abs=1e-3) and abs(step.time - 125 - size) < 0.1
    assert fit_even_clock(g.time, valid)[1] == pytest.approx(1 / 16, rel=1e-7)


@pytest.mark.parametrize("rate", [5e-4, -5e-5])
def test_a_clock_that_was_slewed_is_found_with_its_times(rate: float) -> None:
    stamps = TIME + rate * np.clip(TIME - 200, 0, 100) + 0.02 * (TIME > 450)
    jump, slew = find_clock_steps(stamps, ALL)
    assert (slew.time, slew.ends) == pytest.approx((200, 300), abs=20) and " to " in str(slew)
    assert (slew.size, jump.size) == pytest.approx((100 * rate, 0.02), abs=1e-3)
    _, step, set_by = fit_even_clock(stamps, ALL)
    assert step == pytest.approx(1 / 16, rel=1e-9) and set_by[-1] == pytest.approx(
        100 * rate + 0.02, rel=1e-3
    )


def test_steps_that_cannot_be_followed_are_named_with_the_rate_between_them() -> None:
    two = r"by 0.025 s at t = 100[.\d]* s, by -0.06 s at t = 125[.\d]* s: was the clock [^$]*rate = .16 Hz"
    for stamps, said in (
        (TIME + 0.025 * (TIME > 100) - 0.06 * (TIME > 125), two),
        (TIME - 10.0 * (TIME > 125), r"jump back by 10 s at t = 125 s: was the clock adjusted"),
        (TIME + 36000.0 * (TIME >= 100), r"jump by 36000[.\d]* s at t = 99[.\d]* s: was the clock adjusted"),
    ):
        with pytest.raises(UserError, match=said):
            make_grid(stamps, None)


def test_jitter_and_pauses_are_no_steps() -> None:
    """Were each gap fitted as one, the jitter of the stamps beside it would change the rate."""
    kept = np.abs(np.arange(N) % 600 - 500) > 40
    for stamps in (TIME + 0.005 * RNG.uniform(-1, 1, N), TIME + 0.02 * (np.arange(N) == 777)):
        assert find_clock_steps(stamps, ALL) == []
    stamps = TIME + 1e-3 / 16 * NOISE
    assert fit_even_clock(stamps, kept)[1] == 1 / 16
    assert not any(c.part for c in find_clock_steps(stamps, kept))


@pytest.mark.parametrize(
    ("period", "low"), [(2.0**32 * 1e-6, 0.0), (2.0**32 * 1e-6, -0.5), (65.536, 0.0), (86400.0, 0.0)]
)
def test_a_counter_of_time_that_begins_anew_is_continued(period: float, low: float) -> None:
    g = make_grid(np.mod(TIME + period - 50.0, period) + low * period, None)
    assert np.allclose(g.time - g.time[0], TIME, atol=1e-6) and f"({period:.10g} s)" in g.notes[0]


# --- auxiliary channels of a lower rate; a record that lacks half of itself is none ---

G0 = 9.8


@pytest.fixture(scope="module")
def hot() -> Flight:
    return simulate_flight(api.example(), [], seed=4, duration=400.0, rate=8.0)


def rarely(flight: Flight, every: int, names: tuple[str, ...], path: Path) -> Path:
    """The flight with some channels recorded at a lower rate."""
    kept = np.arange(len(flight)) % every == 0
    channels = {n: np.where(kept, v, np.nan) if n in names else v for n, v in flight.channels.items()}
    write_flight(replace(flight, channels=channels), path)
    return path


def test_a_thermometer_read_every_ten_seconds_is_interpolated(hot: Flight, tmp_path: Path) -> None:
    """It dropped all samples but one in eighty, and acquitted the model."""
    read = read_flight(rarely(hot, 80, ("temperature",), tmp_path / "slow.parquet"), G0)
    assert np.flatnonzero(~read.valid).tolist() == list(range(3121, 3200)), "after the last value"
    assert any("temperature: recorded every 10 s; interpolated" in n for n in read.notes)
    temperature = hot.channels["temperature"]
    assert np.max(np.abs(read.channels["temperature"] - temperature)[:3121]) < 0.01 * np.ptp(temperature)


@pytest.mark.parametrize("noise", [0.0, 0.05])
def test_a_thermometer_of_coarse_steps_is_interpolated_between_them(noise, hot, tmp_path) -> None:
    """thermal-scale of 54 sigma was gain-drift and gain-step where temperatures had steps of 0.1 K."""
    temperature, rng = hot.channels["temperature"], np.random.default_rng(2)
    read = 0.0625 * np.round((temperature + 0.0625 * noise * rng.standard_normal(len(hot))) / 0.0625)
    switch = np.where(hot.time > 200.0, 1.0, 0.0)
    channels = {**hot.channels, "temperature": read, "pressure": switch}
    write_flight(replace(hot, channels=channels), tmp_path / "coarse.csv")
    flight = read_flight(tmp_path / "coarse.csv", G0)
    assert "temperature: recorded in steps of 0.0625 K; interpolated between them" in flight.notes
    assert np.std(flight.channels["temperature"] - temperature) < 0.55 * np.std(read - temperature)
    assert np.array_equal(flight.channels["pressure"], switch)


def test_what_changes_faster_than_it_was_recorded_is_left_out(hot: Flight, tmp_path: Path) -> None:
    fast = {**hot.channels, "B_x": np.random.default_rng(1).normal(size=len(hot)), "pressure": hot.time * 0.0}
    flight = replace(hot, channels=fast)
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
    write_flight(replace(hot, channels=channels, outputs=outputs), path)
    with pytest.raises(UserError, match="most samples of the flight are incomplete") as refused:
        read_flight(path, G0)
    assert f"{name}: without a value" in refused.value.message


def test_a_slow_channel_that_ends_early_does_not_take_the_record_with_it(hot: Flight, tmp_path: Path) -> None:
    short = np.where(hot.time < 150.0, hot.channels["temperature"], np.nan)
    flight = replace(hot, channels={**hot.channels, "temperature": short})
    read = read_flight(rarely(flight, 80, ("temperature",), tmp_path / "short.parquet"), G0)
    assert read.valid.all()
    assert any("temperature" in n and "cover 140 s of 399.9 s" in n for n in read.notes)
