from derive.effect import Context, Effect, Expr, Values, shared


def disc_angle(p: Values, c: Context) -> Expr:
    return -p.c * c.motion.omegadot[2]


EFFECT = Effect(
    id="spin-servo",
    title="Compliance of the spin servo",
    physics=(
        "The disc's inertia holds it back when the platform is turned about the spin axis; the servo that drives it is "
        "no stiffer than its bandwidth, so the true angle lags by the torque over the stiffness."
    ),
    source="a position loop of bandwidth f is as stiff as its inertia times (2 pi f)^2: c = 1/(2 pi f)^2, 2.5e-4 s^2 for 10 Hz",
    equation=r"\phi \leftarrow \phi - c\,\dot\omega_{imz}",
    limits=(
        "Slow against the servo's bandwidth, and only if the recorded angle does not contain it (no encoder, or one on the motor). "
        "The force of the uneven spin, R phi'', is in a model of full kinematics (or with disc-spin)."
    ),
    parameters=(shared("c", "c", "s^2", "angle lost per angular acceleration", 1e-4),),
    disc_angle=disc_angle,
)
