"""Full kinematics against the second derivative of where a point of the turning disc is, to fifty digits.

Attitude and disc angle are given as functions of time and exact rotations; rates and accelerations that the
derivation takes as inputs are read off them by numerical differentiation. Nothing is shared with it.
"""

from __future__ import annotations

from collections.abc import Callable

import mpmath as mp
import pytest
from evaluated import place, voltage

from derive.effects import catalogue
from derive.stages import EXACT
from derive.symbols import ACCELEROMETER, MOTION, SPIN_ACCELERATION, SPIN_RATE

DIGITS = 50
NOW = mp.mpf("0.7")
Function = Callable[[mp.mpf], mp.matrix]
DISC_SPIN = next(e for e in catalogue() if e.id == "disc-spin")


def about(axis: int, angle: mp.mpf) -> mp.matrix:
    """Right-handed rotation about x, y or z."""
    c, s = mp.cos(angle), mp.sin(angle)
    i, k = (axis + 1) % 3, (axis + 2) % 3
    turn = mp.eye(3)
    turn[i, i] = turn[k, k] = c
    turn[i, k], turn[k, i] = -s, s
    return turn


def attitude(t: mp.mpf) -> mp.matrix:
    """From the measurement frame to inertial space, tumbling about all axes."""
    first = about(2, mp.mpf("0.3") + mp.mpf("0.4") * t + mp.mpf("0.1") * mp.sin(3 * t))
    second = about(1, mp.mpf("0.2") * mp.cos(2 * t))
    return first * second * about(0, mp.mpf("-0.5") * t + mp.mpf("0.2") * mp.sin(t))


def centre(t: mp.mpf) -> mp.matrix:
    """The disc centre in inertial space, m."""
    return mp.matrix([mp.sin(2 * t), t**3 / 5, mp.exp(-t) * mp.cos(t)])


def angle(t: mp.mpf) -> mp.mpf:
    """A spin that varies, rad."""
    return mp.mpf("1.6") * t + mp.mpf("0.05") * mp.sin(5 * t) + t**2 / 20


def derivative(f: Function, t: mp.mpf, order: int = 1) -> mp.matrix:
    shape = f(t)
    return mp.matrix(
        shape.rows,
        shape.cols,
    ) + mp.matrix(
        [
            [mp.diff(lambda s, i=i, k=k: f(s)[i, k], t, order) for k in range(shape.cols)]
            for i in range(shape.rows)
        ]
    )


def rate(t: mp.mpf) -> mp.matrix:
    """Angular rate in the measurement frame: A^T A' is its cross product."""
    turning = attitude(t).T * derivative(attitude, t)
    return mp.matrix([turning[2, 1], turning[0, 2], turning[1, 0]])


def inputs(t: mp.mpf) -> dict[str, mp.mpf]:
    """What the instrument would record, gradients zero."""
    known: dict[str, mp.mpf] = {c.name: mp.mpf(0) for c in MOTION}
    series = {
        "a": attitude(t).T * derivative(centre, t, 2),
        "omega": rate(t),
        "omegadot": derivative(rate, t),
    }
    known |= {f"{n}_{'xyz'[k]}": v[k] for n, v in series.items() for k in range(3)}
    known[SPIN_RATE.name], known[SPIN_ACCELERATION.name] = mp.diff(angle, t), mp.diff(angle, t, 2)
    known["cos_phi"], known["sin_phi"] = mp.cos(angle(t)), mp.sin(angle(t))
    return known


def force(arm: mp.matrix, t: mp.mpf) -> mp.matrix:
    """Inertial acceleration of a point fixed to the disc, in the measurement frame, m/s^2."""

    def where(s: mp.mpf) -> mp.matrix:
        return centre(s) + attitude(s) * about(2, angle(s)) * arm

    return attitude(t).T * derivative(where, t, 2)


@pytest.fixture(autouse=True)
def fifty_digits():
    with mp.workdps(DIGITS):
        yield


@pytest.mark.parametrize("way", ["full kinematics", "disc-spin, share 1"])
@pytest.mark.parametrize("j", range(4))
def test_the_chain_feels_what_its_place_on_the_disc_does(way: str, j: int) -> None:
    """V_j of a mounted accelerometer, exact angles: the force along its axes, from positions alone."""
    k = {q.name: 0.0 for q in ACCELEROMETER} | {"K1": 1.0, "k_VI": 1.0, "beta_x": 0.02, "beta_z": -0.03}
    k |= {"vartheta_z": 0.01, "radius": 0.1, "spin_frequency": 0.25, "dR": 0.003}
    effects, kinematics = ((), "full") if way == "full kinematics" else ((DISC_SPIN,), "platform")
    V = voltage(effects, EXACT, kinematics)
    known = {n: float(v) for n, v in inputs(NOW).items()}
    found = float(V(known | k | place(j) | {"disc_spin__share": 1.0})["V"])

    quarter = (0, 2, 1, 3)[j]
    at = about(2, quarter * mp.pi / 2 + mp.mpf(k["beta_z"]))
    arm = (
        at
        * mp.matrix([mp.cos(k["beta_x"]), 0, mp.sin(k["beta_x"])])
        * (mp.mpf(k["radius"]) + mp.mpf(k["dR"]))
    )
    on_disc = about(2, angle(NOW)).T * force(arm, NOW)
    tau_x = at * mp.matrix([0, 1, 0])
    tau_y = at * mp.matrix([mp.cos(k["beta_x"]), 0, -mp.sin(k["beta_x"])])  # the triad dips (Eq. 19)
    axis = mp.cos(k["vartheta_z"]) * tau_x + mp.sin(k["vartheta_z"]) * tau_y
    expected = (axis.T * on_disc)[0]
    assert abs(found - float(expected)) < 1e-15
