"""Spikes: single samples that no physics makes; steps, bursts and smooth motion are left alone."""

from __future__ import annotations

import numpy as np
import pytest

from ragg_runtime.plausibility.spikes import (
    CACHE,
    GLITCH,
    MEDIAN_OF_NORMAL,
    _distance,
    _distances,
    _off,
    _usual,
    glitches,
    spikes,
)

N = 9600
RNG = np.random.default_rng(3)
NOISE = RNG.standard_normal(N)
ALL = np.ones(N, dtype=bool)
TIME = np.arange(N) / 16
PLACES = np.sort(RNG.choice(np.arange(20, N - 20, 3), 96, replace=False))


def test_spikes_of_any_size_are_found_and_nothing_else() -> None:
    for size in (20.0, 1e3, 1e9):
        e = NOISE.copy()
        e[PLACES] += size * RNG.choice([-1.0, 1.0], len(PLACES))
        assert np.flatnonzero(spikes(e, ALL)).tolist() == PLACES.tolist()


@pytest.mark.parametrize(
    "residual",
    [
        NOISE,
        NOISE * (1 + 30 * (np.abs(TIME - 300) < 5)),  # a burst of turbulence
        NOISE + 1e4 * (TIME > 200),  # a step
        NOISE + 50 * np.sin(np.pi * TIME / 2) * (TIME > 200),  # a gain step
        1e3 * np.sin(np.pi * TIME) * (1 + TIME / 100) + NOISE,  # an effect far above the noise
        np.cumsum(NOISE),  # red noise
        np.round(NOISE),  # coarse quantisation
        np.clip(10 * np.sin(TIME), -9, 9) + 1e-3 * NOISE,  # saturation
        np.zeros(N),
    ],
    ids=["noise", "burst", "step", "gain-step", "effect", "red", "quantised", "saturated", "nothing"],
)
def test_what_is_no_spike(residual: np.ndarray) -> None:
    assert not spikes(residual, ALL).any()


def test_missing_samples_are_no_spikes_and_hide_none() -> None:
    valid = ALL.copy()
    valid[1000:1500] = False
    valid[PLACES[50]] = False
    e = np.where(valid, NOISE, np.nan)
    e[PLACES[60]] = 30.0
    e[1600] = -50.0
    assert np.flatnonzero(spikes(e, valid)).tolist() == sorted([PLACES[60], 1600])


def test_what_happens_too_often_is_the_signal() -> None:
    often = np.where(RNG.random(N) < 0.1, 100.0, NOISE)
    assert not spikes(often, ALL).any()


def test_glitches_of_smooth_motion_are_interpolated() -> None:
    smooth = np.sin(TIME) + 0.3 * np.sin(3.3 * TIME) + 0.05 * np.sin(2 * np.pi * 2.1 * TIME)
    x = smooth.copy()
    x[PLACES] += 50 * RNG.choice([-1.0, 1.0], len(PLACES))
    mask, mended = glitches(x, ALL)
    assert np.flatnonzero(mask).tolist() == PLACES.tolist()
    assert np.max(np.abs(mended - smooth)) < 0.1
    mask, same = glitches(smooth, ALL)
    assert not mask.any()
    assert same is smooth


def test_a_long_record_is_looked_at_in_parts() -> None:
    e = NOISE.copy()
    e[PLACES] += 1e3
    assert np.array_equal(spikes(e, ALL, part=1000), spikes(e, ALL))
    smooth = np.sin(TIME)
    smooth[PLACES] += 50
    whole, parts = glitches(smooth, ALL), glitches(smooth, ALL, part=1000)
    assert np.array_equal(whole[0], parts[0])
    assert parts[1] == pytest.approx(whole[1], abs=1e-9)


@pytest.mark.parametrize("n", [41, 64, 65, 300, 5000])
def test_what_is_far_off_is_told_as_by_the_median_itself(n: int) -> None:
    """Counting spares the median of a long record; ties, zeros and heavy tails make no difference."""
    draw, found = np.random.default_rng(n), 0
    for power in (0.5, 1.0, 3.0, 8.0):
        for kind in range(6):
            size = np.abs(draw.standard_normal(n)) ** power
            size[draw.integers(n, size=1 + n // 100)] *= 10 ** draw.uniform(0, 5)
            if kind in (1, 4):
                size[draw.integers(n, size=n // 2)] = 0.0
            size = np.round(size, 1) if kind > 2 else size
            limit = GLITCH / MEDIAN_OF_NORMAL
            at = np.flatnonzero(size > limit * np.median(size))
            expected = at[size[at] > limit * _usual(size, at)]
            assert _off(size).tolist() == expected.tolist()
            found += len(expected)
    assert found


def test_the_distance_of_some_samples_is_that_of_all() -> None:
    """Where a glitch was interpolated the distances beside it are made anew, to the bit; the ends are mirrored."""
    x = RNG.standard_normal(2 * CACHE + 100)
    every = _distances(x, np.arange(len(x)))
    assert np.array_equal(_distance(x), every)
    taps = np.array([1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0]) / 20.0
    mirrored = np.convolve(np.pad(x, 3, mode="reflect"), taps, "valid")
    np.testing.assert_allclose(every, np.abs(mirrored), rtol=0, atol=1e-14)
