from derive.effect import Context, Effect, EffectParameter, Expr, SensedForce, Values


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    # 1/(1 + tau s) = 1 - tau s + tau^2 s^2 - ...
    first = c.rate(f.i)
    return i - p.tau * first + p.tau**2 * c.rate(first)


EFFECT = Effect(
    id="lag",
    title="Lag of the accelerometer loop",
    physics=(
        "The closed rebalance loop follows the specific force with a first-order lag. Since the disc "
        "turns a steady horizontal force into one at the spin frequency, even nanoseconds show."
    ),
    source="closed-loop transfer function of a force-rebalance accelerometer, 1/(1 + tau s)",
    equation=r"V_j \leftarrow V_j/(1 + \tau_j s)",
    limits=(
        "Expanded to second order in tau: tau must be far below the time scale of the force (0.1 s). Cross-talk, a share of "
        "another voltage some time late, is in G_out a gain and a lag of the accelerometer that it comes from: the two are degenerate "
        "there, and tau may then be negative."
    ),
    parameters=(EffectParameter("tau", r"\tau", "s", "time constant of the loop", 1e-8),),
    transducer=transducer,
)
