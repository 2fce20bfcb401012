"""Saturated motion sensors: many samples of a channel at one and the same extreme value, and few just below it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.flight.output_effects.saturation import saturation
from ragg_runtime.flight.record import ANGULAR_RATE, SPECIFIC_FORCE

Array = NDArray[np.float64]

CHANNELS = (*SPECIFIC_FORCE, *ANGULAR_RATE)
"""Columns that it is looked for in."""

LATTICE = 5
"""So many times as often as the next smaller value occurs the extreme one, or the channel is but coarsely quantised."""


def present(values: Array, valid: NDArray[np.bool_], noise: float) -> bool:
    """Of a channel of the motion, (N,); the noise of the output does not matter."""
    return clipped(values, valid) is not None


def clipped(x: Array, valid: NDArray[np.bool_]) -> NDArray[np.bool_] | None:
    """Samples (N,) at the end of the sensor's range; ``None`` if it was not reached."""
    usable = valid & np.isfinite(x)
    found = saturation(x, usable)
    if found is None:
        return None
    below = np.where(usable & ~found[1], np.abs(x), 0.0)
    next_ = float(np.max(below))
    if next_ == 0.0 or np.sum(found[1]) < LATTICE * np.sum(below >= next_ * (1 - 1e-12)):
        return None
    return found[1]
