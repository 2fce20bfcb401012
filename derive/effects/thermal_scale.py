from derive.effect import Effect, EffectParameter
from derive.hooks import following, warmth

EFFECT = Effect(
    id="thermal-scale",
    title="Temperature coefficient of the scale factor",
    physics="The torquer magnet weakens and the sense resistor changes as the instrument warms.",
    source="IEEE Std 1293, scale-factor temperature sensitivity",
    equation=r"K_1 \leftarrow K_1 (1 + \partial_T K_1 (T - 293.15\,\mathrm{K}))",
    limits=(
        "Linear in one temperature, without the lag of heat flow. Where the temperature changes steadily it is gain-drift; in G_out a "
        "change of the neighbours' vartheta_z acts alike."
    ),
    channels=("temperature",),
    parameters=(
        EffectParameter("dK1_dT", r"\partial_T K_1", "1/K", "relative change of the scale factor", 1e-6),
    ),
    instrument=following("K1", "dK1_dT", warmth),
)
