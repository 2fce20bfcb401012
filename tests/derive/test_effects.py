"""The physics of single effects: limits, symmetries, and what existing parameters absorb of them."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pytest
import sympy as sp
from evaluated import G0, LIKE_REFERENCE, base_derivatives, place, signatures, voltage
from numpy.typing import NDArray

from derive.chain import recorded_motion
from derive.context import Context
from derive.effect import Effect
from derive.effects import catalogue
from derive.effects.near_mass import EFFECT as NEAR_MASS
from derive.rotation import small_rotation
from derive.stages import EXACT, PAPER, Order
from derive.symbols import ACCELEROMETER, MOTION
from derive.tape import Tape
from ragg_runtime.instrument.units import units

Array = NDArray[np.float64]

EFFECT = {e.id: e for e in catalogue()}
RADIUS, SPIN = 0.1, 0.25
OMEGA = 2 * np.pi * SPIN


def instrument(**changed: float) -> dict[str, float]:
    """One accelerometer without any error, but for those given."""
    perfect = {q.name: 0.0 for q in ACCELEROMETER} | {"K1": 1.0, "k_VI": 1.0}
    return perfect | changed | {"radius": RADIUS, "spin_frequency": SPIN}


def world(n: int = 40, seed: int = 1, **given: Array | float) -> dict[str, Array]:
    """Random channels of the usual sizes, a disc angle, and no gradient; ``given`` replaces some."""
    rng = np.random.default_rng(seed)
    size = {"a": 1.0, "omega": 0.1, "omegadot": 0.3, "Gamma": 0.0}
    values = {c.name: size[c.name.split("_")[0]] * rng.standard_normal(n) for c in MOTION}
    values |= {f"{d}_{c.name}": rng.standard_normal(n) for d in ("d", "d2") for c in MOTION}
    values |= {
        "temperature": 293.15 + rng.standard_normal(n),
        "pressure": 101325 + 50 * rng.standard_normal(n),
    }
    values |= {name: 0.1 * rng.standard_normal(n) for name in ("roll", "pitch", "B_x", "B_y", "B_z")}
    phi = rng.uniform(0, 2 * np.pi, n)
    values |= {"phi": phi, "time": np.arange(n) / 10.0}
    values |= {"d_spin_angle": np.full(n, OMEGA), "d2_spin_angle": np.zeros(n)}
    values |= {name: np.full(n, v) for name, v in given.items()}
    return values | {"cos_phi": np.cos(values["phi"]), "sin_phi": np.sin(values["phi"])}


def signature(
    id_: str, w: Mapping[str, Array], k: Mapping[str, float], order: Order = PAPER, j: int = 0
) -> dict[str, Array]:
    """dV/d(parameter) of an effect by parameter name, (N,) each."""
    e = EFFECT[id_]
    found = signatures((e,), order)({**w, **k, **place(j)})
    return {
        q.name: np.broadcast_to(found[e.symbol(q).name], w["time"].shape) for q in e.parameters if q.fitted
    }


def base(
    w: Mapping[str, Array], k: Mapping[str, float], order: Order = PAPER, j: int = 0
) -> dict[str, Array]:
    """dV/d(parameter) of the paper's instrument, (N,) each."""
    found = base_derivatives(order)({**w, **k, **place(j)})
    return {n: np.broadcast_to(v, w["time"].shape) for n, v in found.items()}


def output(
    effects: tuple[str, ...],
    w: Mapping[str, Array],
    k: Mapping[str, float],
    order: Order = PAPER,
    j: int = 0,
    **p: float,
) -> Array:
    """V of an accelerometer with effects; ``p`` by parameter name, the others neutral."""
    es = tuple(EFFECT[i] for i in effects)
    values = {e.symbol(q).name: p.get(q.name, q.neutral) for e in es for q in e.parameters}
    V = voltage(es, order)({**w, **k, **place(j), **values})["V"]
    return np.broadcast_to(V, w["time"].shape)


def close(x: Array, y: Array, relative: float = 1e-12) -> None:
    np.testing.assert_allclose(x, y, rtol=0, atol=relative * float(np.max(np.abs(y))))


# The catalogue.

IDS = [
    "arm-sag", "arm-stretch", "bias-drift", "cubic-cross", "cubic-input", "encoder-harmonic", "gain-drift",
    "gain-step", "gyro-scale", "imu-lever-arm", "imu-misalignment", "lag", "mount-compliance", "near-mass",
    "odd-quadratic", "pendulum-angular", "quantisation", "saturation", "second-order-misalignment",
    "self-gradient", "spin-axis-tilt", "spin-axis-wobble", "spin-phase-offset", "spin-rate-jitter",
    "thermal-bias", "thermal-scale", "time-offset", "vibration-rectification",
]  # fmt: skip


def test_the_catalogue_holds_the_interface() -> None:
    assert {*IDS, "magnetic-bias", "pressure-bias"} <= set(EFFECT)
    assert [e.id for e in catalogue()] == sorted(EFFECT)


def test_channels_and_kinds() -> None:
    known = [EFFECT[i] for i in (*IDS, "magnetic-bias", "pressure-bias")]
    assert {e.id: e.channels for e in known if e.channels} == {
        "magnetic-bias": ("B_x", "B_y", "B_z"),
        "pressure-bias": ("pressure",),
        "self-gradient": ("roll", "pitch"),
        "thermal-bias": ("temperature",),
        "thermal-scale": ("temperature",),
    }
    assert {e.id: e.kind for e in known if e.kind != "deterministic"} == {
        "gain-step": "step",
        "quantisation": "output",
        "saturation": "output",
        "spin-rate-jitter": "random",
    }
    assert {q.channel for q in EFFECT["self-gradient"].parameters} == {"roll", "pitch"}
    assert [q.name for e in known if e.kind != "output" for q in e.parameters if not q.fitted] == ["t_step"]


def test_output_effects_are_absent_at_their_neutral_values() -> None:
    assert EFFECT["saturation"].parameters[0].neutral == math.inf
    assert EFFECT["quantisation"].parameters[0].neutral == 0


def test_display_units_follow_g() -> None:
    """ug/g^3 of a coefficient of f^3 in m/s^2: 1e-6 g / g^3 = 1e-6 / g^2."""
    known = units(G0)
    assert known.to_si(1.0, EFFECT["cubic-input"].parameters[0].unit, "1/(m/s^2)^2") == pytest.approx(
        1e-6 / G0**2
    )
    assert known.to_si(1.0, EFFECT["arm-stretch"].parameters[0].unit, "m/(m/s^2)") == pytest.approx(1e-6 / G0)


# Transducer.


def test_cubic_terms_of_a_perfect_accelerometer() -> None:
    """Products of the components along the tangent, the radius and downwards."""
    w = world(omega_x=0, omega_y=0, omega_z=0, omegadot_x=0, omegadot_y=0, omegadot_z=0)
    along = {
        "i": -w["a_x"] * w["sin_phi"] + w["a_y"] * w["cos_phi"],
        "o": w["a_x"] * w["cos_phi"] + w["a_y"] * w["sin_phi"],
        "p": -w["a_z"],
    }
    found = signature("cubic-cross", w, instrument()) | signature("cubic-input", w, instrument())
    assert len(found) == 10
    for name, row in found.items():
        close(row, np.prod([along[axis] for axis in name.removeprefix("K_")], axis=0))


def test_odd_quadratic_keeps_the_sign_of_the_force() -> None:
    w = world()
    reversed_ = w | {n: -w[n] for n in ("a_x", "a_y", "a_z", "omegadot_x", "omegadot_y", "omegadot_z")}
    still = {f"omega_{k}": np.zeros(w["time"].size) for k in "xyz"}
    row = signature("odd-quadratic", w | still, instrument())["K_oq"]
    close(signature("odd-quadratic", reversed_ | still, instrument())["K_oq"], -row)
    even = base(w | still, instrument())["K2"]
    close(np.abs(row), even)


def test_odd_quadratic_at_vanishing_force() -> None:
    w = world(**{c.name: 0.0 for c in MOTION})
    e = EFFECT["odd-quadratic"]
    V = output(("odd-quadratic",), w, instrument(), K_oq=1.0)
    assert np.all(V == 0)
    assert np.all(
        signatures((e,), PAPER)({**w, **instrument(), **place(0)})[e.symbol(e.parameters[0]).name] == 0
    )


def test_lag_of_a_force_that_turns() -> None:
    """A steady horizontal force is a sine at the spin rate: 1/(1 + tau s) turns and shrinks it."""
    tau = 2e-3
    phi = np.linspace(0, 2 * np.pi, 50)
    calm = {c.name: 0.0 for c in MOTION} | {f"{d}_{c.name}": 0.0 for d in ("d", "d2") for c in MOTION}
    w = world(50, **calm) | {"phi": phi, "cos_phi": np.cos(phi), "sin_phi": np.sin(phi), "a_y": np.ones(50)}
    expected = np.cos(phi - np.arctan(OMEGA * tau)) / np.hypot(1, OMEGA * tau)
    found = output(("lag",), w, instrument(), tau=tau)
    assert np.max(np.abs(found - expected)) < (OMEGA * tau) ** 3
    # The spin is not all: a force that grows steadily is followed late by tau.
    w |= {"d_a_y": np.full(50, 3.0), "cos_phi": np.ones(50), "sin_phi": np.zeros(50)}
    close(output(("lag",), w, instrument(), tau=tau), 1 - 3.0 * tau - (OMEGA * tau) ** 2 * np.ones(50), 1e-12)


def test_pendulum_shifts_the_accelerometer_along_the_spin_axis() -> None:
    """Seen by angular acceleration of the platform alone, K_pa is an altitude: -R beta_x."""
    none = {n: 0.0 for c in MOTION if (n := c.name).split("_")[0] in ("a", "omega")}
    w = world(**none)
    for j in range(4):
        row = signature("pendulum-angular", w, instrument(), j=j)["K_pa"]
        close(row, -base(w, instrument(), j=j)["beta_x"] / RADIUS)
    assert not np.allclose(
        signature("pendulum-angular", world(), instrument())["K_pa"],
        -base(world(), instrument())["beta_x"] / RADIUS,
    )


@pytest.mark.parametrize(
    ("id_", "name", "parameter", "factor"),
    [
        ("thermal-bias", "dK0_dT", "K0", lambda w: w["temperature"] - 293.15),
        ("thermal-scale", "dK1_dT", "K1", lambda w: 2.0 * (w["temperature"] - 293.15)),
        ("bias-drift", "dK0_dt", "K0", lambda w: w["time"]),
        ("gain-drift", "dK1_dt", "K1", lambda w: 2.0 * w["time"]),
        ("pressure-bias", "dK0_dp", "K0", lambda w: w["pressure"] - 101325),
    ],
)
def test_parameters_that_follow_a_channel(id_: str, name: str, parameter: str, factor: object) -> None:
    """Bias by the channel, scale factor by its relative change (here K1 = 2)."""
    k = instrument(K1=2.0, K0=0.1, K2=1e-3)
    w = world()
    assert callable(factor)
    close(signature(id_, w, k)[name], factor(w) * base(w, k)[parameter])


def test_gain_steps_once() -> None:
    w, k = world(), instrument(K0=0.1, K2=1e-3)
    before, after = output((), w, k), output(("gain-step",), w, k, dK1=0.25, t_step=1.5)
    late = w["time"] >= 1.5
    assert late.sum() == 25
    np.testing.assert_array_equal(after[~late], before[~late])
    close(after[late], 1.25 * before[late])


def test_magnetic_field_looks_like_horizontal_force() -> None:
    """A steady field along the rotating input axis cannot be told from a horizontal specific force."""
    w = world()
    k = instrument(vartheta_x=1e-3, vartheta_y=2e-3, vartheta_z=-3e-3)
    row = signature("magnetic-bias", w, k, j=2)["dK0_dB"]
    force = world(**{c.name: 0.0 for c in MOTION}) | {f"a_{a}": w[f"B_{a}"] for a in "xyz"}
    close(row, output((), force | {n: w[n] for n in ("cos_phi", "sin_phi")}, k, j=2))


# Second-order terms.


def test_all_of_the_angles_are_the_model_that_keeps_them() -> None:
    rng = np.random.default_rng(3)
    names = ("beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z")
    k = instrument(**dict(zip(names, 1e-2 * rng.standard_normal(5), strict=True)), K4=0.1, K6=0.2, K8=0.3)
    w = world()
    kept = output((), w, k, LIKE_REFERENCE)
    close(output(("second-order-misalignment",), w, k, PAPER, kappa=1.0), kept, 1e-14)
    dropped = output((), w, k, PAPER)
    assert np.max(np.abs(kept - dropped)) > 1e-4
    # A model that keeps them already has nothing to add.
    close(output(("second-order-misalignment",), w, k, LIKE_REFERENCE, kappa=1.0), kept, 1e-15)


def test_second_order_coefficients_absorb_the_misalignment_of_their_axes() -> None:
    """Rotating a quadratic form gives another one: kappa is a combination of K2 ... K8."""
    k = instrument(
        vartheta_x=1e-3, vartheta_y=-2e-3, vartheta_z=1.5e-3, K2=0.1, K4=0.2, K5=-0.1, K6=0.3, K7=0.4, K8=0.2
    )
    w = world()
    row = signature("second-order-misalignment", w, k)["kappa"]
    of_base = base(w, k)
    columns = np.column_stack([of_base[n] for n in ("K2", "K4", "K5", "K6", "K7", "K8")])
    left = row - columns @ np.linalg.lstsq(columns, row, rcond=None)[0]
    assert np.max(np.abs(left)) < 1e-12 * np.max(np.abs(row))


def test_vibration_is_rectified_as_its_average_says() -> None:
    """Mean output over a shake of either sign along each principal axis of P: exact for squares."""
    rng = np.random.default_rng(4)
    k = instrument(
        **dict(zip(("K2", "K4", "K5", "K6", "K7", "K8"), rng.standard_normal(6), strict=True)),
        vartheta_x=0.1, vartheta_y=-0.2, vartheta_z=0.3,
    )  # fmt: skip
    root = 0.3 * rng.standard_normal((3, 3))
    P = root @ root.T
    w = world()
    mean = output((), w, k, LIKE_REFERENCE)
    for axis in root.T:
        shaken = (
            output(
                (),
                w | {f"a_{n}": w[f"a_{n}"] + sign * axis[m] for m, n in enumerate("xyz")},
                k,
                LIKE_REFERENCE,
            )
            for sign in (1, -1)
        )
        mean = mean + sum(shaken) / 2 - output((), w, k, LIKE_REFERENCE)
    p = {f"P_{'xyz'[m]}{'xyz'[n]}": P[m, n] for m in range(3) for n in range(m, 3)}
    close(output(("vibration-rectification",), w, k, LIKE_REFERENCE, **p), mean)


def test_vibration_leaves_a_linear_accelerometer_alone() -> None:
    found = signature("vibration-rectification", world(), instrument(K0=0.1, vartheta_y=0.1))
    assert all(np.all(row == 0) for row in found.values())


# Elasticity.


def test_compliance_of_the_mount_is_absorbed_by_second_order_coefficients() -> None:
    """f_i gains (c_z . f) f_y - (c_y . f) f_z."""
    w, k = world(), instrument()
    found, of_base = signature("mount-compliance", w, k), base(w, k)
    twins = {"c_yx": ("K4", -1), "c_yy": ("K8", -1), "c_yz": ("K7", -1), "c_zx": ("K6", 1), "c_zy": ("K5", 1)}
    for name, (twin, sign) in (twins | {"c_zz": ("K8", 1)}).items():
        close(found[name], sign * of_base[twin])


def test_pendulum_feels_the_platform_turn_the_spin() -> None:
    """A steady rate about y turns the spin axis: omega x Omega lies along x, the radius of A1 at phi = 0."""
    w = world(**{c.name: 0.0 for c in MOTION} | {"omega_y": 0.3, "phi": 0.0})
    close(signature("pendulum-angular", w, instrument())["K_pa"], np.full(40, 0.3 * OMEGA))


def test_arms_stretch_with_the_force_along_them() -> None:
    """Force times what a longer radius does, and its rate times what Coriolis makes of it on the turning disc."""
    w, k = world(), instrument()
    longer = base(w, k)["dR"]

    def force(late: float) -> tuple[Array, Array]:
        """Radial and axial force an instant later, by the channels' rates."""
        phi = w["phi"] + OMEGA * late
        a = np.stack([w[f"a_{c}"] + late * w[f"d_a_{c}"] for c in "xyz"])
        omega = np.stack([w[f"omega_{c}"] + late * w[f"omegadot_{c}"] for c in "xyz"])
        omegadot = np.stack([w[f"omegadot_{c}"] + late * w[f"d_omegadot_{c}"] for c in "xyz"])
        e_r = np.stack([np.cos(phi), np.sin(phi), np.zeros(phi.size)])
        r = RADIUS * e_r
        f = a + np.cross(omegadot, r, axis=0) + np.cross(omega, np.cross(omega, r, axis=0), axis=0)
        return np.sum(f * e_r, axis=0), f[2]

    h = 1e-4
    turning = 2 * (w["omega_z"] + OMEGA)
    radial, axial = ((up - down) / (2 * h) for up, down in zip(force(h), force(-h), strict=True))
    now = force(0.0)
    close(signature("arm-stretch", w, k)["c_r"], now[0] * longer + turning * radial, 1e-7)
    close(signature("arm-sag", w, k)["c_z"], -now[1] * longer - turning * axial, 1e-7)


def test_nothing_stretches_without_rotation() -> None:
    """In a uniform field a longer arm feels nothing else."""
    w = world(**{c.name: 0.0 for c in MOTION if c.name[0] in "oG"} | {"d_spin_angle": 0.0})
    np.testing.assert_allclose(signature("arm-stretch", w, instrument())["c_r"], 0.0, atol=1e-14)


# The disc.


def test_a_common_initial_phase_is_an_offset_of_the_disc_angle() -> None:
    w = world(Gamma_xy=0.3, Gamma_xx=0.2, Gamma_zz=-0.1)
    k = instrument(beta_x=1e-2, vartheta_x=1e-2, vartheta_y=2e-2, vartheta_z=3e-2, K2=0.1, K8=0.2)
    for j in range(4):
        row = signature("spin-phase-offset", w, k, EXACT, j)["phi_0"]
        close(row, base(w, k, EXACT, j)["beta_z"])
        # A random angle has the same sensitivity.
        jitter = signature("spin-rate-jitter", w, k, EXACT, j)
        close(jitter["sigma_phi"], row)
        close(jitter["sigma_walk"], row)


def test_encoder_harmonics_are_an_offset_that_follows_the_angle() -> None:
    w, k = world(), instrument(vartheta_y=1e-2, K6=0.1)
    offset = signature("spin-phase-offset", w, k)["phi_0"]
    found = signature("encoder-harmonic", w, k)
    for n in range(1, 5):
        close(found[f"c_{n}"], np.cos(n * w["phi"]) * offset)
        close(found[f"s_{n}"], np.sin(n * w["phi"]) * offset)


def test_leaning_the_disc_is_turning_the_motion_back() -> None:
    """Without gradients only the relative orientation of disc and motion sensor counts."""
    k = instrument(
        beta_x=1e-2, beta_z=-1e-2, vartheta_x=1e-2, vartheta_y=2e-2, vartheta_z=3e-2, K4=0.1, K5=0.2
    )
    w = world()
    tilt, turned = signature("spin-axis-tilt", w, k, EXACT), signature("imu-misalignment", w, k, EXACT)
    close(tilt["alpha_x"], -turned["e_x"])
    close(tilt["alpha_y"], -turned["e_y"])
    close(signature("spin-phase-offset", w, k, EXACT)["phi_0"], -turned["e_z"])


def test_gradients_tell_a_leaning_disc_from_a_turned_sensor() -> None:
    w, k = world(Gamma_xz=0.5, Gamma_yy=0.3), instrument()
    tilt, turned = signature("spin-axis-tilt", w, k), signature("imu-misalignment", w, k)
    assert not np.allclose(tilt["alpha_y"], -turned["e_y"], atol=1e-3 * np.max(np.abs(turned["e_y"])))


def test_wobble_is_absorbed_by_the_mounting_angles() -> None:
    w = world(Gamma_xz=0.5, Gamma_yy=0.3)
    for j in range(4):
        of_base = base(w, instrument(), j=j)
        columns = np.column_stack([of_base["beta_x"], of_base["vartheta_y"]])
        for row in signature("spin-axis-wobble", w, instrument(), j=j).values():
            left = row - columns @ np.linalg.lstsq(columns, row, rcond=None)[0]
            assert np.max(np.abs(left)) < 1e-12 * np.max(np.abs(row))


def test_small_rotations_are_rotations_to_second_order() -> None:
    e = sp.symbols("e_x e_y e_z", real=True)
    scale = sp.Symbol("scale", positive=True)
    c = Context(Tape(), recorded_motion())
    turn = small_rotation(scale * sp.Matrix(e), "turn", c)
    named = dict(c.tape.assignments)
    excess = (turn * turn.T).applyfunc(lambda v: sp.expand(v.xreplace(named))) - sp.eye(3)
    assert all(sp.Poly(v, scale).monoms()[-1][0] >= 4 for v in excess if v != 0)


# The motion sensor.


def test_scaled_gyroscopes_are_undone_exactly() -> None:
    w, k = world(), instrument(K6=0.1, vartheta_y=1e-2)
    s = {"s_x": 0.5, "s_y": -0.25, "s_z": 1.0}
    recorded = w | {
        f"{n}_{a}": (1 + s[f"s_{a}"]) * w[f"{n}_{a}"] for n in ("omega", "omegadot") for a in "xyz"
    }
    close(output(("gyro-scale",), recorded, k, **s), output((), w, k), 1e-14)


def test_a_sensor_on_the_axis_of_a_steady_turn() -> None:
    """It records nothing, while the disc centre, away from it, is drawn towards the axis."""
    w = world(**{c.name: 0.0 for c in MOTION} | {"omega_z": 2.0})
    at_centre = output(("imu-lever-arm",), w, instrument(), l_x=0.5)
    true = output((), w | {"a_x": np.full(w["time"].size, 2.0**2 * 0.5)}, instrument())
    close(at_centre, true)


def test_a_late_record_is_read_at_its_later_instant() -> None:
    """For motion that is a parabola in time, the shift is exact."""
    delta, t = 0.3, np.linspace(0, 4, 40)
    parabola = {f"a_{k}": (1.0 + n) * t**2 - n * t for n, k in enumerate("xyz")}
    rates = {f"d_a_{k}": 2 * (1.0 + n) * t - n for n, k in enumerate("xyz")}
    curvature = {f"d2_a_{k}": np.full(40, 2 * (1.0 + n)) for n, k in enumerate("xyz")}
    later = {f"a_{k}": (1.0 + n) * (t + delta) ** 2 - n * (t + delta) for n, k in enumerate("xyz")}
    w = world(**{c.name: 0.0 for c in MOTION}) | {
        f"{d}_{c.name}": np.zeros(40) for d in ("d", "d2") for c in MOTION
    }
    found = output(("time-offset",), w | parabola | rates | curvature, instrument(K2=0.1), delta_t=delta)
    close(found, output((), w | later, instrument(K2=0.1)))


def test_a_late_record_leaves_disc_and_gradients_in_time() -> None:
    w = world(**{c.name: 0.0 for c in MOTION}) | {
        f"{d}_{c.name}": np.zeros(40) for d in ("d", "d2") for c in MOTION
    }
    assert np.all(
        signature("time-offset", w | {"Gamma_xy": np.linspace(0, 1, 40)}, instrument())["delta_t"] == 0
    )


# Gravity.


def test_self_gradient_is_a_gradient_that_turns_with_the_platform() -> None:
    w, k = world(), instrument(beta_x=1e-2, vartheta_y=1e-2)
    found, of_base = signature("self-gradient", w, k), base(w, k)
    for angle in ("roll", "pitch"):
        for c in ("xy", "xz", "yz"):
            close(found[f"G_{c}_{angle}"], np.sin(w[angle]) * of_base[f"Gamma_{c}"])
        for c in ("xx", "yy"):
            # No trace: what one diagonal component gains, zz loses.
            close(
                found[f"G_{c}_{angle}"],
                np.sin(w[angle]) * (of_base[f"Gamma_{c}"] - of_base["Gamma_zz"]),
            )


def near_field(e: Effect) -> tuple[sp.Matrix, sp.Matrix]:
    r = sp.Matrix(sp.symbols("x y z", real=True))
    assert e.field is not None
    return e.field(r, e.values, Context(Tape(), recorded_motion())), r


def test_field_of_a_near_mass_obeys_laplace_and_has_no_curl() -> None:
    f, r = near_field(NEAR_MASS)
    assert sp.expand(sum(sp.diff(f[n], r[n]) for n in range(3))) == 0
    for m in range(3):
        for n in range(m):
            assert sp.expand(sp.diff(f[m], r[n]) - sp.diff(f[n], r[m])) == 0
    assert all({sum(m) for m in sp.Poly(v, *r).monoms()} == {2, 3} for v in f)


def test_a_point_mass_converges_to_its_third_order_tensor() -> None:
    """Newton's law less its value and gradient at the centre; what comes next falls with the distance's square."""
    f, r = near_field(NEAR_MASS)
    x = sp.Matrix(sp.symbols("x y z", real=True))
    s = sp.symbols("s_x s_y s_z", real=True)
    potential = 1 / sp.sqrt(sum((v - c) ** 2 for v, c in zip(x, s, strict=True)))
    direction, place_ = np.array([0.6, -0.48, 0.64]), np.array([0.08, 0.05, -0.03])
    errors = []
    for distance in (2.0, 4.0):
        centre = {**dict.fromkeys(x, 0), **dict(zip(s, distance * direction, strict=True))}
        values = {}
        for q in NEAR_MASS.parameters:
            axes = [x["xyz".index(k)] for k in q.name.removeprefix("T_")]
            values[NEAR_MASS.symbol(q)] = sp.diff(potential, *axes).subs(centre)
        here = dict(zip(r, place_, strict=True))
        found = np.array(f.subs(values).subs(here), dtype=float).ravel()
        away = distance * direction
        attraction = (away - place_) / np.linalg.norm(away - place_) ** 3 - away / distance**3
        gradient = (3 * np.outer(direction, direction) - np.eye(3)) / distance**3
        expected = -(attraction - gradient @ place_)
        errors.append(np.linalg.norm(found - expected) / np.linalg.norm(expected))
    assert errors[0] < 0.1
    assert errors[1] == pytest.approx(errors[0] / 4, rel=0.1)


def test_opposite_accelerometers_cancel_a_near_mass() -> None:
    """Its third derivatives, even in r; the fourth add up.

    With perfect mounting, arms and input axes are in the plane, where no z is seen.
    """
    w = world()
    first, second = (signature("near-mass", w, instrument(), j=j) for j in (0, 1))
    for name, row in first.items():
        if name.endswith("z"):
            assert np.all(row == 0)
        else:
            assert np.any(row != 0)
            close(second[name], -row if len(name) == len("T_xxx") else row)
