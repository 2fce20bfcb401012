"""Gradient of fuel that is burnt."""

import sympy as sp

from derive.context import Context
from derive.effect import Effect, EffectParameter, Values
from derive.stages import Motion


def sensing(m: Motion, p: Values, c: Context) -> Motion:
    xx, xy, xz, yy, yz = (p[f"G_{k}"] for k in ("xx", "xy", "xz", "yy", "yz"))
    # Outside the masses the gradient is free of trace.
    of_mass = sp.Matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, -(xx + yy)]])
    return m._replace(Gamma=m.Gamma + c.channel("fuel_mass") * of_mass)


EFFECT = Effect(
    id="fuel-gradient",
    title="Gradient of the fuel",
    physics="The fuel in the carrier's tanks attracts the instrument, and decreases during the flight.",
    source="3 G m / r^3: a ton at three metres is 7 Eo",
    equation=r"\bm\Gamma \leftarrow \bm\Gamma + \bm G\, m_{fuel}(t)",
    limits=(
        "Fuel at one place, or tanks that empty in proportion; the carrier keeps its attitude (else self-gradient). A mass "
        "that does not change looks like gradient-offset."
    ),
    channels=("fuel_mass",),
    parameters=tuple(
        EffectParameter(f"G_{k}", f"G_{{{k}}}", "Eo/kg", f"gradient {k} per mass of fuel", 0.01, shared=True)
        for k in ("xx", "xy", "xz", "yy", "yz")
    ),
    sensing=sensing,
)
