from derive.effect import Context, Effect, Motion, Values, shared


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m.with_each(lambda e: c.shifted(e, p.delta_t))


EFFECT = Effect(
    id="time-offset",
    title="Clock offset of the motion record",
    physics=(
        "Motion sensor and output are sampled by different clocks or filtered with different delays: the motion of instant t is "
        "recorded at t + delta_t."
    ),
    source="time synchronisation of inertial sensors",
    equation=r"\bm v(t) = \bm v_{rec}(t + \delta t),\; \bm v = \bm a, \bm\omega_{im}, \dot{\bm\omega}_{im}",
    limits=(
        "Fits interpolate the recorded motion; exported programs approximate the delay to second order in delta_t, which "
        "must be far below the time scale of the motion. Gradients and the disc angle, which belong to the output's clock, are "
        "not moved."
    ),
    parameters=(
        shared(
            "delta_t",
            r"\delta t",
            "s",
            "lateness of the motion record",
            1e-3,
            late=("a", "omega", "omegadot"),
        ),
    ),
    sensing=sensing,
)
