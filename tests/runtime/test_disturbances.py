"""Lines, jumps and bursts are no noise; and of noise alone nothing is taken."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.fit import bursts
from ragg_runtime.fit.bursts import quiet_estimate
from ragg_runtime.fit.disturbances import disturbances, in_words
from ragg_runtime.signals.noise_spectrum import LOWEST, estimate, without_lines

RATE = 16.0
N = 10240
TIME = np.arange(N) / RATE

Array = NDArray[np.float64]


def noise(seed: int, slope: float = 0.0) -> Array:
    f = np.fft.rfftfreq(N, 1 / RATE)
    shape = np.sqrt(1.0 + (slope > 0) * (0.05 / np.maximum(f, f[1])) ** slope)
    return np.asarray(np.fft.irfft(np.fft.rfft(np.random.default_rng(seed).standard_normal(N)) * shape, N))


@pytest.mark.parametrize("slope", [0.0, 1.0, 2.0])
def test_noise_is_left_as_it_is(slope: float) -> None:
    for seed in range(12):
        x = noise(seed, slope)
        _, p = signal.periodogram(x, RATE, window="hann", detrend="constant")
        assert np.array_equal(without_lines(p[LOWEST:-1]), p[LOWEST:-1])
        assert disturbances(x, np.ones(N, dtype=bool), RATE) == []
        plain, (found, _) = estimate([x], RATE), quiet_estimate([x], RATE)
        assert np.array_equal(plain.log_psd, found.log_psd)


@pytest.mark.parametrize("size", [1.0, 30.0, 1000.0])
def test_a_line_is_found_and_does_not_raise_the_noise(size: float) -> None:
    x = noise(3) + size * np.sin(2 * np.pi * 0.3712 * TIME + 0.4)
    (found,) = disturbances(x, np.ones(N, dtype=bool), RATE)[:1]
    assert found.kind == "line"
    assert found.at == pytest.approx(0.3712, abs=0.1 * RATE / N)
    assert found.size == pytest.approx(size, rel=0.1)
    assert estimate([x], RATE).rms == pytest.approx(estimate([noise(3)], RATE).rms, rel=0.06)


@pytest.mark.parametrize("size", [3.0, 100.0])
def test_a_jump_is_found_at_its_instant(size: float) -> None:
    x = noise(5, 1.0) + size * (TIME >= 400.0)
    (found,) = disturbances(x, np.ones(N, dtype=bool), RATE)
    assert (found.kind, round(found.at)) == ("jump", 400)
    assert "jumps at 400 s" in str(in_words([found]))


def test_a_burst_is_left_out_and_named_but_not_noise_that_changes_its_level() -> None:
    x = noise(6)
    loud = np.where((TIME > 300) & (TIME < 330), 20.0, 1.0)
    model, (found,) = quiet_estimate([x * loud], RATE)
    assert model.rms == pytest.approx(estimate([x], RATE).rms, rel=0.05)
    assert min(b.start for b in found) / RATE == pytest.approx(300, abs=15)
    assert max(b.stop for b in found) / RATE == pytest.approx(330, abs=15)
    said = bursts.in_words([(b.start, b.stop, b.factor) for b in found], TIME)
    assert said is not None
    assert "far noisier" in said
    half = np.where(TIME > 320, 10.0, 1.0)
    model, (none,) = quiet_estimate([x * half], RATE)
    assert none == []
    assert model.rms == pytest.approx(np.std(x * half), rel=0.1)
