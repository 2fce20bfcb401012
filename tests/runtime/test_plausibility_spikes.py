"""Spikes: single samples that no physics makes; steps, bursts and smooth motion are left alone."""

from __future__ import annotations

import numpy as np
import pytest

from ragg_runtime.screening.spikes import (
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
