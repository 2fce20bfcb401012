"""The values of the output channel themselves: saturation and quantisation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CLIPPED = 5
"""Samples at one and the same extreme value that make a saturated output."""

ENOUGH = 1 << 20
"""Samples that show a lattice, if there is one."""

COARSE = 0.5
"""Quantisation step, in standard deviations of the noise, from which it is reported."""


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


def quantisation(G: Array, valid: NDArray[np.bool_], noise: float) -> float | None:
    """Step of the lattice on which all values of an output lie, V, if it matters beside the noise."""
    values = np.unique(G[:ENOUGH][valid[:ENOUGH]])
    if len(values) < 3:
        return None
    steps = np.diff(values)
    q = float(np.min(steps))
    if q < COARSE * noise:
        return None
    # all values multiples of one step, to the rounding of the file
    q = float(np.median(steps / np.rint(steps / q)))
    if np.max(np.abs(values / q - np.rint(values / q))) > 1e-3:
        return None
    return q
