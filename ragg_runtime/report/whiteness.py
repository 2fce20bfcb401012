"""Panels that ask whether a residual is noise: its autocorrelation, its correlation with the motion, and against a channel.

The residual is whitened with the estimated noise spectrum. Of N white samples a correlation at any lag has a standard deviation
of 1/sqrt(N), also with a series that is not white (Box, Jenkins, Reinsel, Time Series Analysis, section 12.2); the bounds hold 99 %.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.whitening import PreparedFlight
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.wording import numbers
from ragg_runtime.wording.sections import Axes, Curve, Curves

Array = NDArray[np.float64]

NORMAL_99 = 2.5758
"""Half width of the interval that holds 99 % of a normal distribution, standard deviations."""

TURNS, LONGEST, STEPS = 4.0, 30.0, 1200
"""Lags reach over so many turns of the disc, so many seconds (of a disc that stands), and so many samples at most."""

BINS = 40
"""Bins of a channel, each of as many samples."""

MOTION = (*SPECIFIC_FORCE, *ANGULAR_RATE)


def whiten_residual(w: PreparedFlight, residual: Array) -> Array:
    """(N,) the residual (N,), V, divided by the root of the noise's density: unit variance where it is noise; NaN where not valid."""
    r = w.observation.record
    if w.observation.recorded.demodulated:
        raise UserError(
            "only demodulated channels were recorded; above their low-pass there is nothing to test"
        )
    f = np.fft.rfftfreq(len(residual), 1.0 / r.rate)
    density = w.noise_psd(np.maximum(f, f[1])) * r.rate / 2.0
    white = np.fft.irfft(np.fft.rfft(np.where(r.valid, residual, 0.0)) / np.sqrt(density), len(residual))
    return np.where(r.valid, white, np.nan)


def correlate(x: Array, y: Array, most: int) -> tuple[Array, Array]:
    """Correlation of x (N,) with y (N,) earlier by 0 ... ``most`` samples, NaN passed over; and how many pairs each lag has."""
    size = 1 << int(len(x) + most).bit_length()

    def lagged(a: Array, b: Array) -> Array:
        return np.fft.irfft(np.fft.rfft(a, size) * np.conj(np.fft.rfft(b, size)), size)[: most + 1]

    known = np.isfinite(x), np.isfinite(y)
    u, v = (np.where(k, z - np.mean(z[k]), 0.0) for k, z in zip(known, (x, y), strict=True))
    pairs = np.maximum(np.round(lagged(*(k.astype(float) for k in known))), 1.0)
    scale = np.sqrt(np.sum(u**2) / np.sum(known[0]) * np.sum(v**2) / np.sum(known[1]))
    return lagged(u, v) / pairs / max(float(scale), 1e-300), pairs


def _bounds(x: Array, middle: float, half: Array) -> Curve:
    few = np.unique(np.linspace(0, len(x) - 1, 40).astype(np.intp))  # they vary slowly
    return Curve("99 % of noise", x[few], middle - half[few], "envelope", "band", middle + half[few])


def _lags(w: PreparedFlight) -> int:
    r = w.observation.record
    spin = abs(r.spin_frequency)
    seconds = TURNS / spin if spin > 0.0 else LONGEST
    return max(2, min(int(seconds * r.rate), STEPS, len(r.time) // 4))


def plot_whiteness(f: Fitted, n: int, residual: Array, channels: Sequence[str] = MOTION) -> Curves:
    """Autocorrelation of the whitened residual (N,), V, of flight n, and its cross-correlation with channels, over lags."""
    w = f.prepared[n]
    r, e, most = w.observation.record, whiten_residual(w, residual), _lags(f.prepared[n])
    own, pairs = correlate(e, e, most)
    lag = np.arange(most + 1) / r.rate
    half = NORMAL_99 / np.sqrt(pairs)
    axes = [
        Axes(
            (_bounds(lag[1:], 0.0, half[1:]), Curve("residual", lag[1:], own[1:], width=0.9)),
            "autocorrelation",
        )
    ]
    for name in channels:
        x = np.where(r.valid, r.channels[name], np.nan)
        after, before = correlate(e, x, most)[0], correlate(x, e, most)[0]
        both, time = np.concatenate([before[:0:-1], after]), np.concatenate([-lag[:0:-1], lag])
        inside = np.concatenate([half[:0:-1], half])
        curves = (_bounds(time, 0.0, inside), Curve("correlation", time, both, width=0.9))
        axes.append(Axes(curves, "correlation", f"with {numbers.product(name)}", share=0.8))
    caption = (
        "Correlation of the whitened residual with itself and with the motion, over the lag (positive: the motion was earlier)."
        " Pale: 99 % of noise lies inside."
    )
    return Curves(f"white{n}", caption, tuple(axes), "lag, s", 1.4)


def plot_against(f: Fitted, n: int, residual: Array, channel: str) -> Curves:
    """Mean and rms of the whitened residual (N,), V, of flight n in bins of a channel, in its own unit."""
    w = f.prepared[n]
    r = w.observation.record
    if channel not in r.channels:
        raise UserError("the flight has no such channel", found=repr(channel[:40]))
    e, x = whiten_residual(w, residual), np.asarray(r.channels[channel], dtype=np.float64)
    parts = _divide(e, x)
    at, mean = (np.array([np.mean(v[p]) for p in parts]) for v in (x, e))
    rms = np.array([np.sqrt(np.mean(e[p] ** 2)) for p in parts])
    half = NORMAL_99 / np.sqrt([len(p) for p in parts])
    name, unit = numbers.product(channel), numbers.unit(SI_UNITS.get(channel, ""))
    axes = (
        Axes((_bounds(at, 0.0, half), Curve("mean", at, mean)), "mean, σ"),
        Axes((_bounds(at, 1.0, half / np.sqrt(2.0)), Curve("rms", at, rms)), "rms, σ"),
    )
    caption = (
        f"The whitened residual against {name}: mean and rms of {BINS} bins of equal counts, in standard deviations of the noise."
        " Pale: 99 % of noise lies inside. A mean outside: a missing term; an rms outside: noise that depends on the channel."
    )
    label = f"{name}{f', {unit}' if unit else ''}"
    return Curves(f"against{n}", caption, axes, label, 1.6)


def _divide(e: Array, x: Array) -> list[NDArray[np.intp]]:
    """The samples at which both are known, in bins of x, each of as many."""
    kept = np.flatnonzero(np.isfinite(e) & np.isfinite(x))
    ordered = kept[np.argsort(x[kept], kind="stable")]
    return [p for p in np.array_split(ordered, BINS) if len(p) > 2]


def find_worst_channel(f: Fitted, n: int, residual: Array) -> str:
    """The channel of flight n against which the mean of the whitened residual departs most from zero."""
    r = f.prepared[n].observation.record
    e = whiten_residual(f.prepared[n], residual)

    def departs(name: str) -> float:
        x = np.asarray(r.channels[name], dtype=np.float64)
        return float(sum(len(p) * np.mean(e[p]) ** 2 for p in _divide(e, x)))

    return max(sorted(r.channels), key=departs)
