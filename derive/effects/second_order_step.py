from derive.effect import Effect, EffectParameter
from derive.hooks import T_STEP, begun, following

EFFECT = Effect(
    id="second-order-step",
    title="Step of the second-order coefficient",
    physics="A shock moves the pendulum's null position or the magnet: the curvature of an accelerometer's characteristic is another one.",
    source="IEEE Std 1293, repeatability of the model's coefficients after shock and over switch-on: 1 to 10 ug/g^2",
    equation=r"K_2 \leftarrow K_2 + \Delta K_2 [t \ge t_s]",
    limits=(
        "One step a record; its instant is scanned, not fitted. A step of K5 is that of K2 of the neighbours on the disc; under a steady "
        "weight steps of K4, K7 and K8 are gain-step, bias-step and misalignment-step."
    ),
    kind="step",
    parameters=(EffectParameter("dK2", r"\Delta K_2", "ug/g^2", "step of K2", 1.0, like="K2"), T_STEP),
    instrument=following("K2", "dK2", begun),
)
