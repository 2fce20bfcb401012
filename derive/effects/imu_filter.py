import sympy as sp

from derive.effect import Context, Effect, Motion, Values, shared


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    def unfiltered(v: sp.Matrix, b: sp.Expr) -> sp.Matrix:
        return v.applyfunc(lambda e: e - b * c.rate(c.rate(e)))

    return m._replace(
        a=unfiltered(m.a, p.b_a), omega=unfiltered(m.omega, p.b_w), omegadot=unfiltered(m.omegadot, p.b_w)
    )


EFFECT = Effect(
    id="imu-filter",
    title="Filter between motion sensor and disc",
    physics=(
        "The motion sensor averages over its sampling interval or has a low-pass, or a mount between it and the disc "
        "resonates: fast motion is recorded smaller, or larger, than it acts on the disc."
    ),
    source=(
        "Taylor series of a response without delay: b is a 24th of the square of the averaging interval, and 1/w^2 of a "
        "mount on which the disc resonates at w: 3e-3 s^2 at 3 Hz"
    ),
    equation=(
        r"\bm a = \bm a_{rec} - b_a\,\ddot{\bm a}_{rec},\; \bm\omega_{im} = \bm\omega_{rec} - b_\omega\,\ddot{\bm\omega}_{rec}"
    ),
    limits=(
        "First order in b, for motion slow against filter or resonance, whose quality factor does not matter there; alike along all "
        "axes. The delay is time-offset or gyro-delay. A resonance near the motion's frequencies is mount-resonance, one of an "
        "accelerometer accelerometer-resonance."
    ),
    parameters=tuple(
        shared(f"b_{n}", latex, "s^2", f"curvature of the response to {of}", 1e-5)
        for n, latex, of in (("a", "b_a", "specific force"), ("w", r"b_\omega", "angular rate"))
    ),
    sensing=sensing,
)
