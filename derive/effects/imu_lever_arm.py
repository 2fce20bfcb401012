import sympy as sp

from derive.effect import Context, Effect, Motion, Values, components


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    arm = sp.Matrix([p.l_x, p.l_y, p.l_z])
    return m._replace(a=m.a - m.omegadot.cross(arm) - m.omega.cross(m.omega.cross(arm)))


EFFECT = Effect(
    id="imu-lever-arm",
    title="Lever arm of the motion sensor",
    physics="The motion sensor sits at l from the disc centre and records the specific force of that place.",
    source="rigid-body kinematics (as paper, Eq. 9)",
    equation=(
        r"\bm a = \bm a_{rec} - \dot{\bm\omega}_{im} \times \bm l"
        r" - \bm\omega_{im} \times (\bm\omega_{im} \times \bm l)"
    ),
    limits=(
        "The gradient between the two places, Gamma l (3e-7 m/s^2 for 0.1 m), is neglected: it is constant and below any "
        "accelerometer's bias."
    ),
    parameters=components("l", "xyz", "m", "position of the motion sensor, {k}", 0.01),
    sensing=sensing,
)
