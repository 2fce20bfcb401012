"""How large an error is: before demodulation, in the demodulated channels, as a density; and tails of distributions, as logarithms."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.base.threads import split_range
from ragg_runtime.model.record import Record
from ragg_runtime.signals.demodulators import CUTOFF, Demodulator, find_demodulator, low_pass
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Error:
    """The *error* object of the interface: rms before demodulation, V and over k_ggi, Eo; standard deviations of the channels (NaN
    if the record is shorter than the low-pass).
    """

    rms_V: float
    rms_Eo: float
    inline_Eo: float
    cross_Eo: float

    def as_json(self) -> dict[str, float | None]:
        """The object as JSON, with densities, over the root of the bandwidth of 0.2 Hz: NaN becomes null."""
        root = float(np.sqrt(CUTOFF))
        densities = {"inline_Eo_per_rtHz": self.inline_Eo / root, "cross_Eo_per_rtHz": self.cross_Eo / root}
        return {k: finite(v) for k, v in (asdict(self) | densities).items()}


def list_errors(nominal: Error, calibrated: Error, holdout: Error) -> dict[str, Any]:
    """The ``error`` of the JSON of a comparison and of a calibration."""
    errors = {"nominal": nominal, "calibrated": calibrated, "holdout": holdout}
    return {name: e.as_json() for name, e in errors.items()}


def finite(x: float) -> float | None:
    """``None`` for NaN and infinity, which JSON does not have."""
    return float(x) if np.isfinite(x) else None


def demodulate_residual(e: Array, r: Record, k_ggi: float) -> Complex:
    """Inline + i cross (N,), Eo, of a residual of an output (N,), V; NaN where a sample under the low-pass is missing."""
    found = np.full(len(e), complex(np.nan, np.nan))
    if r.turning and len(e) >= shortest_demodulated(r.rate):
        d = find_demodulator("fir", r.rate)
        cosine, sine = r.quadratures
        there = find_whole(r.valid, d)
        found[there] = d.low_passed(np.where(r.valid, e, 0.0) * (4 * sine - 2j * cosine) / k_ggi)[there]
    return found


def find_whole(valid: NDArray[np.bool_], d: Demodulator) -> NDArray[np.bool_]:
    """(N,): where the whole of a low-pass lies on valid samples (N,)."""
    there = np.zeros(len(valid), dtype=np.bool_)
    there[d.before : len(valid) - d.ahead] = find_supported(valid[None], valid, len(d.taps))[0]
    return there


HOLES = 0.05
"""Share of the samples under the low-pass that may be missing, as spikes are: it takes zeros in their place."""


def find_supported(selected: NDArray[np.bool_], valid: NDArray[np.bool_], taps: int) -> NDArray[np.bool_]:
    """(groups, N - taps + 1): where a filter of so many taps lies within a selection (groups, N), mostly valid (N,)."""

    def under(x: NDArray[np.bool_]) -> NDArray[np.int64]:
        seen = np.cumsum(np.pad(x.astype(np.int64), ((0, 0), (1, 0))), axis=1)
        return np.asarray(seen[:, taps:] - seen[:, :-taps])

    return np.asarray((under(selected) == taps) & (under(valid[None]) >= (1 - HOLES) * taps))


def shortest_demodulated(rate: float) -> int:
    """Samples that a segment needs for the demodulator's low-pass to fit and leave something."""
    return len(low_pass(rate)) + int(2 * rate)


def measure_error(residual: Array, r: Record, k_ggi: float) -> Error:
    """The error object of a residual of G_out.

    Parameters
    ----------
    residual
        (N,) V.
    k_ggi
        V/Eo.
    """
    tally = Tally(1, 1, r.rate, turning=r.turning)
    everything = np.ones_like(r.valid)[None]
    tally.add(np.where(r.valid, residual, 0.0)[None], r.demodulation_angle, everything, r.valid)
    return tally.error(0, k_ggi)


def pool_errors(errors: list[Error], weights: list[float]) -> Error:
    """One error of several flights: quadratic mean, weighted by their samples."""
    w = np.asarray(weights) / np.sum(weights)
    values = np.array([[getattr(e, k) for k in Error.__dataclass_fields__] for e in errors])
    counted = np.where(np.isfinite(values), w[:, None], 0.0)
    total = np.sum(counted, axis=0)
    squares = np.sum(counted * np.nan_to_num(values) ** 2, axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return Error(*(float(v) for v in np.sqrt(squares / total)))


SERIES = 8
"""Series that are demodulated at a time: they stay in the cache."""


class Tally:
    """Sums of squares of k residual series of a flight, before and after demodulation, for ``groups`` of samples.

    ``beyond`` is a mean square, V^2, that each of the series has lost before (:mod:`ragg_runtime.estimation.thinning`). Of a disc that
    is at rest (not ``turning``) there is nothing to demodulate.
    """

    def __init__(
        self, k: int, groups: int, rate: float, *, turning: bool = True, beyond: float = 0.0
    ) -> None:
        self._beyond = beyond
        self._taps = low_pass(rate) if turning else np.empty(0)
        self.samples = np.zeros(groups)
        self.squares = np.zeros((groups, k))
        self.demodulated = np.zeros(groups)
        self._sums = np.zeros((2, groups, 2, k))  # first and second moment, group, channel, series
        none = np.empty((groups, 0), dtype=np.bool_)
        self._tail: tuple[NDArray[Any], ...] = (np.empty((k, 0)), np.empty(0), none, none[0])

    def add(self, e: Array, phi: Array, selected: NDArray[np.bool_], valid: NDArray[np.bool_]) -> None:
        """Count in the samples that follow those before: e (k, N) V, zero where not valid (N,); phi (N,) rad; selected (groups, N)."""
        counted = selected & valid
        self.samples += np.sum(counted, axis=1)
        self.squares += np.where(counted, 1.0, 0.0) @ (e**2).T
        if self._taps.size:
            new = (e, phi, selected, valid)
            joined = tuple(np.concatenate(x, axis=-1) for x in zip(self._tail, new, strict=True))
            self._demodulate(*joined)
            self._tail = tuple(x[..., 1 - len(self._taps) :].copy() for x in joined)

    def _demodulate(
        self, e: Array, phi: Array, selected: NDArray[np.bool_], valid: NDArray[np.bool_]
    ) -> None:
        if len(phi) < len(self._taps):
            return
        whole = np.where(find_supported(selected, valid, len(self._taps)), 1.0, 0.0)
        self.demodulated += np.sum(whole, axis=1)
        for c, carrier in enumerate((4 * np.sin(2 * phi), -2 * np.cos(2 * phi))):
            for some in split_range(len(e), SERIES):
                x = convolve(e[some] * carrier, self._taps)
                self._sums[0, :, c, some] += whole @ x.T
                self._sums[1, :, c, some] += whole @ (x**2).T

    def error(self, series: int, k_ggi: float, group: int = 0) -> Error:
        """The error object of one series; ``k_ggi`` in V/Eo."""
        n, m = self.samples[group], self.demodulated[group]
        rms = float(np.sqrt(self.squares[group, series] / n + self._beyond)) if n else float("nan")
        i = c = float("nan")
        if m > 1:
            mean, square = self._sums[:, group, :, series] / m
            i, c = (float(x) / k_ggi for x in np.sqrt(np.maximum(0.0, square - mean**2)))
        return Error(rms, rms / k_ggi, i, c)


INDISTINGUISHABLE = 9.0
"""Chi-square by which one explanation may be worse than another and still not be told apart (3 sigma)."""

DISTINGUISHABLE = INDISTINGUISHABLE / 2
"""Difference of log evidence from which one explanation is distinguishable from another."""


def log_sf(chi2: float, rank: int, freedom: float = np.inf) -> float:
    """Logarithm of the chi-square survival function, also where the function itself underflows.

    ``freedom``: degrees of freedom of the noise's variance, where that was estimated: chi2 / rank then follows Fisher's F.
    """
    if rank == 0:
        return 0.0
    if np.isfinite(freedom):
        return log_sf_f(chi2 / rank, rank, freedom)
    value = float(special.chdtrc(rank, chi2))
    if value > 0.0:
        return math.log(value)
    # leading asymptotic term of the incomplete gamma function
    h = rank / 2
    return float(-chi2 / 2 + (h - 1) * np.log(chi2 / 2) - special.gammaln(h))


def log_sf_t(z: float, freedom: float) -> float:
    """Logarithm of the survival function of Student's t (of the normal distribution where ``freedom`` is infinite)."""
    if np.isfinite(freedom) and freedom > 0.0:
        if z > 0.0:
            return log_sf_f(z**2, 1.0, freedom) - math.log(2.0)
        return math.log(special.stdtr(freedom, -z))
    return float(special.log_ndtr(-z))


def log_sf_f(ratio: float, d1: float, d2: float) -> float:
    """Logarithm of the F distribution's survival function, also where the function itself underflows."""
    value = float(special.fdtrc(d1, d2, ratio))
    if value > 0.0:
        return math.log(value)
    # leading term of the incomplete beta function
    x = d1 * ratio / (d2 + d1 * ratio)
    log_rest = -float(np.log1p(d1 * ratio / d2))
    return float(
        d2 / 2 * log_rest + (d1 / 2 - 1) * np.log(x) - np.log(d2 / 2) - special.betaln(d1 / 2, d2 / 2)
    )
