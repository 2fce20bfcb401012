"""The angular acceleration as the derivative of a recorded angular rate, and where it can be relied upon."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.interpolate import make_interp_spline

from ragg_runtime.signals.derivative import differentiate, runs, weights

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

REACH = 64
"""Samples on either side that enter a derivative. Where there are fewer, next to an end or a gap, it is good to half the frequency and
not relied upon; of a short run an eighth at either end, or little would be left of a record with many gaps."""

BAND = 0.9
"""End of the band, of the Nyquist frequency."""

JITTER = 1e-7
"""Deviation from even instants, in steps, from which they are followed: the last digits of a time of a day."""

DEGREE = 5
"""Of the splines through instants that jitter: their derivative is as good as the finite differences'."""

NOTE = (
    f"omegadot_x, omegadot_y, omegadot_z are derived from omega, good to {100 * BAND:.0f} % of the Nyquist frequency; up to"
    f" {REACH} samples next to an end or a gap, where they are poor, are not used"
)


def derive_accelerations(rates: Sequence[Array], time: Array) -> tuple[list[Array], Mask]:
    """The derivatives of angular rates, and whether they can be relied upon.

    Parameters
    ----------
    rates
        (N,) each, NaN where none was recorded.
    time
        (N,) s: the samples' own instants, which may jitter.

    Returns
    -------
    (N,) each, NaN where there is no rate; (N,) bool.
    """
    k = np.arange(len(time))
    even = np.asarray(np.polyval(np.polyfit(k, time, 1), k), dtype=np.float64)
    rate = (len(time) - 1) / float(time[-1] - time[0])
    jitters = bool(np.max(np.abs(time - even)) * rate > JITTER)
    straight = [resample(x, time, even) for x in rates] if jitters else rates
    made, sure = zip(*(differentiate_rate(x, rate) for x in straight), strict=True)
    slopes = [resample(x, even, time) if jitters else x for x in made]
    return slopes, np.all(sure, axis=0)


def differentiate_rate(omega: Array, rate: float) -> tuple[Array, Mask]:
    """Time derivative (N,) of an evenly sampled rate (N,), NaN where there is no sample, and where it can be relied upon."""
    result, sure = differentiate(omega, rate), np.zeros(len(omega), dtype=np.bool_)
    for run in runs(np.isfinite(omega)):
        n = run.stop - run.start
        if n > 2 * REACH:
            x = omega[run] - omega[run.start]
            inner = ndimage.correlate1d(x, wide_weights(), mode="nearest")[REACH : n - REACH]
            result[run.start + REACH : run.stop - REACH] = inner * rate
        unsure = min(REACH, n // 8)
        sure[run.start + unsure : run.stop - unsure] = n > 1
    return result, sure


def resample(x: Array, time: Array, instants: Array) -> Array:
    """A series (N,) at instants that are near its own, s; every run without a gap separately, NaN where it has no sample."""
    found = np.full(len(x), np.nan)
    for run in runs(np.isfinite(x)):
        size = run.stop - run.start
        degree = min(DEGREE, (size - 1) // 2 * 2 - 1)
        found[run] = x[run] if size < 3 else make_interp_spline(time[run], x[run], degree)(instants[run])
    return found


def wide_weights() -> Array:
    """Weights (2 REACH + 1,) of a derivative, per sample, at the middle one."""
    return weights(2 * REACH + 1, REACH, BAND)
