"""Low-passes of the demodulated channels, as kernels: two without phase for afterwards, one causal for at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from types import MappingProxyType

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.signals.demodulate import low_pass
from ragg_runtime.signals.fir import convolved

Array = NDArray[np.float64]

ORDER, CUTOFF = 6, 0.18
"""Butterworth, in each direction; half-power frequency, Hz: forward and backward it passes half of the amplitude there."""

FORGOTTEN = 1e-9
"""Share of its sum at which a Butterworth kernel is cut off: far below what noise leaves of any gradient."""

EDGE = 1e-4
"""Share of the kernel that may lie beyond the record's end: of a gradient of 1000 Eo it is 0.1 Eo."""


@dataclass(frozen=True)
class Demodulator:
    """A low-pass of the mixed output: y[k] = sum over j of taps[j] x[k + ahead - j].

    Attributes
    ----------
    name, description
        As on the command line; in words.
    rate
        Hz.
    taps
        (n,): the kernel; its sum is 1.
    ahead
        Samples of the future that a value needs.
    latency
        By how much a value lags behind the gradient that it tells, s: the group delay at zero frequency.
    """

    name: str
    description: str
    rate: float
    taps: Array
    ahead: int
    latency: float

    @property
    def before(self) -> int:
        """Samples of the past that a value needs."""
        return len(self.taps) - 1 - self.ahead

    @cached_property
    def settling(self) -> tuple[int, int]:
        """Samples at the beginning and the end of a record of which the kernel has not heard enough."""
        share = np.abs(self.taps) / np.sum(np.abs(self.taps))
        from_right = np.cumsum(share[::-1])[::-1]  # [j]: all from j on
        first = int(np.sum(from_right[self.ahead + 1 :] > EDGE))
        last = int(np.sum(np.cumsum(share)[: self.ahead] > EDGE))
        return first, last

    @cached_property
    def bandwidth(self) -> float:
        """Noise bandwidth, Hz: of white noise of density 1 a variance of this passes (one-sided)."""
        return float(np.sum(self.taps**2)) * self.rate / 2

    def response(self, frequency: Array) -> NDArray[np.complex128]:
        """Complex gain at frequencies, Hz; its phase is against the sample's own instant."""
        back = np.exp(-2j * np.pi * frequency / self.rate)
        return np.asarray(polyval(back, self.taps) * back ** (-float(self.ahead)))

    def low_passed(self, x: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """Series (..., N) through the kernel; beyond their ends they are taken as zero."""
        ends = [(0, 0)] * (x.ndim - 1) + [(self.before, self.ahead)]
        padded: NDArray[np.complex128] = np.pad(x, ends)
        return convolved(padded, self.taps)


def _fir(rate: float) -> Demodulator:
    taps = low_pass(rate)
    return Demodulator(
        name="fir",
        description="linear-phase FIR, half amplitude at 0.2 Hz (the paper's)",
        rate=rate,
        taps=taps,
        ahead=len(taps) // 2,
        latency=0.0,
    )


def _impulse(rate: float) -> Array:
    """Impulse response of the Butterworth low-pass until it is forgotten."""
    from scipy import signal  # slow to import, and only these demodulators need it

    if rate / 2 <= CUTOFF:
        raise UserError(
            "the low-pass does not fit the sampling rate",
            found=f"cutoff {CUTOFF:g} Hz, rate {rate:g} Hz",
            expected="a rate of more than twice the cutoff",
        )
    sections = signal.butter(ORDER, CUTOFF, fs=rate, output="sos")
    impulse = np.zeros(int(200 * rate))  # 200 s: the slowest pole is forgotten (1e-9) after 71 s
    impulse[0] = 1.0
    h = signal.sosfilt(sections, impulse)
    rest = np.cumsum(np.abs(h[::-1]))[::-1]
    return np.asarray(h[: int(np.sum(rest > FORGOTTEN * rest[0]))])


def _butterworth(rate: float) -> Demodulator:
    h = _impulse(rate)
    both = convolved(h, h[::-1], "full")
    return Demodulator(
        name="butterworth",
        description="Butterworth of order 6 at 0.18 Hz, forward and backward",
        rate=rate,
        taps=both / np.sum(both),
        ahead=len(h) - 1,
        latency=0.0,
    )


def _causal(rate: float) -> Demodulator:
    h = _impulse(rate)
    h = h / np.sum(h)
    return Demodulator(
        name="causal",
        description="Butterworth of order 6 at 0.18 Hz, forward alone",
        rate=rate,
        taps=h,
        ahead=0,
        latency=float(np.sum(np.arange(len(h)) * h)) / rate,
    )


DEMODULATORS: Mapping[str, Callable[[float], Demodulator]] = MappingProxyType(
    {"fir": _fir, "butterworth": _butterworth, "causal": _causal}
)
"""Name -> demodulator at a sampling rate, Hz."""


@cache
def demodulator(name: str, rate: float) -> Demodulator:
    """The demodulator of this name; UserError if there is none."""
    if name not in DEMODULATORS:
        raise UserError("there is no such demodulator", found=repr(name), expected=", ".join(DEMODULATORS))
    return DEMODULATORS[name](rate)
