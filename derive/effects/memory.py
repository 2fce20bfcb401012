"""What an instrument remembers: series that the runtime forms of the record, as channels of the derivation.

A Taylor series in a period or a time constant fails where it is as long as what is recorded. So the record itself is passed through
what has the memory, at the values to which a fit has come (``ragg_runtime.model.memory``), with derivatives by them: a hook has only
to say where the response enters, and how it changes with what is left of these values, which is their distance from the neutral ones.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values, shared
from derive.stages import NOMINAL_TRIAD, Motion, SensedForce
from derive.symbols import COS_J, SIN_J

FREQUENCY, QUALITY = 5.0, 10.0
"""Hz, and 1: where a search begins. Isolators and stabilised platforms resonate at 2 to 20 Hz, with Q from 3 to 30."""

RESONANCE = (
    shared("f_0", "f_0", "Hz", "frequency of the resonance", 3.0, neutral=FREQUENCY, shape=True),
    shared("Q", "Q", "1", "its quality factor", 5.0, neutral=QUALITY, shape=True),
)

HEAT = (shared("tau", r"\tau", "s", "time constant of the heat", 20.0, neutral=40.0, shape=True),)
"""A search begins at 40 s: a torquer in its housing takes from ten seconds to ten minutes."""

RELAXATION = (shared("tau", r"\tau", "s", "time constant of the creep", 20.0, neutral=20.0, shape=True),)
"""Creep goes on in every decade of time: one that a record of minutes shows is of seconds to minutes."""

SLIP = (shared("w", "w", "m/s^2", "force at which it slips", 0.02, neutral=0.01, shape=True),)
"""A milli-g; a search begins at a share of what the record's force changes by."""


THERMAL_SLIP = (shared("w", "w", "K", "change at which it slips", 0.1, neutral=0.1, shape=True),)


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


def warmth(p: Values, c: Context) -> sp.Expr:
    """Square of the force along the input axis as the torquer's heat remembers it, m^2/s^4."""
    axis, terms = axes_on_disc(c)[0, :], []
    for i, a in enumerate("rta"):
        for k, b in enumerate("rta"[i:], i):
            weight = axis[i] * axis[k] * (1 if i == k else 2)
            terms += [weight * response(f"heat_{a}{b}", p, c, HEAT)] if weight != 0 else []
    return sp.Add(*terms)


def mount_resonance(m: Motion, p: Values, c: Context) -> Motion:
    def through(name: str, v: sp.Matrix) -> sp.Matrix:
        further = [response(f"mount_{name}_{k}", p, c, RESONANCE if name == "a" else ()) for k in "xyz"]
        return v + p.share * sp.Matrix(further)

    return m._replace(
        a=through("a", m.a), omega=through("omega", m.omega), omegadot=through("omegadot", m.omegadot)
    )


MOUNT_RESONANCE = Effect(
    id="mount-resonance",
    title="Resonance of the mount",
    physics=(
        "Isolators or a frame connect the motion sensor and the disc: spring and damper transmit slow motion unchanged, amplify it near "
        "their resonance, and isolate faster motion."
    ),
    source="transmissibility of a mass on spring and damper (D. J. Ewins, Modal Testing, 2000; ISO 2041)",
    equation=(
        r"\bm a = \bm a_{rec} + \kappa (H - 1)\,\bm a_{rec},\; H = \frac{1 + d s}{1 + d s + b s^2},\;"
        r" b = (2\pi f_0)^{-2},\; d = (2\pi f_0 Q)^{-1};\; \bm\omega, \dot{\bm\omega} \text{ likewise}"
    ),
    limits=(
        "One resonance, equal along all axes; kappa is 1 where it carries the whole disc, less for the share of a mode. For f_0 far "
        "above the motion only kappa/f_0^2 matters, as imu-filter; Q matters where the motion is near f_0. The record is assumed to "
        "begin at rest, and its first seconds are excluded."
    ),
    parameters=(
        shared("share", r"\kappa", "1", "share of the motion that passes the resonance", 1.0),
        *RESONANCE,
    ),
    sensing=mount_resonance,
    memory="mount",
    contains=("imu-filter",),
)


def accelerometer_resonance(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    axes = NOMINAL_TRIAD.T if c.turn_of_triad is None else c.turn_of_triad * NOMINAL_TRIAD.T
    k = c.parameters
    axis = axes[:, 0] + k["vartheta_z"] * axes[:, 1] - k["vartheta_y"] * axes[:, 2]

    def along_input(kind: str) -> sp.Expr:
        radial, tangential = (response(f"{kind}_{n}", p, c, RESONANCE) for n in ("radial", "tangential"))
        r, t = COS_J * radial + SIN_J * tangential, COS_J * tangential - SIN_J * radial
        r, t = r + k["beta_z"] * t, t - k["beta_z"] * r
        return axis.dot(sp.Matrix([r, t, response(f"{kind}_axial", p, c)]))

    return i - p.u * along_input("rate") - p.v * along_input("curvature")


ACCELEROMETER_RESONANCE = Effect(
    id="accelerometer-resonance",
    title="Resonance of an accelerometer",
    physics=(
        "The mount of an accelerometer, or its rebalance loop, resonates: force along its input axis, which turns with the disc, is "
        "amplified and delayed near the resonance."
    ),
    source="closed-loop response of second order (IEEE Std 1293, frequency response); of a mount as mount-resonance",
    equation=(
        r"V_j \leftarrow V_j - \frac{u_j s + v_j s^2}{1 + d s + b s^2} f_i,\; b = (2\pi f_0)^{-2},\; d = (2\pi f_0 Q)^{-1}"
    ),
    limits=(
        "One frequency and Q for all accelerometers. A loop has u = d and v = b, a mount u = 0 and v = b, a mode a share of them. For a "
        "resonance far above the spin rate and the motion, u and v are lag and second-order-loop. The response to gradients, a "
        "millionth, is neglected, and the first seconds of a record are excluded. A diagnosis does not look for it: of 720 simulated "
        "flights five had another effect and got this name, and two had it."
    ),
    parameters=(
        EffectParameter("u", "u", "s", "first order of what the resonance takes away", 1e-8),
        EffectParameter("v", "v", "s^2", "second order of what the resonance takes away", 1e-8),
        *RESONANCE,
    ),
    transducer=accelerometer_resonance,
    memory="accelerometer",
    searched=False,
    contains=("lag", "second-order-loop"),
)


def bias_creep(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    i, o, p_axis = remembered_force("creep", p, c, RELAXATION)
    start = response("creep_start", p, c, RELAXATION)
    return {"K0": k["K0"] + p.c_i * i + p.c_o * o + p.c_p * p_axis + p.c_0 * start}


BIAS_CREEP = Effect(
    id="bias-creep",
    title="Creep of the null bias",
    physics=(
        "Flexures, leads and adhesives go on yielding for a while after a force has changed, and recover as slowly: the null bias "
        "follows the force of the last seconds to hours."
    ),
    source=(
        "Standard linear solid, strain = f/E_1 + f/E_2/(1 + tau s) with tau = eta/E_2 (W. N. Findley, J. S. Lai and K. Onaran, Creep and "
        "Relaxation of Nonlinear Viscoelastic Materials, 1976)"
    ),
    equation=r"K_0 \leftarrow K_0 + \sum_k c_k f_k/(1 + \tau s) + c_0 e^{-t/\tau},\; k = i, o, p",
    limits=(
        "Added by name, not searched for: sixteen coefficients and a time constant look like many effects. The part that yields at once "
        "is K1 and the misalignment angles. c_0 settles from the force before the record. A tau far below the turn of the disc is lag; "
        "far above the record's length c_i and c_o vanish, as the disc turns the force over, and c_p is a walk of the bias with the sum "
        "of a_z. Where a_z hardly changes it is mount-creep; nearly steady a_z makes c_p bias-drift."
    ),
    parameters=(
        EffectParameter("c_i", "c_i", "ug/g", "slow bias by a steady force along the input axis", 10.0),
        EffectParameter("c_o", "c_o", "ug/g", "slow bias by a steady force along the output axis", 10.0),
        EffectParameter("c_p", "c_p", "ug/g", "slow bias by a steady force along the pendulous axis", 10.0),
        EffectParameter("c_0", "c_0", "ug", "null bias at the beginning by the force of before", 1.0),
        *RELAXATION,
    ),
    instrument=bias_creep,
    memory="creep",
    searched=False,
)


def mount_creep(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    x, _, z = remembered_force("flow", p, c, RELAXATION)
    start = response("flow_start", p, c, RELAXATION)
    return {
        "vartheta_y": k["vartheta_y"] + p.e_yx * x + p.e_yz * z + p.e_y0 * start,
        "vartheta_z": k["vartheta_z"] + p.e_zx * x + p.e_z0 * start,
    }


MOUNT_CREEP = Effect(
    id="mount-creep",
    title="Creep of the mount",
    physics="Glue and plastic below an accelerometer flow under its weight: it goes on tilting for a while after the force has changed.",
    source="as bias-creep; creep of adhesives: R. D. Adams, Adhesive Bonding, 2005",
    equation=(
        r"\vartheta_y \leftarrow \vartheta_y + (e_{yx} f_x + e_{yz} f_z)/(1 + \tau s) + e_{y0} e^{-t/\tau},\;"
        r" \vartheta_z \leftarrow \vartheta_z + e_{zx} f_x/(1 + \tau s) + e_{z0} e^{-t/\tau}"
    ),
    limits=(
        "Added by name, not searched for, as bias-creep. The part that yields at once is mount-compliance, to which all of it comes for "
        "a tau far below the turn of the disc. Where a_z hardly changes, e_yx and e_yz are the c_i and c_p of bias-creep. A tau far "
        "above the record's length is misalignment-drift."
    ),
    parameters=(
        EffectParameter("e_yx", "e_{yx}", "urad/g", "slow vartheta_y by a steady force along x", 10.0),
        EffectParameter("e_yz", "e_{yz}", "urad/g", "slow vartheta_y by a steady force along z", 10.0),
        EffectParameter("e_zx", "e_{zx}", "urad/g", "slow vartheta_z by a steady force along x", 10.0),
        EffectParameter("e_y0", "e_{y0}", "urad", "vartheta_y at the beginning by the force of before", 1.0),
        EffectParameter("e_z0", "e_{z0}", "urad", "vartheta_z at the beginning by the force of before", 1.0),
        *RELAXATION,
    ),
    instrument=mount_creep,
    memory="flow",
    searched=False,
)


def bias_hysteresis(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    i, o, p_axis = remembered_force("slip", p, c, SLIP)
    return {"K0": k["K0"] + p.h_i * i + p.h_o * o + p.h_p * p_axis}


BIAS_HYSTERESIS = Effect(
    id="bias-hysteresis",
    title="Hysteresis of the null bias",
    physics=(
        "Friction in pivots and leads, and the torquer's magnet, hold against a force until it has changed by enough: the null bias "
        "differs between rising and falling force."
    ),
    source=(
        "IEEE Std 1293, hysteresis error; play and stop operators (A. Visintin, Differential Models of Hysteresis, 1994; P. R. Dahl, "
        "AIAA J. 14, 1675, 1976)"
    ),
    equation=(
        r"K_0 \leftarrow K_0 + \sum_k h_k S_w[f_k],\; k = i, o, p;\; \mathrm d S_w = \mathrm d f_k/w"
        r" \text{ while } -1 \le S_w \le 1"
    ),
    limits=(
        "One w for all; play of half width w, P_w[f] = f - w S_w[f], has a share of K1, vartheta_z or vartheta_y besides. If the force "
        "changes by less than w nothing slips, and it is these parameters alone. A record tells the product h/w least where the force "
        "changes by far more than w. Where a_z hardly changes it is mount-hysteresis. Accelerometers stand at quarter turns of the disc."
    ),
    parameters=(
        EffectParameter("h_i", "h_i", "ug", "half of the loop in the force along the input axis", 1.0),
        EffectParameter("h_o", "h_o", "ug", "half of the loop in the force along the output axis", 1.0),
        EffectParameter("h_p", "h_p", "ug", "half of the loop in the force along the pendulous axis", 1.0),
        *SLIP,
    ),
    instrument=bias_hysteresis,
    memory="slip",
)


def mount_hysteresis(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    x, _, z = remembered_force("play", p, c, SLIP)
    return {
        "vartheta_y": k["vartheta_y"] + p.e_yx * x + p.e_yz * z,
        "vartheta_z": k["vartheta_z"] + p.e_zx * x,
    }


MOUNT_HYSTERESIS = Effect(
    id="mount-hysteresis",
    title="Play of the mount",
    physics="Screws and seats of an accelerometer have play: it tilts to and fro, and stays tilted until the force has changed by enough.",
    source="as bias-hysteresis; friction in bolted joints (L. Gaul and R. Nitsche, Appl. Mech. Rev. 54, 93, 2001)",
    equation=(
        r"\vartheta_y \leftarrow \vartheta_y + e_{yx} S_w[f_x] + e_{yz} S_w[f_z],\;"
        r" \vartheta_z \leftarrow \vartheta_z + e_{zx} S_w[f_x];\; S_w \text{ as in bias-hysteresis}"
    ),
    limits=(
        "One w for all; play of half width w besides has a share of mount-compliance. Where a_z hardly changes, e_yx and e_yz are the "
        "h_i and h_p of bias-hysteresis. If the force changes by less than w nothing slips. Accelerometers stand at quarter turns."
    ),
    parameters=(
        EffectParameter("e_yx", "e_{yx}", "urad", "half of the loop of vartheta_y in the force along x", 1.0),
        EffectParameter("e_yz", "e_{yz}", "urad", "half of the loop of vartheta_y in the force along z", 1.0),
        EffectParameter("e_zx", "e_{zx}", "urad", "half of the loop of vartheta_z in the force along x", 1.0),
        *SLIP,
    ),
    instrument=mount_hysteresis,
    memory="play",
)


def thermal_hysteresis(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {"K0": k["K0"] + p.h * response("cycle_temperature", p, c, THERMAL_SLIP)}


THERMAL_HYSTERESIS = Effect(
    id="thermal-hysteresis",
    title="Hysteresis of the null bias in temperature",
    physics=(
        "Parts of unlike metals slip on each other, and glue stays strained, as the instrument warms and cools: the null bias differs "
        "between rising and falling temperature."
    ),
    source="IEEE Std 1293, thermal hysteresis; stop operator as in bias-hysteresis (A. Visintin, Differential Models of Hysteresis, 1994)",
    equation=(
        r"K_0 \leftarrow K_0 + h\,S_w[T],\; \mathrm d S_w = \mathrm d T/w \text{ while } -1 \le S_w \le 1"
    ),
    limits=(
        "Added by name, not searched for: in a record in which the temperature only rises it is a bias that settles, and looks like "
        "inner-temperature, thermal-lag, a drift or a step; it needs turns by more than 2 w. While the temperature changes by less than "
        "w it is thermal-bias; play besides has a share of that. S begins at 0. That of vartheta_y acts alike where a_z hardly changes."
    ),
    channels=("temperature",),
    parameters=(EffectParameter("h", "h", "ug", "half of the loop of the bias", 1.0), *THERMAL_SLIP),
    instrument=thermal_hysteresis,
    memory="cycle",
    searched=False,
)


def inner_temperature(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    heat, start = warmth(p, c), response("heat_start", p, c, HEAT)
    return {"K0": k["K0"] + p.b * heat + p.b_0 * start, "K1": k["K1"] * (1 + p.s * heat + p.s_0 * start)}


INNER_TEMPERATURE = Effect(
    id="inner-temperature",
    title="Inner temperature by the torquer's heat",
    physics=(
        "The current that holds the proof mass heats torquer and magnet with its square; what is warmed so loses the heat to the case in "
        "some time: bias and scale factor follow the force of the last seconds to minutes, and settle after switch-on."
    ),
    source="Micromachines 16, 241 (2025); IEEE Std 1293, self-heating: T_i' = (T_s - T_i)/tau + c f_i^2, linear in T_s and f_i^2",
    equation=(
        r"K_0 \leftarrow K_0 + b\,\Theta + b_0 e^{-t/\tau},\; K_1 \leftarrow K_1 (1 + s\,\Theta + s_0 e^{-t/\tau}),\;"
        r" \Theta = f_i^2/(1 + \tau s)"
    ),
    limits=(
        "One time constant. b and s are the bias' and the scale factor's dependence on temperature times the heating, b_0 and s_0 those "
        "of the inner temperature at the beginning, from which it settles. What follows T_s is thermal-bias, thermal-scale and, to first "
        "order, thermal-lag. A tau far above the record's length is bias-drift and gain-drift, one far below the turn of the disc K2 and "
        "cubic-input."
    ),
    parameters=(
        EffectParameter("b", "b", "ug/g^2", "null bias by the heat of a steady force", 100.0),
        EffectParameter("s", "s", "1/g^2", "relative scale factor by the heat of a steady force", 1e-4),
        EffectParameter("b_0", "b_0", "ug", "null bias at the beginning by heat of before", 1.0),
        EffectParameter("s_0", "s_0", "1", "relative scale factor at the beginning by heat of before", 1e-6),
        *HEAT,
    ),
    instrument=inner_temperature,
    memory="heat",
    contains=("bias-drift", "gain-drift"),
)
