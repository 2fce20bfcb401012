from derive.effect import Context, Effect, EffectParameter, Parameters, Values
from derive.hooks import RELAXATION, remembered_force, response


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    i, o, p_axis = remembered_force("creep", p, c, RELAXATION)
    start = response("creep_start", p, c, RELAXATION)
    return {"K0": k["K0"] + p.c_i * i + p.c_o * o + p.c_p * p_axis + p.c_0 * start}


EFFECT = Effect(
    id="bias-creep",
    title="Creep of the null bias",
    physics=(
        "Flexures, leads and adhesives go on yielding for a while after a force has changed, and recover as slowly: the null bias follows "
        "the force of the last seconds to hours."
    ),
    source=(
        "Standard linear solid, strain = f/E_1 + f/E_2/(1 + tau s) with tau = eta/E_2 (W. N. Findley, J. S. Lai and K. Onaran, Creep and "
        "Relaxation of Nonlinear Viscoelastic Materials, 1976)"
    ),
    equation=r"K_0 \leftarrow K_0 + \sum_k c_k f_k/(1 + \tau s) + c_0 e^{-t/\tau},\; k = i, o, p",
    limits=(
        "Added by name, not searched for: sixteen coefficients and a time constant look like many effects. The part that yields at once is "
        "K1 and the misalignment angles. c_0 settles from the force before the record. A tau far below the turn of the disc is lag; far "
        "above the record's length c_i and c_o vanish, as the disc turns the force over, and c_p is a walk of the bias with the "
        "sum of a_z. Where a_z hardly changes it is mount-creep; nearly steady a_z makes c_p bias-drift."
    ),
    parameters=(
        EffectParameter("c_i", "c_i", "ug/g", "slow bias by a steady force along the input axis", 10.0),
        EffectParameter("c_o", "c_o", "ug/g", "slow bias by a steady force along the output axis", 10.0),
        EffectParameter("c_p", "c_p", "ug/g", "slow bias by a steady force along the pendulous axis", 10.0),
        EffectParameter("c_0", "c_0", "ug", "null bias at the beginning by the force of before", 1.0),
        *RELAXATION,
    ),
    instrument=instrument,
    memory="creep",
    searched=False,
)
