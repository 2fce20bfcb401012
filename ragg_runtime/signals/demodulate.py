"""Quadrature demodulation of G_out into the inline and cross channels.

From Eq. 30 and 16, G_out = k_ggi (T1 sin 2 phi + T2 cos 2 phi) with T1 = (Gamma_xx - Gamma_yy)/2 + ... and
T2 = -Gamma_xy + ...; so with a low-pass LP

    inline = Gamma_xx - Gamma_yy =  LP(4 G_out sin 2 phi) / k_ggi
    cross  = Gamma_xy            = -LP(2 G_out cos 2 phi) / k_ggi
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import i0

from ragg_runtime.base.errors import UserError
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]

CUTOFF = 0.2
"""Half-amplitude frequency of the low-pass (Hz), as in the paper."""

WIDTH = 0.1
"""Transition width (Hz): the stop band begins at 0.25 Hz, where the neighbours of the 2nd harmonic land."""

ATTENUATION = 100.0
"""Stop-band attenuation (dB)."""

REFERENCE = 16.0
"""Sampling rate (Hz) at which the length of the low-pass is rounded to samples: that of the paper's experiments here."""


class Demodulated(NamedTuple):
    """Gamma_xx - Gamma_yy and Gamma_xy, (M,) s^-2 each, where the filter saw a whole record: of the input samples ``valid``."""

    inline: Array
    cross: Array
    valid: slice


def low_pass(rate: float, *, cutoff: float = CUTOFF, attenuation: float = ATTENUATION) -> Array:
    """Linear-phase FIR low-pass of odd length, unit gain at zero frequency (Kaiser window).

    Samples of one function of time, whatever the rate: channels that were made at one and thinned out to another have
    passed the same filter. ``rate``, ``cutoff``: Hz; ``attenuation``: dB.
    """
    from scipy.signal import kaiser_beta  # slow to import

    if not (np.isfinite(rate) and 0 < cutoff - WIDTH / 2 < cutoff + WIDTH / 2 < rate / 2):
        raise UserError(
            "the low-pass does not fit the sampling rate",
            found=f"cutoff {cutoff:g} Hz, transition {WIDTH:g} Hz, rate {rate:g} Hz",
            expected="a pass band above zero and a stop band below half of the rate",
        )
    # Kaiser's rule (1974) for the transition
    length = int(np.ceil((attenuation - 7.95) / 2.285 / (np.pi * WIDTH / (REFERENCE / 2)) + 1))
    half = (length // 2) / REFERENCE
    reach = int(half * rate * (1 + 1e-12))
    t = np.arange(-reach, reach + 1) / rate
    taps = np.sinc(2 * cutoff * t) * i0(
        kaiser_beta(attenuation) * np.sqrt(np.clip(1 - (t / half) ** 2, 0.0, None))
    )
    return np.asarray(taps / np.sum(taps), dtype=np.float64)


def is_demodulable(rate: float) -> bool:
    """Whether a record of this rate, Hz, is long enough for the low-pass; of a disc at rest it need not be."""
    return rate / 2 > CUTOFF + WIDTH / 2


def demodulate(
    G_out: ArrayLike, phi: ArrayLike, rate: float, k_ggi: float, *, attenuation: float = ATTENUATION
) -> Demodulated:
    """Inline and cross channels of an output before demodulation, or of a residual of it, (N,) V.

    ``phi``: the disc angle at the same instants, (N,) rad, evenly spaced in time at ``rate``, Hz. ``k_ggi``: sum of k_VI K1 R, V per
    s^-2 (in SI; 4.54e-4 V/Eo is 4.54e5). ``attenuation``: of the low-pass's stop band, dB.
    """
    G = np.asarray(G_out, dtype=np.float64)
    angle = np.asarray(phi, dtype=np.float64)
    taps = low_pass(rate, attenuation=attenuation)
    half = taps.size // 2
    inline = convolve(4 * G * np.sin(2 * angle), taps) / k_ggi
    cross = -convolve(2 * G * np.cos(2 * angle), taps) / k_ggi
    return Demodulated(inline, cross, slice(half, G.size - half))
