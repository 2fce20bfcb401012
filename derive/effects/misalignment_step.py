"""A misalignment that jumps at an unknown instant."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    on = sp.Heaviside(c.time - p.t_step, 1)
    return {n: k[n] + p[f"d{n}"] * on for n in ("vartheta_y", "vartheta_z")}


EFFECT = Effect(
    id="misalignment-step",
    title="Step of the misalignment",
    physics="A shock moves an accelerometer on its mount, or a strained screw slips.",
    source="IEEE Std 1293, repeatability of the input-axis misalignment after shock: 1 to 100 microradians",
    equation=r"\vartheta_{y,z} \leftarrow \vartheta_{y,z} + \Delta\vartheta_{y,z} [t \ge t_s]",
    limits=(
        "One step a record; its instant is scanned, not fitted. Where a_z hardly changes vartheta_y is bias-step."
    ),
    kind="step",
    parameters=(
        *(
            EffectParameter(
                f"dvartheta_{a}",
                rf"\Delta\vartheta_{a}",
                "urad",
                f"step of vartheta_{a}",
                1.0,
                like=f"vartheta_{a}",
            )
            for a in "yz"
        ),
        EffectParameter("t_step", "t_s", "s", "instant of the step", 1.0, shared=True, fitted=False),
    ),
    instrument=instrument,
)
