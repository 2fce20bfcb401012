"""The tape: derivatives, degrees, rates; and full kinematics against positions on a turning disc, to fifty digits."""

from __future__ import annotations

from collections.abc import Callable

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
from evaluated import place, voltage

from derive import ir
from derive.chain import recorded_motion
from derive.effect import Context
from derive.effects import catalogue
from derive.hooks import small_rotation
from derive.layout import SymbolicForm
from derive.stages import EXACT
from derive.symbols import ACCELEROMETER, MOTION, SPIN_ACCELERATION, SPIN_RATE
from derive.tape import Tape, partials
from tests.derive.evaluated import Evaluated, neutral_values

X, Y, Z = sp.symbols("x y z", real=True)


@pytest.mark.parametrize(
    "e",
    [
        sp.Integer(3),
        X,
        3 * X * Y**2 - Z / 7,
        (X + Y) * (X - Z) ** 3 * (Y * Z + 2),
        X / (1 + Y) ** 2 + sp.sqrt(1 + Z**2),
        sp.sin(X * Y) * sp.cos(Z) + Y * sp.Abs(Y),
        X**Y + sp.exp(X * Z),
        sp.pi * X * sp.Heaviside(Y, 1),
    ],
    ids=str,
)
def test_partials_are_derivatives(e: sp.Expr) -> None:
    found = partials(e)
    assert list(found) == sorted(found, key=lambda s: s.name)
    assert 0 not in found.values()
    for s in (X, Y, Z):
        assert (
            sp.simplify(
                found.get(s, sp.Integer(0)) - sp.diff(e, s).replace(sp.DiracDelta, lambda *_: sp.Integer(0))
            )
            == 0
        )


@pytest.mark.parametrize(
    "e",
    [
        X / sp.sin(sp.sign(X / Y)),
        sp.sin(sp.Abs(sp.sqrt(X)) * Y),
        Z * sp.exp(sp.sign(sp.sqrt(X) - Y)),
        sp.tanh(sp.Abs(X / Y) * Z),
    ],
    ids=str,
)
def test_no_derivative_is_left_open(e: sp.Expr) -> None:
    """Of functions of signs and moduli whose argument SymPy does not know to be real; against differences."""
    at, h = {X: 0.7, Y: 1.3, Z: -0.4}, 1e-6
    found = partials(e)
    for s in at:
        ends = [e.subs(at | {s: at[s] + d}).evalf() for d in (h, -h)]
        slope = found.get(s, sp.Integer(0)).subs(at).evalf()
        assert float(slope) == pytest.approx(float(ends[0] - ends[1]) / (2 * h), abs=1e-6)


def test_what_cancels_is_left_out() -> None:
    assert partials((X + Y) * 2 - 2 * X + Z) == {Y: 2, Z: 1}


def test_a_name_holds_one_value() -> None:
    tape = Tape()
    first = tape.let("product", X * Y)
    assert tape.let("product", Y * X) is first
    assert len(tape.assignments) == 1
    other = tape.let("product", X + Y)
    assert other != first
    assert tape.let("product", X + Y) is other
    assert [v for _, v in tape.assignments] == [X * Y, X + Y]
    assert tape.let("a_x", X**2).name != "a_x", "a channel has this name"


FULL = SymbolicForm(kinematics="full")
# those that differentiate by time, and some whose parameters stand under their derivatives
NESTED = ("encoder-harmonic", "gyro-delay", "time-offset", "lag")


def test_signatures_are_the_derivatives_of_the_whole_model_at_neutral_values() -> None:
    effects = [e for e in catalogue() if e.id in NESTED]
    assert len(effects) == len(NESTED)
    short = ir.chain((), "s", "", FULL, effects).derivatives
    whole = ir.chain(effects, "w", "", FULL).derivatives
    rng = np.random.default_rng(1)
    names = sorted({s.name for program in (short, whole) for s in program.inputs})
    values = {n: rng.normal(size=5) for n in names}
    values |= {s.name: np.full(5, float(v)) for s, v in neutral_values(effects).items()}
    found, expected = Evaluated(short)(values), Evaluated(whole)(values)
    rows = [n for n in found if n in expected]
    assert len(rows) == len(found) >= 8
    for n in rows:
        np.testing.assert_allclose(
            found[n], expected[n], rtol=1e-12, atol=1e-12 * np.max(np.abs(expected[n])), err_msg=n
        )


def test_small_rotations_are_rotations_to_second_order() -> None:
    e = sp.symbols("e_x e_y e_z", real=True)
    scale = sp.Symbol("scale", positive=True)
    c = Context(Tape(), recorded_motion())
    turn = small_rotation(scale * sp.Matrix(e), "turn", c)
    named = dict(c.tape.assignments)
    excess = (turn * turn.T).applyfunc(lambda v: sp.expand(v.xreplace(named))) - sp.eye(3)
    assert all(sp.Poly(v, scale).monoms()[-1][0] >= 4 for v in excess if v != 0)


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
    rows, columns = f(t).rows, f(t).cols
    of = [[mp.diff(lambda s, i=i, k=k: f(s)[i, k], t, order) for k in range(columns)] for i in range(rows)]
    return mp.matrix(of)


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
