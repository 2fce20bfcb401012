"""Null bias proportional to temperature."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values
from derive.effects.thermal_scale import REFERENCE_KELVIN


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {"K0": k["K0"] + p.dK0_dT * (c.channel("temperature") - REFERENCE_KELVIN)}


EFFECT = Effect(
    id="thermal-bias",
    title="Temperature coefficient of the null bias",
    physics="Hinge torque and pick-off null shift as the instrument warms.",
    source="IEEE Std 1293, bias temperature sensitivity",
    equation=r"K_0 \leftarrow K_0 + \partial_T K_0 (T - 293.15\,\mathrm{K})",
    limits="Linear in one temperature, without the lag of heat flow.",
    channels=("temperature",),
    parameters=(EffectParameter("dK0_dT", r"\partial_T K_0", "ug/K", "change of the null bias", 1.0),),
    instrument=instrument,
)
