from derive.effect import Context, Effect, EffectParameter, Parameters, Values
from derive.hooks import RELAXATION, remembered_force, response


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    x, _, z = remembered_force("flow", p, c, RELAXATION)
    start = response("flow_start", p, c, RELAXATION)
    return {
        "vartheta_y": k["vartheta_y"] + p.e_yx * x + p.e_yz * z + p.e_y0 * start,
        "vartheta_z": k["vartheta_z"] + p.e_zx * x + p.e_z0 * start,
    }


EFFECT = Effect(
    id="mount-creep",
    title="Creep of the mount",
    physics="Glue and plastic below an accelerometer flow under its weight: it goes on tilting for a while after the force has changed.",
    source="as bias-creep; creep of adhesives: R. D. Adams, Adhesive Bonding, 2005",
    equation=(
        r"\vartheta_y \leftarrow \vartheta_y + (e_{yx} f_x + e_{yz} f_z)/(1 + \tau s) + e_{y0} e^{-t/\tau},\;"
        r" \vartheta_z \leftarrow \vartheta_z + e_{zx} f_x/(1 + \tau s) + e_{z0} e^{-t/\tau}"
    ),
    limits=(
        "Added by name, not searched for, as bias-creep. The part that yields at once is mount-compliance, to which all of it comes for a "
        "tau far below the turn of the disc. Where a_z hardly changes, e_yx and e_yz are the c_i and c_p of bias-creep. A tau far above "
        "the record's length is misalignment-drift."
    ),
    parameters=(
        EffectParameter("e_yx", "e_{yx}", "urad/g", "slow vartheta_y by a steady force along x", 10.0),
        EffectParameter("e_yz", "e_{yz}", "urad/g", "slow vartheta_y by a steady force along z", 10.0),
        EffectParameter("e_zx", "e_{zx}", "urad/g", "slow vartheta_z by a steady force along x", 10.0),
        EffectParameter("e_y0", "e_{y0}", "urad", "vartheta_y at the beginning by the force of before", 1.0),
        EffectParameter("e_z0", "e_{z0}", "urad", "vartheta_z at the beginning by the force of before", 1.0),
        *RELAXATION,
    ),
    instrument=instrument,
    memory="flow",
    searched=False,
)
