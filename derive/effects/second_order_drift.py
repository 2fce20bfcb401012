from derive.effect import Effect, EffectParameter
from derive.hooks import elapsed, following

EFFECT = Effect(
    id="second-order-drift",
    title="Drift of the second-order coefficient",
    physics="Magnet and hinge age or warm: the curvature of an accelerometer's characteristic creeps with them.",
    source="IEEE Std 1293, stability of the model's coefficients",
    equation=r"K_2 \leftarrow K_2 + \partial_t K_2\, t",
    limits=(
        "Linear over the record, from the instant 0 of its time column. K5 of an accelerometer is K2 of its neighbours on "
        "the disc; under a steady weight the drifts of K4, K7 and K8 are gain-drift, bias-drift and misalignment-drift."
    ),
    parameters=(EffectParameter("dK2_dt", r"\partial_t K_2", "ug/g^2/s", "rate of K2", 1e-4, like="K2"),),
    instrument=following("K2", "dK2_dt", elapsed),
)
