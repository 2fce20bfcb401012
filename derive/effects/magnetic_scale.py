import sympy as sp

from derive.effect import Context, Effect, EffectParameter, SensedForce, Values


def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    field = c.in_disc_frame(sp.Matrix([c.channel("B_x"), c.channel("B_y"), 0]))
    return i * (1 + p.dK1_dB * c.geometry.tau[0, :].dot(field))


EFFECT = Effect(
    id="magnetic-scale",
    title="Magnetic sensitivity of the scale factor",
    physics=(
        "The torquer's magnet points along the input axis: what leaks through its shield of the field along it adds to "
        "the flux, and to the force for a current. The axis turns with the disc, and the scale factor with it."
    ),
    source=(
        "flux of a permanent-magnet torquer, 0.5 T, behind a shield of 1000: 2e-3 per tesla; terms of the field along the "
        "axes of a sensor as those of Tolles and Lawson"
    ),
    equation=r"K_{j1} \leftarrow K_{j1} (1 + \partial_B K_1\, \bm B \cdot \bm\tau_{jx})",
    limits=(
        "Linear, in the recorded field, uniform over the disc, along the nominal input axis, which turns in the "
        "plane: B_z is neglected, and components that are not recorded count as zero. A steady field looks like K2 and K6 of a "
        "steady motion."
    ),
    channels=("B_x", "B_y"),
    either=True,
    parameters=(
        EffectParameter("dK1_dB", r"\partial_B K_1", "1/mT", "relative scale factor per flux density", 1e-6),
    ),
    transducer=transducer,
)
