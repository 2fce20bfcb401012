"""Radius proportional to the radial specific force."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import sympy as sp

from derive.effect import Effect, EffectParameter, Values

if TYPE_CHECKING:
    from derive.context import Context


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    assert c.force is not None
    return {"dR": k["dR"] + p.c_r * c.force.y}


EFFECT = Effect(
    id="arm-stretch",
    title="Elastic stretch of the arm",
    physics="The mount between disc and accelerometer yields to the specific force along the radius.",
    source="linear elasticity of the mount",
    equation=r"R_j \leftarrow R_j + c_r f_y",
    limits=(
        "Static and linear, with the force at the unstretched position; the velocity and acceleration of the "
        "yielding itself are left out."
    ),
    parameters=(EffectParameter("c_r", "c_r", "um/g", "stretch per radial specific force", 0.1),),
    instrument=instrument,
)
