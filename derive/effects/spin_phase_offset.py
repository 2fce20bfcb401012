from derive.effect import Context, Effect, Expr, Values, shared


def disc_angle(p: Values, c: Context) -> Expr:
    return p.phi_0


EFFECT = Effect(
    id="spin-phase-offset",
    title="Offset of the disc angle",
    physics="The encoder's zero is not at the angle where A1 is on the x axis.",
    source="definition of the disc angle (paper, Section II.A.1)",
    equation=r"\phi \leftarrow \phi + \phi_0",
    limits=(
        "Exact. A common part of beta_z is equivalent and absorbs it; rotating the motion record about z is equivalent except for the "
        "gradients."
    ),
    parameters=(shared("phi_0", r"\phi_0", "rad", "true disc angle less the recorded one", 1e-4),),
    disc_angle=disc_angle,
)
