import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components
from derive.hooks import small_rotation


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    # Seen by a disc that leans by alpha, everything else leans by -alpha: the spin axis stays its z.
    back = small_rotation(sp.Matrix([-p.alpha_x, -p.alpha_y, 0]), "tilt", c)
    if (
        c.standing is not None
    ):  # about the disc's own axes: about the measurement frame's, one may be the spin's
        back = c.tape.let_each("tilt_on_disc", c.standing * back * c.standing.T)
    return Motion(back * m.a, back * m.omega, back * m.omegadot, back * m.Gamma * back.T)


EFFECT = Effect(
    id="spin-axis-tilt",
    title="Tilt of the spin axis",
    physics=(
        "The disc's bearing is not along the z axis of the motion sensor: the plane in which the accelerometers turn is tilted in the "
        "measurement frame, and the spin with it."
    ),
    source="rigid-body kinematics",
    equation=(
        r"\bm r_j \leftarrow \bm R(\bm\alpha)\, \bm r_j,\; \bm\tau_j \leftarrow \bm R(\bm\alpha)\, \bm\tau_j,"
        r"\; \bm e_z \leftarrow \bm R(\bm\alpha)\, \bm e_z,\; \bm\alpha = (\alpha_x, \alpha_y, 0)"
    ),
    limits=(
        "Rotation to second order in alpha. The same as rotating the motion record back (imu-misalignment), except for the gradients, "
        "which alpha rotates too."
    ),
    parameters=components(
        "alpha", "xy", "rad", "lean about the {k} axis of the disc at rest", 1e-4, latex=r"\alpha"
    ),
    sensing=sensing,
)
