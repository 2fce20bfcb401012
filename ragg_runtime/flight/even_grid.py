"""Series whose samples jitter, on the even grid and back: derivatives are made there."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline

from ragg_runtime.flight.angular_acceleration import Derivative
from ragg_runtime.flight.record import Array, Mask
from ragg_runtime.flight.sampling import Grid

DEGREE = 5
"""Of the splines: their derivative is as good as the finite differences'."""

FEWEST = DEGREE + 3
"""Samples from which one is drawn."""


def differentiated(x: Array, grid: Grid, derivative: Derivative) -> tuple[Array, Mask]:
    """Time derivative at the samples' own instants, and where it is good; where they jitter, by way of the even grid."""
    resampled = evenly(x, grid)
    slope, sure = derivative.of(resampled, 1 / grid.step)
    there = np.isfinite(slope)
    if resampled is x or np.sum(there) < FEWEST:
        return slope, sure
    even = _even(grid)
    return np.where(there, make_interp_spline(even[there], slope[there], DEGREE)(grid.time), np.nan), sure


def evenly(x: Array, grid: Grid) -> Array:
    """Samples at evenly spaced instants; themselves where they do not jitter."""
    there = np.isfinite(x)
    if not grid.jitters or np.sum(there) < FEWEST:
        return x
    return np.where(there, make_interp_spline(grid.time[there], x[there], DEGREE)(_even(grid)), np.nan)


def _even(grid: Grid) -> Array:
    n = len(grid.time)
    return np.asarray(np.polyval(np.polyfit(np.arange(n), grid.time, 1), np.arange(n)))
