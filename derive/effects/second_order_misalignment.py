from derive.effect import Context, Effect, SensedForce, Values, shared


def second_order(q: SensedForce, f: SensedForce, p: Values, c: Context) -> SensedForce:
    return SensedForce(*(nominal + p.kappa * (full - nominal) for nominal, full in zip(q, f, strict=True)))


EFFECT = Effect(
    id="second-order-misalignment",
    title="Mounting angles in the second-order terms",
    physics=(
        "The second-order coefficients act on the force along the true input, output and pendulous axes, vartheta_x and the mounting "
        "angles included; the paper uses the nominal axes."
    ),
    source="paper, Eq. 5a and 5b, dropped from Eq. 5 on as being of the order of 1e-12 g",
    equation=r"K f_x f_y \to K f_i f_o,\; f_{i,o,p} = f_{x,y,z} + \kappa\,(\bm C - 1) f_{x,y,z}",
    limits=(
        "kappa is 0 (the paper) or 1 (in full); nothing in between is physical. With constant coefficients it only redefines K2 ... K8 "
        "by parts in ten thousand, and is absorbed by them; it vanishes "
        "where the model already keeps the angles."
    ),
    parameters=(
        shared("kappa", r"\kappa", "1", "share of the angles in the second-order terms", 1.0, physical=1.0),
    ),
    second_order=second_order,
    moot=lambda order, kinematics: order.second_order_angles,
)
