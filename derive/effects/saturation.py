"""Saturation of the output channel."""

from __future__ import annotations

import math

from derive.effect import Effect, EffectParameter

EFFECT = Effect(
    id="saturation",
    title="Saturation of the output",
    physics="The amplifier or converter of G_out has a limit, which stands in the record for what is larger.",
    source="range of the output converter",
    equation=r"G_{out} \leftarrow \min(\max(G_{out}, -V_{max}), V_{max})",
    limits="Symmetric, of G_out alone; single accelerometers do not saturate.",
    kind="output",
    parameters=(
        EffectParameter(
            "V_max",
            "V_{max}",
            "V",
            "largest output that is recorded",
            10.0,
            shared=True,
            neutral=math.inf,
            fitted=False,
        ),
    ),
)
