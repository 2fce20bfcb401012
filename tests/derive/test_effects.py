"""The physics of single effects: limits, symmetries, and what existing parameters absorb of them."""

from __future__ import annotations

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


def test_the_catalogue_holds_the_interface() -> None:
    """Ids that users write: the effect's file may change, its name not."""
    names = (
        "arm-sag arm-stretch bias-drift cubic-cross cubic-input encoder-harmonic gain-drift gain-step gyro-scale "
        "imu-lever-arm imu-misalignment lag magnetic-bias mount-compliance near-mass odd-quadratic pendulum-angular "
        "pressure-bias quantisation saturation second-order-misalignment self-gradient spin-axis-tilt spin-axis-wobble "
        "spin-phase-offset spin-rate-jitter thermal-bias thermal-scale time-offset vibration-rectification"
    )
    assert set(names.split()) <= set(EFFECT)
    assert [e.id for e in catalogue()] == sorted(EFFECT)


def test_display_units_follow_g() -> None:
    """ug/g^3 of a coefficient of f^3 in m/s^2: 1e-6 g / g^3 = 1e-6 / g^2."""
    known = units(G0)
    assert known.to_si(1.0, EFFECT["cubic-input"].parameters[0].unit, "1/(m/s^2)^2") == pytest.approx(
        1e-6 / G0**2
    )
    assert known.to_si(1.0, EFFECT["arm-stretch"].parameters[0].unit, "m/(m/s^2)") == pytest.approx(1e-6 / G0)


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


# Gravity.


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
