"""A scale factor that jumps at an unknown instant."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {"K1": k["K1"] * (1 + p.dK1 * sp.Heaviside(c.time - p.t_step, 1))}


EFFECT = Effect(
    id="gain-step",
    title="Step of the scale factor",
    physics="A shock, a relay or a range switch changes the gain of an accelerometer's circuit at once.",
    source="common fault of analogue front ends",
    equation=r"K_1 \leftarrow K_1 (1 + \Delta K_1 [t \ge t_s])",
    limits="One step a record; its instant is scanned, not fitted.",
    kind="step",
    parameters=(
        EffectParameter("dK1", r"\Delta K_1", "1", "relative step of the scale factor", 1e-6),
        EffectParameter("t_step", "t_s", "s", "instant of the step", 1.0, shared=True, fitted=False),
    ),
    instrument=instrument,
)
