from derive.effect import Context, Effect, EffectParameter, Parameters, Values
from derive.hooks import SLIP, remembered_force


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    i, o, p_axis = remembered_force("slip", p, c, SLIP)
    return {"K0": k["K0"] + p.h_i * i + p.h_o * o + p.h_p * p_axis}


EFFECT = Effect(
    id="bias-hysteresis",
    title="Hysteresis of the null bias",
    physics=(
        "Friction in pivots and leads, and the torquer's magnet, hold against a force until it has changed by enough: the null bias "
        "differs between rising and falling force."
    ),
    source=(
        "IEEE Std 1293, hysteresis error; play and stop operators (A. Visintin, Differential Models of Hysteresis, 1994; P. R. Dahl, "
        "AIAA J. 14, 1675, 1976)"
    ),
    equation=(
        r"K_0 \leftarrow K_0 + \sum_k h_k S_w[f_k],\; k = i, o, p;\; \mathrm d S_w = \mathrm d f_k/w"
        r" \text{ while } -1 \le S_w \le 1"
    ),
    limits=(
        "One w for all; play of half width w, P_w[f] = f - w S_w[f], has a share of K1, vartheta_z or vartheta_y besides. If the force "
        "changes by less than w nothing slips, and it is these parameters alone. A record tells the product h/w least where the force "
        "changes by far more than w. Where a_z hardly changes it is mount-hysteresis. Accelerometers stand at quarter turns of the disc."
    ),
    parameters=(
        EffectParameter("h_i", "h_i", "ug", "half of the loop in the force along the input axis", 1.0),
        EffectParameter("h_o", "h_o", "ug", "half of the loop in the force along the output axis", 1.0),
        EffectParameter("h_p", "h_p", "ug", "half of the loop in the force along the pendulous axis", 1.0),
        *SLIP,
    ),
    instrument=instrument,
    memory="slip",
)
