from derive.effect import Effect, EffectParameter
from derive.hooks import following, warmth

EFFECT = Effect(
    id="thermal-bias",
    title="Temperature coefficient of the null bias",
    physics="Hinge torque and pick-off null shift as the instrument warms.",
    source="IEEE Std 1293, bias temperature sensitivity",
    equation=r"K_0 \leftarrow K_0 + \partial_T K_0 (T - 293.15\,\mathrm{K})",
    limits=(
        "Linear in one temperature, without the lag of heat flow. Where the temperature changes steadily it is bias-drift, and where "
        "pressure or field change with it pressure-bias or magnetic-axial-bias; where a_z hardly changes thermal-misalignment acts alike."
    ),
    channels=("temperature",),
    parameters=(EffectParameter("dK0_dT", r"\partial_T K_0", "ug/K", "change of the null bias", 1.0),),
    instrument=following("K0", "dK0_dT", warmth),
)
