import sympy as sp

from derive.effect import Context, Effect, Geometry, Values, components
from derive.hooks import lean


def geometry(g: Geometry, p: Values, c: Context) -> Geometry:
    turned = [c.cos_phi * p.w_x - c.sin_phi * p.w_y, c.sin_phi * p.w_x + c.cos_phi * p.w_y, 0]
    return lean(g, sp.Matrix(turned), "wobble", c)


EFFECT = Effect(
    id="spin-axis-wobble",
    title="Wobble of the disc",
    physics="The disc does not sit square on its shaft: its plane is tilted, and the tilt turns with the disc.",
    source="rigid-body kinematics",
    equation=(
        r"\bm r_j \leftarrow \bm R(\bm w)\, \bm r_j,\; \bm\tau_j \leftarrow \bm R(\bm w)\, \bm\tau_j,\;"
        r" \bm w = w_x \bm e_r(\phi) + w_y \bm e_t(\phi)"
    ),
    limits=(
        "Rotation to second order in w; the shaft about which the disc turns is unchanged. To first order it "
        "is a pattern of the mounting angles of the four accelerometers, which beta_x and vartheta_y absorb."
    ),
    parameters=components("w", "xy", "rad", "lean of the disc about its own {k} axis", 1e-5),
    geometry=geometry,
)
