"""Disc angle off by a constant."""

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values


def disc_angle(p: Values, c: Context) -> sp.Expr:
    return p.phi_0


EFFECT = Effect(
    id="spin-phase-offset",
    title="Offset of the disc angle",
    physics="The encoder's zero is not where A1 stands on the x axis.",
    source="definition of the disc angle (paper, Section II.A.1)",
    equation=r"\phi \leftarrow \phi + \phi_0",
    limits=(
        "Exact. A common part of beta_z is the same thing and absorbs it; turning the motion record about z "
        "is the same but for the gradients."
    ),
    parameters=(
        EffectParameter(
            "phi_0", r"\phi_0", "rad", "true disc angle less the recorded one", 1e-4, shared=True
        ),
    ),
    disc_angle=disc_angle,
)
