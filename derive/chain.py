"""The instrument as a chain of stages, with the changes that effects make to it.

One generic accelerometer is written down, at the disc angle phi plus the constant angle of its nominal
place (cos_j, sin_j); the four of them and G_out follow from it (Eq. 15).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from derive import stages
from derive.effect import OMEGA, Context, Effect, Values
from derive.layout import AXES, HEIGHT, PAPERS, TURN, SymbolicForm, SymbolicLayout
from derive.names import id_in_code
from derive.stages import Force, Geometry, Motion, Order, SensedForce, Spin
from derive.symbols import (
    ACCELEROMETER,
    COMPONENTS,
    COS_J,
    COS_PHI,
    MOTION,
    SIN_J,
    SIN_PHI,
    SPIN_ACCELERATION,
    SPIN_RATE,
    Channel,
    symbol,
    symmetric,
)
from derive.tape import Tape


def recorded_motion() -> Motion:
    """The motion as it is recorded: one symbol a channel."""
    v = {c.name: c.symbol for c in MOTION}
    vector = {n: sp.Matrix([v[f"{n}_{k}"] for k in "xyz"]) for n in ("a", "omega", "omegadot")}
    return Motion(vector["a"], vector["omega"], vector["omegadot"], symmetric(v, "Gamma"))


@dataclass(frozen=True)
class Accelerometer:
    """The recorded chain of one accelerometer: its tape, and V_j in volts."""

    tape: Tape
    voltage: sp.Expr


def accelerometer(
    effects: Sequence[Effect] = (), form: SymbolicForm = PAPERS, candidates: Sequence[Effect] = ()
) -> Accelerometer:
    """Write down V_j of the generic accelerometer (Eq. 1-14) with these effects, on a tape.

    Of ``candidates`` among them only the first order in their parameters is kept where these are zero. From the end of
    the stage ``sensing`` on, everything is resolved along the axes of the disc at rest.
    """
    tape, layout = Tape(), form.layout
    hooked = [(e, e.values) for e in effects]
    c = Context(tape, recorded_motion(), Omega=OMEGA if form.kinematics == "platform" else SPIN_RATE)
    c.small = frozenset(s for e in candidates for s in _list_fitted(e) if e.at_zero)
    c.enter(frozenset())
    _sensing(hooked, c, layout)
    _turn_disc(hooked, c)
    M = stages.gradient(c.motion if form.kinematics == "platform" else c.case).applyfunc(sp.sympify)
    at = _Place(
        hooked=hooked,
        c=c,
        order=form.order,
        layout=layout,
        M=tape.let_each("M", M),
        cos_psi=tape.let("cos_psi", c.cos_phi * COS_J - c.sin_phi * SIN_J),
        sin_psi=tape.let("sin_psi", c.sin_phi * COS_J + c.cos_phi * SIN_J),
    )
    k: dict[str, sp.Expr] = {q.name: q.symbol for q in ACCELEROMETER}
    c.parameters = dict(k)
    if any(e.instrument for e in effects):
        c.geometry, c.sensed, c.force = at.forces(k, "b")
        for e, p in _one_by_one(hooked, c):
            if e.instrument:
                changed = e.instrument(k, p, c)
                k |= {n: tape.let(f"{n}_{id_in_code(e.id)}", v) for n, v in changed.items()}
    c.geometry, f, c.force = at.forces(k, "f")
    c.sensed, c.parameters = f, dict(k)
    q = f if form.order.second_order_angles else at.forces(k, "q")[1]
    i = _transducer(hooked, c, f, q, k)
    return Accelerometer(tape, tape.let("V", k["k_VI"] * k["K1"] * i))


Hooked = Sequence[tuple[Effect, Values]]


def _list_fitted(e: Effect) -> frozenset[sp.Symbol]:
    return frozenset(e.symbol(q) for q in e.parameters if q.fitted)


def _one_by_one(hooked: Hooked, c: Context) -> Iterator[tuple[Effect, Values]]:
    """Apply one effect after another; the context holds whose hook is called."""
    for e, p in hooked:
        c.enter(_list_fitted(e))
        yield e, p
    c.enter(frozenset())


def _sensing(hooked: Hooked, c: Context, layout: SymbolicLayout) -> None:
    """Stage 1: the motion at the disc centre, by the axes of the disc at rest."""
    c.standing = AXES if layout.has(AXES[0, 0]) else None
    c.turn_of_triad = TURN if layout.has(TURN[0, 0]) else None
    for e, p in _one_by_one(hooked, c):
        if e.sensing:
            c.motion = _named_motion(c.tape, id_in_code(e.id), e.sensing(c.motion, p, c))
    if c.standing is not None:
        c.axes = AXES
        c.motion = _named_motion(c.tape, "disc", stages.in_frame(c.motion, AXES))


def _turn_disc(hooked: Hooked, c: Context) -> None:
    """The true disc angle and its rates, where effects change them."""
    let = c.tape.let
    increment = sp.Add(*(e.disc_angle(p, c) for e, p in _one_by_one(hooked, c) if e.disc_angle))
    if increment == 0:
        return
    d = let("delta_phi", increment)
    cos_d, sin_d = let("cos_delta_phi", sp.cos(d)), let("sin_delta_phi", sp.sin(d))
    c.cos_phi = let("cos_phi_true", COS_PHI * cos_d - SIN_PHI * sin_d)
    c.sin_phi = let("sin_phi_true", SIN_PHI * cos_d + COS_PHI * sin_d)
    swing = let("rate_delta_phi", c.rate(d))
    c.spin = Spin(
        let("spin_rate_true", SPIN_RATE + swing),
        let("spin_acceleration_true", SPIN_ACCELERATION + c.rate(swing)),
    )


@dataclass(frozen=True)
class _Place:
    """Where an accelerometer is, and stages 2 and 3 there.

    Attributes
    ----------
    M
        Eq. 10, named.
    cos_psi, sin_psi
        Of the angle of its place.
    """

    hooked: Hooked
    c: Context
    order: Order
    layout: SymbolicLayout
    M: sp.Matrix
    cos_psi: sp.Expr
    sin_psi: sp.Expr

    def forces(self, k: Mapping[str, sp.Expr], label: str) -> tuple[Geometry, SensedForce, Force]:
        """Geometry, sensed force and force along the nominal triad, with parameters k; names begin with ``label``."""
        let = self.c.tape.let
        g = self._geometry(k, label)
        f = self._force(g, k, label)
        resolved = Force(*(let(f"{label}_f_{'xyz'[n]}j", g.tau[n, :].dot(f)) for n in range(3)))
        if label == "q":
            return g, SensedForce(*resolved), resolved
        vartheta = (k["vartheta_x"], k["vartheta_y"], k["vartheta_z"])
        sensed = stages.sensed_force(resolved, vartheta, self.order)
        named = (let(f"{label}_f_{n}", v) for n, v in zip("iop", sensed, strict=True))
        return g, SensedForce(*named), resolved

    def _geometry(self, k: Mapping[str, sp.Expr], label: str) -> Geometry:
        angles = {n: k[n] for n in ("beta_x", "beta_z")}
        if label == "q":  # second-order terms, whose angles the order counting drops
            angles = {n: sp.Integer(0) for n in angles}
        arm = symbol("radius") + k["dR"]
        g = stages.mounting(
            arm, order=self.order, height=self._height, turn_of_triad=self.c.turn_of_triad, **angles
        )
        g = _named_geometry(self.c.tape, f"{label}_disc", g)
        g = _named_geometry(self.c.tape, label, stages.to_measurement_frame(g, self.cos_psi, self.sin_psi))
        for e, p in _one_by_one(self.hooked, self.c):
            if e.geometry:
                g = _named_geometry(self.c.tape, f"{label}_{id_in_code(e.id)}", e.geometry(g, p, self.c))
        return g

    @property
    def _height(self) -> sp.Expr:
        return HEIGHT if self.layout.has(HEIGHT) else sp.Integer(0)

    def _force(self, g: Geometry, k: Mapping[str, sp.Expr], label: str) -> sp.Matrix:
        """Eq. 11 with what effects add, in the measurement frame, named."""
        f = self.c.motion.a + self.M * g.r
        for e, p in _one_by_one(self.hooked, self.c):
            if e.field:
                f = f + e.field(g.r, p, self.c)
        if k["dR"] != symbol("dR"):  # an arm that changes its length
            lifted, length = sp.Matrix([0, 0, self._height]), symbol("radius") + k["dR"]
            arm = self.c.tape.let_each(f"{label}_arm", (g.r - lifted) / length)
            growth = self.c.rate(k["dR"])
            f = f + stages.of_growing_arm(self.c.case, arm, growth, self.c.rate(growth))
        return self.c.tape.let_each(f"{label}_f", f)


def _transducer(hooked: Hooked, c: Context, f: SensedForce, q: SensedForce, k: dict[str, sp.Expr]) -> sp.Expr:
    """Stage 4: I_j/K_j1; the second-order terms see q."""
    let = c.tape.let
    for e, p in _one_by_one(hooked, c):
        if e.second_order:
            changed = zip("iop", e.second_order(q, f, p, c), strict=True)
            q = SensedForce(*(let(f"q_{n}_{id_in_code(e.id)}", v) for n, v in changed))
    i = let("i_sensed", stages.transducer(f, q, k))
    for e, p in _one_by_one(hooked, c):
        if e.transducer:
            i = let(f"i_{id_in_code(e.id)}", e.transducer(i, f, p, c))
    return i


def _named_motion(tape: Tape, label: str, m: Motion) -> Motion:
    at = [("xyz".index(k[0]), "xyz".index(k[1])) for k in COMPONENTS]
    G = {f"G_{k}": tape.let(f"{label}_Gamma_{k}", m.Gamma[i]) for k, i in zip(COMPONENTS, at, strict=True)}
    a, omega, omegadot = (tape.let_each(f"{label}_{n}", getattr(m, n)) for n in ("a", "omega", "omegadot"))
    return Motion(a, omega, omegadot, symmetric(G, "G"))


def _named_geometry(tape: Tape, label: str, g: Geometry) -> Geometry:
    return Geometry(tape.let_each(f"{label}_r", g.r), tape.let_each(f"{label}_tau", g.tau))


def auxiliary_channel(name: str) -> Channel:
    """A channel beyond the motion: a derivative ``d_a_x`` ..., or an auxiliary that an effect declares."""
    for prefix, meaning in (("d_", "time derivative"), ("d2_", "second time derivative")):
        if name.startswith(prefix):
            return Channel(name, name, "", f"{meaning} of {name.removeprefix(prefix)}")
    return Channel(name, rf"\mathrm{{{name}}}", "", f"auxiliary channel {name}")
