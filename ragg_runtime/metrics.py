"""How large an error is: before demodulation, in the demodulated channels, and as a density."""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.demodulate import CUTOFF, demodulate
from ragg_runtime.evaluate import EOTVOS, Record
from ragg_runtime.whiten import stretches

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Error:
    """The *error* object of the interface.

    Attributes
    ----------
    rms_V, rms_Eo
        Root mean square of the residual before demodulation, V, and over k_ggi, Eo.
    inline_Eo, cross_Eo
        Standard deviations of the demodulated residual (NaN if the record is shorter than the low-pass).
    inline_Eo_per_rtHz, cross_Eo_per_rtHz
        Those over the root of the demodulator's bandwidth, 0.2 Hz.
    """

    rms_V: float
    rms_Eo: float
    inline_Eo: float
    cross_Eo: float
    inline_Eo_per_rtHz: float
    cross_Eo_per_rtHz: float

    def as_json(self) -> dict[str, float | None]:
        """The object as JSON: NaN becomes null."""
        return {k: (v if np.isfinite(v) else None) for k, v in asdict(self).items()}


def channels(
    residual: Array, r: Record, k_ggi: float, selected: NDArray[np.bool_]
) -> tuple[Array, Array, Array]:
    """Demodulated residual: (time, inline, cross), s and Eo, of every selected stretch, joined."""
    phi = np.arctan2(r.sin_phi, r.cos_phi)
    times, inline, cross = [np.empty(0)], [np.empty(0)], [np.empty(0)]
    for run in stretches(selected & r.valid, shortest_demodulated(r.rate)):
        d = demodulate(residual[run], phi[run], r.rate, k_ggi / EOTVOS)
        times.append(r.time[run][d.valid])
        inline.append(d.inline / EOTVOS)
        cross.append(d.cross / EOTVOS)
    return np.concatenate(times), np.concatenate(inline), np.concatenate(cross)


def shortest_demodulated(rate: float) -> int:
    """Samples that a stretch must have for the demodulator's low-pass to fit, and leave something."""
    from ragg_runtime.demodulate import low_pass

    return len(low_pass(rate)) + int(2 * rate)


def error(residual: Array, r: Record, k_ggi: float, selected: NDArray[np.bool_] | None = None) -> Error:
    """The error object of a residual of G_out.

    Parameters
    ----------
    residual
        (N,) V.
    k_ggi
        V/Eo.
    selected
        (N,) bool: the samples to count (default: all valid ones).
    """
    chosen = r.valid if selected is None else (selected & r.valid)
    rms = float(np.sqrt(np.mean(residual[chosen] ** 2))) if np.any(chosen) else float("nan")
    _, inline, cross = channels(residual, r, k_ggi, chosen)
    i, c = (float(np.std(x)) if len(x) > 1 else float("nan") for x in (inline, cross))
    root = float(np.sqrt(CUTOFF))
    return Error(rms, rms / k_ggi, i, c, i / root, c / root)


def pooled(errors: list[Error], weights: list[float]) -> Error:
    """One error of several flights: quadratic mean, weighted by their samples."""
    w = np.asarray(weights) / np.sum(weights)
    values = np.array([[getattr(e, k) for k in Error.__dataclass_fields__] for e in errors])
    counted = np.where(np.isfinite(values), w[:, None], 0.0)
    total = np.sum(counted, axis=0)
    squares = np.sum(counted * np.nan_to_num(values) ** 2, axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return Error(*(float(v) for v in np.sqrt(squares / total)))
