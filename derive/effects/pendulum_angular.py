from derive.effect import Context, Effect, EffectParameter, Expr, SensedForce, Values


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    return i + p.K_pa * c.case.omegadot.dot(c.geometry.tau[1, :])


EFFECT = Effect(
    id="pendulum-angular",
    title="Sensitivity to angular acceleration",
    physics=(
        "The proof mass is a pendulum about the output axis, which lies along the radius: angular "
        "acceleration of its case about that axis has to be balanced like a force."
    ),
    source="IEEE Std 1293, angular-acceleration sensitivity of a pendulous accelerometer",
    equation=(
        r"I_j/K_{j1} \mathrel{+}= K_{pa}\, (\dot{\bm\omega}_{im} + \bm\omega_{im} \times \dot\phi\,\bm e_z"
        r" + \ddot\phi\,\bm e_z) \cdot \bm\tau_{jy}"
    ),
    limits=(
        "Angular acceleration of the case, which turns with the disc: that of the platform, and the turning of "
        "the spin axis by the platform, omega x Omega, which is as large. In the omegadot terms it shifts the "
        "effective position of the accelerometer along z by -K_pa, as beta_x does."
    ),
    parameters=(
        EffectParameter("K_pa", "K_{pa}", "ug/(rad/s^2)", "bias per angular acceleration about tau_y", 10.0),
    ),
    transducer=transducer,
)
