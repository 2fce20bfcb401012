"""Quadrature demodulation of G_out into inline and cross, its low-passes as kernels, and the gradient tensor from several discs.

From Eq. 30 and 16, G_out = k_ggi (T1 sin 2 phi + T2 cos 2 phi) with T1 = (Gamma_xx - Gamma_yy)/2 + ... and
T2 = -Gamma_xy + ...; so with a low-pass LP

    inline = Gamma_xx - Gamma_yy =  LP(4 G_out sin 2 phi) / k_ggi
    cross  = Gamma_xy            = -LP(2 G_out cos 2 phi) / k_ggi

A disc with axes e_1, e_2 (angle 0, a quarter turn on) sees inline = e_1 G e_1 - e_2 G e_2 and cross = e_1 G e_2. No
channel sees the trace: it is zero by Laplace's equation, and that is put in. So three discs give six channels for five
components, and one combination of them vanishes for any gradient (for axes at right angles the sum of the three
inline channels, (Gamma_yy - Gamma_zz) + (Gamma_zz - Gamma_xx) + (Gamma_xx - Gamma_yy)): its size is a figure of quality.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import NamedTuple

import numpy as np
import scipy  # its parts are loaded when they are first used: commands without a flight need none
from numpy.polynomial.polynomial import polyval
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, check_choice, count
from ragg_runtime.signals.fir import Series, convolve

Array = NDArray[np.float64]

CUTOFF = 0.2  # half-amplitude frequency of the low-pass (Hz), as in the paper
# transition width (Hz): the stop band begins at 0.25 Hz, where the neighbours of the 2nd harmonic land
WIDTH = 0.1
ATTENUATION = 100.0  # stop-band attenuation (dB)
# sampling rate, Hz, at which the length of the low-pass is a whole number of samples: that of our repeated experiments
REFERENCE = 16.0
# Butterworth, in each direction; half-power frequency, Hz: forward and backward it passes half of the amplitude there
ORDER, CORNER = 6, 0.18
# share of its sum at which a Butterworth kernel is cut off: far below what noise leaves of any gradient
FORGOTTEN = 1e-9
# highest frequency, Hz, at which power is summed, as nothing passes beyond it; and number of frequencies
TOP, GRID = 0.5, 4001
EDGE = 1e-4  # share of the kernel that may lie beyond the record's end: of a gradient of 1000 Eo it is 0.1 Eo


class Demodulated(NamedTuple):
    """Gamma_xx - Gamma_yy and Gamma_xy, (M,) s^-2 each, where the filter saw a whole record: of the input samples ``valid``."""

    inline: Array
    cross: Array
    valid: slice


def demodulate(G_out: Array, phi: Array, rate: float, k_ggi: float) -> Demodulated:
    """Inline and cross channels of an output before demodulation, or of a residual of it, (N,) V.

    ``phi``: the disc angle at the same instants, (N,) rad, evenly spaced in time at ``rate``, Hz. ``k_ggi``: sum of k_VI K1 R, V per
    s^-2 (in SI; 4.54e-4 V/Eo is 4.54e5).
    """
    taps = low_pass(rate)
    inline = convolve(4 * G_out * np.sin(2 * phi), taps) / k_ggi
    cross = -convolve(2 * G_out * np.cos(2 * phi), taps) / k_ggi
    half = taps.size // 2
    return Demodulated(inline, cross, slice(half, G_out.size - half))


def low_pass(rate: float, *, cutoff: float = CUTOFF) -> Array:
    """Linear-phase FIR low-pass of odd length, unit gain at zero frequency (Kaiser window).

    Samples of one function of time, whatever the rate: channels that were made at one and thinned out to another have
    passed the same filter. ``rate``, ``cutoff``: Hz.
    """
    from scipy.signal import kaiser_beta  # slow to import

    if not 0 < cutoff - WIDTH / 2 < cutoff + WIDTH / 2 < rate / 2 < np.inf:
        raise _refuse(rate, cutoff)
    # Kaiser's rule (1974) for the transition
    length = int(np.ceil((ATTENUATION - 7.95) / 2.285 / (np.pi * WIDTH / (REFERENCE / 2)) + 1))
    half = (length // 2) / REFERENCE
    reach = int(half * rate * (1 + 1e-12))
    t = np.arange(-reach, reach + 1) / rate
    window = scipy.special.i0(kaiser_beta(ATTENUATION) * np.sqrt(np.clip(1 - (t / half) ** 2, 0.0, None)))
    taps = np.sinc(2 * cutoff * t) * window
    return np.asarray(taps / np.sum(taps), dtype=np.float64)


def _refuse(rate: float, cutoff: float) -> UserError:
    return UserError(
        "the low-pass does not fit the sampling rate",
        found=f"cutoff {cutoff:g} Hz, rate {rate:g} Hz",
        expected=f"a pass band above zero, and a stop band, {WIDTH / 2:g} Hz higher, below half of the rate",
    )


def is_demodulable(rate: float) -> bool:
    """Whether a record of this rate, Hz, is long enough for the low-pass; of a disc at rest it need not be."""
    return rate / 2 > CUTOFF + WIDTH / 2


@dataclass(frozen=True)
class Demodulator:
    """A low-pass of the mixed output: y[k] = sum over j of taps[j] x[k + ahead - j]."""

    name: str  # as on the command line
    rate: float  # Hz
    taps: Array  # (n,): the kernel; its sum is 1
    ahead: int  # samples of the future that a value needs
    description: str = ""  # in words, of those that may be asked for by name

    @cached_property
    def latency(self) -> float:
        """By how much a value lags behind the gradient, s: the group delay at zero frequency."""
        delay = float((np.arange(len(self.taps)) - self.ahead) @ self.taps)
        return delay / self.rate if abs(delay) > FORGOTTEN else 0.0  # rounding, of an even kernel

    @property
    def before(self) -> int:
        """Samples of the past that a value needs."""
        return len(self.taps) - 1 - self.ahead

    @cached_property
    def settling(self) -> tuple[int, int]:
        """Samples at the beginning and the end of a record at which the kernel has not settled."""
        share = np.cumsum(np.abs(self.taps)) / np.sum(np.abs(self.taps))
        return int(np.sum(1 - share[self.ahead : -1] > EDGE)), int(np.sum(share[: self.ahead] > EDGE))

    @cached_property
    def bandwidth(self) -> float:
        """Noise bandwidth, Hz: of white noise of density 1 a variance of this passes (one-sided)."""
        return float(np.sum(self.taps**2)) * self.rate / 2

    @cached_property
    def centred(self) -> Array:
        """(2 h + 1,): the same kernel about its present sample."""
        half = max(self.before, self.ahead)
        return np.pad(self.taps, (half - self.ahead, half - self.before))

    def response(self, frequency: Array) -> NDArray[np.complex128]:
        """Complex gain at frequencies, Hz; its phase is against the sample's own instant."""
        back = np.exp(-2j * np.pi * frequency / self.rate)
        return np.asarray(polyval(back, self.taps) * back ** (-float(self.ahead)))

    def pass_power(self, psd: Callable[[Array], Array], carrier: float) -> float:
        """Variance of a noise of one-sided density ``psd`` (function of Hz, per Hz) times 2 cos(2 pi carrier t), low-passed."""
        top = min(TOP, self.rate / 2)
        f = np.linspace(-top, top, GRID)
        power = np.abs(self.response(f)) ** 2 * psd(np.abs(carrier + f))
        return float(np.sum(power) * (f[1] - f[0]))

    def low_pass(self, x: Series) -> Series:
        """Series (..., N) through the kernel; beyond their ends they are taken as zero."""
        ends = [(0, 0)] * (x.ndim - 1) + [(self.before, self.ahead)]
        padded: Series = np.pad(x, ends)
        return convolve(padded, self.taps)


def _measure_impulse(rate: float, order: int, cutoff: float) -> Array:
    """Impulse response of a Butterworth low-pass until it is forgotten, its sum 1."""
    from scipy import signal  # slow to import, and only these demodulators need it

    if rate / 2 <= cutoff:
        raise _refuse(rate, cutoff)
    sections = signal.butter(order, cutoff, fs=rate, output="sos")
    # the slowest pole decays at this rate, 1/s; once and a half as long, for it is not alone
    slowest = 2 * np.pi * cutoff * np.sin(np.pi / (2 * order))
    impulse = np.zeros(int(-1.5 * np.log(FORGOTTEN) / slowest * rate) + 16)
    impulse[0] = 1.0
    h = signal.sosfilt(sections, impulse)
    rest = np.cumsum(np.abs(h[::-1]))[::-1]
    h = h[rest > FORGOTTEN * rest[0]]
    return np.asarray(h / np.sum(h))


DEMODULATORS = ("fir", "butterworth", "causal")


@cache
def find_demodulator(
    name: str, rate: float, cutoff: float | None = None, order: int | None = None
) -> Demodulator:
    """The demodulator of this name at a sampling rate, Hz; ``fir`` is the paper's, ``butterworth`` goes forward and backward, ``causal``
    forward alone. Of another ``cutoff``, Hz, or ``order`` than usual if these are given. UserError if there is none.
    """
    check_choice(name, DEMODULATORS, "demodulator", "there is no such demodulator")
    if name == "fir":
        corner, remark = cutoff or CUTOFF, "" if cutoff else " (the paper's)"
        taps = low_pass(rate, cutoff=corner)
        words = f"linear-phase FIR, half amplitude at {corner:g} Hz{remark}"
        return Demodulator(name, rate, taps, len(taps) // 2, words)
    corner, order, both = cutoff or CORNER, order or ORDER, name == "butterworth"
    h = _measure_impulse(rate, order, corner)
    taps = convolve(h, h[::-1], "full") if both else h
    words = (
        f"Butterworth of order {order} at {corner:g} Hz, {'forward and backward' if both else 'forward only'}"
    )
    return Demodulator(name, rate, taps, len(h) - 1 if both else 0, words)


Axis = Sequence[float] | Array

COMPONENTS = ("xx", "xy", "xz", "yy", "yz", "zz")

# channels do not determine the tensor if their design matrix has a smaller ratio of least to largest singular value
ILL = 1e-6


@dataclass(frozen=True)
class Tensor:
    """A tensor over time."""

    gamma: Array  # (6, N), components in the order of COMPONENTS, in the unit of the channels; without trace
    # (checks, N): combinations of the channels that vanish for any gradient, each normalised so that channels with errors of the size of
    # std give it a standard deviation of 1
    closure: Array
    std: Array  # (6,): standard deviation of the components for the given ones of the channels

    @property
    def quality(self) -> float:
        """rms of the closure over its expected size: 1 if the channels are as good as stated."""
        return float(np.sqrt(np.mean(self.closure**2))) if self.closure.size else float("nan")


_ENTRIES = np.array([1.0, 2.0, 2.0, 1.0, 2.0, 1.0])  # of the matrix that each component is


def project_components(first: Array, second: Array) -> Array:
    """(2, 6): inline and cross of a disc with these axes (3,), by the six components."""
    inline = np.outer(first, first) - np.outer(second, second)
    cross = (np.outer(first, second) + np.outer(second, first)) / 2
    upper = np.triu_indices(3)
    return np.asarray(np.array([inline[upper], cross[upper]]) * _ENTRIES)


def spread_across(axes: tuple[Axis, Axis], inline: Array, cross: Array) -> Array:
    """(6, N): the tensor across a disc's two axes that it sees as these channels (N,); in their unit."""
    inline_seen, cross_seen = project_components(*(np.array(a, dtype=np.float64) for a in axes)) / _ENTRIES
    return np.asarray(np.outer(inline_seen / 2, inline) + np.outer(2 * cross_seen, cross))


# the six components by xx, xy, xz, yy, yz: zz = -(xx + yy)
_TRACELESS = np.insert(np.eye(5), 5, [-1.0, 0.0, 0.0, -1.0, 0.0], axis=0)


def solve_tensor(axes: Sequence[tuple[Axis, Axis]], channels: Array, std: Array) -> Tensor:
    """The tensor that agrees best with channels (2 discs, N), inline and cross of each disc in turn.

    Parameters
    ----------
    axes
        First two axes of each disc.
    std
        (2 discs,): standard deviation of each channel.

    Raises
    ------
    UserError
        If the discs do not determine it: fewer than three, or axes in one plane.
    """
    pairs = (np.asarray(pair, dtype=np.float64) for pair in axes)
    W = np.concatenate([project_components(*pair) for pair in pairs]) @ _TRACELESS / std[:, None]
    U, s, Vt = np.linalg.svd(W)
    if len(s) < 5 or s[4] < ILL * s[0]:
        raise UserError(
            "the discs do not determine the gravity gradient tensor",
            found=count(len(axes), "disc"),
            expected="three discs with axes that do not lie in one plane",
        )
    y = channels / std[:, None]
    inverse = Vt.T / s
    gamma = _TRACELESS @ inverse @ (U[:, :5].T @ y)
    spread = _TRACELESS @ inverse
    return Tensor(gamma=gamma, closure=U[:, 5:].T @ y, std=np.asarray(np.linalg.norm(spread, axis=1)))
