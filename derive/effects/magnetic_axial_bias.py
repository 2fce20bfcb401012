import sympy as sp

from derive.effect import Context, Effect, EffectParameter, SensedForce, Values
from derive.effects.magnetic_bias import FIELD


def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    field = c.in_disc_frame(sp.Matrix([c.channel(name) for name in FIELD]))
    return i + p.dK0_dBz * c.geometry.tau[2, :].dot(field)


EFFECT = Effect(
    id="magnetic-axial-bias",
    title="Magnetic sensitivity along the spin axis",
    physics="The residual moment of a pendulum that lies across it is turned by the field along the spin axis, which does not rotate.",
    source="IEEE Std 1293, magnetic sensitivity of the bias, along the pendulous axis",
    equation=r"I_j/K_{j1} \mathrel{+}= \partial_{B_z} K_0\, \bm B \cdot \bm\tau_{jz}",
    limits=(
        "Linear, in the recorded field; a bias that follows the slow changes of B_z as others do temperature or pressure. The field along "
        "the input axis is magnetic-bias, which eddy currents of a steady field in the turning disc, Omega B a quarter of a turn ahead, "
        "are too, in the neighbours' coefficients. What follows dB_z/dt is neglected: eddy currents of a shield last 1 ms to 0.1 s, so "
        "that 0.1 uT/s is below 1e-4 ug."
    ),
    channels=FIELD,
    either=True,
    parameters=(
        EffectParameter(
            "dK0_dBz", r"\partial_{B_z} K_0", "ug/mT", "bias per flux density along the spin axis", 10.0
        ),
    ),
    transducer=transducer,
)
