from derive.effect import Context, Effect, EffectParameter, Expr, SensedForce, Values


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    return i + p.b * c.rate(c.rate(i))


EFFECT = Effect(
    id="second-order-loop",
    title="Second-order response of the loop",
    physics=(
        "The closed rebalance loop has a mass and a spring: beyond the delay that a lag describes it amplifies or attenuates fast "
        "forces, differently in each accelerometer."
    ),
    source=(
        "closed-loop transfer function 1/(1 + 2 zeta s/w + s^2/w^2), whose delay is the lag tau = 2 zeta/w; "
        "b = (2 zeta^2 - 1)/w^2, 3e-7 s^2 for 300 Hz"
    ),
    equation=r"V_j \leftarrow V_j + b_j\,\ddot V_j",
    limits=(
        "First order in b, for forces slow against the loop. The delay itself is lag; a b common to all accelerometers is"
        " output-filter, one of the motion only imu-filter. A mount that resonates at w has b = -1/w^2; near the force's "
        "frequencies it is accelerometer-resonance. The simulator has loops without a resonance (b not negative)."
    ),
    parameters=(
        EffectParameter("b", "b", "s^2", "curvature of the loop's response at low frequencies", 1e-8),
    ),
    transducer=transducer,
)
