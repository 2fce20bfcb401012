from derive.effect import Effect, EffectParameter
from derive.hooks import T_STEP, begun, following

EFFECT = Effect(
    id="bias-step",
    title="Step of the null bias, or of the output's offset",
    physics="A shock, a relay or a released strain shifts an accelerometer's null, or the offset of the output, at once.",
    source="IEEE Std 1293, bias stability; common fault of analogue front ends",
    equation=r"K_0 \leftarrow K_0 + \Delta K_0 [t \ge t_s]",
    limits=(
        "One step a record; its instant is scanned, not fitted. G_out depends on one combination of the four, which is also that of a "
        "step of the output's offset."
    ),
    kind="step",
    parameters=(EffectParameter("dK0", r"\Delta K_0", "ug", "step of the null bias", 0.01), T_STEP),
    instrument=following("K0", "dK0", begun),
)
