"""Stage 5: the recorder of G_out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference.effects.catalogue import Injected

Array = NDArray[np.float64]


def record_output(G_out: Array, effects: Injected) -> Array:
    """G_out (N,) V, bent by a curve, clipped at +-V_max and then rounded to multiples of q."""
    if bent := effects.get("output-curve"):
        G_out = _reading(G_out, float(bent["c_2"]), float(bent["c_3"]))
    if limit := effects.get("saturation"):
        if limit["V_max"] <= 0:
            raise UserError("V_max of saturation must be positive", found=f"{limit['V_max']:g} V")
        G_out = np.clip(G_out, -limit["V_max"], limit["V_max"])
    if steps := effects.get("quantisation"):
        if steps["q"] < 0:
            raise UserError("q of quantisation must not be negative", found=f"{steps['q']:g} V")
        if steps["q"] > 0:
            G_out = steps["q"] * np.rint(G_out / steps["q"])
    return G_out


def _reading(G: Array, c_2: float, c_3: float) -> Array:
    """The reading r of a converter at the voltage G = r + c_2 r^2 + c_3 r^3, by Newton's method from r = G on."""
    r = G
    for _ in range(_NEWTON if c_2 or c_3 else 0):
        r = r - (r + c_2 * r**2 + c_3 * r**3 - G) / (1 + 2 * c_2 * r + 3 * c_3 * r**2)
    return np.asarray(r)


_NEWTON = 6
"""Steps that bring a curve of a per cent to the last digit."""
