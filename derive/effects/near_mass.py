from functools import cache

import sympy as sp

from derive.effect import Context, Effect, Values, components

INDEPENDENT = ("xxx", "xxy", "xxz", "xyy", "xyz", "yyy", "yyz")
FOURTH = ("xxxx", "xxxy", "xxxz", "xxyy", "xxyz", "xyyy", "xyyz", "yyyy", "yyyz")


def component(p: Values, *axes: str) -> sp.Expr:
    """T_abc or T_abcd, symmetric in its indices and without trace: T_xxc + T_yyc + T_zzc = 0."""
    name = "".join(sorted(axes))
    if name.endswith("zz"):
        others = name[:-2]
        return -(component(p, "x", "x", *others) + component(p, "y", "y", *others))
    return p[f"T_{name}"]


def field(r: sp.Matrix, p: Values, c: Context) -> sp.Matrix:
    # Gravity that grows with r is a specific force of the other sign.
    r = c.in_measurement_frame(r)

    @cache
    def along(axes: str) -> sp.Expr:
        return r.dot(sp.Matrix(3, 3, [component(p, *axes, a, b) for a in "xyz" for b in "xyz"]) * r)

    second = {k: along(k) / 2 for k in "xyz"}
    third = {
        k: sp.Add(*(r["xyz".index(j)] * along("".join(sorted(k + j))) for j in "xyz")) / 6 for k in "xyz"
    }
    return c.in_disc_frame(sp.Matrix([-second[k] - third[k] for k in "xyz"]))


EFFECT = Effect(
    id="near-mass",
    title="Near mass",
    physics=(
        "The gradient of a mass close to the instrument changes across the disc; Eq. 10 assumes it uniform."
    ),
    source="Taylor series of the gravity field, continued from paper, Eq. 10",
    equation=r"\bm f_j \mathrel{-}= \tfrac12\, T_{abc}\, r_b r_c + \tfrac16\, T_{abcd}\, r_b r_c r_d",
    limits=(
        "Constant tensors, fixed in the measurement frame, two orders beyond the gradient: the mass is farther than a "
        "few radii of the disc. The first is even in r, so that opposite accelerometers cancel it up to their mismatch; "
        "the second adds up, at twice the spin rate, where it looks like a constant gradient, and at four times it."
    ),
    parameters=(
        *components("T", INDEPENDENT, "Eo/m", "third derivative {k} of the potential", 10.0),
        *components("T", FOURTH, "Eo/m^2", "fourth derivative {k} of the potential", 30.0),
    ),
    field=field,
)
