from derive.effect import Effect, EffectParameter
from derive.hooks import following, overpressure

EFFECT = Effect(
    id="pressure-bias",
    title="Pressure sensitivity of the null bias",
    physics="Air pressure strains case and hinge; buoyancy acts on the proof mass of an unsealed instrument.",
    source="IEEE Std 1293, pressure sensitivity of the bias",
    equation=r"K_0 \leftarrow K_0 + \partial_p K_0 (p - 101325\,\mathrm{Pa})",
    limits=(
        "Linear in one pressure, without the lag of a leaking seal. Where the pressure changes with temperature or time it looks like "
        "thermal-bias or bias-drift."
    ),
    channels=("pressure",),
    parameters=(EffectParameter("dK0_dp", r"\partial_p K_0", "ug/kPa", "change of the null bias", 0.1),),
    instrument=following("K0", "dK0_dp", overpressure),
)
