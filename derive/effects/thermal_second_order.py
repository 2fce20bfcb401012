from derive.effect import Effect, EffectParameter
from derive.hooks import following, warmth

EFFECT = Effect(
    id="thermal-second-order",
    title="Temperature coefficient of the second-order coefficient",
    physics=(
        "The causes of an accelerometer's curvature, the flux weakened by the torquer's own current and the hinge's compliance, change "
        "with temperature like bias and scale factor."
    ),
    source="IEEE Std 1293, temperature sensitivity of the model's coefficients: K2 by some per cent in ten kelvin",
    equation=r"K_2 \leftarrow K_2 + \partial_T K_2 (T - 293.15\,\mathrm{K})",
    limits=(
        "Linear in one temperature. K5 of an accelerometer is K2 of its neighbours on the disc, and K6 lies beside both. "
        "Where the pendulous axis carries a steady weight K4, K7 and K8 with temperature are thermal-scale, thermal-bias "
        "and thermal-misalignment."
    ),
    channels=("temperature",),
    parameters=(EffectParameter("dK2_dT", r"\partial_T K_2", "ug/g^2/K", "change of K2", 0.03, like="K2"),),
    instrument=following("K2", "dK2_dT", warmth),
)
