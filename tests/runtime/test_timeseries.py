"""The derivative is right on motion in its band, at the ends and beside gaps too."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ragg_runtime.signals.derivative import WINDOW, differentiate, interpolate_even

RATE = 16.0


def band_limited(rng: np.random.Generator, t: np.ndarray, top: float) -> tuple[np.ndarray, np.ndarray]:
    """A sum of sines up to ``top`` Hz and its exact derivative."""
    f = rng.uniform(0.01, top, 40) * 2 * np.pi
    phase = rng.uniform(0, 2 * np.pi, 40)
    size = rng.normal(size=40)
    argument = np.outer(t, f) + phase
    return np.sin(argument) @ size, np.cos(argument) @ (size * f)


@pytest.mark.parametrize("share", [0.01, 0.1, 0.2, 0.3, 0.4])
def test_accuracy_on_sines(share: float) -> None:
    """The figures of the docstring, at every phase."""
    w = share * np.pi * RATE
    t = np.arange(200) / RATE
    phase = np.linspace(0, 2 * np.pi, 33)[:, None]
    error = np.abs(differentiate(np.sin(w * t + phase), RATE) - w * np.cos(w * t + phase)).max(axis=0) / w
    assert error[6:-6].max() < 1e-6
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
    assert gain[6:-6].max() < 1.3
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
