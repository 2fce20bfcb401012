"""Low-passes of the demodulated channels, as kernels: two without phase for afterwards, one causal for at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property
from types import MappingProxyType

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, check_choice
from ragg_runtime.signals.demodulate import CUTOFF as HALF_AMPLITUDE
from ragg_runtime.signals.demodulate import low_pass
from ragg_runtime.signals.fir import Series, convolve

Array = NDArray[np.float64]

ORDER, CUTOFF = 6, 0.18
"""Butterworth, in each direction; half-power frequency, Hz: forward and backward it passes half of the amplitude there."""

FORGOTTEN = 1e-9
"""Share of its sum at which a Butterworth kernel is cut off: far below what noise leaves of any gradient."""

ROOM = 32
"""Samples on either side into which a delay of part of a sample may ring."""

TOP, GRID = 0.5, 4001
"""Highest frequency, Hz, and number of those at which power is summed: beyond it nothing passes."""

EDGE = 1e-4
"""Share of the kernel that may lie beyond the record's end: of a gradient of 1000 Eo it is 0.1 Eo."""


@dataclass(frozen=True)
class Demodulator:
    """A low-pass of the mixed output: y[k] = sum over j of taps[j] x[k + ahead - j].

    Attributes
    ----------
    name
        As on the command line.
    rate
        Hz.
    taps
        (n,): the kernel; its sum is 1.
    ahead
        Samples of the future that a value needs.
    description
        In words, of those that may be asked for by name.
    """

    name: str
    rate: float
    taps: Array
    ahead: int
    description: str = ""

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
        share = np.abs(self.taps) / np.sum(np.abs(self.taps))
        from_right = np.cumsum(share[::-1])[::-1]  # [j]: all from j on
        first = int(np.sum(from_right[self.ahead + 1 :] > EDGE))
        last = int(np.sum(np.cumsum(share)[: self.ahead] > EDGE))
        return first, last

    @cached_property
    def bandwidth(self) -> float:
        """Noise bandwidth, Hz: of white noise of density 1 a variance of this passes (one-sided)."""
        return float(np.sum(self.taps**2)) * self.rate / 2

    @cached_property
    def centred(self) -> Array:
        """(2 h + 1,): the same kernel about its present sample."""
        half = max(self.before, self.ahead)
        return np.pad(self.taps, (half - self.ahead, half - self.before))

    def thinned(self, every: int) -> Demodulator:
        """What it is to the samples that are left if of its output every so many are kept, and of what it is made of too."""
        first = self.ahead % every
        taps = self.taps[first::every]
        return replace(self, rate=self.rate / every, taps=taps / np.sum(taps), ahead=self.ahead // every)

    def delayed(self, seconds: float) -> Demodulator:
        """Its output so much later; by parts of a sample with a phase in the spectrum."""
        whole = round(seconds * self.rate)
        part = seconds * self.rate - whole
        taps, ahead = self.taps, self.ahead - whole
        if abs(part) > 1e-9:
            taps = np.pad(taps, ROOM)
            ahead += ROOM
            spectrum = np.fft.rfft(taps) * np.exp(-2j * np.pi * np.fft.rfftfreq(len(taps)) * part)
            taps = np.fft.irfft(spectrum, len(taps))
        # of the past alone, or of the future alone: the kernel then has zeros at the present
        taps = np.pad(taps, (max(0, -ahead), max(0, ahead - len(taps) + 1)))
        return replace(self, taps=taps, ahead=max(0, ahead))

    def response(self, frequency: Array) -> NDArray[np.complex128]:
        """Complex gain at frequencies, Hz; its phase is against the sample's own instant."""
        back = np.exp(-2j * np.pi * frequency / self.rate)
        return np.asarray(polyval(back, self.taps) * back ** (-float(self.ahead)))

    @cached_property
    def power_gain(self) -> tuple[Array, Array]:
        """Frequencies, Hz, to either side of zero, and the power gain there."""
        top = min(TOP, self.rate / 2)
        f = np.linspace(-top, top, GRID)
        return f, np.abs(self.response(f)) ** 2

    def pass_power(self, psd: Callable[[Array], Array], carrier: float) -> float:
        """Variance of the low-pass of 2 cos(2 pi carrier t) times a noise of one-sided density ``psd``, per Hz, of frequencies, Hz."""
        f, gain = self.power_gain
        return float(np.sum(gain * psd(np.abs(carrier + f))) * (f[1] - f[0]))

    def low_passed(self, x: Series) -> Series:
        """Series (..., N) through the kernel; beyond their ends they are taken as zero."""
        ends = [(0, 0)] * (x.ndim - 1) + [(self.before, self.ahead)]
        padded: Series = np.pad(x, ends)
        return convolve(padded, self.taps)


def fir(rate: float, cutoff: float = HALF_AMPLITUDE) -> Demodulator:
    """The paper's low-pass, or one as narrow at another corner, Hz."""
    taps, own = low_pass(rate, cutoff=cutoff), " (the paper's)" if cutoff == HALF_AMPLITUDE else ""
    words = f"linear-phase FIR, half amplitude at {cutoff:g} Hz{own}"
    return Demodulator("fir", rate, taps, len(taps) // 2, words)


def _impulse(rate: float, order: int, cutoff: float) -> Array:
    """Impulse response of a Butterworth low-pass until it is forgotten, its sum 1."""
    from scipy import signal  # slow to import, and only these demodulators need it

    if rate / 2 <= cutoff:
        raise UserError(
            "the low-pass does not fit the sampling rate",
            found=f"cutoff {cutoff:g} Hz, rate {rate:g} Hz",
            expected="a rate of more than twice the cutoff",
        )
    sections = signal.butter(order, cutoff, fs=rate, output="sos")
    # the slowest pole decays at this rate, 1/s; once and a half as long, for it is not alone
    slowest = 2 * np.pi * cutoff * np.sin(np.pi / (2 * order))
    impulse = np.zeros(int(-1.5 * np.log(FORGOTTEN) / slowest * rate) + 16)
    impulse[0] = 1.0
    h = signal.sosfilt(sections, impulse)
    rest = np.cumsum(np.abs(h[::-1]))[::-1]
    h = h[: int(np.sum(rest > FORGOTTEN * rest[0]))]
    return np.asarray(h / np.sum(h))


def butterworth(rate: float, order: int = ORDER, cutoff: float = CUTOFF) -> Demodulator:
    """Forward and backward."""
    h = _impulse(rate, order, cutoff)
    words = f"Butterworth of order {order} at {cutoff:g} Hz, forward and backward"
    return Demodulator("butterworth", rate, convolve(h, h[::-1], "full"), len(h) - 1, words)


def causal(rate: float, order: int = ORDER, cutoff: float = CUTOFF) -> Demodulator:
    """Forward alone."""
    words = f"Butterworth of order {order} at {cutoff:g} Hz, forward only"
    return Demodulator("causal", rate, _impulse(rate, order, cutoff), 0, words)


def average(rate: float, seconds: float, *, centred: bool = True) -> Demodulator:
    """A moving average; samples at its ends count in part, so that its length may be any."""
    samples = max(seconds * rate, 1.0)
    ahead = int(np.ceil(samples / 2 - 0.5)) if centred else 0
    n = np.arange(-ahead, (ahead if centred else int(np.ceil(samples)) - 1) + 1)
    low, high = (-samples / 2, samples / 2) if centred else (-0.5, samples - 0.5)
    taps = np.clip(np.minimum(n + 0.5, high) - np.maximum(n - 0.5, low), 0.0, None)
    return Demodulator("average" if centred else "causal average", rate, taps / np.sum(taps), ahead)


DEMODULATORS: Mapping[str, Callable[[float], Demodulator]] = MappingProxyType(
    {"fir": fir, "butterworth": butterworth, "causal": causal}
)
"""Name -> demodulator at a sampling rate, Hz."""


@cache
def find_demodulator(name: str, rate: float) -> Demodulator:
    """The demodulator of this name; UserError if there is none."""
    check_choice(name, tuple(DEMODULATORS), "demodulator", "there is no such demodulator")
    return DEMODULATORS[name](rate)
