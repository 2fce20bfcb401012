"""Stage 5: the recorder of G_out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference.effects.catalogue import Injected

Array = NDArray[np.float64]


def record_output(G_out: Array, effects: Injected) -> Array:
    """G_out (N,) V, clipped at +-V_max and then rounded to multiples of q."""
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
