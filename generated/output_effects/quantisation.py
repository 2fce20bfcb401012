"""Recogniser of quantisation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


Array = NDArray[np.float64]

ENOUGH = 1 << 20
"""Samples that show a lattice, if there is one."""

COARSE = 0.5
"""Quantisation step, in standard deviations of the noise, from which it is reported."""


def present(values: Array, valid: NDArray[np.bool_], noise: float) -> bool:
    """Of an output (N,), V, with the standard deviation of its noise, V."""
    return quantisation(values, valid, noise) is not None


def quantisation(G: Array, valid: NDArray[np.bool_], noise: float) -> float | None:
    """Quantisation step of an output, V, if it is not negligible against the noise."""
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
