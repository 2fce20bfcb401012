"""Scale factors that a loop of the instrument keeps balanced."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {"K1": k["K1"] * (1 + p.dK1_di * c.channel("balance_current"))}


EFFECT = Effect(
    id="balancing-loop",
    title="Balancing loop of the scale factors",
    physics=(
        "Loops demodulate the output at the spin frequency and its double, integrate the result, and change scale factors by a current "
        "until it vanishes: while they run no calibration stays valid."
    ),
    source="US 5922951; Sensors 17, 1710 (2017); Sensors 18, 1247 (2018): k' = -gamma LP[G_out sin(phi + ...)]",
    equation=r"K_1 \leftarrow K_1 (1 + \partial_i K_1\, i(t))",
    limits=(
        "The loop's current is recorded, in one channel; the scale factors are linear in it. Without this channel a settling loop looks "
        "like gain-drift; a stopped loop has no effect."
    ),
    channels=("balance_current",),
    parameters=(
        EffectParameter(
            "dK1_di", r"\partial_i K_1", "1/A", "relative scale factor per current of the loop", 1e-3
        ),
    ),
    instrument=instrument,
)
