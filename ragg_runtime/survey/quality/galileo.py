"""Figures as the package galileoQC (M. H. Dransfield, Geoscience Australia, 1.0.16) defines them, written anew.

Its users find their numbers again; where this project's own figures differ, the page on quality control says so.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import correlate

from ragg_runtime.flight.record import Array
from ragg_runtime.survey.quality.spectra import causal_band, rolling_std

WINDOW = 50
"""Samples of the rolling standard deviation of ``checkHighFreq``."""

_ENDS = 10  # samples whose mean is one end of the line that checkHighFreq takes away
_ORDER = 6


def in_line_sum(uv: Sequence[Array]) -> Array:
    """(N,) Eo: the sum of three in-line channels over the root of three, less its mean (``ilsNoiseAnalysis``)."""
    total = np.sum(uv, axis=0) / np.sqrt(3.0)
    return np.asarray(total - np.mean(total))


def in_line_sum_filtered(
    uv: Sequence[Array], rate: float, low: float = 0.03, high: float = 0.1
) -> Array | None:
    """The same, band-passed (``dontfilter=False``)."""
    return causal_band(in_line_sum(uv), rate, low, high, _ORDER)


def difference_noise(a: Array, b: Array) -> float:
    """Eo: the standard deviation of (A - B)/sqrt(8) (``diffNoiseVturb``); its documentation says (A - B)/2."""
    there = np.isfinite(a + b)
    return float(np.std((a - b)[there] / np.sqrt(8.0))) if there.any() else float("nan")


def vertical_displacement_turbulence(height: Array) -> float:
    """The standard deviation of the second differences of the height, per sample squared (``ilsNoiseAnalysis``)."""
    return float(np.std(np.diff(height, n=2)))


def high_frequency(values: Array, rate: float, low: float, high: float) -> float:
    """Eo: the largest rolling standard deviation of the channel in a band (``checkHighFreq``); NaN without the band."""
    n = len(values)
    start, end = np.mean(values[:_ENDS]), np.mean(values[-_ENDS:])
    straight = values - start - np.arange(n) * (end - start) / n
    filtered = causal_band(straight, rate, low, high, _ORDER)
    if filtered is None or n <= WINDOW:
        return float("nan")
    return float(np.max(rolling_std(filtered, WINDOW)))


def phase_lag(a: Array, b: Array, rate: float) -> float:
    """s: the shift at which two channels are most alike, to a tenth of a sample (``checkPhase``)."""
    n = len(a)
    both = correlate((a - a.mean()) / a.std(), (b - b.mean()) / b.std())
    lags = np.arange(1 - n, n)
    near = slice(
        max(0, int(both.argmax()) - 20), int(both.argmax()) + 21
    )  # the spline of all gives the same there
    fine = np.arange(lags[near][0], lags[near][-1], 0.1)
    return float(fine[np.argmax(CubicSpline(lags[near], both[near])(fine))] / rate)


def tensor(uv: Sequence[Array], ne: Sequence[Array]) -> dict[str, Array]:
    """The gradient's components from six channels of three discs, as ``checkFrobenius`` has them (Brewster, 2016)."""
    i1, i2, i3 = uv
    c1, c2, c3 = ne
    s2, s3 = np.sqrt(2.0), np.sqrt(3.0)
    return {
        "xx": 2 / 3 * (i3 - s2 * c1),
        "xy": 0.75 / s2 * (np.sqrt(2 / 3) * i3 - np.sqrt(1.5) * (c1 - c2)),
        "xz": np.sqrt(6) / (2 + 3 * s2) * (c1 - c2 + 2 * i3),
        "yy": s2 / 3 * c1 - (s2 * c2 + c3) / s3 - i3 / 3,
        "yz": 3 / s2 * (2 / 3 * (c3 - i1 + i2) - (c1 + c2) / 3),
        "zz": s2 / 3 * c1 + (s2 * c2 + c3) / s3 - i3 / 3,
    }


def frobenius(uv: Sequence[Array], ne: Sequence[Array]) -> float:
    """Eo: the standard deviation of the tensor's Frobenius norm above 0.1 Hz, of a line at 1 Hz (``checkFrobenius``).

    Faithfully: the channels' means are not taken away, so that the filter's start is in it, and the filtered xy stands
    in the place of yy. :func:`frobenius_centred` does without both.
    """
    parts = {n: causal_band(v, 1.0, 0.1, 0.49, _ORDER) for n, v in tensor(uv, ne).items()}
    return _norm({**parts, "yy": parts["xy"]})


def frobenius_centred(uv: Sequence[Array], ne: Sequence[Array], rate: float) -> float:
    """The same of channels without their means, with yy in its own place, at any rate."""
    centred = [[v - np.mean(v) for v in group] for group in (uv, ne)]
    made = tensor(*centred)
    return _norm({n: causal_band(v, rate, 0.1, 0.49 * min(rate, 1.0), _ORDER) for n, v in made.items()})


def _norm(parts: Mapping[str, Array | None]) -> float:
    total = np.zeros(1)
    for name, values in parts.items():
        if values is None:
            return float("nan")
        total = total + (1.0 if name[0] == name[1] else 2.0) * values**2
    return float(np.std(np.sqrt(total)))
