"""Noise of short and of uneven records, its level, lines and jumps that are none; and of noise alone nothing is taken."""

from __future__ import annotations

from dataclasses import replace

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import signal
from scipy.linalg import toeplitz

from ragg_runtime.estimation import calibration, observation
from ragg_runtime.estimation.noise import describe_level, estimate_level
from ragg_runtime.estimation.residual import describe_disturbances, find_lines, fit_columns
from ragg_runtime.estimation.scores import log_sf, log_sf_f, log_sf_t
from ragg_runtime.estimation.spectrum import LOWEST, Stretch, cut_lines, estimate
from ragg_runtime.estimation.unknown_gradient import make_splines
from ragg_runtime.model import model
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.signals.fir import fill_gaps

Array = NDArray[np.float64]

RATE = 16.0


def slow_columns(n: int, count: int, rng: np.random.Generator) -> Array:
    """(count, n): random series below 1 Hz."""
    x = np.fft.rfft(rng.normal(size=(count, n)))
    x[:, np.fft.rfftfreq(n, 1 / RATE) > 1.0] = 0.0
    return np.fft.irfft(x, n)


def test_what_columns_take_of_the_noise_is_no_quiet() -> None:
    """White noise of a minute, fitted by 80 slow columns: its density below 1 Hz came out three times too small."""
    found = []
    valid = np.ones(960, dtype=bool)
    for seed in range(12):
        rng = np.random.default_rng(seed)
        flat = np.vstack([slow_columns(960, 80, rng), rng.normal(size=960)])
        left = fit_columns(flat, valid, RATE, None)
        assert left.rank == pytest.approx(80)
        found.append(estimate([Stretch(left.rest, RATE, left.kept)]).psd(np.array([0.2, 0.5, 4.0])))
        blind = estimate([Stretch(left.rest, RATE)]).psd(np.array([0.5]))
    assert np.exp(np.mean(np.log(found), axis=0)) == pytest.approx(2 / RATE, rel=0.25)
    assert blind[0] < 0.5 * 2 / RATE


def test_a_jump_to_which_slow_columns_bend_is_found() -> None:
    size = 2.0
    rng = np.random.default_rng(5)
    n = 4800
    time = np.arange(n) / RATE
    powers = np.linspace(-1.0, 1.0, n) ** np.arange(9)[:, None]
    y = rng.normal(size=n) + size * (time >= 113.0)
    left = fit_columns(np.vstack([powers, y]), np.ones(n, dtype=bool), RATE, None)
    assert [d.kind for d in left.found] == ["jump"]
    assert left.found[0].at == pytest.approx(113.0, abs=2.0 / size)
    assert np.std(left.rest) == pytest.approx(1.0, rel=0.05)
    assert "jumps at 113 s" in str(describe_disturbances(left.found))


def test_where_all_samples_weigh_the_same_lines_are_noise() -> None:
    """Held against the floor alone, a fit down to the noise passed for one that lacks an effect, and a sheet that was off
    could not be widened: effects that are none took up what its parameters were held from.
    """
    s = scenario(12, duration=320.0, rate=RATE)
    flight = s.simulate().flight()
    time, rms = flight.time, 4.0 * 1.6e-3
    further = np.sqrt(2.0) * rms * np.sin(2 * np.pi * 5.1 * time)
    flight = replace(flight, outputs={n: x + further for n, x in flight.outputs.items()})
    o = observation.observe(flight, s.sheet)
    c = calibration.fit(model.load_packaged(), s.sheet, [o], unweighted=True)
    (noise,) = c.noise
    assert noise.lines
    assert noise.spectra[0].rms < 0.6 * rms
    assert c.excess == pytest.approx(1.0, abs=0.15)


def test_a_jump_beside_an_unknown_gradient_leaves_nothing_of_its_edge() -> None:
    """What was projected out of the data, not of the jump's own column, passed for further jumps and for noise."""
    rng = np.random.default_rng(6)
    n = 4800
    time = np.arange(n) / RATE
    phase = np.pi * time  # twice the spin rate
    Q = np.linalg.qr(make_splines(time, np.cos(phase), np.sin(phase)).T)[0]

    def through(columns: Array) -> Array:
        return np.asarray(columns - (columns @ Q) @ Q.T)

    flat = through(np.vstack([np.ones(n), rng.normal(size=n) + 30.0 * (time >= 113.0)]))
    left = fit_columns(flat, np.ones(n, dtype=bool), RATE, (0.44, 0.56), through)
    assert [(d.kind, d.at) for d in left.found] == [("jump", 113.0)]
    assert np.std(left.rest) == pytest.approx(1.0, rel=0.03)


def quantities(n: int, rng: np.random.Generator) -> dict[str, Array]:
    return {
        "time": np.arange(n) / RATE,
        "abs(a_x)": np.abs(rng.normal(size=n)),
        "phi": np.mod(np.arange(n) * 0.1, 2 * np.pi),
    }


def test_even_noise_has_no_level_even_if_its_tails_are_heavy() -> None:
    for seed in range(20):
        rng = np.random.default_rng(seed)
        x = quantities(4800, rng)
        assert not estimate_level(rng.normal(size=4800), x, {}).parts
        assert not estimate_level(rng.standard_t(3, size=4800), x, {}).parts


@pytest.mark.parametrize("name", ["time", "abs(a_x)", "phi"])
def test_the_level_is_found_and_undone(name: str) -> None:
    rng = np.random.default_rng(7)
    x = quantities(4800, rng)
    loud = {
        "time": np.where(x["time"] > 100.0, 10.0, 1.0),
        "abs(a_x)": 0.2 + x["abs(a_x)"],
        "phi": 1.0 + 0.8 * np.cos(2 * x["phi"]),
    }[name]
    level = estimate_level(loud * rng.normal(size=4800), x, {})
    assert level.parts[0].name == name
    found = level.of(x.__getitem__)
    assert np.mean(found**2) == pytest.approx(1.0)
    ratio = found / loud
    assert np.std(ratio) < 0.2 * np.mean(ratio)
    said = describe_level(level)
    assert said is not None and "level changes" in said


def test_what_a_random_effect_explains_best_is_left_to_its_test() -> None:
    rng = np.random.default_rng(8)
    x = quantities(4800, rng)
    share = (x["abs(a_x)"] * np.cos(x["phi"])) ** 2
    assert not estimate_level(np.sqrt(0.1 + share) * rng.normal(size=4800), x, {"jitter": share}).parts


def test_few_degrees_of_freedom_have_heavier_tails() -> None:
    assert log_sf(25.0, 1, 50.0) > log_sf(25.0, 1) + 1.0
    assert log_sf(25.0, 1, 1e9) == pytest.approx(log_sf(25.0, 1), rel=1e-6)
    assert log_sf_t(5.0, 40.0) == pytest.approx(np.log(5.9e-6), abs=0.1)
    assert log_sf_t(5.0, np.inf) == pytest.approx(np.log(2.87e-7), abs=0.01)


@pytest.mark.parametrize(("ratio", "d1", "d2"), [(9.0, 2.0, 400.0), (1e4, 24.0, 4800.0), (3e6, 576.0, 1.2e5)])
def test_tails_beyond_all_floats_are_known(ratio: float, d1: float, d2: float) -> None:
    """Logarithm of the F distribution's tail, against the regularised incomplete beta function in 60 digits."""
    with mpmath.workdps(60):
        x = mpmath.mpf(d2) / (d2 + d1 * mpmath.mpf(ratio))
        expected = mpmath.log(mpmath.betainc(mpmath.mpf(d2) / 2, mpmath.mpf(d1) / 2, 0, x, regularized=True))
    assert log_sf_f(ratio, d1, d2) == pytest.approx(float(expected), rel=1e-3)


def test_noise_in_proportion_to_a_force_is_no_random_effect() -> None:
    """Its level follows the force along the input axes, or along one; the angle's jitter, louder where that is, explains no more."""
    rng = np.random.default_rng(9)
    force, phi = rng.normal(size=(2, 4800)), np.arange(4800) * 0.1
    across = np.abs(force[1] * np.cos(phi) - force[0] * np.sin(phi))
    along = np.abs(force[0] * np.cos(phi) + force[1] * np.sin(phi))
    x = {**quantities(4800, rng), "input-rms": np.hypot(*force), "input": across + along}
    x |= {"input(0)": across, "input(2)": along}
    jitter = (0.8 * along + 0.3 * across) ** 2
    for loud, names in (
        (np.hypot(0.2 + across, 0.2 + along), ("input-rms", "input")),
        (0.2 + along, ("input(2)",)),
    ):
        level = estimate_level(loud * rng.normal(size=4800), x, {"jitter": jitter})
        assert level.parts[0].name in names


def test_noise_about_the_carrier_is_resolved() -> None:
    """Five times the density, 0.1 Hz wide, at twice the spin rate; where there is none the spectrum stays smooth."""
    f = np.fft.rfftfreq(9600, 1 / RATE)
    for size, expected in ((4.0, 5.0), (0.0, 1.0)):
        found = []
        for seed in range(6):
            x = np.fft.rfft(np.random.default_rng(seed).normal(size=9600))
            x *= np.sqrt(1.0 + size * np.exp(-0.5 * ((f - 0.5) / 0.05) ** 2))
            model = estimate([Stretch(np.fft.irfft(x, 9600)[:4800], RATE)], spin=0.25)
            found.append(model.psd(np.array([0.5, 0.8])) * RATE / 2)
        assert np.exp(np.mean(np.log(found), axis=0)) == pytest.approx([expected, 1.0], rel=0.4)


def test_what_slow_columns_take_of_red_noise_is_known() -> None:
    """A random walk, fitted by eight slow columns: of its density at 1/50 Hz a third was left without a word."""
    found, blind = [], []
    for seed in range(20):
        rng = np.random.default_rng(seed)
        walk = rng.normal(size=4800) + 0.03 * np.cumsum(rng.normal(size=4800))
        left = fit_columns(
            np.vstack([np.linspace(-1.0, 1.0, 4800) ** np.arange(8)[:, None], walk]),
            np.ones(4800, dtype=bool),
            RATE,
            None,
        )
        model = estimate([Stretch(left.rest, RATE, left.kept)])
        blind.append(model.psd(np.array([0.01])))
        for _ in range(3):
            model = estimate([Stretch(left.rest, RATE, left.kept_of(model))])
        found.append(model.psd(np.array([0.01])))
    true = 2 / RATE * (1.0 + (0.03 * RATE / (2 * np.pi * 0.01)) ** 2)
    assert np.exp(np.mean(np.log(found))) == pytest.approx(true, rel=0.35)
    assert np.mean(np.log(blind)) < np.mean(np.log(found))


def test_a_walk_that_is_slower_than_the_record_is_noise() -> None:
    """Most of its rms is of periods that no spectrum of the record shows: it is no reason to weigh all samples alike."""
    s = scenario(12, duration=320.0, rate=RATE)
    flight = s.simulate().flight()
    walk = np.cumsum(np.random.default_rng(1).normal(size=len(flight.time))) * 4.0 * 1.6e-3 * 0.04
    flight = replace(flight, outputs={n: x + walk for n, x in flight.outputs.items()})
    c = calibration.fit(model.load_packaged(), s.sheet, [observation.observe(flight, s.sheet)])
    assert c.excess == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize("swells", [True, False])
def test_noise_that_swells_is_told_from_white_noise_that_does(swells: bool) -> None:
    """Of drifting noise in proportion to |a_x| the level is divided out first; beside drifts that stay as they are, after the filter."""
    s = scenario(12, duration=200.0, rate=RATE)
    flight = s.simulate().flight()
    size = np.abs(flight.channels["a_x"])
    level = 0.2 + size / np.sqrt(np.mean(size**2))
    white, other = 0.1 * np.random.default_rng(2).normal(size=(2, len(flight)))
    drift = signal.lfilter([0.15], [1.0, -0.98], other)
    noise = level * (white + drift) if swells else level * white + drift
    flight = replace(flight, outputs={n: x + noise for n, x in flight.outputs.items()})
    c = calibration.fit(model.load_packaged(), s.sheet, [observation.observe(flight, s.sheet)])
    assert [p.name for p in c.noise[0].level.parts] == ["abs(a_x)"]
    assert c.noise[0].level_first is swells


LONG = 10240
LONG_TIME = np.arange(LONG) / RATE


def noise(seed: int, slope: float = 0.0) -> Array:
    f = np.fft.rfftfreq(LONG, 1 / RATE)
    shape = np.sqrt(1.0 + (slope > 0) * (0.05 / np.maximum(f, f[1])) ** slope)
    return np.asarray(
        np.fft.irfft(np.fft.rfft(np.random.default_rng(seed).standard_normal(LONG)) * shape, LONG)
    )


@pytest.mark.parametrize("slope", [0.0, 1.0, 2.0])
def test_noise_is_left_as_it_is(slope: float) -> None:
    for seed in range(12):
        x = noise(seed, slope)
        _, p = signal.periodogram(x, RATE, window="hann", detrend="constant")
        assert np.array_equal(cut_lines(p[LOWEST:-1]), p[LOWEST:-1])
        assert find_lines(x, RATE, None) == []
        if slope < 2.0:
            assert not fit_columns(np.stack([np.ones(LONG), x]), np.ones(LONG, dtype=bool), RATE, None).found


@pytest.mark.parametrize("size", [1.0, 30.0, 1000.0])
def test_a_line_is_found_and_does_not_raise_the_noise(size: float) -> None:
    x = noise(3) + size * np.sin(2 * np.pi * 0.3712 * LONG_TIME + 0.4)
    found = find_lines(x, RATE, None)[0]
    assert found.kind == "line"
    assert found.at == pytest.approx(0.3712, abs=0.1 * RATE / LONG)
    shapes = fit_columns(np.stack([np.ones(LONG), x]), np.ones(LONG, dtype=bool), RATE, None).shapes
    assert np.std(np.sum(shapes, axis=0)) == pytest.approx(size / np.sqrt(2.0), rel=0.1)
    assert estimate([Stretch(x, RATE)]).rms == pytest.approx(
        estimate([Stretch(noise(3), RATE)]).rms, rel=0.06
    )


def test_a_gap_holds_what_the_noise_makes_most_likely() -> None:
    pole, n = 0.95, 400
    C = toeplitz(pole ** np.arange(n))
    x = np.linalg.cholesky(C) @ np.random.default_rng(4).normal(size=n)
    there = np.ones(n, dtype=bool)
    there[[20, 90, 91, *range(200, 230)]] = False
    filled = fill_gaps((x * there)[None], there, np.array([1.0, -pole, 0.0]))[0]
    best = C[np.ix_(~there, there)] @ np.linalg.solve(C[np.ix_(there, there)], x[there])
    assert filled[~there] == pytest.approx(best, abs=1e-6)
    np.testing.assert_array_equal(filled[there], x[there])


def test_noise_of_a_narrow_band_is_known_though_one_sample_in_a_hundred_is_missing() -> None:
    """With zeros in their place its density above the band came out nine times as large."""
    s = scenario(12, duration=150.0, rate=RATE)
    flight = s.simulate().flight()
    rng = np.random.default_rng(1)
    f = np.fft.rfftfreq(len(flight), 1 / RATE)
    shape = 1 / (1 + (f / 3.0) ** 16)
    noise = 0.16 * np.fft.irfft(np.fft.rfft(rng.normal(size=len(flight))) * np.sqrt(shape), len(flight))
    there = rng.random(len(flight)) > 0.01
    outputs = {n: np.where(there, x + noise, np.nan) for n, x in flight.outputs.items()}
    c = calibration.fit(
        model.load_packaged(), s.sheet, [observation.observe(replace(flight, outputs=outputs), s.sheet)]
    )
    low, high = c.noise[0].spectra[0].psd(np.array([1.0, 7.0]))
    assert low == pytest.approx(2 * 0.16**2 / RATE, rel=0.5)
    assert high < 2e-3 * low  # without gaps 1.1e-3
