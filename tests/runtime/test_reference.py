"""The reference simulator: flights and their statistics, each effect against a formula worked by hand, and what must stay as it is;
effects with a memory, and bodies, fitted to its flights.

At phi = 0 the input, output and pendulous axes of A1 are +y, +x and -z of the measurement frame.
"""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy as sp
from scipy.signal import welch
from scipy.spatial.transform import Rotation

from derive.effects.quantisation import quantisation
from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.fitted import Fitted, fit
from ragg_runtime.estimation.observation import observe
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.io import Flight
from ragg_runtime.model import derive
from ragg_runtime.model.memory import add_responses, first_memories
from ragg_runtime.model.model import load_packaged
from ragg_runtime.model.record import record
from ragg_runtime.reference import simulate as reference
from ragg_runtime.reference.effects import CATALOGUE, EffectValues, resolve
from ragg_runtime.reference.effects.force import gravity_tensor
from ragg_runtime.reference.geometry import Taylor, carry
from ragg_runtime.reference.gravity import Gradient, PointMass
from ragg_runtime.reference.motion import MotionSignals, RecordedSignal, Sinusoids, disc_angle, still, turns
from ragg_runtime.reference.scenario import SHAPES, draw_motion, perfect, scenario, trimmed, turbulence
from ragg_runtime.reference.simulate import Noise, Simulation, eotvos_noise, simulate
from ragg_runtime.signals.demodulators import demodulate
from ragg_runtime.simulate import simulate_flight
from tests.simulated import RATE as SLOW

RATE = 16.0
DEG_PER_HOUR = np.pi / 180 / 3600

# --- flights, signals and noise ---


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
    f, density = welch(signal(np.arange(0, 3600, 1 / RATE)), RATE, nperseg=4096)
    assert np.sum(density[f > 1.8]) < 1e-3 * np.sum(density)
    assert np.sum(density[f > 3]) < 1e-6 * np.sum(density)
    band = (f > 0.1) & (f < 1.0)
    ratio = density[band] / SHAPES[shape](f[band])
    assert np.std(ratio) / np.mean(ratio) < 0.35


def test_seed_and_trim_decide() -> None:
    """The same flight for the same seed; how much acceleration gets through."""
    first, again, other = (scenario(s, duration=60).simulate().G_out for s in (5, 5, 6))
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)
    assert np.std(scenario(5, duration=60, trim="table-v").simulate().G_out) > 100 * np.std(first)


def test_flights_are_of_one_instrument_unless_another_is_asked_for(tmp_path, monkeypatch) -> None:
    """A calibration of the first flight holds on the second."""
    true: list[Instrument] = []
    original = reference.simulate

    def watched(instrument: Instrument, *rest: Any, **options: Any) -> Simulation:
        true.append(instrument)
        return original(instrument, *rest, **options)

    monkeypatch.setattr(reference, "simulate", watched)
    i = api.new(tmp_path / "m").instrument
    x = [
        simulate_flight(i, [], seed=k, instrument_seed=n, duration=10.0) for k, n in ((1, 0), (2, 0), (1, 3))
    ]
    first, second, third = (i.accelerometers["K0"] for i in true)
    np.testing.assert_array_equal(first, second)
    assert np.all(first != third)
    assert np.all(x[0].channels["a_x"] != x[1].channels["a_x"])


@pytest.mark.parametrize("frequency", [0.25, 0.1, 1 / 3, 0.24999999999999, 7.123456789012345, 1e-4])
def test_turns_agree_with_arbitrary_precision_after_ten_days(frequency: float) -> None:
    rng = np.random.default_rng(1)
    times = np.concatenate([1e6 * rng.random(200), 1e6 - np.arange(5) / 16, -1e5 * rng.random(5)])
    with mpmath.workdps(60):
        for t, computed in zip(times, turns(frequency, times), strict=True):
            gap = mpmath.mpf(frequency) * mpmath.mpf(float(t)) - mpmath.mpf(float(computed))
            assert abs(gap - mpmath.nint(gap)) < 1.2e-16


HUNDRED = np.random.default_rng(3).standard_normal(400) * np.hanning(400)
RECORDED = RecordedSignal(np.arange(400) / 8, HUNDRED)


def test_what_a_turning_platform_carries_is_accelerated_as_its_positions_say() -> None:
    """Full kinematics (Euler, Coriolis and centrifugal) of a tumbling platform, by differences of positions in inertial space."""
    step, n = 1e-2, np.arange(-3, 4)
    t = 0.7 + step * n
    angles = np.stack([0.4 * t + 0.1 * np.sin(3 * t), 0.2 * np.cos(2 * t), 0.2 * np.sin(t) - 0.5 * t], axis=1)
    A = Rotation.from_euler("ZYX", angles).as_matrix()  # to inertial space
    r = np.stack([np.sin(2 * t), t**3 / 5, np.exp(-t) * np.cos(t)], axis=1)
    weights = (
        np.array([-1, 9, -45, 0, 45, -9, 1]) / 60 / step,
        np.array([2, -27, 270, -490, 270, -27, 2]) / 180 / step**2,
    )
    along = Taylor(r[3][:, None], *((w @ r)[:, None] for w in weights))
    turning, changing = (A[3].T @ np.tensordot(w, A, 1) for w in weights)
    omega, omegadot = (
        np.array([[W[2, 1]], [W[0, 2]], [W[1, 0]]]) for W in (turning, (changing - changing.T) / 2)
    )
    expected = A[3].T @ (weights[1] @ np.einsum("nij,nj->ni", A, r))
    np.testing.assert_allclose(carry(along, omega, omegadot)[:, 0], expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("noise", [Noise(omega_T=2e-14), Noise(1e-15, 1.0), Noise(3e-16, 1.7, 1e-15)])
def test_spectrum_of_noise_follows_the_formula(noise: Noise) -> None:
    record = noise.sample(np.random.default_rng(7), 400_000, RATE)
    f, density = welch(record, RATE, window="hann", nperseg=4096, detrend="constant")
    # away from the first bins, where the window smears a steep spectrum, and from Nyquist
    band = slice(8, -2)
    ratio = density[band] / noise.psd(f[band])
    averages = 2 * record.size / 4096 * 18 / 19
    assert np.mean(ratio) == pytest.approx(1, abs=0.01)
    assert np.std(ratio) < 1.3 / np.sqrt(averages)
    for low in 2.0 ** np.arange(-4, 3):  # no trend over the band
        octave = (f[band] >= low) & (f[band] < 2 * low)
        assert np.mean(ratio[octave]) == pytest.approx(1, abs=5 / np.sqrt(averages * octave.sum()))


def test_noise_of_the_demodulated_channels() -> None:
    density = 2e-9
    flight = simulate(perfect(), still(), 6000, RATE, noise=eotvos_noise(density, 0.1), seed=4)
    noise = flight.G_out - flight.G_out_noise_free
    out = demodulate(noise, disc_angle(0.25, flight.time), RATE, perfect().scale_factor)
    for channel, expected in ((out.cross, density), (out.inline, 2 * density)):
        f, power = welch(channel, RATE, nperseg=4096)
        assert np.sqrt(np.mean(power[(f > 0.01) & (f < 0.14)])) == pytest.approx(expected, rel=0.05)
    V = flight.voltages - flight.voltages_noise_free
    assert np.max(np.abs(np.corrcoef(V) - np.eye(4))) < 0.02


# --- effects ---

GAIN = 1e9 * 1e-2 / 9.8
ROLL = {"roll": lambda t: 0.1 + 0 * t}


def run(effects=None, instrument=None, motion=None, duration=20.0, **options) -> Simulation:
    """Of an instrument in turbulence, which records no auxiliary channel but the roll; or as asked for."""
    instrument, motion = instrument or trimmed(), motion or draw_motion(np.random.default_rng(8), duration)
    return simulate(instrument, motion, duration, RATE, effects=effects, **{"auxiliaries": ROLL} | options)


PLAIN = run()


@pytest.mark.parametrize("tau", [1e-9, 1e-3, 0.03])
def test_lag_is_the_exact_first_order_filter(tau) -> None:
    # A horizontal force at 2.2 Hz is seen by A1 at 1.95 and 2.45 Hz: filter each line exactly.
    amplitude, f = 2.0, 2.2
    motion = MotionSignals((Sinusoids(0.3, [amplitude], [f], [0.4]), Sinusoids(), Sinusoids()), still().omega)
    flight, plain_flight = (
        run(effects, perfect(), motion, 60.0, start=1000.0)
        for effects in ({"lag": {"tau": [tau, 0, 0, tau]}}, None)
    )
    t = flight.time
    # -(0.3 + A sin(wt + 0.4)) sin(Wt), as complex lines.
    lines = [(0.25, 0.3j)]
    for sign in (1, -1):
        lines.append((f + sign * 0.25, sign * 0.5 * amplitude * np.exp(0.4j)))
    filtered = sum(np.real(c * np.exp(2j * np.pi * nu * t) / (1 + 2j * np.pi * nu * tau)) for nu, c in lines)
    plain = sum(np.real(c * np.exp(2j * np.pi * nu * t)) for nu, c in lines)
    np.testing.assert_allclose(flight.voltages[0] / GAIN, filtered, rtol=0, atol=2e-10)
    # Even a nanosecond's effect itself is right to a millionth, as far as doubles resolve it.
    change = (flight.voltages[0] - plain_flight.voltages[0]) / GAIN
    size = np.max(np.abs(filtered - plain))
    np.testing.assert_allclose(change, filtered - plain, rtol=0, atol=1e-6 * size + 2e-15)


def test_spin_rate_jitter_has_its_statistics() -> None:
    def angle_error(**sigma: float) -> np.ndarray:
        flight = run({"spin-rate-jitter": sigma}, perfect(), still(a=(1.0, 0, 0)), 2000.0)
        # A1 measures -sin phi, A3 measures -cos phi.
        phi = np.unwrap(np.arctan2(-flight.voltages[0], -flight.voltages[2]))
        error = phi - 2 * np.pi * 0.25 * flight.time
        return error - 2 * np.pi * np.rint(error[0] / (2 * np.pi))

    white = angle_error(sigma_phi=1e-3)
    assert np.std(white) == pytest.approx(1e-3, rel=0.03)
    assert abs(np.corrcoef(white[1:], white[:-1])[0, 1]) < 0.03
    walk = angle_error(sigma_walk=1e-4)
    assert walk[0] == pytest.approx(0, abs=1e-12)
    assert np.std(np.diff(walk)) == pytest.approx(1e-4 / np.sqrt(RATE), rel=0.03)
    assert np.std(walk[16000:] - walk[:-16000]) > 5 * np.std(np.diff(walk))


def test_near_mass_is_what_newton_adds_to_the_gradient() -> None:
    """Third and fourth derivative of its potential; opposite accelerometers of a perfect instrument add up the fourth alone."""
    site = np.array([2.4, -1.6, 1.1])
    x = sp.symbols("x y z", real=True)
    distance = sp.sqrt(sum((sp.Float(str(s), 30) - v) ** 2 for s, v in zip(site, x, strict=True)))
    potential = sp.Float("6.6743e-11", 30) * 2000 / distance
    T = {}
    for name in CATALOGUE["near-mass"]:
        axes = [x["xyz".index(k)] for k in name.removeprefix("T_")]
        T[name] = float(sp.diff(potential, *axes).subs(dict.fromkeys(x, 0)))
    mass = PointMass(2000.0, site)
    linear = Gradient(mass.gradient(np.zeros(1))[:, 0])
    third = {k: v for k, v in T.items() if len(k) == 5}
    newton, flat, even, both = (
        run(e, perfect(), still(), 4.0, gravity=g)
        for e, g in ((None, mass), (None, linear), ({"near-mass": third}, linear), ({"near-mass": T}, linear))
    )
    for name, of_third in (("voltages", 0.07), ("G_out", 2.0)):
        missing = np.max(np.abs(getattr(newton, name) - getattr(flat, name)))
        assert np.max(np.abs(getattr(newton, name) - getattr(even, name))) < of_third * missing
        assert np.max(np.abs(getattr(newton, name) - getattr(both, name))) < 0.05 * missing
    assert np.max(np.abs(even.G_out - flat.G_out)) < 1e-5 * missing
    values = resolve({"near-mass": T})["near-mass"]
    np.testing.assert_allclose(np.einsum("iij->j", gravity_tensor(values, 3)), 0, atol=1e-20)
    np.testing.assert_allclose(np.einsum("iijk->jk", gravity_tensor(values, 4)), 0, atol=1e-20)


def test_saturation_and_quantisation() -> None:
    limit = float(np.quantile(np.abs(PLAIN.G_out), 0.7))
    clipped = run({"saturation": {"V_max": limit}}).G_out
    np.testing.assert_array_equal(clipped, np.clip(PLAIN.G_out, -limit, limit))
    rounded = run({"quantisation": {"q": 0.5}}).G_out
    np.testing.assert_array_equal(rounded, 0.5 * np.round(rounded / 0.5))
    assert 0.2 < np.max(np.abs(rounded - PLAIN.G_out)) <= 0.25
    # in a wide range the closest two values are several steps apart: their common divisor is the step
    values = 0.003 * np.random.default_rng(0).integers(-(10**7), 10**7, 2000)
    valid = np.ones(len(values), dtype=bool)
    assert np.min(np.diff(np.unique(values))) > 0.005
    assert quantisation(values, valid, 0.003) == pytest.approx(0.003, rel=1e-9)
    assert quantisation(values + np.random.default_rng(1).normal(size=len(values)), valid, 0.003) is None


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (lambda: run({"cubic-inputs": {}}), "did you mean 'cubic-input'"),
        (lambda: run({"lag": {"tua": 1.0}}), "did you mean 'tau'"),
        (lambda: run({"lag": {"tau": [1, 2, 3]}}), "four numbers"),
        (lambda: run({"lag": {"tau": "soon"}}), "four numbers"),
        (lambda: run({"time-offset": {"delta_t": [1, 2]}}), "one number in s"),
        (lambda: run({"time-offset": {"delta_t": np.nan}}), "one number in s"),
        (lambda: run({"vibration-rectification": {"P_xx": 1.0, "P_xy": 2.0}}), "positive semidefinite"),
        (lambda: run({"lag": {"tau": 1.0}}), "tau .* is out of range"),
        (lambda: run({"imu-saturation": {"a_max": -1.0}}), "a_max .* is out of range"),
        (lambda: run({"quantisation": {"q": -1.0}}), "q .* is out of range"),
        (lambda: run({"thermal-bias": {"dK0_dT": 1e-6}}), "temperature"),
        (lambda: run({"self-gradient": {"G_xx_pitch": 1e-6}}), "pitch"),
        (lambda: PointMass(1.0, [0, 0, 0]).difference(np.zeros(1), np.ones((3, 1))), "sits on"),
        (lambda: RECORDED(np.array([49.9, 60.0])), "does not cover"),
    ],
)
def test_what_cannot_be_is_refused(asked, message: str) -> None:
    with pytest.raises(UserError, match=message):
        asked()


def test_a_flight_carries_the_record_and_not_the_truth() -> None:
    run({"self-gradient": {"G_xx_roll": 1e-6}})  # needs no pitch
    s = scenario(5, duration=20.0)
    flight = s.simulate().flight("line 1", voltages=True)
    assert sorted(flight.outputs) == ["G_out", "V_1", "V_2", "V_3", "V_4"]
    assert {"a_x", "omega_y", "omegadot_z", "Gamma_zz", "temperature", "roll"} <= set(flight.channels)
    blind = s.simulate(record_gradient=False).flight()
    assert not any(name.startswith("Gamma") for name in blind.channels)
    V = [flight.outputs[f"V_{j}"] for j in range(1, 5)]
    np.testing.assert_array_equal(flight.outputs["G_out"], V[0] + V[1] - V[2] - V[3])


# --- fitted: what is remembered, and bodies ---


def fitted_to(
    flight: Flight, sheet: Instrument, effect: str
) -> tuple[Fitted, dict[str, tuple[float, float]]]:
    """The model with the effect, and the value and its standard deviation of each parameter of it."""
    model = derive.with_effects(sheet, load_packaged(), [effect])
    f = fit(model, sheet, [observe(flight, sheet)], candidates=False)
    c = f.calibration
    fits = zip(c.columns, c.index, np.diag(c.covariance), strict=True)
    return f, {q.name.split(".")[1]: (c.p[k], q.scale * np.sqrt(v)) for q, k, v in fits if q.effect}


OMEGA = 2 * np.pi * 3.0
REMEMBERED: dict[str, dict[str, Any]] = {
    "mount-resonance": {"f_0": 1.3, "Q": 4.0, "share": 1.0},
    "accelerometer-resonance": {"f_0": 3.0, "Q": 15.0, "u": 1e-5 / (OMEGA * 15.0), "v": 1e-5 / OMEGA**2},
    "bias-hysteresis": {"h_p": 1e-8, "w": 0.2},
    "mount-hysteresis": {"e_zx": 1e-7, "w": 0.03},
    "inner-temperature": {"s": 3e-6, "tau": 120.0},
    "bias-creep": {"c_p": 1e-6, "tau": 30.0},
    "mount-creep": {"e_yx": 1e-6, "tau": 3.0},
    "thermal-hysteresis": {"h": 1e-7, "w": 0.05},
}


@pytest.mark.parametrize("effect", REMEMBERED)
def test_what_describes_a_memory_is_fitted_down_to_noise(effect: str) -> None:
    values = REMEMBERED[effect]
    full = {n: [v, 0, 0, 0] if CATALOGUE[effect][n].per_accelerometer else v for n, v in values.items()}
    s = scenario(72, duration=240.0, rate=SLOW)
    sim = s.simulate({effect: full})
    f, found = fitted_to(sim.flight(), s.sheet, effect)
    kept = f.observations[0].record.valid
    assert np.std(f.residuals()[0][kept]) < 1.02 * np.std(sim.G_out - sim.G_out_noise_free)
    for name in {"f_0", "Q", "w", "tau"} & {*values}:
        value, std = found[name]
        assert std < 0.2 * values[name]
        assert abs(value - values[name]) < 4 * std + 0.01 * values[name]


def test_a_part_of_a_record_hears_what_the_whole_one_does() -> None:
    s = scenario(72, duration=120.0)
    r = record(s.simulate().flight(), s.sheet)
    memories = [m for _, m in first_memories(load_packaged().candidates, r)]
    names = (
        *("mount_a_x", "curvature_tangential", "rate_radial_by_f_0", "rate_radial_by_Q"),
        *("slip_radial", "play_axial", "play_axial_by_w", "heat_rt", "heat_start_by_tau"),
    )
    whole, part = (add_responses(x, memories, names) for x in (r, r.part(slice(900, 1000))))
    for name in names:
        expected, got = whole.series(name), part.series(name)
        assert expected is not None and got is not None
        assert np.max(np.abs(got - expected[900:1000])) < 1e-4 * np.std(expected)


MOVED = (("x", 0.1, 90.0), ("y", 0.6, 50.0), ("z", 0.2, 70.0))
"""How far, m, and how often, s, along each axis."""

EDGES = {"l_x": 0.8, "l_y": 0.3, "l_z": 0.5}


@pytest.mark.parametrize(
    ("body", "M", "known"),
    [
        pytest.param("near-sphere", 60.0, True, id="point, place known"),
        pytest.param("near-cuboid", 600.0, False, id="cuboid, place fitted"),
    ],
)
def test_a_body_that_moves_is_weighed_and_placed(body: str, M: float, known: bool) -> None:
    s = scenario(7, duration=200.0, rate=SLOW)
    moving = {f"mass_{k}": Sinusoids(0.0, [a], [1 / T], [0.3]) for k, a, T in MOVED}
    s = replace(s, auxiliaries={**s.auxiliaries, **moving})
    true = {"x": 1.0, "y": 0.7, "z": -0.4} | (EDGES if body == "near-cuboid" else {})
    hidden: EffectValues = {body: true | {"M": M}}
    stated = {n: RawQuantity(v + (0.0 if known or n in EDGES else 0.15), "m") for n, v in true.items()}
    setting = EffectSetting(body, MappingProxyType(stated), fixed=frozenset(stated if known else ()))
    _, found = fitted_to(s.simulate(hidden).flight(), replace(s.sheet, effects=(setting,)), body)
    assert set(found) == {"M"} if known else {"M", "x", "y", "z"}
    assert 20.0 < found["M"][0] / found["M"][1] < 40.0 if known else found["x"][1] < 0.02
    for name, (value, std) in found.items():
        assert abs(value - ({"M": M} | true)[name]) < 4 * std
