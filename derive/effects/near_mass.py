"""Third-order gravity tensor of a near mass."""

from __future__ import annotations

from typing import TYPE_CHECKING

import sympy as sp

from derive.effect import Effect, EffectParameter, Values

if TYPE_CHECKING:
    from derive.context import Context

INDEPENDENT = ("xxx", "xxy", "xxz", "xyy", "xyz", "yyy", "yyz")


def component(p: Values, *axes: str) -> sp.Expr:
    """T_abc, symmetric in its indices and without trace: T_xxc + T_yyc + T_zzc = 0."""
    name = "".join(sorted(axes))
    if name in INDEPENDENT:
        return p[f"T_{name}"]
    other = name[0]  # sorted, so that the pair is z z
    return -(component(p, "x", "x", other) + component(p, "y", "y", other))


def field(r: sp.Matrix, p: Values, c: Context) -> sp.Matrix:
    # Gravity that grows with r is felt as specific force of the other sign.
    second = [sp.Matrix(3, 3, [component(p, k, a, b) for a in "xyz" for b in "xyz"]) for k in "xyz"]
    return sp.Matrix([-r.dot(T * r) / 2 for T in second])


EFFECT = Effect(
    id="near-mass",
    title="Near mass",
    physics=(
        "The gradient of a mass close to the instrument changes across the disc; Eq. 10 takes it for uniform."
    ),
    source="Taylor series of the gravity field, continued from paper, Eq. 10",
    equation=r"\bm f_j \mathrel{-}= \tfrac12\, T_{abc}\, r_b r_c",
    limits=(
        "Constant tensor, fixed in the measurement frame, one order beyond the gradient: the mass is farther "
        "than a few radii of the disc. Even in r: opposite accelerometers cancel it up to their mismatch."
    ),
    parameters=tuple(
        EffectParameter(
            f"T_{k}", f"T_{{{k}}}", "Eo/m", f"third derivative {k} of the potential", 10.0, shared=True
        )
        for k in INDEPENDENT
    ),
    field=field,
)
