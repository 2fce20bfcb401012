from derive.effect import Context, Effect, EffectParameter, Parameters, Values
from derive.hooks import HEAT, heat_of_force, response


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    heat, start = heat_of_force(p, c), response("heat_start", p, c, HEAT)
    return {"K0": k["K0"] + p.b * heat + p.b_0 * start, "K1": k["K1"] * (1 + p.s * heat + p.s_0 * start)}


EFFECT = Effect(
    id="inner-temperature",
    title="Inner temperature by the torquer's heat",
    physics=(
        "The current that holds the proof mass heats torquer and magnet with its square; what is warmed so loses the heat to the case in "
        "some time: bias and scale factor follow the force of the last seconds to minutes, and settle after switch-on."
    ),
    source="Micromachines 16, 241 (2025); IEEE Std 1293, self-heating: T_i' = (T_s - T_i)/tau + c f_i^2, linear in T_s and f_i^2",
    equation=(
        r"K_0 \leftarrow K_0 + b\,\Theta + b_0 e^{-t/\tau},\; K_1 \leftarrow K_1 (1 + s\,\Theta + s_0 e^{-t/\tau}),\;"
        r" \Theta = f_i^2/(1 + \tau s)"
    ),
    limits=(
        "One time constant. b and s are the bias' and the scale factor's dependence on temperature times the heating, b_0 and s_0 those "
        "of the inner temperature at the beginning, from which it settles. What follows T_s is thermal-bias, thermal-scale and, to first "
        "order, thermal-lag. A tau far above the record's length is bias-drift and gain-drift, one far below the turn of the disc K2 and "
        "cubic-input."
    ),
    parameters=(
        EffectParameter("b", "b", "ug/g^2", "null bias by the heat of a steady force", 100.0),
        EffectParameter("s", "s", "1/g^2", "relative scale factor by the heat of a steady force", 1e-4),
        EffectParameter("b_0", "b_0", "ug", "null bias at the beginning by heat of before", 1.0),
        EffectParameter("s_0", "s_0", "1", "relative scale factor at the beginning by heat of before", 1e-6),
        *HEAT,
    ),
    instrument=instrument,
    memory="heat",
    contains=("bias-drift", "gain-drift"),
)
