"""A saturated output: many samples at one and the same extreme value."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CLIPPED = 5
"""Samples at one and the same extreme value that make a saturated output."""


def present(values: Array, valid: NDArray[np.bool_], noise: float) -> bool:
    """Of an output (N,), V; the noise, V, does not matter."""
    return saturation(values, valid) is not None


def saturation(G: Array, valid: NDArray[np.bool_]) -> tuple[float, NDArray[np.bool_]] | None:
    """(V_max, samples at it) if many samples share the extreme value of an output; else ``None``."""
    g = np.where(valid, G, 0.0)
    top = float(np.max(np.abs(g)))
    if top == 0.0:
        return None
    at = np.abs(g) >= top * (1 - 1e-12)
    # a short record at coarse quantisation may repeat its maximum: neighbours at the top tell a clip
    neighbours = int(np.sum(at[1:] & at[:-1]))
    if np.sum(at) < CLIPPED or neighbours < 2:
        return None
    return top, at
