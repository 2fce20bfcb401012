"""The numerical model against physics formulated another way."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.layout import PAPER
from ragg_runtime.reference import MotionSignals, Simulation, Sinusoids, disc_angle, simulate, still
from ragg_runtime.reference.geometry import mount
from ragg_runtime.reference.gravity import Gradient
from ragg_runtime.reference.instruments import perfect, table_v, trimmed
from ragg_runtime.reference.rotation import frame_rotation

ARCSEC = np.pi / 180 / 3600
GAMMA = np.array([300, 120, 50, 200, -80, -500]) * 1e-9
ANGLES = ("beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z")

SHAKEN = MotionSignals(
    a=(
        Sinusoids(0.15, [0.1, 0.05], [0.25, 0.61], [0.0, 1.0]),
        Sinusoids(0.15, [0.08, 0.03], [0.25, 0.43], [0.5, 2.0]),
        Sinusoids(1.0, [0.3, 0.1], [0.25, 0.87], [1.0, 3.0]),
    ),
    omega=(
        Sinusoids(5e-4, [7e-4], [0.31], [0.2]),
        Sinusoids(4e-4, [6e-4], [0.57], [0.9]),
        Sinusoids(6e-4, [5e-4], [0.22], [1.9]),
    ),
)


def run(instrument=None, motion=SHAKEN, duration=60.0, **options) -> Simulation:
    return simulate(perfect() if instrument is None else instrument, motion, duration, 16, **options)


@pytest.mark.parametrize("rotations", ["first-order", "exact"])
def test_perfect_instrument_sees_only_the_second_harmonic(rotations: str) -> None:
    flight = run(gravity=Gradient(GAMMA), rotations=rotations)
    c = flight.channels
    T1 = (c["Gamma_xx"] - c["Gamma_yy"] + c["omega_y"] ** 2 - c["omega_x"] ** 2) / 2
    T2 = -c["Gamma_xy"] + c["omega_x"] * c["omega_y"]
    phi = disc_angle(0.25, flight.time)
    expected = perfect().scale_factor * (T1 * np.sin(2 * phi) + T2 * np.cos(2 * phi))
    # Cancellation of voltages near 1e6 V leaves 1e-9 V, a millionth of an Eo.
    np.testing.assert_allclose(flight.G_out, expected, rtol=0, atol=3e-9)
    assert np.ptp(expected) > 1e-3


def test_common_mode_cancels_in_a_perfect_instrument() -> None:
    quiet = run(motion=still())
    loud = run(motion=still(a=(3.0, -5.0, 9.8)))
    assert np.max(np.abs(loud.voltages)) > 1e6
    np.testing.assert_allclose(loud.G_out, quiet.G_out, rtol=0, atol=1e-8)


def test_rigid_rotation_against_positions_differentiated_in_an_inertial_frame() -> None:
    """Eq. 9: the second derivative of where a point fixed to the turning frame is, seen from outside."""
    swing = np.array([0.3, -0.2, 0.5])

    def attitude(t: float) -> Rotation:
        return Rotation.from_rotvec(swing * np.sin(1.3 * t)) * Rotation.from_rotvec([0, 0.4 * t * t, 0.1 * t])

    h = 1e-3
    stencil = np.array([-1, 16, -30, 16, -1]) / (12 * h * h)
    slope = np.array([1, -8, 0, 8, -1]) / (12 * h)

    def rate(t: float) -> np.ndarray:
        derivative = sum(
            w * attitude(t + k * h).as_matrix() for k, w in zip(range(-2, 3), slope, strict=True)
        )
        spin = attitude(t).as_matrix().T @ derivative
        return np.array([spin[2, 1], spin[0, 2], spin[1, 0]])

    t0 = 0.7
    omega = rate(t0)
    omegadot = sum(w * rate(t0 + k * h) for k, w in zip(range(-2, 3), slope, strict=True))
    # A motion with these values at its first sample; the instrument stands at phi = 0 there.
    motion = MotionSignals(
        still().a,
        tuple(
            Sinusoids(w, [d / (2 * np.pi * 0.01)], [0.01], [0.0])
            for w, d in zip(omega, omegadot, strict=True)
        ),
    )
    instrument = perfect().replace(
        dR=[0, 0.01, 0.02, 0.03], beta_x=[0.1, 0.2, -0.1, 0.3], beta_z=[0.2, -0.1, 0.05, 0.3]
    )
    measured = run(instrument, motion, duration=0.1, rotations="exact").voltages[:, 0] / (1e9 * 1e-2 / 9.8)
    for j, station in enumerate(np.deg2rad([0, 180, 90, 270])):
        k = {name: values[j] for name, values in instrument.accelerometers.items()}
        azimuth, height = station + k["beta_z"], k["beta_x"]
        r = (0.1 + k["dR"]) * np.array(
            [np.cos(height) * np.cos(azimuth), np.cos(height) * np.sin(azimuth), np.sin(height)]
        )
        inertial = sum(w * attitude(t0 + n * h).apply(r) for n, w in zip(range(-2, 3), stencil, strict=True))
        acceleration = attitude(t0).inv().apply(inertial)
        tangential = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
        assert measured[j] == pytest.approx(acceleration @ tangential, abs=1e-8)


def test_triads_are_right_handed_and_orthogonal_when_exact() -> None:
    for j in range(4):
        m = mount(PAPER.places[j], 0.3, -0.2, "exact")
        np.testing.assert_allclose(m.triad @ m.triad.T, np.eye(3), atol=1e-15)
        assert np.linalg.det(m.triad) == pytest.approx(1)
        assert np.linalg.norm(m.arm) == pytest.approx(1)
        assert m.arm[2] == pytest.approx(np.sin(0.3))


def test_first_order_rotations_approach_the_exact_ones_quadratically() -> None:
    def gap(scale: float) -> float:
        k = table_v().accelerometers
        instrument = trimmed().replace(**{name: scale * (k[name] + 5 * ARCSEC) for name in ANGLES})
        flights = [run(instrument, gravity=Gradient(GAMMA), rotations=r) for r in ("first-order", "exact")]
        return float(np.std(flights[0].G_out - flights[1].G_out))

    gaps = [gap(scale) for scale in (400, 200, 100)]
    assert gaps[0] / gaps[1] == pytest.approx(4, rel=0.05)
    assert gaps[1] / gaps[2] == pytest.approx(4, rel=0.05)


def test_exact_misalignment_starts_with_eq_5b() -> None:
    x, y, z = 1e-3, 2e-3, -3e-3
    row = frame_rotation(x, y, z)[0]
    assert row[1] == pytest.approx(z + x * y, abs=2e-8)
    assert -row[2] == pytest.approx(y - x * z, abs=2e-8)


@pytest.mark.parametrize(
    ("name", "force"), [("K2", "ii"), ("K4", "ip"), ("K5", "oo"), ("K6", "io"), ("K7", "pp"), ("K8", "op")]
)
def test_second_order_coefficients_multiply_their_axes(name: str, force: str) -> None:
    # At phi = 0: A1 has input +y, output +x, pendulous -z.
    f = {"i": 2.0, "o": 3.0, "p": -5.0}
    K = 1e-6
    motion = still(a=(f["o"], f["i"], -f["p"]))
    plain, bent = (
        run(i, motion, 0.1).voltages[0, 0] for i in (perfect(), perfect().replace(**{name: [K, 0, 0, 0]}))
    )
    assert (bent - plain) / (1e9 * 1e-2 / 9.8) == pytest.approx(K * f[force[0]] * f[force[1]], rel=1e-6)


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [
        ("vartheta_z", 1e-4, 3.0e-4),
        ("vartheta_y", 1e-4, 5.0e-4),
        ("vartheta_x", 1e-4, 0.0),
        ("K0", 1e-5, 1e-5),
    ],
)
def test_misalignment_and_bias_of_eq_3(name: str, value: float, expected: float) -> None:
    # f_i = f_x + f_y vartheta_z - f_z vartheta_y with f_y = a_x and f_z = -a_z for A1 at phi = 0.
    motion = still(a=(3.0, 2.0, 5.0))
    V = [
        run(i, motion, 0.1).voltages[0, 0] for i in (perfect(), perfect().replace(**{name: [value, 0, 0, 0]}))
    ]
    assert (V[1] - V[0]) / (1e9 * 1e-2 / 9.8) == pytest.approx(expected, abs=1e-14)


def test_altitude_dips_the_triad_and_lifts_the_position() -> None:
    # tau_z = -e_z - beta_x e_r: vartheta_y couples a radial force in; and r_z > 0 couples omegadot.
    instrument = perfect().replace(beta_x=[1e-3, 0, 0, 0], vartheta_y=[1e-2, 0, 0, 0])
    V = run(instrument, still(a=(1.0, 0.0, 0.0)), 0.1).voltages[0, 0] / (1e9 * 1e-2 / 9.8)
    assert pytest.approx(1e-2 * 1e-3, rel=1e-9) == V
    # f_y (tangential at phi = 0) of omegadot x r with r_z = R beta_x is omegadot_z r_x - omegadot_x r_z.
    rolling = MotionSignals(still().a, (Sinusoids(0.0, [1.0], [0.1], [0.0]), Sinusoids(), Sinusoids()))
    V = run(perfect().replace(beta_x=[1e-3, 0, 0, 0]), rolling, 0.1).voltages[0, 0] / (1e9 * 1e-2 / 9.8)
    assert pytest.approx(-2 * np.pi * 0.1 * 0.1 * 1e-3, rel=1e-9) == V


def test_flight_carries_the_record_and_not_the_truth() -> None:
    flight = run(gravity=Gradient(GAMMA)).flight("line 1", voltages=True)
    assert sorted(flight.outputs) == ["G_out", "V_1", "V_2", "V_3", "V_4"]
    assert {"a_x", "omega_y", "omegadot_z", "Gamma_zz", "temperature", "roll", "pitch"} <= set(
        flight.channels
    )
    blind = run(record_gradient=False).flight()
    assert not any(name.startswith("Gamma") for name in blind.channels)
    np.testing.assert_array_equal(
        flight.outputs["G_out"],
        flight.outputs["V_1"] + flight.outputs["V_2"] - flight.outputs["V_3"] - flight.outputs["V_4"],
    )


def test_bad_arguments_are_refused() -> None:
    with pytest.raises(UserError, match="duration"):
        run(duration=0.0)
    with pytest.raises(UserError, match="rotations"):
        run(rotations="third-order")
