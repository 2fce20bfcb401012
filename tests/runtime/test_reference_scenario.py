"""The reference: random flights and their statistics, the disc angle, signals, noise, and flights simulated for a model directory."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.signal import welch

from ragg_runtime import api, reference
from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.record import Record
from ragg_runtime.reference import disc_angle, simulate, still
from ragg_runtime.reference.motion import RecordedSignal, Signal, Sinusoids, turns
from ragg_runtime.reference.scenario import SHAPES, perfect, scenario, turbulence
from ragg_runtime.reference.simulate import Noise, eotvos_noise
from ragg_runtime.signals.demodulators import demodulate
from ragg_runtime.simulate import simulate_flight

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


def test_equal_seeds_equal_flights() -> None:
    first, again, other = (scenario(s, duration=60).simulate() for s in (5, 5, 6))
    np.testing.assert_array_equal(first.G_out, again.G_out)
    assert not np.array_equal(first.G_out, other.G_out)


def test_trim_decides_how_much_acceleration_gets_through() -> None:
    matched, uneven = (scenario(2, duration=120, trim=t).simulate().G_out for t in ("matched", "table-v"))
    assert np.std(uneven) > 100 * np.std(matched)


def test_noise_is_the_one_asked_for() -> None:
    s = scenario(7)
    flight = s.simulate()
    noise = (flight.G_out - flight.G_out_noise_free) / s.instrument.scale_factor
    assert np.std(noise) == pytest.approx(2e-9 * np.sqrt(4), rel=0.02)
    red = scenario(7, red_corner=0.1).simulate()
    slow = (red.G_out - red.G_out_noise_free) / s.instrument.scale_factor
    f, density = welch(slow, 16, nperseg=4096)
    assert np.mean(density[(f > 0.008) & (f < 0.012)]) > 5 * np.mean(density[f > 2])


def test_flights_are_of_one_instrument_unless_another_is_asked_for(tmp_path, monkeypatch) -> None:
    """A calibration of the first flight holds on the second."""
    true: list[Instrument] = []
    simulate = reference.simulate

    def watched(instrument: Instrument, *rest: object, **options: object) -> object:
        true.append(instrument)
        return simulate(instrument, *rest, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(reference, "simulate", watched)
    m = api.new(tmp_path / "m")
    one, two, _ = (
        simulate_flight(m.instrument, [], seed=k, instrument_seed=n, duration=10.0)
        for k, n in ((1, 0), (2, 0), (1, 3))
    )
    first, second, third = (i.accelerometers["K0"] for i in true)
    np.testing.assert_array_equal(first, second)
    assert np.all(first != third)
    assert np.all(one.channels["a_x"] != two.channels["a_x"])


@pytest.mark.parametrize("frequency", [0.25, 0.1, 1 / 3, 0.24999999999999, 7.123456789012345, 1e-4])
def test_turns_agree_with_arbitrary_precision_after_ten_days(frequency: float) -> None:
    rng = np.random.default_rng(1)
    times = np.concatenate([1e6 * rng.random(200), 1e6 - np.arange(5) / 16, -1e5 * rng.random(5)])
    with mpmath.workdps(60):
        for t, computed in zip(times, turns(frequency, times), strict=True):
            exact = mpmath.mpf(float(frequency)) * mpmath.mpf(float(t))
            gap = exact - mpmath.mpf(float(computed))
            assert abs(gap - mpmath.nint(gap)) < 1.2e-16


def test_nanosecond_shift_survives_a_long_time() -> None:
    shift = 1.234567e-9
    moved = disc_angle(0.25, np.array([0.0]), shift) - disc_angle(0.25, np.array([0.0]))
    assert moved[0] == pytest.approx(-2 * np.pi * 0.25 * shift, rel=1e-12, abs=0)
    late = disc_angle(0.25, np.array([9e5 + 0.25]), shift) - disc_angle(0.25, np.array([9e5 + 0.25]))
    # What is left is the rounding of an angle near 0.4 rad, not that of a time near 1e6 s (1e-10 s).
    assert late[0] == pytest.approx(moved[0], abs=2e-16)


SIGNALS: dict[str, Signal] = {
    "sinusoids": Sinusoids(0.7, [1.0, 0.4, 0.2], [0.11, 0.63, 1.2], [0.1, 2.0, 4.0]),
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


SIXTEEN = 16.0
MODELS = [Noise(omega_T=2e-14), Noise(1e-15, 1.0, 0.0), Noise(3e-16, 1.7, 1e-15), Noise(1e-15, 0.0, 1e-15)]


@pytest.mark.parametrize("noise", MODELS)
def test_spectrum_follows_the_formula(noise: Noise) -> None:
    record = noise.sample(np.random.default_rng(7), 400_000, SIXTEEN)
    f, density = welch(record, SIXTEEN, window="hann", nperseg=4096, detrend="constant")
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


def test_noise_of_the_demodulated_channels() -> None:
    density = 2e-9
    flight = simulate(perfect(), still(), 20_000, SIXTEEN, noise=eotvos_noise(density, 0.1), seed=4)
    noise = flight.G_out - flight.G_out_noise_free
    out = demodulate(noise, disc_angle(0.25, flight.time), SIXTEEN, perfect().scale_factor)
    for channel, expected in ((out.cross, density), (out.inline, 2 * density)):
        f, power = welch(channel, SIXTEEN, nperseg=4096)
        assert np.sqrt(np.mean(power[(f > 0.01) & (f < 0.14)])) == pytest.approx(expected, rel=0.05)
    V = flight.voltages - flight.voltages_noise_free
    assert np.max(np.abs(np.corrcoef(V) - np.eye(4))) < 0.01


def test_the_level_of_a_noise_may_follow_the_length_of_a_vector() -> None:
    rng = np.random.default_rng(4)
    omega = rng.normal(size=(3, 50))
    wide = {f"omega_{k}": x for k, x in zip("xyz", omega, strict=True)}
    r = Record(np.arange(50.0), wide, 1.0, np.ones(50, dtype=np.bool_), 0.0)
    assert r.quantity("abs(omega)") == pytest.approx(np.linalg.norm(omega, axis=0))
    assert r.quantity("abs(omega_x)") == pytest.approx(np.abs(omega[0]))
