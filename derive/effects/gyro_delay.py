from derive.effect import Context, Effect, Expr, Motion, Values, shared


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    def rate(e: Expr) -> Expr:
        # The recorded acceleration is the rate of the recorded one only where both are equally late.
        change = c.rate(e)
        return e + p.delta_w * change + (p.delta_w * p.delta_d - p.delta_w**2 / 2) * c.rate(change)

    omega = m.omega.applyfunc(rate)
    return m._replace(omega=omega, omegadot=m.omegadot.applyfunc(lambda e: c.shifted(e, p.delta_d)))


EFFECT = Effect(
    id="gyro-delay",
    title="Delay of the gyroscopes against the accelerometers",
    physics=(
        "Gyroscopes and accelerometers of a motion sensor pass filters of different delay, or are read one after the "
        "other: the rate of instant t is recorded at t + delta, together with the specific force of t."
    ),
    source="group delays of the digital filters of inertial sensors; found in a record of real sensors",
    equation=(
        r"\bm\omega_{im}(t) = \bm\omega_{rec}(t + \delta_\omega),\;"
        r" \dot{\bm\omega}_{im}(t) = \dot{\bm\omega}_{rec}(t + \delta_{\dot\omega})"
    ),
    limits=(
        "Specific force keeps its clock (time-offset moves both). Fits interpolate the recorded rates; exported programs approximate "
        "the delays to second order. The two delays are equal where the angular acceleration is derived from the rate."
    ),
    parameters=(
        shared("delta_w", r"\delta_\omega", "s", "lateness of the angular rate", 1e-3, late=("omega",)),
        shared(
            "delta_d",
            r"\delta_{\dot\omega}",
            "s",
            "lateness of the angular acceleration",
            1e-3,
            late=("omegadot",),
        ),
    ),
    sensing=sensing,
)
