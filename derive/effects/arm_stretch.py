from derive.effect import Context, Effect, EffectParameter, Parameters, Values


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    return {"dR": k["dR"] + p.c_r * c.force.y}


EFFECT = Effect(
    id="arm-stretch",
    title="Elastic stretch of the arm",
    physics="The mount between disc and accelerometer yields to the specific force along the radius.",
    source="linear elasticity of the mount",
    equation=(
        r"R_j \leftarrow R_j + c_r f_y,\; \bm f_j \mathrel{+}= 2\,(\bm\omega_{im} + \dot\phi\,\bm e_z)"
        r" \times \dot R_j \bm e_r + \ddot R_j \bm e_r"
    ),
    limits=(
        "Linear, without resonance (that of an accelerometer is accelerometer-resonance, that of the disc's mount mount-resonance), "
        "with the force at the unstretched position. A steady horizontal force stretches and releases the arm once a "
        "turn: the Coriolis force on the stretching arm exceeds the effect of its length, and acts mostly like a scale factor."
    ),
    parameters=(EffectParameter("c_r", "c_r", "um/g", "stretch per radial specific force", 0.1),),
    instrument=instrument,
)
