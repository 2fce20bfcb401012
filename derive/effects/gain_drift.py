from derive.effect import Effect, EffectParameter
from derive.hooks import elapsed, following

EFFECT = Effect(
    id="gain-drift",
    title="Drift of the scale factor",
    physics="Magnet, sense resistor and converter age or warm: the scale factor creeps.",
    source="IEEE Std 1293, scale-factor stability",
    equation=r"K_1 \leftarrow K_1 (1 + \partial_t K_1\, t)",
    limits=(
        "Linear over the record, from the instant 0 of its time column (another one is absorbed by K1). In G_out it is also a drift of "
        "the neighbours' vartheta_z. Where they change steadily, thermal-scale and a balancing-loop look like it, as do inner-temperature "
        "that settles and, with a steady horizontal force, spin-rate-offset."
    ),
    parameters=(
        EffectParameter("dK1_dt", r"\partial_t K_1", "1/s", "relative rate of the scale factor", 1e-9),
    ),
    instrument=following("K1", "dK1_dt", elapsed),
)
