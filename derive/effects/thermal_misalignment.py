"""Misalignment angles proportional to temperature."""

from collections.abc import Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values
from derive.effects.thermal_scale import REFERENCE_KELVIN


def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> dict[str, sp.Expr]:
    warmer = c.channel("temperature") - REFERENCE_KELVIN
    return {n: k[n] + p[f"d{n}_dT"] * warmer for n in ("vartheta_y", "vartheta_z")}


EFFECT = Effect(
    id="thermal-misalignment",
    title="Temperature coefficient of the misalignment",
    physics="Glue, screws and frames of unlike metals turn an accelerometer on its mount as the instrument warms.",
    source=(
        "LISA Pathfinder, arXiv:2407.05852: angles of an optical bench follow its temperature, 30 microradians per kelvin; "
        "IEEE Std 1293, input-axis misalignment"
    ),
    equation=r"\vartheta_{y,z} \leftarrow \vartheta_{y,z} + \partial_T \vartheta_{y,z} (T - 293.15\,\mathrm{K})",
    limits=(
        "Linear in one temperature, without the lag of heat flow. beta_z differs from vartheta_z, and beta_x from "
        "vartheta_y, by gradients alone; the growing radius, 20 ppm/K, is below 0.1 Eo/K in 3000 Eo: all three are left "
        "out. Where a_z hardly changes vartheta_y is thermal-bias."
    ),
    channels=("temperature",),
    parameters=tuple(
        EffectParameter(
            f"dvartheta_{a}_dT",
            rf"\partial_T \vartheta_{a}",
            "urad/K",
            f"change of vartheta_{a}",
            10.0,
            like=f"vartheta_{a}",
        )
        for a in "yz"
    ),
    instrument=instrument,
)
