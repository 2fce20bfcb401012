"""Null bias proportional to air pressure."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values

REFERENCE_PASCAL = sp.Integer(101325)
"""Pressure at which the test sheet's null bias holds; another one is absorbed by K0."""


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {"K0": k["K0"] + p.dK0_dp * (c.channel("pressure") - REFERENCE_PASCAL)}


EFFECT = Effect(
    id="pressure-bias",
    title="Pressure sensitivity of the null bias",
    physics="Air pressure strains case and hinge; buoyancy acts on the proof mass of an unsealed instrument.",
    source="IEEE Std 1293, pressure sensitivity of the bias",
    equation=r"K_0 \leftarrow K_0 + \partial_p K_0 (p - 101325\,\mathrm{Pa})",
    limits="Linear in one pressure, without the lag of a leaking seal.",
    channels=("pressure",),
    parameters=(EffectParameter("dK0_dp", r"\partial_p K_0", "ug/kPa", "change of the null bias", 0.1),),
    instrument=instrument,
)
