import sympy as sp

from derive.effect import Context, Effect, EffectParameter, SensedForce, Values
from derive.stages import misalignment_matrix

FIELD = ("B_x", "B_y", "B_z")


def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    k = c.parameters
    field = sp.Matrix([c.channel(name) for name in FIELD])
    input_axis = misalignment_matrix(k["vartheta_x"], k["vartheta_y"], k["vartheta_z"])[0, :] * c.geometry.tau
    return i + p.dK0_dB * input_axis.dot(c.in_disc_frame(field))


EFFECT = Effect(
    id="magnetic-bias",
    title="Magnetic sensitivity of the null bias",
    physics=(
        "A residual magnetic moment of the pendulum is turned by the ambient field. The input axis turns "
        "with the disc, so that a steady field looks like a horizontal specific force."
    ),
    source="IEEE Std 1293, magnetic sensitivity of the bias",
    equation=r"I_j/K_{j1} \mathrel{+}= \partial_B K_0\, \bm B \cdot \bm\tau_{ji}",
    limits=(
        "Linear, in the field recorded in the measurement frame, assumed uniform over the disc, along the input axis only; a "
        "response to the field along the spin axis is magnetic-axial-bias. Components "
        "that are not recorded count as zero: without B_z hardly anything is lost, without B_x or B_y half."
    ),
    channels=FIELD,
    either=True,
    parameters=(
        EffectParameter(
            "dK0_dB", r"\partial_B K_0", "ug/mT", "bias per magnetic flux density along the input axis", 10.0
        ),
    ),
    transducer=transducer,
)
