from derive.effect import Context, Effect, EffectParameter, Parameters, Values


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    return {"dR": k["dR"] + p.c_z * c.force.z}


EFFECT = Effect(
    id="arm-sag",
    title="Sag of the arm",
    physics=(
        "The disc sags under the specific force along the spin axis; the bending shortens or lengthens the "
        "distance of the accelerometer from the centre."
    ),
    source="linear elasticity of the disc",
    equation=(
        r"R_j \leftarrow R_j + c_z f_z,\; \bm f_j \mathrel{+}= 2\,(\bm\omega_{im} + \dot\phi\,\bm e_z)"
        r" \times \dot R_j \bm e_r + \ddot R_j \bm e_r"
    ),
    limits=(
        "Linear, without resonance; f_z is along tau_z, which points down. Its tilt is mount-compliance. While the "
        "axial force changes, so does the radius, and the turning disc adds the Coriolis force of that velocity."
    ),
    parameters=(EffectParameter("c_z", "c_z", "um/g", "lengthening per axial specific force", 0.1),),
    instrument=instrument,
)
