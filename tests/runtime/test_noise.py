"""Noise follows its formula."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats
from scipy.signal import welch

from ragg_runtime.base.errors import UserError
from ragg_runtime.model.record import Record
from ragg_runtime.reference import disc_angle, simulate, still
from ragg_runtime.reference.accelerometer_noise import Noise, eotvos_noise
from ragg_runtime.reference.instruments import perfect
from ragg_runtime.signals.demodulate import demodulate

RATE = 16.0
MODELS = [Noise(omega_T=2e-14), Noise(1e-15, 1.0, 0.0), Noise(3e-16, 1.7, 1e-15), Noise(1e-15, 0.0, 1e-15)]


@pytest.mark.parametrize("noise", MODELS)
def test_spectrum_follows_the_formula(noise: Noise) -> None:
    record = noise.sample(np.random.default_rng(7), 400_000, RATE)
    f, density = welch(record, RATE, window="hann", nperseg=4096, detrend="constant")
    # Away from the first bins, where the window smears a steep spectrum, and from Nyquist.
    band = slice(8, -2)
    ratio = density[band] / noise.psd(f[band])
    averages = 2 * record.size / 4096 * 18 / 19
    assert np.mean(ratio) == pytest.approx(1, abs=0.01)
    assert np.std(ratio) < 1.3 / np.sqrt(averages)
    # No trend over the band: each octave agrees by itself.
    for low in 2.0 ** np.arange(-4, 3):
        octave = (f[band] >= low) & (f[band] < 2 * low)
        assert np.mean(ratio[octave]) == pytest.approx(1, abs=5 / np.sqrt(averages * octave.sum()))


def test_variance_is_the_integral_of_the_density() -> None:
    noise = Noise(1e-15, 1.0, 1e-15)
    size = 4096
    rng = np.random.default_rng(5)
    power = [np.mean(noise.sample(rng, size, RATE) ** 2) for _ in range(400)]
    low = RATE / (2 * size)
    # Sum over the lines of the periodic record of twice the length.
    f = np.arange(1, size + 1) * low
    lines = np.full(f.size, low)
    lines[-1] /= 2
    expected = float(np.sum(noise.psd(f) * lines))
    assert np.mean(power) == pytest.approx(expected, abs=4 * np.std(power) / np.sqrt(len(power)))


def test_white_noise_is_normal_with_half_the_rate_times_the_density() -> None:
    record = Noise(omega_T=4e-12).sample(np.random.default_rng(2), 50_000, RATE)
    assert stats.kstest(record / np.sqrt(4e-12 * RATE / 2), "norm").pvalue > 1e-3


@pytest.mark.parametrize("size", [0, 1, 2, 3, 1009, 4096])
def test_any_length_and_reproducible(size: int) -> None:
    noise = Noise(1e-15, 1.5, 1e-15)
    first, again = (noise.sample(np.random.default_rng(3), size, RATE) for _ in range(2))
    assert first.shape == (size,)
    np.testing.assert_array_equal(first, again)
    assert np.all(np.isfinite(first))


def test_noise_of_the_demodulated_channels() -> None:
    density = 2e-9
    flight = simulate(perfect(), still(), 20_000, RATE, noise=eotvos_noise(density, 0.1), seed=4)
    noise = flight.G_out - flight.G_out_noise_free
    out = demodulate(noise, disc_angle(0.25, flight.time), RATE, perfect().scale_factor)
    for channel, expected in ((out.cross, density), (out.inline, 2 * density)):
        f, power = welch(channel, RATE, nperseg=4096)
        assert np.sqrt(np.mean(power[(f > 0.01) & (f < 0.14)])) == pytest.approx(expected, rel=0.05)
    V = flight.voltages - flight.voltages_noise_free
    assert np.max(np.abs(np.corrcoef(V) - np.eye(4))) < 0.01


@pytest.mark.parametrize(("alpha", "b", "omega_T"), [(-1, 0, 0), (0, 5, 0), (0, -1, 0), (0, 0, np.nan)])
def test_bad_densities_are_refused(alpha: float, b: float, omega_T: float) -> None:
    with pytest.raises(UserError):
        Noise(alpha, b, omega_T)


def test_the_level_of_a_noise_may_follow_the_length_of_a_vector() -> None:
    rng = np.random.default_rng(4)
    omega = rng.normal(size=(3, 50))
    wide = {f"omega_{k}": x for k, x in zip("xyz", omega, strict=True)}
    r = Record(np.arange(50.0), wide, 1.0, np.ones(50, dtype=np.bool_), 0.0)
    assert r.quantity("abs(omega)") == pytest.approx(np.linalg.norm(omega, axis=0))
    assert r.quantity("abs(omega_x)") == pytest.approx(np.abs(omega[0]))
