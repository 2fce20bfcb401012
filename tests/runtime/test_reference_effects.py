"""Each injected effect against a formula worked by hand, and what it must leave alone.

At phi = 0 the input, output and pendulous axes of A1 are +y, +x and -z of the measurement frame.
"""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from derive.effects import catalogue
from derive.effects.quantisation import quantisation
from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.units import units
from ragg_runtime.reference import CATALOGUE, MotionSignals, Simulation, Sinusoids, simulate, still
from ragg_runtime.reference.effects import resolve
from ragg_runtime.reference.effects.force import gravity_tensor
from ragg_runtime.reference.gravity import Gradient, PointMass
from ragg_runtime.reference.motion import recorded_motion
from ragg_runtime.reference.scenario import perfect, trimmed

RATE = 16.0
GAIN = 1e9 * 1e-2 / 9.8
GAMMA = Gradient(np.array([300, 120, 50, 200, -80, -500]) * 1e-9)
CONSTANT = {
    "roll": 0.1, "pitch": -0.2, "pressure": 101325.0 - 40.0, "B_x": 2e-5, "B_y": 3e-5, "B_z": -4e-5, "yaw": 0.7, "fuel_mass": 400.0,
    "vibration_rms": 0.5, "angular_vibration_rms": 0.01, "balance_current": 0.01, "second_order_current": 0.01,
}  # fmt: skip
AUXILIARIES = {
    **{f"mass_{k}": (lambda t, n=n: 0.2 * np.sin(0.1 * t + n)) for n, k in enumerate("xyz")},
    **{name: (lambda t, x=x: x + 0 * t) for name, x in CONSTANT.items()},
    "temperature": lambda t: 293.15 + 0.5 + 1e-3 * t,
}


def shaken() -> MotionSignals:
    rng = np.random.default_rng(8)
    t = np.arange(-32, 32 * RATE) / RATE
    smooth = np.cumsum(np.cumsum(rng.standard_normal((6, t.size)), axis=1), axis=1)
    smooth = (smooth - np.linspace(0, 1, t.size) * smooth[:, -1:]) / np.std(smooth, axis=1, keepdims=True)
    rapid = np.sin(2 * np.pi * np.outer([0.3, 0.5, 0.7, 0.35, 0.55, 0.75], t))
    a = np.array([[0.15], [0.15], [1.0]]) + 0.1 * (smooth + rapid)[:3]
    return recorded_motion(t, a, 5e-4 + 7e-4 * (smooth + rapid)[3:])


SHAKEN = shaken()


def run(effects=None, instrument=None, motion=SHAKEN, duration=20.0, **options) -> Simulation:
    instrument = trimmed() if instrument is None else instrument
    options = {"gravity": GAMMA, "auxiliaries": AUXILIARIES} | options
    return simulate(instrument, motion, duration, RATE, effects=effects, **options)


def force(effects, motion: MotionSignals, instrument=None, **options) -> np.ndarray:
    """Bracket of Eq. 52 of the four accelerometers in m/s^2, (4, N), effects minus none."""
    instrument = perfect() if instrument is None else instrument
    options = {"gravity": None, "duration": 0.25} | options
    with_effect, without = (run(e, instrument, motion, **options).voltages for e in (effects, None))
    return (with_effect - without) / GAIN


PLAIN = run()
UNITS = units(9.8)
KNOWN = {(e.id, q.name): q for e in catalogue() for q in e.parameters}
SHOWN: dict[str, dict[str, object]] = {
    "saturation": {"V_max": 3.0},
    "imu-saturation": {"a_max": 0.1, "omega_max": 1e-3},
    "second-order-misalignment": {"kappa": 0.5},
}
"""Values of effects that do not show at a plausible size, or are there at it."""
RECORD_ONLY = {
    "time-offset", "clock-drift", "imu-lever-arm", "imu-misalignment", "gyro-scale", "gyro-delay",
    "gyro-bias",
    "gyro-g-sensitivity", "imu-acceleration-scale", "imu-acceleration-bias", "imu-acceleration-misalignment",
    "imu-saturation", "imu-filter", "imu-skew", "imu-acceleration-quadratic", "imu-thermal", "gyro-misalignment",
    "mount-resonance",
}  # fmt: skip
OUTPUT_ONLY = {"saturation", "quantisation", "output-curve"}


def _some(effect: str) -> dict[str, object]:
    """Values at which every parameter of the effect acts, in A2 only where each accelerometer has its own."""
    values: dict[str, object] = {}
    for name, parameter in CATALOGUE[effect].items():
        q = KNOWN[effect, name]
        size = float(UNITS.to_si(q.plausible, q.unit, parameter.unit))
        values[name] = [0, size, 0, 0] if parameter.per_accelerometer else size
    values |= SHOWN.get(effect, {})
    if effect == "vibration-rectification":
        values |= {"P_xy": 0.0, "P_xz": 0.0, "P_yz": 1e-3}
    if effect == "vibration-level":
        values |= {"L_xy": 0.0, "L_xz": 0.0, "L_yz": 0.0}
    return values


@pytest.mark.parametrize("effect", CATALOGUE)
def test_an_effect_changes_either_the_truth_or_the_record(effect: str) -> None:
    """And nothing at all, bit for bit, where its values are neutral."""
    neutral = run({effect: {name: parameter.neutral for name, parameter in CATALOGUE[effect].items()}})
    np.testing.assert_array_equal(neutral.voltages, PLAIN.voltages)
    np.testing.assert_array_equal(neutral.G_out, PLAIN.G_out)
    assert all(np.array_equal(neutral.channels[name], x) for name, x in PLAIN.channels.items())
    flight = run({effect: _some(effect)})
    same_voltages = np.array_equal(flight.voltages, PLAIN.voltages)
    same_record = all(np.array_equal(flight.channels[name], v) for name, v in PLAIN.channels.items())
    assert same_record == (effect not in RECORD_ONLY)
    assert same_voltages == (effect in RECORD_ONLY | OUTPUT_ONLY)
    assert np.array_equal(flight.G_out, PLAIN.G_out) == (effect in RECORD_ONLY)
    if all(p.per_accelerometer for p in CATALOGUE[effect].values()):
        np.testing.assert_array_equal(flight.voltages[[0, 2, 3]], PLAIN.voltages[[0, 2, 3]])


@pytest.mark.parametrize("tau", [1e-9, 1e-3, 0.03])
def test_lag_is_the_exact_first_order_filter(tau) -> None:
    # A horizontal force at 2.2 Hz is seen by A1 at 1.95 and 2.45 Hz: filter each line exactly.
    amplitude, f = 2.0, 2.2
    motion = MotionSignals((Sinusoids(0.3, [amplitude], [f], [0.4]), Sinusoids(), Sinusoids()), still().omega)
    flight = run({"lag": {"tau": [tau, 0, 0, tau]}}, perfect(), motion, 60.0, gravity=None, start=1000.0)
    t = flight.time
    # -(0.3 + A sin(wt + 0.4)) sin(Wt), as complex lines.
    lines = [(0.25, 0.3j)]
    for sign in (1, -1):
        lines.append((f + sign * 0.25, sign * 0.5 * amplitude * np.exp(0.4j)))
    filtered = sum(np.real(c * np.exp(2j * np.pi * nu * t) / (1 + 2j * np.pi * nu * tau)) for nu, c in lines)
    plain = sum(np.real(c * np.exp(2j * np.pi * nu * t)) for nu, c in lines)
    np.testing.assert_allclose(flight.voltages[0] / GAIN, filtered, rtol=0, atol=2e-10)
    # Even a nanosecond's effect itself is right to a millionth, as far as doubles resolve it.
    change = (
        flight.voltages[0] - run(None, perfect(), motion, 60.0, gravity=None, start=1000.0).voltages[0]
    ) / GAIN
    size = np.max(np.abs(filtered - plain))
    np.testing.assert_allclose(change, filtered - plain, rtol=0, atol=1e-6 * size + 2e-15)


def test_spin_rate_jitter_has_its_statistics() -> None:
    def angle_error(**sigma: float) -> np.ndarray:
        flight = run({"spin-rate-jitter": sigma}, perfect(), still(a=(1.0, 0, 0)), 2000.0, gravity=None)
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


# --- specific force ---


def test_near_mass_is_what_newton_adds_to_the_gradient() -> None:
    """Third and fourth derivative of its potential; opposite accelerometers of a perfect instrument add up the fourth alone."""
    site = np.array([2.4, -1.6, 1.1])
    x = sp.symbols("x y z", real=True)
    G, m = sp.Float("6.6743e-11", 30), 2000
    potential = G * m / sp.sqrt(sum((sp.Float(str(s), 30) - v) ** 2 for s, v in zip(site, x, strict=True)))
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
    inside = np.abs(PLAIN.G_out) <= limit
    np.testing.assert_array_equal(clipped[inside], PLAIN.G_out[inside])
    np.testing.assert_array_equal(clipped[~inside], np.copysign(limit, PLAIN.G_out[~inside]))
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
    ("effects", "message"),
    [
        ({"cubic-inputs": {}}, "did you mean 'cubic-input'"),
        ({"lag": {"tua": 1.0}}, "did you mean 'tau'"),
        ({"lag": {"tau": [1, 2, 3]}}, "four numbers"),
        ({"lag": {"tau": "soon"}}, "four numbers"),
        ({"time-offset": {"delta_t": [1, 2]}}, "one number in s"),
        ({"time-offset": {"delta_t": np.nan}}, "one number in s"),
        ({"vibration-rectification": {"P_xx": 1.0, "P_xy": 2.0}}, "positive semidefinite"),
        ({"saturation": {"V_max": -1.0}}, "positive"),
        ({"quantisation": {"q": -1.0}}, "negative"),
    ],
)
def test_bad_effects_are_refused(effects: dict, message: str) -> None:
    with pytest.raises(UserError, match=message):
        run(effects)


def test_missing_auxiliary_channel_is_named() -> None:
    only_roll = {"roll": AUXILIARIES["roll"]}
    with pytest.raises(UserError, match="temperature"):
        run({"thermal-bias": {"dK0_dT": 1e-6}}, auxiliaries=only_roll)
    with pytest.raises(UserError, match="pitch"):
        run({"self-gradient": {"G_xx_pitch": 1e-6}}, auxiliaries=only_roll)
    run({"self-gradient": {"G_xx_roll": 1e-6}}, auxiliaries=only_roll)


def test_a_flight_carries_the_record_and_not_the_truth() -> None:
    flight = run().flight("line 1", voltages=True)
    assert sorted(flight.outputs) == ["G_out", "V_1", "V_2", "V_3", "V_4"]
    assert {"a_x", "omega_y", "omegadot_z", "Gamma_zz", "temperature", "roll", "pitch"} <= set(
        flight.channels
    )
    blind = run(record_gradient=False).flight()
    assert not any(name.startswith("Gamma") for name in blind.channels)
    V = [flight.outputs[f"V_{j}"] for j in range(1, 5)]
    np.testing.assert_array_equal(flight.outputs["G_out"], V[0] + V[1] - V[2] - V[3])
