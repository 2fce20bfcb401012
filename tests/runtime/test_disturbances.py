"""Lines and jumps are no noise; and of noise alone nothing is taken."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.estimation.residual import describe_disturbances, find_disturbances
from ragg_runtime.estimation.spectrum import LOWEST, cut_lines, estimate

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
        assert np.array_equal(cut_lines(p[LOWEST:-1]), p[LOWEST:-1])
        assert find_disturbances(x, np.ones(N, dtype=bool), RATE) == []


@pytest.mark.parametrize("size", [1.0, 30.0, 1000.0])
def test_a_line_is_found_and_does_not_raise_the_noise(size: float) -> None:
    x = noise(3) + size * np.sin(2 * np.pi * 0.3712 * TIME + 0.4)
    (found,) = find_disturbances(x, np.ones(N, dtype=bool), RATE)[:1]
    assert found.kind == "line"
    assert found.at == pytest.approx(0.3712, abs=0.1 * RATE / N)
    assert found.size == pytest.approx(size, rel=0.1)
    assert estimate([x], RATE).rms == pytest.approx(estimate([noise(3)], RATE).rms, rel=0.06)


@pytest.mark.parametrize("size", [3.0, 100.0])
def test_a_jump_is_found_at_its_instant(size: float) -> None:
    x = noise(5, 1.0) + size * (TIME >= 400.0)
    (found,) = find_disturbances(x, np.ones(N, dtype=bool), RATE)
    assert (found.kind, round(found.at)) == ("jump", 400)
    assert "jumps at 400 s" in str(describe_disturbances([found]))
