"""Signals: value and derivative belong together, at any instant and any shift."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference.motion import RecordedSignal, Signal, Sinusoids, recorded_motion

ENVELOPE = Sinusoids(1.0, [0.5], [0.02], [0.3])
SIGNALS: dict[str, Signal] = {
    "sinusoids": Sinusoids(0.7, [1.0, 0.4, 0.2], [0.11, 0.63, 1.2], [0.1, 2.0, 4.0]),
    "bursts": Sinusoids(-0.2, [1.0, 0.3], [0.31, 0.9], [0.1, 1.0], ENVELOPE),
    "recorded": RecordedSignal(
        np.arange(400) / 8, np.random.default_rng(3).standard_normal(400) * np.hanning(400)
    ),
}


@pytest.mark.parametrize("signal", SIGNALS.values(), ids=SIGNALS)
def test_rate_integrates_to_the_value(signal: Signal) -> None:
    def rate(t: float) -> float:
        return float(signal.rate(np.array([t]))[0])

    begin, end = signal.value(np.array([20.013, 20.31]))
    knots = [20.125, 20.25]
    integral = quad(rate, 20.013, 20.31, points=knots, epsabs=1e-13)[0]
    assert integral == pytest.approx(end - begin, abs=1e-11)


@pytest.mark.parametrize("signal", SIGNALS.values(), ids=SIGNALS)
def test_a_shift_is_another_instant(signal: Signal) -> None:
    t = 10 + np.arange(100) / 16
    for shift in (0.4, 1e-2, -0.03):
        np.testing.assert_allclose(signal.value(t, shift), signal.value(t - shift), rtol=0, atol=2e-13)
        np.testing.assert_allclose(signal.rate(t, shift), signal.rate(t - shift), rtol=0, atol=2e-12)


def test_record_passes_through_its_samples_and_reproduces_a_sine() -> None:
    t = np.arange(0, 60, 1 / 16)
    sine = RecordedSignal(t, np.sin(2 * np.pi * 0.5 * t))
    np.testing.assert_allclose(sine.value(t), sine.samples, rtol=0, atol=1e-13)
    between = np.arange(5, 55, 0.0173)
    np.testing.assert_allclose(sine.value(between), np.sin(np.pi * between), rtol=0, atol=1e-6)


def test_motion_takes_the_derivative_of_its_own_rate() -> None:
    t = np.arange(0, 30, 1 / 16)
    rng = np.random.default_rng(0)
    motion = recorded_motion(t, rng.standard_normal((3, t.size)), rng.standard_normal((3, t.size)))
    h = 1e-5
    at = np.array([10.02, 11.3, 15.77])
    numeric = (motion.at(at, -h).omega - motion.at(at, h).omega) / (2 * h)
    np.testing.assert_allclose(motion.at(at).omegadot, numeric, rtol=1e-7, atol=1e-6)


def test_a_record_too_short_says_so() -> None:
    signal = SIGNALS["recorded"]
    with pytest.raises(UserError, match="does not cover"):
        signal.value(np.array([49.9, 60.0]))


@pytest.mark.parametrize(
    ("time", "samples"),
    [([0, 1, 2], [0, 0, 0]), ([0, 1, 2, 3, 5, 4], [0] * 6), (range(6), [0, 1, 2, 3, 4, np.nan])],
)
def test_a_bad_record_is_refused(time: list[float], samples: list[float]) -> None:
    with pytest.raises(UserError):
        RecordedSignal(np.array(time, dtype=float), np.array(samples, dtype=float))
    with pytest.raises(UserError):
        Sinusoids(0.0, [1.0], [0.1, 0.2], [0.0])
