from derive.effect import Effect, EffectParameter
from derive.hooks import T_STEP, begun, following

EFFECT = Effect(
    id="misalignment-step",
    title="Step of the misalignment",
    physics="A shock moves an accelerometer on its mount, or a strained screw slips.",
    source="IEEE Std 1293, repeatability of the input-axis misalignment after shock: 1 to 100 microradians",
    equation=r"\vartheta_y \leftarrow \vartheta_y + \Delta\vartheta_y [t \ge t_s]",
    limits=(
        "One step a record; its instant is scanned, not fitted. Where a_z hardly changes it is bias-step; a step of vartheta_z "
        "is in G_out the gain-step of the neighbours on the disc."
    ),
    kind="step",
    parameters=(
        EffectParameter(
            "dvartheta_y", r"\Delta\vartheta_y", "urad", "step of vartheta_y", 1.0, like="vartheta_y"
        ),
        T_STEP,
    ),
    instrument=following("vartheta_y", "dvartheta_y", begun),
)
