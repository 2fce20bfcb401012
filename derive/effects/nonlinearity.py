"""Characteristics that are no straight line: of an accelerometer, of its converter, of the output's."""

from __future__ import annotations

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values, shared
from derive.stages import SensedForce


def cubic_input(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i + p.K_iii * f.i**3


CUBIC_INPUT = Effect(
    id="cubic-input",
    title="Cubic input nonlinearity",
    physics=(
        "The rebalance loop's torquer and pick-off are odd functions of the current at large force: the accelerometer's response has a "
        "third-order term in the force along its input axis."
    ),
    source="IEEE Std 1293 (model equation of the linear, single-axis accelerometer), coefficient K3",
    equation=r"I_j/K_{j1} \mathrel{+}= K_{iii} f_i^3",
    limits=(
        "Orders above the third are neglected. f_i of an accelerometer is f_o of its neighbours on the disc: K_iii acts like their K_ooo "
        "(cubic-cross), and where the force hardly changes its size like odd-quadratic; c_3 of output-curve is one combination of both."
    ),
    parameters=(
        EffectParameter("K_iii", "K_{iii}", "ug/g^3", "third-order coefficient of f_i^3", 5.0, like="K2"),
    ),
    transducer=cubic_input,
)


MONOMIALS: tuple[str, ...] = ("iio", "iip", "ioo", "iop", "ipp", "ooo", "oop", "opp", "ppp")
"""All monomials of third degree in f_i, f_o, f_p but f_i^3, which is the effect ``cubic-input``."""


def cubic_cross(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i + sp.Add(*(p[f"K_{m}"] * sp.Mul(*(getattr(f, axis) for axis in m)) for m in MONOMIALS))


CUBIC_CROSS = Effect(
    id="cubic-cross",
    title="Cubic cross-axis nonlinearity",
    physics=(
        "Force across the input axis bends the pendulum's hinge and its frame and shifts the pick-off: beyond the second order of Eq. 1 "
        "the accelerometer responds to products of three components."
    ),
    source="IEEE Std 1293 (model equation of the linear, single-axis accelerometer), carried to third order",
    equation=(
        r"I_j/K_{j1} \mathrel{+}= K_{iio} f_i^2 f_o + K_{iip} f_i^2 f_p + K_{ioo} f_i f_o^2"
        r" + K_{iop} f_i f_o f_p + K_{ipp} f_i f_p^2 + K_{ooo} f_o^3"
        r" + K_{oop} f_o^2 f_p + K_{opp} f_o f_p^2 + K_{ppp} f_p^3"
    ),
    limits=(
        "Orders above the third are neglected. f_i of an accelerometer is f_o of its neighbours on the disc: K_ooo acts like their K_iii "
        "(cubic-input), K_iio like their K_ioo. Under a steady weight K_iip, K_iop and K_oop are K2, K6 and K5; K_ipp and K_opp are K1 "
        "and vartheta_z, K_ppp is K0."
    ),
    parameters=tuple(
        EffectParameter(
            f"K_{m}",
            f"K_{{{m}}}",
            "ug/g^3",
            "third-order coefficient of " + " ".join(f"f_{axis}" for axis in m),
            5.0,
            like="K2",
        )
        for m in MONOMIALS
    ),
    transducer=cubic_cross,
)


def odd_quadratic(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i + p.K_oq * f.i * sp.Abs(f.i)


ODD_QUADRATIC = Effect(
    id="odd-quadratic",
    title="Odd quadratic nonlinearity",
    physics=(
        "The torquer's flux changes with the current through it, oppositely for the two senses: a term of second order that keeps the "
        "sign of the force."
    ),
    source="IEEE Std 1293, odd quadratic coefficient of the model equation",
    equation=r"I_j/K_{j1} \mathrel{+}= K_{oq} f_i |f_i|",
    limits=(
        "f_i is the recorded force: unrecorded vibration is not rectified here. Where the force hardly changes its size it acts like "
        "cubic-input."
    ),
    parameters=(EffectParameter("K_oq", "K_{oq}", "ug/g^2", "coefficient of f_i |f_i|", 5.0, like="K2"),),
    transducer=odd_quadratic,
)


def second_order_misalignment(q: SensedForce, f: SensedForce, p: Values, c: Context) -> SensedForce:
    return SensedForce(*(nominal + p.kappa * (full - nominal) for nominal, full in zip(q, f, strict=True)))


SECOND_ORDER_MISALIGNMENT = Effect(
    id="second-order-misalignment",
    title="Mounting angles in the second-order terms",
    physics=(
        "The second-order coefficients act on the force along the true input, output and pendulous axes, vartheta_x and the mounting "
        "angles included; the paper uses the nominal axes."
    ),
    source="paper, Eq. 5a and 5b, dropped from Eq. 5 on as being of the order of 1e-12 g",
    equation=r"K f_x f_y \to K f_i f_o,\; f_{i,o,p} = f_{x,y,z} + \kappa\,(\bm C - 1) f_{x,y,z}",
    limits=(
        "kappa is 0 (the paper) or 1 (in full); nothing in between is physical. With constant coefficients it only redefines K2 ... K8 "
        "by parts in ten thousand, and is absorbed by them; it vanishes where the model already keeps the angles."
    ),
    parameters=(
        shared("kappa", r"\kappa", "1", "share of the angles in the second-order terms", 1.0, physical=1.0),
    ),
    second_order=second_order_misalignment,
    moot=lambda order, kinematics: order.second_order_angles,
)


def adc_nonlinearity(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i + p.h * sp.sign(i)


ADC_NONLINEARITY = Effect(
    id="adc-nonlinearity",
    title="Nonlinearity of the converters",
    physics=(
        "Where an accelerometer's voltage passes through zero all bits of a converter change at once; they do not match, and its "
        "characteristic has a step there."
    ),
    source="IEEE Std 1241: major-carry transition, the largest error of a binary-weighted converter",
    equation=r"V_j \leftarrow V_j + h_j\,\mathrm{sign}(V_j)",
    limits=(
        "A converter for each accelerometer, its step at zero and of no width. A smooth bend of the characteristic is cubic-input or K2; "
        "finite steps are quantisation. A fit with it excludes samples so close to zero that their side is uncertain."
    ),
    parameters=(EffectParameter("h", "h", "ug", "half the height of the step", 0.01),),
    transducer=adc_nonlinearity,
    switches=True,
)


def output_curve(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    # a factor common to all voltages is a factor of their sum
    reading = c.channel("G_out")
    return i / (1 + p.c_2 * reading + p.c_3 * reading**2)


OUTPUT_CURVE = Effect(
    id="output-curve",
    title="Nonlinearity of the output's converter",
    physics=(
        "Amplifier and converter of G_out are nonlinear, with a quadratic and a cubic term. They act on the sum of the voltages, and so "
        "multiply forces on different accelerometers."
    ),
    source="IEEE Std 1241: integral nonlinearity; 1 to 10 parts in a million of the range at its end",
    equation=r"G_{out} + c_2 G_{out}^2 + c_3 G_{out}^3 \leftarrow G_{out}",
    limits=(
        "A smooth curve up to the third power. A test uses the predicted output, a program the recorded one. A step is adc-nonlinearity, "
        "the end of the range saturation; the curve of a single voltage is K2 and cubic-input of its accelerometer. Where the disc "
        "centre's force is all that moves the output, K2 ... K8 take c_2, and c_3 is one combination of cubic-input and cubic-cross."
    ),
    channels=("G_out",),
    parameters=(
        shared("c_2", "c_2", "1/V", "relative change of the gain per volt", 1e-7),
        shared("c_3", "c_3", "1/V^2", "relative change of the gain per square volt", 1e-9),
    ),
    transducer=output_curve,
)
