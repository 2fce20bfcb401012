from derive.effect import Context, Effect, EffectParameter, Expr, SensedForce, Values


def transducer(i: Expr, f: SensedForce, p: Values, c: Context) -> Expr:
    return i + p.K_iii * f.i**3


EFFECT = Effect(
    id="cubic-input",
    title="Cubic input nonlinearity",
    physics=(
        "The rebalance loop's torquer and pick-off are odd functions of the current at large force: "
        "the accelerometer's response has a third-order term in the force along its input axis."
    ),
    source="IEEE Std 1293 (model equation of the linear, single-axis accelerometer), coefficient K3",
    equation=r"I_j/K_{j1} \mathrel{+}= K_{iii} f_i^3",
    limits=(
        "Orders above the third are neglected. f_i of an accelerometer is f_o of its neighbours on the disc: K_iii acts like their K_ooo "
        "(cubic-cross), and where the force hardly changes its size like odd-quadratic; c_3 of output-curve is one combination of both."
    ),
    parameters=(
        EffectParameter("K_iii", "K_{iii}", "ug/g^3", "third-order coefficient of f_i^3", 5.0, like="K2"),
    ),
    transducer=transducer,
)
