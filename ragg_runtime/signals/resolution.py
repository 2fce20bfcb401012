"""The step in which a column is recorded: of a converter, of single precision, of the digits that were written."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LOOKED_AT = 1 << 15
"""Samples of a column from which its step is found: sorted, they are closer together than most of the others."""

FEWEST = 8
"""Different values from which a step can be told: that so many lie on a grid to ``OFF`` by chance has a probability of 2e-7."""

REPEATED = 20
"""Times that every value occurs on average from which fewer tell it as well: no continuous column repeats itself."""

OFF = 0.1
"""Part of a step by which values may lie off its multiples: what writing them in decimal digits makes of them."""

FINEST = 1e-12
"""Step over the range of a column below which it is the rounding of floating-point numbers."""


def find_step(x: Array) -> float | None:
    """The step of which all values of a column are multiples, but for an offset.

    Parameters
    ----------
    x : (N,) array
        A column, in any unit; values that are not finite do not count.

    Returns
    -------
    float or None
        The step in the column's unit; ``None`` if the values lie on no grid, or are too few.
    """
    there = x[np.isfinite(x)][:LOOKED_AT]
    values = np.unique(there)
    if len(values) < 2 or (len(values) < FEWEST and len(there) < REPEATED * len(values)):
        return None
    span = float(values[-1] - values[0])
    apart = np.sort(np.diff(values))
    apart = apart[apart > FINEST * span]
    step, reach = float(apart[0]), 1.5
    # The closest two give the step to the rounding of two values; wider distances, in whole steps, refine it.
    while True:
        some = apart[apart <= reach * step]
        step = float(np.sum(some) / np.sum(np.rint(some / step)))
        if len(some) == len(apart):
            break
        reach *= 4.0
    places = np.rint((values - values[0]) / step)
    slope, first = np.polyfit(places, values, 1)
    off = np.abs(values - first - slope * places) / slope
    return float(slope) if np.max(off) < OFF and places[-1] < 1 / FINEST else None
