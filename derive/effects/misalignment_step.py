"""A misalignment that jumps at an unknown instant."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {"vartheta_y": k["vartheta_y"] + p.dvartheta_y * sp.Heaviside(c.time - p.t_step, 1)}


EFFECT = Effect(
    id="misalignment-step",
    title="Step of the misalignment",
    physics="A shock moves an accelerometer on its mount, or a strained screw slips.",
    source="IEEE Std 1293, repeatability of the input-axis misalignment after shock: 1 to 100 microradians",
    equation=r"\vartheta_y \leftarrow \vartheta_y + \Delta\vartheta_y [t \ge t_s]",
    limits=(
        "One step a record; its instant is scanned, not fitted. Where a_z hardly changes it is bias-step; a step of vartheta_z "
        "is in G_out the gain-step of the neighbours on the disc."
    ),
    kind="step",
    parameters=(
        EffectParameter(
            "dvartheta_y", r"\Delta\vartheta_y", "urad", "step of vartheta_y", 1.0, like="vartheta_y"
        ),
        EffectParameter("t_step", "t_s", "s", "instant of the step", 1.0, shared=True, fitted=False),
    ),
    instrument=instrument,
)
