from derive.effect import Effect, EffectParameter
from derive.hooks import elapsed, following

EFFECT = Effect(
    id="bias-drift",
    title="Drift of the null bias",
    physics="Stress in the hinge and charge on the pick-off relax after switch-on: the null bias creeps.",
    source="IEEE Std 1293, bias stability",
    equation=r"K_0 \leftarrow K_0 + \partial_t K_0\, t",
    limits=(
        "Linear over the record, from the instant 0 of its time column (another one is absorbed by K0). Where they change steadily, "
        "thermal-bias, pressure-bias and magnetic-axial-bias look like it, as does inner-temperature that settles, and misalignment-drift "
        "where a_z hardly changes."
    ),
    parameters=(EffectParameter("dK0_dt", r"\partial_t K_0", "ug/s", "rate of the null bias", 1e-4),),
    instrument=following("K0", "dK0_dt", elapsed),
)
