"""Sensitivity to the magnetic field."""

from __future__ import annotations

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values
from derive.stages import SensedForce, misalignment_matrix

FIELD = ("B_x", "B_y", "B_z")


def magnetic_bias(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    assert c.geometry is not None
    k = c.parameters
    field = sp.Matrix([c.channel(name) for name in FIELD])
    input_axis = misalignment_matrix(k["vartheta_x"], k["vartheta_y"], k["vartheta_z"])[0, :] * c.geometry.tau
    return i + p.dK0_dB * input_axis.dot(c.in_disc_frame(field))


MAGNETIC_BIAS = Effect(
    id="magnetic-bias",
    title="Magnetic sensitivity of the null bias",
    physics=(
        "A residual magnetic moment of the pendulum is turned by the ambient field. The input axis turns with the disc, so that a steady "
        "field looks like a horizontal specific force."
    ),
    source="IEEE Std 1293, magnetic sensitivity of the bias",
    equation=r"I_j/K_{j1} \mathrel{+}= \partial_B K_0\, \bm B \cdot \bm\tau_{ji}",
    limits=(
        "Linear, in the field recorded in the measurement frame, assumed uniform over the disc, along the input axis only; a response to "
        "the field along the spin axis is magnetic-axial-bias. Components that are not recorded count as zero: without B_z hardly "
        "anything is lost, without B_x or B_y half."
    ),
    channels=FIELD,
    either=True,
    parameters=(
        EffectParameter(
            "dK0_dB", r"\partial_B K_0", "ug/mT", "bias per magnetic flux density along the input axis", 10.0
        ),
    ),
    transducer=magnetic_bias,
)


def magnetic_axial_bias(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    assert c.geometry is not None
    field = c.in_disc_frame(sp.Matrix([c.channel(name) for name in FIELD]))
    return i + p.dK0_dBz * c.geometry.tau[2, :].dot(field)


MAGNETIC_AXIAL_BIAS = Effect(
    id="magnetic-axial-bias",
    title="Magnetic sensitivity along the spin axis",
    physics="The residual moment of a pendulum that lies across it is turned by the field along the spin axis, which does not rotate.",
    source="IEEE Std 1293, magnetic sensitivity of the bias, along the pendulous axis",
    equation=r"I_j/K_{j1} \mathrel{+}= \partial_{B_z} K_0\, \bm B \cdot \bm\tau_{jz}",
    limits=(
        "Linear, in the recorded field; a bias that follows the slow changes of B_z as others do temperature or pressure. The field "
        "along the input axis is magnetic-bias, which eddy currents of a steady field in the turning disc, Omega B a quarter of a turn "
        "ahead, are too, in the neighbours' coefficients. What follows dB_z/dt is neglected: eddy currents of a shield last 1 ms to 0.1 "
        "s, so that 0.1 uT/s is below 1e-4 ug."
    ),
    channels=FIELD,
    either=True,
    parameters=(
        EffectParameter(
            "dK0_dBz", r"\partial_{B_z} K_0", "ug/mT", "bias per flux density along the spin axis", 10.0
        ),
    ),
    transducer=magnetic_axial_bias,
)


def magnetic_scale(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    assert c.geometry is not None
    field = c.in_disc_frame(sp.Matrix([c.channel("B_x"), c.channel("B_y"), 0]))
    return i * (1 + p.dK1_dB * c.geometry.tau[0, :].dot(field))


MAGNETIC_SCALE = Effect(
    id="magnetic-scale",
    title="Magnetic sensitivity of the scale factor",
    physics=(
        "The torquer's magnet points along the input axis: what leaks through its shield of the field along it adds to the flux, and to "
        "the force for a current. The axis turns with the disc, and the scale factor with it."
    ),
    source=(
        "flux of a permanent-magnet torquer, 0.5 T, behind a shield of 1000: 2e-3 per tesla; terms of the field along the axes of a "
        "sensor as those of Tolles and Lawson"
    ),
    equation=r"K_{j1} \leftarrow K_{j1} (1 + \partial_B K_1\, \bm B \cdot \bm\tau_{jx})",
    limits=(
        "Linear, in the recorded field, uniform over the disc, along the nominal input axis, which turns in the plane: B_z is neglected, "
        "and components that are not recorded count as zero. A steady field looks like K2 and K6 of a steady motion."
    ),
    channels=("B_x", "B_y"),
    either=True,
    parameters=(
        EffectParameter("dK1_dB", r"\partial_B K_1", "1/mT", "relative scale factor per flux density", 1e-6),
    ),
    transducer=magnetic_scale,
)
