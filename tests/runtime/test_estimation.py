"""Noise of short and of uneven records, its level, lines and jumps that are none; the minimiser finds minima and says if it has not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import optimize, signal
from scipy.linalg import toeplitz

from ragg_runtime.estimation import calibration, observation
from ragg_runtime.estimation.drifting_noise import DriftingNoise
from ragg_runtime.estimation.least_squares import SETTLED, VALLEY, Linear, is_settled, minimise
from ragg_runtime.estimation.noise import describe_disturbances, describe_level, estimate_level
from ragg_runtime.estimation.scores import log_sf_f
from ragg_runtime.estimation.spectrum import LOWEST, Stretch, cut_lines, estimate, find_lines, fit_columns
from ragg_runtime.estimation.unknown_gradient import make_splines
from ragg_runtime.io import Flight
from ragg_runtime.model import model
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.signals.fir import fill_gaps

Array = NDArray[np.float64]

RATE = 16.0
N, LONG = 4800, 10240
ALL = np.ones(N, dtype=bool)


def powers(count: int) -> Array:
    """(count, N): slow columns."""
    return np.linspace(-1.0, 1.0, N) ** np.arange(count)[:, None]


def mean_of(densities: list[Array]) -> Array:
    return np.asarray(np.exp(np.mean(np.log(densities), axis=0)))


# --- density, lines, jumps ---


def test_what_columns_take_of_the_noise_is_no_quiet() -> None:
    """White noise of a minute, fitted by 80 slow columns: its density below 1 Hz came out three times too small."""
    densities = []
    for rng in map(np.random.default_rng, range(12)):
        slow = np.fft.rfft(rng.normal(size=(80, 960)))
        slow[:, np.fft.rfftfreq(960, 1 / RATE) > 1.0] = 0.0
        flat = np.vstack([np.fft.irfft(slow, 960), rng.normal(size=960)])
        left = fit_columns(flat, np.ones(960, dtype=bool), RATE, None)
        assert left.rank == pytest.approx(80)
        densities.append(estimate([Stretch(left.rest, RATE, left.kept)]).psd(np.array([0.2, 0.5, 4.0])))
        blind = estimate([Stretch(left.rest, RATE)]).psd(np.array([0.5]))
    assert mean_of(densities) == pytest.approx(2 / RATE, rel=0.25)
    assert blind[0] < 0.5 * 2 / RATE


def test_noise_about_the_carrier_is_resolved() -> None:
    """Five times the density, 0.1 Hz wide, at twice the spin rate; where there is none the spectrum stays smooth."""
    f = np.fft.rfftfreq(9600, 1 / RATE)
    for size, expected in ((4.0, 5.0), (0.0, 1.0)):
        densities = []
        for seed in range(6):
            x = np.fft.rfft(np.random.default_rng(seed).normal(size=9600))
            x *= np.sqrt(1.0 + size * np.exp(-0.5 * ((f - 0.5) / 0.05) ** 2))
            spectrum = estimate([Stretch(np.fft.irfft(x, 9600)[:N], RATE)], spin=0.25)
            densities.append(spectrum.psd(np.array([0.5, 0.8])) * RATE / 2)
        assert mean_of(densities) == pytest.approx([expected, 1.0], rel=0.4)


def test_a_jump_to_which_slow_columns_bend_is_found() -> None:
    y = np.random.default_rng(5).normal(size=N) + 2.0 * (np.arange(N) / RATE >= 113.0)
    left = fit_columns(np.vstack([powers(9), y]), ALL, RATE, None)
    assert [d.kind for d in left.events] == ["jump"]
    assert left.events[0].at == pytest.approx(113.0, abs=1.0)
    assert np.std(left.rest) == pytest.approx(1.0, rel=0.05)
    assert "jumps at 113 s" in str(describe_disturbances(left.events))


def test_a_jump_beside_an_unknown_gradient_leaves_nothing_of_its_edge() -> None:
    """What was projected out of the data, not of the jump's own column, passed for further jumps and for noise."""
    time = np.arange(N) / RATE
    phase = np.pi * time  # twice the spin rate
    Q = np.linalg.qr(make_splines(time, np.cos(phase), np.sin(phase)).T)[0]

    def through(columns: Array) -> Array:
        return np.asarray(columns - (columns @ Q) @ Q.T)

    y = np.random.default_rng(6).normal(size=N) + 30.0 * (time >= 113.0)
    left = fit_columns(through(np.vstack([np.ones(N), y])), ALL, RATE, (0.44, 0.56), through)
    assert [(d.kind, d.at) for d in left.events] == [("jump", 113.0)]
    assert np.std(left.rest) == pytest.approx(1.0, rel=0.03)


def noise(seed: int, slope: float = 0.0) -> Array:
    f = np.fft.rfftfreq(LONG, 1 / RATE)
    shape = np.sqrt(1.0 + (slope > 0) * (0.05 / np.maximum(f, f[1])) ** slope)
    white = np.fft.rfft(np.random.default_rng(seed).standard_normal(LONG))
    return np.asarray(np.fft.irfft(white * shape, LONG))


@pytest.mark.parametrize("slope", [0.0, 1.0, 2.0])
def test_noise_is_left_as_it_is(slope: float) -> None:
    for seed in range(12):
        x = noise(seed, slope)
        p = signal.periodogram(x, RATE, window="hann", detrend="constant")[1][LOWEST:-1]
        assert np.array_equal(cut_lines(p), p)
        assert find_lines(x, RATE, None) == []
        if slope < 2.0:
            assert not fit_columns(np.stack([np.ones(LONG), x]), np.ones(LONG, dtype=bool), RATE, None).events


def test_a_gap_holds_what_the_noise_makes_most_likely() -> None:
    pole, n = 0.95, 400
    C = toeplitz(pole ** np.arange(n))
    x = np.linalg.cholesky(C) @ np.random.default_rng(4).normal(size=n)
    present = np.ones(n, dtype=bool)
    present[[20, 90, 91, *range(200, 230)]] = False
    filled = fill_gaps((x * present)[None], present, np.array([1.0, -pole, 0.0]))[0]
    best = C[np.ix_(~present, present)] @ np.linalg.solve(C[np.ix_(present, present)], x[present])
    assert filled[~present] == pytest.approx(best, abs=1e-6)
    np.testing.assert_array_equal(filled[present], x[present])


# --- the level ---


def quantities(rng: np.random.Generator) -> dict[str, Array]:
    force = np.abs(rng.normal(size=N))
    return {"time": np.arange(N) / RATE, "abs(a_x)": force, "phi": np.mod(np.arange(N) * 0.1, 2 * np.pi)}


def test_even_noise_has_no_level_even_if_its_tails_are_heavy() -> None:
    for seed in range(20):
        rng = np.random.default_rng(seed)
        x = quantities(rng)
        assert not estimate_level(rng.normal(size=N), x, {}).parts
        assert not estimate_level(rng.standard_t(3, size=N), x, {}).parts


@pytest.mark.parametrize("name", ["time", "abs(a_x)", "phi"])
def test_the_level_is_found_and_undone(name: str) -> None:
    rng = np.random.default_rng(7)
    x = quantities(rng)
    loud = {
        "time": np.where(x["time"] > 100.0, 10.0, 1.0),
        "abs(a_x)": 0.2 + x["abs(a_x)"],
        "phi": 1.0 + 0.8 * np.cos(2 * x["phi"]),
    }[name]
    level = estimate_level(loud * rng.normal(size=N), x, {})
    assert level.parts[0].name == name
    values = level.of(x.__getitem__)
    assert np.mean(values**2) == pytest.approx(1.0)
    assert np.std(values / loud) < 0.2 * np.mean(values / loud)
    assert "level changes" in str(describe_level(level))


def test_what_a_random_effect_explains_best_is_left_to_its_test() -> None:
    """Not so noise in proportion to the force along the input axes, or one, though the angle's jitter is louder where that is."""
    rng = np.random.default_rng(9)
    (x, y), phi = rng.normal(size=(2, N)), np.arange(N) * 0.1
    across, along = np.abs(y * np.cos(phi) - x * np.sin(phi)), np.abs(x * np.cos(phi) + y * np.sin(phi))
    terms = {**quantities(rng), "input-rms": np.hypot(x, y), "input": across + along}
    terms |= {"input(0)": across, "input(2)": along}
    jitter = (0.8 * along + 0.3 * across) ** 2
    both = np.hypot(0.2 + across, 0.2 + along)
    for loud, names in ((both, ("input-rms", "input")), (0.2 + along, ("input(2)",))):
        assert estimate_level(loud * rng.normal(size=N), terms, {"jitter": jitter}).parts[0].name in names
    few = quantities(rng)
    share = (few["abs(a_x)"] * np.cos(few["phi"])) ** 2
    assert not estimate_level(np.sqrt(0.1 + share) * rng.normal(size=N), few, {"jitter": share}).parts


@pytest.mark.parametrize(("ratio", "d1", "d2"), [(9.0, 2.0, 400.0), (1e4, 24.0, 4800.0), (3e6, 576.0, 1.2e5)])
def test_tails_beyond_all_floats_are_known(ratio: float, d1: float, d2: float) -> None:
    """Logarithm of the F distribution's tail, against the regularised incomplete beta function in 60 digits."""
    with mpmath.workdps(60):
        x = mpmath.mpf(d2) / (d2 + d1 * mpmath.mpf(ratio))
        expected = mpmath.log(mpmath.betainc(mpmath.mpf(d2) / 2, mpmath.mpf(d1) / 2, 0, x, regularized=True))
    assert log_sf_f(ratio, d1, d2) == pytest.approx(float(expected), rel=1e-3)


# --- of flights ---

SIZE = 4.0 * 1.6e-3  # V: four times the noise of a flight


def calibrated(
    further: Callable[[Flight], Array], duration: float, **options: bool
) -> calibration.Calibration:
    """The calibration of a flight whose output has this as well."""
    s = scenario(12, duration=duration, rate=RATE)
    flight = s.simulate().flight()
    flight = replace(flight, outputs={n: x + further(flight) for n, x in flight.outputs.items()})
    return calibration.fit(model.load_packaged(), s.sheet, [observation.observe(flight, s.sheet)], **options)


def test_where_all_samples_weigh_the_same_lines_are_noise() -> None:
    """Held against the floor alone, a fit down to the noise passed for one that lacks an effect, and a sheet that was off
    could not be widened: effects that are none took up what its parameters were held from.
    """
    c = calibrated(lambda x: np.sqrt(2.0) * SIZE * np.sin(2 * np.pi * 5.1 * x.time), 200.0, unweighted=True)
    assert c.noise[0].lines
    assert c.noise[0].spectra[0].rms < 0.6 * SIZE
    assert c.excess == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize("size", [0.04 * SIZE, 0.002 * SIZE])
def test_a_walk_that_is_slower_than_the_record_is_noise(size: float) -> None:
    """Most of its rms is of periods that no spectrum of the record shows; a weak one the columns of candidates take whole."""
    c = calibrated(lambda x: size * np.cumsum(np.random.default_rng(1).normal(size=len(x))), 320.0)
    assert c.excess == pytest.approx(1.0, abs=0.1)
    density = 2 / RATE * ((SIZE / 4) ** 2 + (size * RATE * 320 / (2 * np.pi)) ** 2)
    assert c.noise[0].spectra[0].psd(np.array([1 / 320])) == pytest.approx(density, rel=0.5)


@pytest.mark.parametrize("drifts", [True, False])
def test_white_noise_that_swells_upon_a_drift_is_told_from_other_noise_that_does(drifts: bool) -> None:
    """Of blue noise in proportion to |a_x| the level is divided out first; beside drifts that stay as they are it is of the white noise."""

    def loud(flight: Flight) -> Array:
        size = np.abs(flight.channels["a_x"])
        level = 0.2 + size / np.sqrt(np.mean(size**2))
        white, other = 0.1 * np.random.default_rng(2).normal(size=(2, len(flight)))
        drift = signal.lfilter([0.15], [1.0, -0.98], other)
        blue = signal.lfilter([1.0, -0.6], 1.0, white)
        return np.asarray(level * white + drift if drifts else level * blue)

    (noise,) = calibrated(loud, 200.0).noise
    assert [p.name for p in noise.level.parts] == ["abs(a_x)"]
    assert bool(noise.drifts) is drifts


def test_a_walk_beneath_uneven_noise_is_whitened_as_by_its_covariance() -> None:
    """Gaps and all, in two segments; and the transposed filter gives the products of whitened columns."""
    drift, rng = DriftingNoise(decay=0.999, power=0.01, white=0.5), np.random.default_rng(0)
    level, valid, columns = 1 + 2 * rng.random(400), np.arange(400) % 90 > 7, rng.normal(size=(3, 400))
    walk = drift.power / (1 - drift.decay**2) * drift.decay ** toeplitz(np.arange(400))
    factor = np.linalg.cholesky((walk + np.diag((drift.white * level) ** 2))[np.ix_(valid, valid)])
    early, past = drift.whiten(columns[:, :150], level[:150], valid[:150], None, 0)
    white = np.hstack([early, drift.whiten(columns[:, 150:], level[150:], valid[150:], past, 0)[0]])
    assert white[:, valid] == pytest.approx(np.linalg.solve(factor, columns[:, valid].T).T, abs=1e-10)
    assert drift.measure_log_size(level, valid) == pytest.approx(np.log(np.diag(factor)).sum())
    product = columns[1] @ drift.whiten_back(white[0] * valid, level, valid)
    assert product == pytest.approx(white[1, valid] @ white[0, valid])


def test_noise_of_a_narrow_band_is_known_though_one_sample_in_a_hundred_is_missing() -> None:
    """With zeros in their place its density above the band came out nine times as large."""

    def narrow(flight: Flight) -> Array:
        rng = np.random.default_rng(1)
        shape = 1 / (1 + (np.fft.rfftfreq(len(flight), 1 / RATE) / 3.0) ** 16)
        x = 0.16 * np.fft.irfft(np.fft.rfft(rng.normal(size=len(flight))) * np.sqrt(shape), len(flight))
        return np.where(rng.random(len(flight)) > 0.01, x, np.nan)

    low, high = calibrated(narrow, 150.0).noise[0].spectra[0].psd(np.array([1.0, 7.0]))
    assert low == pytest.approx(2 * 0.16**2 / RATE, rel=0.5)
    assert high < 2e-3 * low  # without gaps 1.1e-3


# --- the minimiser ---


def problem(residual: Callable[[Array], Array], costs: list[float]) -> Callable[[Array], Linear]:
    """A sum of squares as a linearised problem about a point, its Jacobian by differences."""

    def linearise(x: Array) -> Linear:
        r = residual(x)
        J = np.stack([(residual(x + h) - residual(x - h)) / 2e-6 for h in 1e-6 * np.eye(len(x))], axis=1)
        costs.append(float(r @ r))
        n = len(x) + 1
        rows = np.vstack([np.column_stack([J, -r]), np.zeros((n, n))])
        return Linear(np.linalg.qr(rows, mode="r"))

    return linearise


def make_linear(y: list[float], rest: float) -> Linear:
    """With the identity for R."""
    T = np.eye(len(y) + 1)
    T[:-1, -1], T[-1, -1] = y, np.sqrt(rest)
    return Linear(T)


def rosenbrock(x: Array) -> Array:
    return 30.0 * np.array([100.0 * (x[1] - x[0] ** 2), 1.0 - x[0], 0.3])


def wall(x: Array) -> Array:
    """A step that gains less than nothing counted as the last: fits ended far from their optimum."""
    return np.array([10.0 - x[0] + 3.0 * np.maximum(x[0] - 1.0, 0.0) ** 2, 0.1 * x[0]])


@pytest.mark.parametrize(
    ("residual", "start"), [(rosenbrock, [-1.2, 1.0]), (rosenbrock, [8.0, -5.0]), (wall, [0.0])]
)
def test_the_minimum_is_that_of_scipy_and_no_accepted_step_went_up(residual, start) -> None:
    costs: list[float] = []
    minimum = minimise(problem(residual, costs), np.array(start), most=400)
    best = min(
        float(2 * optimize.least_squares(residual, start, method=m, max_nfev=2000).cost)
        for m in ("lm", "trf")
    )
    assert minimum.converged
    assert minimum.at.cost <= best + (2 * SETTLED if residual is wall else VALLEY)
    assert minimum.at.cost <= costs[0]


def test_a_model_that_does_not_follow_its_slope_has_not_converged() -> None:
    minimum = minimise(lambda x: make_linear([5.0, 0.0], float(np.sum(np.abs(x)))), np.zeros(2))
    assert not minimum.converged
    assert "no step reduces the misfit" in minimum.reason
    assert not is_settled(minimum.at)


@pytest.mark.parametrize(("way", "trials"), [(1000, 22), (60, 60)])
def test_a_search_is_left_where_its_pace_would_not_bring_it_to_its_end(way: int, trials: int) -> None:
    seen: list[Array] = []

    def creeping(x: Array) -> Linear:
        seen.append(x)
        return make_linear([1e3 * max(0.0, 1.0 - len(seen) / way)], 1.0)

    assert minimise(creeping, np.zeros(1)).converged is (way == trials)
    assert len(seen) == pytest.approx(trials, abs=3)
