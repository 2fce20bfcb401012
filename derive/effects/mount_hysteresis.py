from derive.effect import Context, Effect, EffectParameter, Parameters, Values
from derive.hooks import SLIP, remembered_force


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    x, _, z = remembered_force("play", p, c, SLIP)
    return {
        "vartheta_y": k["vartheta_y"] + p.e_yx * x + p.e_yz * z,
        "vartheta_z": k["vartheta_z"] + p.e_zx * x,
    }


EFFECT = Effect(
    id="mount-hysteresis",
    title="Play of the mount",
    physics="Screws and seats of an accelerometer have play: it tilts to and fro, and stays tilted until the force has changed by enough.",
    source="as bias-hysteresis; friction in bolted joints (L. Gaul and R. Nitsche, Appl. Mech. Rev. 54, 93, 2001)",
    equation=(
        r"\vartheta_y \leftarrow \vartheta_y + e_{yx} S_w[f_x] + e_{yz} S_w[f_z],\;"
        r" \vartheta_z \leftarrow \vartheta_z + e_{zx} S_w[f_x];\; S_w \text{ as in bias-hysteresis}"
    ),
    limits=(
        "One w for all; play of half width w besides has a share of mount-compliance. Where a_z hardly changes, e_yx and e_yz are the "
        "h_i and h_p of bias-hysteresis. If the force changes by less than w nothing slips. Accelerometers stand at quarter turns."
    ),
    parameters=(
        EffectParameter("e_yx", "e_{yx}", "urad", "half of the loop of vartheta_y in the force along x", 1.0),
        EffectParameter("e_yz", "e_{yz}", "urad", "half of the loop of vartheta_y in the force along z", 1.0),
        EffectParameter("e_zx", "e_{zx}", "urad", "half of the loop of vartheta_z in the force along x", 1.0),
        *SLIP,
    ),
    instrument=instrument,
    memory="play",
)
