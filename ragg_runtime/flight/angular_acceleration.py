"""The angular acceleration as the derivative of a recorded angular rate, and where it can be relied upon.

Motion has power up to the Nyquist frequency, if little. A derivative that is wrong there by a percent is wrong by
more than the noise of an instrument whose accelerometers are not matched, in a narrow band and beside every gap; so
the window is long and the band wide. Where the upper part of the spectrum of the rate is flat it holds the noise
of the gyroscope, which a derivative would raise in proportion to the frequency: there the band ends below.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, signal

from ragg_runtime.signals.derivative import WINDOW, differentiate, runs, weights

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

REACH = 64
"""Samples on either side that enter a derivative."""

BANDS = (0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
"""Ends of the band, of the Nyquist frequency, from which one is chosen."""

FALL = 0.12
"""Width, of the Nyquist frequency, in which the response falls to zero beyond the band."""

FLAT = 2.0
"""Power over that of the flat top of the spectrum up to which it counts as noise: motion there is smaller than noise."""

ROUGH = 1e-4
"""Error of a shorter window over the rms of the acceleration from which it is not relied upon. An unmatched instrument
sees a tenth of the acceleration times its radius: of some 1e-3 rad/s^2 that is 1e-9 s^-2 times ten, about its noise."""

NOISIER = 4.0
"""Noise of a shorter window over that of the long one up to which it is relied upon."""

HEAD = 32768
"""Samples from the first ones on that decide: enough for a spectrum, and the same however a file is read."""


@dataclass(frozen=True)
class Derivative:
    """How a record's angular rates are differentiated.

    Attributes
    ----------
    band
        End of the band, of the Nyquist frequency.
    unsure
        Samples next to an end or a gap that are not relied upon (an eighth of a short run at most).
    """

    band: float = BANDS[-1]
    unsure: int = 0

    def of(self, omega: Array, rate: float) -> tuple[Array, Mask]:
        """Time derivative (N,) of a rate (N,), NaN where there is no sample, and where it can be relied upon."""
        result = differentiate(omega, rate)
        sure = np.zeros(len(omega), dtype=np.bool_)
        for run in runs(np.isfinite(omega)):
            n = run.stop - run.start
            if n > 2 * REACH:
                x = omega[run] - omega[run.start]
                inner = ndimage.correlate1d(x, _wide(self.band), mode="nearest")[REACH : n - REACH]
                result[run.start + REACH : run.stop - REACH] = inner * rate
            unsure = min(self.unsure, n // 8)
            sure[run.start + unsure : run.stop - unsure] = n > 1
        return result, sure

    @property
    def note(self) -> str:
        text = f"omegadot_x, omegadot_y, omegadot_z are derived from omega, good to {100 * self.band:.0f} % of the Nyquist frequency"
        if self.band < BANDS[-1]:
            text += " (above it omega holds noise alone)"
        if self.unsure:
            text += f"; {self.unsure} samples next to an end or a gap, where they are poor, are not used"
        return text


def planned(omegas: Sequence[Array], rate: float) -> Derivative:
    """How to differentiate these rates (N,): the longest run without a gap of the first HEAD samples decides."""
    omegas = [x[:HEAD] for x in omegas]
    whole = np.asarray(np.isfinite(omegas).all(axis=0))
    longest = max(runs(whole), key=lambda r: r.stop - r.start, default=slice(0, 0))
    if longest.stop - longest.start < 8 * REACH:
        return Derivative()
    series = [x[longest] - x[longest.start] for x in omegas]
    found = [_band(x) for x in series]
    band = max(b for b, _ in found)
    return Derivative(band, max(_unsure(x, band, noise) for x, (_, noise) in zip(series, found, strict=True)))


def _band(x: Array) -> tuple[float, float]:
    """The narrowest band above which the spectrum is flat, and the rms of noise that its top stands for."""
    f, p = signal.welch(x, 2.0, window="hann", nperseg=min(256, len(x) // 4), detrend="constant")
    floor = float(np.median(p[f > BANDS[-1]][:-1]))
    above = f[p > FLAT * floor]
    top = float(above[above < 0.99].max(initial=0.0))
    return next((b for b in BANDS if b >= top), BANDS[-1]), float(np.sqrt(floor))


def _unsure(x: Array, band: float, noise: float) -> int:
    """Samples next to an end at which the short windows are not good enough, by what they do amidst the record."""
    n = len(x)
    inner = slice(REACH, n - REACH)
    best = ndimage.correlate1d(x, _wide(band), mode="nearest")[inner]
    limit = ROUGH * float(np.std(best))
    if band < BANDS[-1]:
        limit = max(limit, NOISIER * noise * float(np.linalg.norm(_wide(band))))
    for at in range(WINDOW // 2, -1, -1):
        short = ndimage.correlate1d(x, weights(WINDOW, at), mode="nearest", origin=at - WINDOW // 2)[inner]
        if np.sqrt(np.mean((short - best) ** 2)) > limit:
            return REACH if at == WINDOW // 2 else at + 1
    return 0


@cache
def _wide(band: float) -> Array:
    """Weights (2 REACH + 1,) of a derivative, per sample, up to ``band`` and of nothing above ``band + FALL``.

    Least squares of the relative error below, of the response above, exact for polynomials up to the fourth degree.
    """
    m = np.arange(1, REACH + 1)
    theta = (np.arange(4000) + 0.5) / 4000 * np.pi
    passed, stopped = theta <= band * np.pi, theta >= (band + FALL) * np.pi
    weight = np.where(passed, 1 / np.maximum(theta, 0.05 * np.pi), np.where(stopped, 1.0, 0.0)) / np.sqrt(
        4000
    )
    response = 2 * np.sin(np.outer(theta, m)) * weight[:, None]
    wanted = np.where(passed, theta, 0.0) * weight
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
