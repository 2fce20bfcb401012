from derive.effect import Context, Effect, Parameters, Values, components


def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
    f = c.force
    return {
        f"vartheta_{a}": k[f"vartheta_{a}"] + p[f"c_{a}x"] * f.x + p[f"c_{a}y"] * f.y + p[f"c_{a}z"] * f.z
        for a in "yz"
    }


EFFECT = Effect(
    id="mount-compliance",
    title="Elastic tilt of the mount",
    physics=(
        "The mount of an accelerometer bends under its own weight: its misalignment angles follow the "
        "specific force, so that force times force appears in the output."
    ),
    source="linear elasticity of the mount",
    equation=r"\vartheta_{y,z} \leftarrow \vartheta_{y,z} + \sum_k c_{(y,z)k} f_k,\; k = x, y, z",
    limits=(
        "Static and linear. To first order f_i gains (c_z. f) f_y - (c_y. f) f_z, which are second-order "
        "terms: K4 absorbs c_yx, K7 c_yz, K6 c_zx, K5 c_zy, and K8 c_yy and c_zz."
    ),
    parameters=components(
        "c",
        ("yx", "yy", "yz", "zx", "zy", "zz"),
        "rad/g",
        "vartheta_{0} per specific force along {1}",
        1e-6,
        shared=False,
    ),
    instrument=instrument,
)
