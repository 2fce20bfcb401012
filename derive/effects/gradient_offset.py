"""A constant gradient of masses at rest around the disc."""

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values
from derive.stages import Motion

COMPONENTS = ("xx", "xy", "xz", "yy", "yz")


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    xx, xy, xz, yy, yz = (p[f"G_{k}"] for k in COMPONENTS)
    # Outside the masses the gradient is free of trace.
    return m._replace(Gamma=m.Gamma + sp.Matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, -(xx + yy)]]))


EFFECT = Effect(
    id="gradient-offset",
    title="Gradient of masses at rest around the disc",
    physics=(
        "Housing, gimbals and counterweights that do not turn with the disc attract it with a constant gradient, which is not in the "
        "recorded gradients."
    ),
    source="self-gradient modelling of airborne gradiometers (paper, Section I: self-gradient modeling)",
    equation=r"\bm\Gamma \leftarrow \bm\Gamma + \bm G",
    limits=(
        "Constant, at rest in the measurement frame. A well-made instrument responds only to G_xx - G_yy and G_xy; any other constant "
        "signal at twice the spin rate looks the same, for example that of rectified vibration."
    ),
    parameters=tuple(
        EffectParameter(f"G_{k}", f"G_{{{k}}}", "Eo", f"constant gradient {k}", 100.0, shared=True)
        for k in COMPONENTS
    ),
    sensing=sensing,
)
