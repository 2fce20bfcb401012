"""What the hooks of several effects have in common, each kind below its heading."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product

import sympy as sp

from derive.effect import Context, EffectParameter, Parameters, Values, shared
from derive.stages import NOMINAL_TRIAD, Geometry, misalignment_matrix, skew
from derive.symbols import COS_J, SIN_J, symbol

# --- Parameters of the accelerometers that follow something, linearly: time, temperature, pressure, or an instant passed ---

REFERENCE_KELVIN = sp.Rational(29315, 100)
"""Temperature at which the test sheet's values hold; another one is absorbed by them."""

REFERENCE_PASCAL = sp.Integer(101325)
"""Pressure at which they hold."""

T_STEP = shared("t_step", "t_s", "s", "instant of the step", 1.0, fitted=False)
"""Of every effect that begins at once; the diagnosis estimates it."""

Driver = Callable[[Values, Context], sp.Expr]
Instrument = Callable[[Parameters, Values, Context], Parameters]


def elapsed(p: Values, c: Context) -> sp.Expr:
    """Time, s."""
    return c.time


def warmth(p: Values, c: Context) -> sp.Expr:
    """Temperature above that of the sheet, K."""
    return c.channel("temperature") - REFERENCE_KELVIN


def overpressure(p: Values, c: Context) -> sp.Expr:
    """Pressure above that of the sheet, Pa."""
    return c.channel("pressure") - REFERENCE_PASCAL


def begun(p: Values, c: Context) -> sp.Expr:
    """1 from the instant ``t_step`` of the effect on, else 0."""
    return sp.Heaviside(c.time - p.t_step, 1)


def following(name: str, slope: str, driver: Driver) -> Instrument:
    """The hook of an effect by whose parameter ``slope`` that of the accelerometers follows; K1 relatively."""

    def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
        change = p[slope] * driver(p, c)
        return {name: k[name] * (1 + change) if name == "K1" else k[name] + change}

    return instrument


# --- What an instrument remembers: series that the runtime forms of the record, as channels of the derivation ---
# A Taylor series in a period or a time constant fails where it is as long as what is recorded. So the record itself is passed
# through what has the memory, at the values to which a fit has come (``ragg_runtime.model.memory``), with derivatives by them: a
# hook has only to say where the response enters, and how it changes with what is left of these values, their distance from the
# neutral ones.

FREQUENCY, QUALITY = 5.0, 10.0
"""Hz, and 1: where a search begins. Isolators and stabilised platforms resonate at 2 to 20 Hz, with Q from 3 to 30."""


def _shape(
    name: str, latex: str, unit: str, meaning: str, plausible: float, neutral: float
) -> EffectParameter:
    return shared(name, latex, unit, meaning, plausible, neutral=neutral, shape=True)


RESONANCE = (
    _shape("f_0", "f_0", "Hz", "frequency of the resonance", 3.0, FREQUENCY),
    _shape("Q", "Q", "1", "its quality factor", 5.0, QUALITY),
)

HEAT = (_shape("tau", r"\tau", "s", "time constant of the heat", 20.0, 40.0),)
"""A search begins at 40 s: a torquer in its housing takes from ten seconds to ten minutes."""

RELAXATION = (_shape("tau", r"\tau", "s", "time constant of the creep", 20.0, 20.0),)
"""Creep goes on in every decade of time: one that a record of minutes shows is of seconds to minutes."""

SLIP = (_shape("w", "w", "m/s^2", "force at which it slips", 0.02, 0.01),)
"""A milli-g; a search begins at a share of what the record's force changes by."""

THERMAL_SLIP = (_shape("w", "w", "K", "change at which it slips", 0.1, 0.1),)


def response(name: str, p: Values, c: Context, by: Sequence[EffectParameter] = ()) -> sp.Expr:
    """The series of this name, as it changes with the parameters ``by``; without, where these changes are too small to matter."""
    changes = ((p[q.name] - sp.Float(q.neutral)) * c.channel(f"{name}_by_{q.name}") for q in by)
    return sp.Add(c.channel(name), *changes)


def axes_on_disc(c: Context) -> sp.Matrix:
    """(3, 3): nominal x, y and z axis of the accelerometer, a row each, along axes that turn with the disc, of angle 0 on it."""
    axes = NOMINAL_TRIAD.T if c.turn_of_triad is None else c.turn_of_triad * NOMINAL_TRIAD.T
    return axes.T * sp.Matrix([[COS_J, SIN_J, 0], [-SIN_J, COS_J, 0], [0, 0, 1]])


def remembered_force(kind: str, p: Values, c: Context, by: Sequence[EffectParameter]) -> sp.Matrix:
    """(3,): what a memory of this ``kind``, which ``by`` describe, makes of the force along the accelerometer's nominal axes."""
    names = ("radial", "tangential", "axial")
    return axes_on_disc(c) * sp.Matrix([response(f"{kind}_{n}", p, c, by) for n in names])


def heat_of_force(p: Values, c: Context) -> sp.Expr:
    """Square of the force along the input axis as the torquer's heat remembers it, m^2/s^4."""
    axis, terms = axes_on_disc(c)[0, :], []
    for i, a in enumerate("rta"):
        for k, b in enumerate("rta"[i:], i):
            weight = axis[i] * axis[k] * (1 if i == k else 2)
            terms += [weight * response(f"heat_{a}{b}", p, c, HEAT)] if weight != 0 else []
    return sp.Add(*terms)


# --- Second-order coefficients and small rotations ---


def rectified(P: sp.Matrix, c: Context) -> sp.Expr:
    """Mean of the second-order terms of Eq. 1 over a force of covariance P (3 x 3, measurement frame), m/s^2."""
    k = c.parameters
    axes = misalignment_matrix(k["vartheta_x"], k["vartheta_y"], k["vartheta_z"]) * c.geometry.tau
    axes = c.tape.let_each("vibration_axis", axes, rows="iop")
    seen = axes * c.in_disc_frame(P) * axes.T
    # Mean of Eq. 1 over force with the covariance ``seen`` along i, o, p: only second powers survive.
    return (
        k["K2"] * seen[0, 0]
        + k["K5"] * seen[1, 1]
        + k["K7"] * seen[2, 2]
        + k["K4"] * seen[0, 2]
        + k["K6"] * seen[0, 1]
        + k["K8"] * seen[1, 2]
    )


def small_rotation(vector: sp.Matrix, name: str, c: Context) -> sp.Matrix:
    """Right-handed rotation about ``vector`` by its length (rad), to second order, (3, 3).

    Polynomial, hence differentiable where the vector vanishes (unlike Rodrigues' formula with its length);
    it departs from a rotation by vector^3/6, 2e-13 for 1e-4 rad. Its entries are named ``name_xx`` ... on
    the tape.
    """
    k = skew(vector)
    turn = sp.eye(3) + k + k * k / 2
    return c.tape.let_each(name, turn)


def lean(g: Geometry, vector: sp.Matrix, name: str, c: Context) -> Geometry:
    """Position and triad, turned together by a small rotation ``vector`` (rad) of the same frame."""
    turn = small_rotation(vector, name, c)
    return Geometry(turn * g.r, (turn * g.tau.T).T)


# --- Gravity of a body beside the instrument, derived from its potential ---

G = sp.Float("6.6743e-11")
"""Newton's constant, m^3 kg^-1 s^-2 (CODATA 2018)."""

CHANNELS = ("mass_x", "mass_y", "mass_z")
"""How far the body has moved, m, along the measurement axes."""

MASS = shared("M", "M", "kg", "mass of the body", 100.0)
PLACE = tuple(
    shared(k, k, "m", f"{k} of its centre where mass_{k} is 0", 0.05, neutral=1.0, shape=True) for k in "xyz"
)

_AT = sp.Matrix([symbol(f"body_{k}") for k in "xyz"])
_POTENTIAL = 1 / sp.sqrt(_AT.dot(_AT))
"""Of a point for a unit of G M, by its place."""


def place(p: Values, c: Context) -> sp.Matrix:
    """(3,) m: the body's centre, from that of the disc along the measurement axes."""
    return sp.Matrix([c.tape.let(f"body_{k}", p[k] + c.channel(f"mass_{k}")) for k in "xyz"])


def of_point(p: Values, c: Context, r: sp.Matrix) -> sp.Matrix:
    """(3,) m/s^2: what a point attracts at r more than at the disc's centre; of a sphere outside it is the same."""
    away, centre = place(p, c) - r, place(p, c)
    slope = -_POTENTIAL.diff(_AT)  # by where it is felt
    at_point, at_centre = (slope.xreplace(dict(zip(_AT, v, strict=True))) for v in (away, centre))
    return G * p["M"] * (at_point - at_centre)


def gradient_of_point(p: Values, c: Context) -> sp.Matrix:
    """(3, 3) s^-2, at the disc's centre."""
    return G * p["M"] * sp.hessian(_POTENTIAL, list(_AT)).xreplace(dict(zip(_AT, place(p, c), strict=True)))


def gradient_of_cuboid(p: Values, c: Context) -> sp.Matrix:
    """(3, 3) s^-2, at the disc's centre, of a homogeneous body with edges l_x, l_y, l_z along the measurement axes.

    The potential is the integral of G rho/s over the body. A derivative by where it is felt is, but for its sign, one by where the
    mass is, which undoes an integration: two by different axes leave the integral of 1/s along the four edges of the third, two by the
    same one that of x/s^3 over two faces, the solid angles at which they are seen.
    """
    at, edges = place(p, c), [p[f"l_{k}"] for k in "xyz"]
    corners = {
        ends: sp.Matrix([at[n] + edges[n] * sp.Rational(e, 2) for n, e in enumerate(ends)])
        for ends in product((-1, 1), repeat=3)
    }
    far = {ends: c.tape.let(f"corner_{n}", sp.sqrt(v.dot(v))) for n, (ends, v) in enumerate(corners.items())}

    def face(axis: int, side: int) -> sp.Expr:
        """Solid angle, negative of what is on the other side: that of two triangles (A. van Oosterom and J. Strackee, 1983)."""
        ring = [_ends({axis: side, (axis + 1) % 3: a, (axis + 2) % 3: b}) for a, b in _AROUND]
        total = []
        for triangle in ((ring[0], ring[1], ring[2]), (ring[0], ring[2], ring[3])):
            (u, v, w), (a, b, d) = ([of[ends] for ends in triangle] for of in (corners, far))
            volume, cosine = u.dot(v.cross(w)), a * b * d + a * v.dot(w) + b * u.dot(w) + d * u.dot(v)
            total.append(2 * sp.atan2(c.tape.let("face_volume", volume), c.tape.let("face_cosine", cosine)))
        return sp.Add(*total)

    def edge(axis: int, others: dict[int, int]) -> sp.Expr:
        """Integral of 1/s along it."""
        both = sp.Add(*(far[_ends({axis: e, **others})] for e in (-1, 1)))
        return sp.log((both + edges[axis]) / (both - edges[axis]))

    def component(i: int, k: int) -> sp.Expr:
        if i == k:
            return face(i, -1) - face(i, 1)
        return sp.Add(*(a * b * edge(3 - i - k, {i: a, k: b}) for a, b in product((-1, 1), repeat=2)))

    density = G * p["M"] / sp.prod(edges)
    of = {(i, k): component(i, k) for i, k in ((0, 0), (1, 1), (0, 1), (0, 2), (1, 2))}
    of[2, 2] = -of[0, 0] - of[1, 1]  # outside of masses
    return sp.Matrix(3, 3, lambda i, k: density * of[min(i, k), max(i, k)])


_AROUND = ((-1, -1), (1, -1), (1, 1), (-1, 1))


def _ends(by_axis: dict[int, int]) -> tuple[int, ...]:
    return tuple(by_axis[n] for n in range(3))
