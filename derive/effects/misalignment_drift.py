"""Misalignment angles linear in time."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {"vartheta_y": k["vartheta_y"] + p.dvartheta_y_dt * c.time}


EFFECT = Effect(
    id="misalignment-drift",
    title="Drift of the misalignment",
    physics="Stress in screws and glue relaxes after assembly, transport or switch-on: an accelerometer creeps on its mount.",
    source="IEEE Std 1293, stability of the input-axis misalignment: some microradians a day",
    equation=r"\vartheta_y \leftarrow \vartheta_y + \partial_t \vartheta_y\, t",
    limits=(
        "Linear over the record, from the instant 0 of its time column (another one is absorbed by vartheta_y); where a_z hardly "
        "changes it is bias-drift. vartheta_z puts the radial force on the input axis, which is the neighbours' input: in G_out "
        "it is their gain-drift. A growing radius acts on gradients only, and is neglected."
    ),
    parameters=(
        EffectParameter(
            "dvartheta_y_dt",
            r"\partial_t \vartheta_y",
            "urad/s",
            "rate of vartheta_y",
            1e-3,
            like="vartheta_y",
        ),
    ),
    instrument=instrument,
)
