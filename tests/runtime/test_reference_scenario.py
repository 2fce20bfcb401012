"""Random flights: their statistics, their reproducibility, their speed."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import welch

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.reference.turbulence import SHAPES, turbulence

DEG_PER_HOUR = np.pi / 180 / 3600


def test_motion_has_the_stated_size() -> None:
    c = scenario(1).simulate().channels
    for name, mean, rms in (("a_x", 15, 10), ("a_y", 15, 10), ("a_z", 100, 30)):
        assert np.mean(c[name]) / 9.8e-3 == pytest.approx(mean, abs=0.05 * rms)
        assert np.std(c[name]) / 9.8e-3 == pytest.approx(rms, rel=0.02)
    for name in ("omega_x", "omega_y", "omega_z"):
        assert np.mean(c[name]) / DEG_PER_HOUR == pytest.approx(100, abs=10)
        assert np.std(c[name]) / DEG_PER_HOUR == pytest.approx(150, rel=0.02)
    assert 270 < np.min(c["temperature"]) < np.max(c["temperature"]) < 310
    assert 0.5 < np.ptp(c["temperature"]) < 5


@pytest.mark.parametrize("shape", SHAPES)
def test_spectrum_ends_at_the_cutoff_and_has_its_shape(shape: str) -> None:
    signal = turbulence(np.random.default_rng(2), 3600, 1.0, shape=shape)
    x = signal.value(np.arange(0, 3600, 1 / 16))
    f, density = welch(x, 16, nperseg=4096)
    assert np.sum(density[f > 1.8]) < 1e-3 * np.sum(density)
    assert np.sum(density[f > 3]) < 1e-6 * np.sum(density)
    band = (f > 0.1) & (f < 1.0)
    ratio = density[band] / SHAPES[shape](f[band])
    assert np.std(ratio) / np.mean(ratio) < 0.35


def test_bursts_make_it_non_stationary() -> None:
    t = np.arange(0, 3600, 1 / 16)

    def unevenness(bursts: float) -> float:
        x = turbulence(np.random.default_rng(4), 3600, 1.0, bursts=bursts).value(t)
        power = np.std(x.reshape(-1, 16 * 60), axis=1)
        return float(np.std(power) / np.mean(power))

    assert unevenness(0.6) > 2.5 * unevenness(0.0)


def test_equal_seeds_equal_flights() -> None:
    first, again, other = (scenario(s, duration=60).simulate() for s in (5, 5, 6))
    np.testing.assert_array_equal(first.G_out, again.G_out)
    assert not np.array_equal(first.G_out, other.G_out)


def test_true_instrument_lies_about_its_test_sheet() -> None:
    drawn = [scenario(s, duration=60) for s in range(30)]
    sheet = drawn[0].sheet.accelerometers
    K2 = np.array([d.instrument.accelerometers["K2"] - sheet["K2"] for d in drawn])
    assert np.std(K2) == pytest.approx(1e-6 / 9.8, rel=0.2)
    same = scenario(3, duration=60, perturbation=0.0)
    for name, values in same.sheet.accelerometers.items():
        np.testing.assert_array_equal(same.instrument.accelerometers[name], values)


def test_trim_decides_how_much_acceleration_gets_through() -> None:
    matched, uneven = (scenario(2, duration=120, trim=t).simulate().G_out for t in ("matched", "table-v"))
    assert np.std(uneven) > 100 * np.std(matched)
    with pytest.raises(UserError, match="trim"):
        scenario(2, trim="loose")


def test_noise_is_the_one_asked_for() -> None:
    s = scenario(7)
    flight = s.simulate()
    noise = (flight.G_out - flight.G_out_noise_free) / s.instrument.scale_factor
    assert np.std(noise) == pytest.approx(2e-9 * np.sqrt(4), rel=0.02)
    red = scenario(7, red_corner=0.1).simulate()
    slow = (red.G_out - red.G_out_noise_free) / s.instrument.scale_factor
    f, density = welch(slow, 16, nperseg=4096)
    assert np.mean(density[(f > 0.008) & (f < 0.012)]) > 5 * np.mean(density[f > 2])
    assert scenario(7, noise_density=0).noise is None


def test_geology_is_traceless_and_slow() -> None:
    c = scenario(3, gradient_rms=20e-9).simulate().channels
    trace = c["Gamma_xx"] + c["Gamma_yy"] + c["Gamma_zz"]
    np.testing.assert_allclose(trace, 0, atol=1e-20)
    assert np.std(c["Gamma_xy"]) == pytest.approx(20e-9, rel=0.3)
    constant = scenario(3).simulate().channels["Gamma_xy"]
    np.testing.assert_allclose(constant, 120e-9)
