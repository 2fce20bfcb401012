"""How large an error is: before demodulation, in the demodulated channels, as a density; and tails of distributions, as logarithms."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, astuple, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.base.progress import split_range
from ragg_runtime.model.record import Record
from ragg_runtime.signals.demodulators import CUTOFF, Demodulator, find_demodulator

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
    """Inline + i cross (..., N), Eo, of residuals of an output (..., N), V; NaN where a sample under the low-pass is missing."""
    demodulated = np.full(e.shape, complex(np.nan, np.nan))
    if r.turning:
        d = find_demodulator("fir", r.rate)
        cosine, sine = r.quadratures
        present = find_whole(np.ones_like(r.valid), r.valid, d)
        mixed = np.where(r.valid, e, 0.0) * ((4 * sine - 2j * cosine) / k_ggi)
        demodulated[..., present] = d.low_pass(mixed)[..., present]
    return demodulated


# share of the samples under the low-pass that may be missing, as spikes are: it takes zeros in their place
HOLES = 0.05


def find_whole(selected: NDArray[np.bool_], valid: NDArray[np.bool_], d: Demodulator) -> NDArray[np.bool_]:
    """(N,): where the whole of a low-pass lies on samples of a selection (N,), mostly valid (N,)."""
    taps, whole = len(d.taps), np.zeros(len(valid), dtype=np.bool_)

    def under(x: NDArray[np.bool_]) -> NDArray[np.int64]:
        seen = np.cumsum(np.pad(x.astype(np.int64), (1, 0)))
        return np.asarray(seen[taps:] - seen[:-taps])

    whole[d.before : max(d.before, len(valid) - d.ahead)] = (under(selected) == taps) & (
        under(valid) >= (1 - HOLES) * taps
    )
    return whole


TOGETHER = 1 << 20  # samples of residuals that are demodulated together


def measure_errors(
    e: Array, r: Record, k_ggi: float, selections: Sequence[NDArray[np.bool_]], beyond: float = 0.0
) -> list[list[Error]]:
    """The error objects of each of some residuals (k, N), V, over each of some selections of samples (N,).

    ``k_ggi``: V/Eo; ``beyond``: mean square, V^2, that residuals have lost before (:mod:`ragg_runtime.estimation.thinning`).
    """
    nowhere = np.zeros_like(r.valid)
    whole = [
        find_whole(x, r.valid, find_demodulator("fir", r.rate)) if r.turning else nowhere for x in selections
    ]

    def measure(x: Array, seen: Complex, selected: NDArray[np.bool_], inside: NDArray[np.bool_]) -> Error:
        counted, g = selected & r.valid, seen[inside]
        rms = float(np.sqrt(np.mean(x[counted] ** 2) + beyond)) if counted.any() else float("nan")
        channels = (np.std(g.real), np.std(g.imag)) if len(g) > 1 else (np.nan, np.nan)
        return Error(rms, rms / k_ggi, float(channels[0]), float(channels[1]))

    errors = []
    for part in split_range(len(e), max(1, TOGETHER // len(r.time))):
        for x, seen in zip(e[part], demodulate_residual(e[part], r, k_ggi), strict=True):
            errors.append([measure(x, seen, *pair) for pair in zip(selections, whole, strict=True)])
    return errors


def measure_error(e: Array, r: Record, k_ggi: float) -> Error:
    """The error object of a residual (N,), V, of a whole record; ``k_ggi``: V/Eo."""
    return measure_errors(e[None], r, k_ggi, [np.ones_like(r.valid)])[0][0]


def pool_errors(errors: Sequence[Error], weights: Sequence[float]) -> Error:
    """One error of several flights: quadratic mean, weighted by their samples."""
    if len(errors) == 1:
        return errors[0]
    w = np.asarray(weights) / np.sum(weights)
    values = np.array([astuple(e) for e in errors])
    counted = np.where(np.isfinite(values), w[:, None], 0.0)
    squares = np.sum(counted * np.nan_to_num(values) ** 2, axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return Error(*(float(v) for v in np.sqrt(squares / np.sum(counted, axis=0))))


STD_OF_MEDIAN = 1.4826  # standard deviation of normal noise over the median of its absolute value
# Chi-square by which one explanation may be worse than another and still not be told apart (3 sigma)
INDISTINGUISHABLE = 9.0
# difference of log evidence from which one explanation is distinguishable from another
DISTINGUISHABLE = INDISTINGUISHABLE / 2


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
