"""Misalignment angles linear in time."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {n: k[n] + p[f"d{n}_dt"] * c.time for n in ("vartheta_y", "vartheta_z")}


EFFECT = Effect(
    id="misalignment-drift",
    title="Drift of the misalignment",
    physics="Stress in screws and glue relaxes after assembly, transport or switch-on: an accelerometer creeps on its mount.",
    source="IEEE Std 1293, stability of the input-axis misalignment: some microradians a day",
    equation=r"\vartheta_{y,z} \leftarrow \vartheta_{y,z} + \partial_t \vartheta_{y,z}\, t",
    limits=(
        "Linear over the record, from the instant 0 of its time column (another one is absorbed by vartheta). Where a_z "
        "hardly changes vartheta_y is bias-drift. A growing radius shows in gradients alone, and is left out."
    ),
    parameters=tuple(
        EffectParameter(
            f"dvartheta_{a}_dt",
            rf"\partial_t \vartheta_{a}",
            "urad/s",
            f"rate of vartheta_{a}",
            1e-3,
            like=f"vartheta_{a}",
        )
        for a in "yz"
    ),
    instrument=instrument,
)
