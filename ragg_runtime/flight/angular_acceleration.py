"""The angular acceleration as the derivative of a recorded angular rate, and where it can be relied upon.

Motion has power up to the Nyquist frequency, if little. A derivative that is wrong there by a percent is wrong by
more than the noise of an instrument whose accelerometers are not matched, in a narrow band and beside every gap; so
the window is long and the band wide. (A band that ends where the rate holds only the noise of the gyroscope would
be quieter, but noise that falls by decades beside it gives the frequencies above it all the weight in a fit.)
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

BAND = 0.9
"""End of the band, of the Nyquist frequency."""

ROUGH = 1e-4
"""Error of a shorter window over the rms of the acceleration from which it is not relied upon. An unmatched instrument
sees a tenth of the acceleration times its radius: of some 1e-3 rad/s^2 that is 1e-9 s^-2 times ten, about its noise."""

NOISIER = 2.0
"""Noise of a shorter window over that of the long one up to which it is relied upon."""

HEAD = 32768
"""Samples from the first ones on that decide: enough for a spectrum, and the same however a file is read."""


@dataclass(frozen=True)
class Derivative:
    """How a record's angular rates are differentiated.

    Attributes
    ----------
    unsure
        Samples next to an end or a gap that are not relied upon (an eighth of a short run at most).
    """

    unsure: int = 0

    def of(self, omega: Array, rate: float) -> tuple[Array, Mask]:
        """Time derivative (N,) of a rate (N,), NaN where there is no sample, and where it can be relied upon."""
        result = differentiate(omega, rate)
        sure = np.zeros(len(omega), dtype=np.bool_)
        for run in runs(np.isfinite(omega)):
            n = run.stop - run.start
            if n > 2 * REACH:
                x = omega[run] - omega[run.start]
                inner = ndimage.correlate1d(x, _wide(), mode="nearest")[REACH : n - REACH]
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


def planned(omegas: Sequence[Array], rate: float) -> Derivative:
    """How to differentiate these rates (N,): the longest run without a gap of the first HEAD samples decides."""
    omegas = [x[:HEAD] for x in omegas]
    whole = np.asarray(np.isfinite(omegas).all(axis=0))
    longest = max(runs(whole), key=lambda r: r.stop - r.start, default=slice(0, 0))
    if longest.stop - longest.start < 8 * REACH:
        return Derivative()
    series = [x[longest] - x[longest.start] for x in omegas]
    return Derivative(max(_unsure(x) for x in series))


def _unsure(x: Array) -> int:
    """Samples next to an end at which the short windows are not good enough, by what they do amidst the record."""
    n = len(x)
    inner = slice(REACH, n - REACH)
    best = ndimage.correlate1d(x, _wide(), mode="nearest")[inner]
    f, p = signal.welch(x, 2.0, window="hann", nperseg=min(256, n // 4), detrend="constant")
    noise = np.sqrt(np.median(p[f > BAND][:-1]))
    limit = max(ROUGH * float(np.std(best)), NOISIER * float(noise * np.linalg.norm(_wide())))
    for at in range(WINDOW // 2, -1, -1):
        short = ndimage.correlate1d(x, weights(WINDOW, at), mode="nearest", origin=at - WINDOW // 2)[inner]
        if np.sqrt(np.mean((short - best) ** 2)) > limit:
            return REACH if at == WINDOW // 2 else at + 1
    return 0


@cache
def _wide() -> Array:
    """Weights (2 REACH + 1,) of a derivative, per sample, at the middle one.

    Least squares of the relative error of the response in the band, exact for polynomials up to the fourth degree.
    """
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
