from derive.effect import Context, Effect, EffectParameter, Expr, SensedForce, Values


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    rate = c.case.omega
    return i + p.K_ip * rate.dot(c.geometry.tau[0, :]) * rate.dot(c.geometry.tau[2, :])


EFFECT = Effect(
    id="anisoinertia",
    title="Anisoinertia of the pendulum",
    physics=(
        "The pendulum's moments of inertia about its input and its pendulous axis differ: turning about both at once "
        "twists it about its output axis. The case spins about the pendulous axis all the time, so the platform's rate about the input "
        "axis appears multiplied by the spin."
    ),
    source="IEEE Std 1293, angular-velocity-sensitive terms of a pendulous accelerometer",
    equation=(
        r"I_j/K_{j1} \mathrel{+}= K_{ip}\,(\bm\omega \cdot \bm\tau_{jx})(\bm\omega \cdot \bm\tau_{jz}),\;"
        r" \bm\omega = \bm\omega_{im} + \dot\phi\,\bm e_z"
    ),
    limits=(
        "Rate of the case along the nominal axes. With a steady spin it acts like the omega x Omega term of pendulum-angular: the two "
        "differ only by the angular acceleration."
    ),
    parameters=(
        EffectParameter(
            "K_ip",
            "K_{ip}",
            "ug/(rad/s)^2",
            "bias per product of the rates about input and pendulous axis",
            10.0,
        ),
    ),
    transducer=transducer,
)
