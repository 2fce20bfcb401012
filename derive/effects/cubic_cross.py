import sympy as sp

from derive.effect import Context, Effect, SensedForce, Values, components

MONOMIALS: tuple[str, ...] = ("iio", "iip", "ioo", "iop", "ipp", "ooo", "oop", "opp", "ppp")
"""All monomials of third degree in f_i, f_o, f_p but f_i^3, which is the effect ``cubic-input``."""


def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    return i + sp.Add(*(p[f"K_{m}"] * sp.Mul(*(getattr(f, axis) for axis in m)) for m in MONOMIALS))


EFFECT = Effect(
    id="cubic-cross",
    title="Cubic cross-axis nonlinearity",
    physics=(
        "Force across the input axis bends the pendulum's hinge and its frame and shifts the pick-off: "
        "beyond the second order of Eq. 1 the accelerometer responds to products of three components."
    ),
    source="IEEE Std 1293 (model equation of the linear, single-axis accelerometer), carried to third order",
    equation=(
        r"I_j/K_{j1} \mathrel{+}= K_{iio} f_i^2 f_o + K_{iip} f_i^2 f_p + K_{ioo} f_i f_o^2"
        r" + K_{iop} f_i f_o f_p + K_{ipp} f_i f_p^2 + K_{ooo} f_o^3"
        r" + K_{oop} f_o^2 f_p + K_{opp} f_o f_p^2 + K_{ppp} f_p^3"
    ),
    limits=(
        "Orders above the third are neglected. f_i of an accelerometer is f_o of its neighbours on the disc: K_ooo acts like their K_iii "
        "(cubic-input), K_iio like their K_ioo. Under a steady weight K_iip, K_iop and K_oop are K2, K6 and K5; K_ipp and K_opp are K1 "
        "and vartheta_z, K_ppp is K0."
    ),
    parameters=components(
        "K", MONOMIALS, "ug/g^3", "third-order coefficient of f_{0} f_{1} f_{2}", 5.0, shared=False, like="K2"
    ),
    transducer=transducer,
)
