from derive.effect import Context, Effect, EffectParameter, Parameters, Values
from derive.hooks import THERMAL_SLIP, response


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    return {"K0": k["K0"] + p.h * response("cycle_temperature", p, c, THERMAL_SLIP)}


EFFECT = Effect(
    id="thermal-hysteresis",
    title="Hysteresis of the null bias in temperature",
    physics=(
        "Parts of unlike metals slip on each other, and glue stays strained, as the instrument warms and cools: the null bias differs "
        "between rising and falling temperature."
    ),
    source="IEEE Std 1293, thermal hysteresis; stop operator as in bias-hysteresis (A. Visintin, Differential Models of Hysteresis, 1994)",
    equation=(
        r"K_0 \leftarrow K_0 + h\,S_w[T],\; \mathrm d S_w = \mathrm d T/w \text{ while } -1 \le S_w \le 1"
    ),
    limits=(
        "Added by name, not searched for: in a record in which the temperature only rises it is a bias that settles, and looks like "
        "inner-temperature, thermal-lag, a drift or a step; it needs turns by more than 2 w. While the temperature changes by less than w "
        "it is thermal-bias; play besides has a share of that. S begins at 0. That of vartheta_y acts alike where a_z hardly changes."
    ),
    channels=("temperature",),
    parameters=(EffectParameter("h", "h", "ug", "half of the loop of the bias", 1.0), *THERMAL_SLIP),
    instrument=instrument,
    memory="cycle",
    searched=False,
)
