"""Scale factor proportional to temperature."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values

REFERENCE_KELVIN = sp.Rational(29315, 100)
"""Temperature at which the test sheet's scale factor holds; another one is absorbed by K1."""


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    return {"K1": k["K1"] * (1 + p.dK1_dT * (c.channel("temperature") - REFERENCE_KELVIN))}


EFFECT = Effect(
    id="thermal-scale",
    title="Temperature coefficient of the scale factor",
    physics="The torquer magnet weakens and the sense resistor changes as the instrument warms.",
    source="IEEE Std 1293, scale-factor temperature sensitivity",
    equation=r"K_1 \leftarrow K_1 (1 + \partial_T K_1 (T - 293.15\,\mathrm{K}))",
    limits="Linear in one temperature, without the lag of heat flow.",
    channels=("temperature",),
    parameters=(
        EffectParameter("dK1_dT", r"\partial_T K_1", "1/K", "relative change of the scale factor", 1e-6),
    ),
    instrument=instrument,
)
