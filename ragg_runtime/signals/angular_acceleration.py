"""The angular acceleration as the derivative of a recorded angular rate, and where it can be relied upon."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.interpolate import make_interp_spline

from ragg_runtime.signals.derivative import WINDOW, differentiate, runs, weights

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

REACH = 64
"""Samples on either side that enter a derivative."""

BAND = 0.9
"""End of the band, of the Nyquist frequency."""

ROUGH = 1e-4
"""Error of a shorter window over the rms of the acceleration from which it is not relied upon. An unmatched instrument
sees a tenth of the acceleration times its radius: of some 1e-3 rad/s^2 that is 1e-9 s^-2 times ten, about its noise."""

NOISIER = 2.0
"""Noise of a shorter window over that of the long one up to which it is relied upon."""

JITTER = 1e-7
"""Deviation from even instants, in steps, from which they are followed: the last digits of a time of a day."""

DEGREE = 5
"""Of the splines through instants that jitter: their derivative is as good as the finite differences'."""

HEAD = 32768
"""Samples from the first ones on that decide: enough for a spectrum, and the same however a file is read."""


@dataclass(frozen=True)
class RateDerivative:
    """How a record's angular rates are differentiated; ``unsure`` samples next to an end or a gap are not relied upon."""

    unsure: int = 0

    def of(self, omega: Array, rate: float) -> tuple[Array, Mask]:
        """Time derivative (N,) of a rate (N,), NaN where there is no sample, and where it can be relied upon."""
        result = differentiate(omega, rate)
        sure = np.zeros(len(omega), dtype=np.bool_)
        for run in runs(np.isfinite(omega)):
            n = run.stop - run.start
            if n > 2 * REACH:
                x = omega[run] - omega[run.start]
                inner = ndimage.correlate1d(x, wide_weights(), mode="nearest")[REACH : n - REACH]
                result[run.start + REACH : run.stop - REACH] = inner * rate
            unsure = min(self.unsure, n // 8)
            sure[run.start + unsure : run.stop - unsure] = n > 1
        return result, sure

    @property
    def note(self) -> str:
        text = f"omegadot_x, omegadot_y, omegadot_z are derived from omega, good to {100 * BAND:.0f} % of the Nyquist frequency"
        if self.unsure:
            text += f"; {self.unsure} samples next to an end or a gap, where they are poor, are not used"
        return text


def derive_accelerations(rates: Sequence[Array], time: Array) -> tuple[list[Array], Mask, RateDerivative]:
    """The derivatives of angular rates, whether they can be relied upon, and how they were made.

    Parameters
    ----------
    rates
        (N,) each, NaN where none was recorded.
    time
        (N,) s: the samples' own instants, which may jitter.

    Returns
    -------
    (N,) each, NaN where there is no rate; (N,) bool; the derivative.
    """
    k = np.arange(len(time))
    even = np.asarray(np.polyval(np.polyfit(k, time, 1), k), dtype=np.float64)
    rate = (len(time) - 1) / float(time[-1] - time[0])
    jitters = bool(np.max(np.abs(time - even)) * rate > JITTER)
    straight = [resample(x, time, even) for x in rates] if jitters else rates
    derivative = plan_derivative(straight, rate)
    made, sure = zip(*(derivative.of(x, rate) for x in straight), strict=True)
    slopes = [resample(x, even, time) if jitters else x for x in made]
    return slopes, np.all(sure, axis=0), derivative


def resample(x: Array, time: Array, instants: Array) -> Array:
    """A series (N,) at instants that are near its own, s; every run without a gap separately, NaN where it has no sample."""
    found = np.full(len(x), np.nan)
    for run in runs(np.isfinite(x)):
        size = run.stop - run.start
        degree = min(DEGREE, (size - 1) // 2 * 2 - 1)
        found[run] = x[run] if size < 3 else make_interp_spline(time[run], x[run], degree)(instants[run])
    return found


def plan_derivative(omegas: Sequence[Array], rate: float) -> RateDerivative:
    """How to differentiate these rates (N,): the runs without a gap of the first HEAD samples decide."""
    omegas = [x[:HEAD] for x in omegas]
    whole = np.asarray(np.isfinite(omegas).all(axis=0))
    longest = max((r.stop - r.start for r in runs(whole)), default=0)
    long = [r for r in runs(whole) if r.stop - r.start >= min(8 * REACH, max(TELLING, longest // 2))]
    if not long:
        return RateDerivative(0 if whole.all() else WINDOW // 2)
    return RateDerivative(max(_unsure([x[r] - x[r.start] for r in long]) for x in omegas))


TELLING = 3 * REACH
"""Shortest run of which the middle is differentiated by the long window, for the short ones to be compared with it."""


def _unsure(series: Sequence[Array]) -> int:
    """Samples next to an end at which the short windows are not good enough, by what they do amidst these runs."""
    inner = [slice(REACH, len(x) - REACH) for x in series]

    def made(taps: Array, origin: int = 0) -> Array:
        parts = [ndimage.correlate1d(x, taps, mode="nearest", origin=origin) for x in series]
        return np.concatenate([y[i] for y, i in zip(parts, inner, strict=True)])

    best = made(wide_weights())
    longest = max(series, key=len)
    from scipy import signal  # slow to import, and only records with gaps need it

    f, p = signal.welch(longest, 2.0, window="hann", nperseg=min(256, len(longest) // 4), detrend="constant")
    noise = np.sqrt(np.median(p[f > BAND][:-1]))
    limit = max(ROUGH * float(np.std(best)), NOISIER * float(noise * np.linalg.norm(wide_weights())))
    for at in range(WINDOW // 2, -1, -1):
        if np.sqrt(np.mean((made(weights(WINDOW, at), at - WINDOW // 2) - best) ** 2)) > limit:
            return REACH if at == WINDOW // 2 else at + 1
    return 0


@cache
def wide_weights() -> Array:
    """Weights (2 REACH + 1,) of a derivative, per sample, at the middle one; exact for polynomials up to the fourth degree."""
    m = np.arange(1, REACH + 1)
    theta = (np.arange(4000) + 0.5) / 4000 * BAND * np.pi
    scale = 1 / np.maximum(theta, 0.05 * np.pi) / np.sqrt(len(theta))
    response, wanted = 2 * np.sin(np.outer(theta, m)) * scale[:, None], theta * scale
    moments = 2 * np.stack([(m / REACH) ** d for d in (1, 3)])
    q, r = np.linalg.qr(moments.T, mode="complete")
    fixed = q[:, :2] @ np.linalg.solve(r[:2].T, np.array([1 / REACH, 0.0]))
    free = q[:, 2:]
    left = np.concatenate([response @ free, 1e-6 * free])
    right = np.concatenate([wanted - response @ fixed, -1e-6 * fixed])
    half = fixed + free @ np.linalg.lstsq(left, right, rcond=None)[0]
    weights = np.concatenate([-half[::-1], [0.0], half])
    weights.flags.writeable = False
    return weights
