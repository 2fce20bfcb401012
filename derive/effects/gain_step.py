from derive.effect import Effect, EffectParameter
from derive.hooks import T_STEP, begun, following

EFFECT = Effect(
    id="gain-step",
    title="Step of the scale factor",
    physics="A shock, a relay or a range switch changes the gain of an accelerometer's circuit at once.",
    source="common fault of analogue front ends",
    equation=r"K_1 \leftarrow K_1 (1 + \Delta K_1 [t \ge t_s])",
    limits=(
        "One step a record; its instant is scanned, not fitted. In G_out it is also a step of the neighbours' vartheta_z; of all four "
        "accelerometers at once output-gain-step."
    ),
    kind="step",
    parameters=(
        EffectParameter("dK1", r"\Delta K_1", "1", "relative step of the scale factor", 1e-6),
        T_STEP,
    ),
    instrument=following("K1", "dK1", begun),
)
