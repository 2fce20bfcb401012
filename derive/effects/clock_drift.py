from derive.effect import Context, Effect, Motion, Values, shared


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    return m.with_each(lambda e: c.shifted(e, p.epsilon * c.time))


EFFECT = Effect(
    id="clock-drift",
    title="Drift of the motion record's clock",
    physics=(
        "Motion sensor and output are sampled by clocks that drift apart: the motion of instant t is recorded at t + epsilon t."
    ),
    source="frequency accuracy of quartz oscillators (IEEE Std 1139): 1e-8 with an oven, 1e-5 without",
    equation=(
        r"\bm v(t) = \bm v_{rec}(t + \epsilon t),\; \bm v = \bm a, \bm\omega_{im}, \dot{\bm\omega}_{im}"
    ),
    limits=(
        "From the instant 0 of the record's time column (another one is time-offset). Fits interpolate the recorded motion; exported "
        "programs approximate the delay to second order in epsilon t, which must be far below the time scale "
        "of the motion."
    ),
    parameters=(
        shared(
            "epsilon",
            r"\epsilon",
            "1",
            "lateness of the motion record that a second adds",
            1e-6,
            late=("a", "omega", "omegadot"),
            growing=True,
        ),
    ),
    sensing=sensing,
)
