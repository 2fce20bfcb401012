"""Quantisation of the output channel."""

from __future__ import annotations

from derive.effect import Effect, EffectParameter

EFFECT = Effect(
    id="quantisation",
    title="Quantisation of the output",
    physics="The converter of G_out has finite steps: the record holds multiples of one of them.",
    source="resolution of the output converter",
    equation=r"G_{out} \leftarrow q\, \mathrm{round}(G_{out}/q)",
    limits="Uniform steps through zero, of G_out alone.",
    kind="output",
    parameters=(
        EffectParameter("q", "q", "V", "step of the recorded output", 1e-3, shared=True, fitted=False),
    ),
)
