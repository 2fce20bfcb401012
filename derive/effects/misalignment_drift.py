from derive.effect import Effect, EffectParameter
from derive.hooks import elapsed, following

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
    instrument=following("vartheta_y", "dvartheta_y_dt", elapsed),
)
