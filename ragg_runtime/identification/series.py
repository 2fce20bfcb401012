"""What a figure shows of a residual: envelope, spectrum, demodulated channels, and the noise expected in each."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import series_name
from ragg_runtime.estimation.fitted import Fitted, estimate_variance
from ragg_runtime.estimation.observation import BLOCKS, combine_output
from ragg_runtime.estimation.scores import finite
from ragg_runtime.estimation.whitening import PreparedFlight
from ragg_runtime.signals import derivative
from ragg_runtime.signals.demodulators import CUTOFF, WIDTH, find_demodulator, low_pass

Array = NDArray[np.float64]

POINTS = 600
"""Columns of a drawn time series: about one for every second pixel of a laptop's screen."""

LEAST = 8
"""Samples of which an rms is drawn."""

SEGMENT = 128.0
"""Length of the segments of a drawn spectrum, s: a resolution of a fraction of the spin rate."""

BAND = CUTOFF
"""Hz up to which the demodulated channels hold the gradient."""

DRAWN = CUTOFF + WIDTH / 2
"""Hz up to which they are drawn: beyond it the low-pass leaves nothing."""


@dataclass(frozen=True)
class SeriesEnvelope:
    """A series in ``POINTS`` segments: middle (s), minimum, maximum and rms of the valid samples (NaN: none)."""

    time: Array
    low: Array
    high: Array
    rms: Array


def decimate(time: Array, x: Array, valid: NDArray[np.bool_], points: int = POINTS) -> SeriesEnvelope:
    """Decimate (N,) samples to at most ``points`` columns of ``LEAST`` samples or more, without losing an extreme."""
    edges = np.unique(np.linspace(0, len(x), min(points, max(1, len(x) // LEAST)) + 1).astype(np.intp))
    starts = edges[:-1]
    count = np.add.reduceat(valid.astype(float), starts)
    empty = count == 0.0
    low = np.minimum.reduceat(np.where(valid, x, np.inf), starts)
    high = np.maximum.reduceat(np.where(valid, x, -np.inf), starts)
    rms = np.sqrt(np.add.reduceat(np.where(valid, x, 0.0) ** 2, starts) / np.maximum(count, 1.0))
    middle = 0.5 * (time[starts] + time[edges[1:] - 1])
    return SeriesEnvelope(middle, *(np.where(empty, np.nan, v) for v in (low, high, rms)))


def compute_measured(w: PreparedFlight) -> Array:
    """(N,) V: what was observed, as G_out; zero where a sample is not valid."""
    return combine_output(w.observation, w.observation.data)


@dataclass(frozen=True)
class AmplitudeSpectrum:
    """One-sided amplitude density over frequency, Hz and unit/sqrt(Hz)."""

    frequency: Array
    density: Array


def estimate_spectrum(
    x: Array, valid: NDArray[np.bool_], rate: float, points: int = 260
) -> AmplitudeSpectrum | None:
    """Welch spectrum over the valid segments of 32 samples and more, averaged to ``points`` steps of log frequency, or ``None``."""
    from scipy import signal  # half a second to import, which a command that draws nothing need not wait for

    parts = derivative.runs(valid, 32)
    if not parts:
        return None
    longest = max(r.stop - r.start for r in parts)
    size = min(int(SEGMENT * rate), max(32, longest // 3))
    used = [r for r in parts if r.stop - r.start >= size]
    total = np.zeros(size // 2 + 1)
    for r in used:
        f, p = signal.welch(x[r], rate, nperseg=size, detrend="constant")
        total += p * (r.stop - r.start)
    psd = total / sum(r.stop - r.start for r in used)
    # The lowest bin is what is left of the mean.
    return _bin_frequencies(f[2:], psd[2:], points)


def pass_band(x: Array, rate: float, low: float, high: float) -> Array:
    """(N,): what of a series, zero where it has no value, oscillates between two frequencies (Hz)."""
    f = np.fft.rfftfreq(len(x), 1.0 / rate)
    return np.asarray(np.fft.irfft(np.where((f >= low) & (f <= high), np.fft.rfft(x), 0.0), len(x)))


def _bin_frequencies(f: Array, psd: Array, points: int) -> AmplitudeSpectrum:
    edges = np.geomspace(f[0] * 0.999, f[-1] * 1.001, points + 1)
    which = np.digitize(f, edges)
    bins = np.unique(which)
    mean = np.array([[np.mean(f[which == k]), np.mean(psd[which == k])] for k in bins])
    return AmplitudeSpectrum(mean[:, 0], np.sqrt(mean[:, 1]))


def compute_noise_density(w: PreparedFlight, k_ggi: float, spin: float, f: Array) -> Array:
    """Density of the estimated noise of what was observed as G_out, Eo/sqrt(Hz)."""
    return np.asarray(np.sqrt(_noise_psd(w, spin, f)) / k_ggi)


def _noise_psd(w: PreparedFlight, spin: float, f: Array) -> Array:
    """One-sided, V^2/Hz; where only the channels were recorded, through their low-pass about 2 spin."""
    psd = w.noise_psd(f)
    if not w.observation.recorded.demodulated:
        return psd
    r = w.observation.record
    H = r.low_pass.response(np.minimum(np.abs(f - 2 * spin), r.rate / 2))
    return np.asarray(psd * np.abs(H) ** 2)


def compute_noise_rms(w: PreparedFlight, k_ggi: float) -> float:
    """rms of the estimated noise of what was observed as G_out, Eo."""
    return float(np.sqrt(estimate_variance(w))) / abs(k_ggi)


def predict_demodulated_noise(w: PreparedFlight, k_ggi: float, multiple: int, amplitude: float) -> float:
    """Standard deviation, Eo, of LP(amplitude cos(2 pi multiple spin t) noise)."""
    r = w.observation.record
    spin, slowest = abs(r.spin_frequency), r.rate / len(r.time)  # what is slower is not in the record

    def psd(frequency: Array) -> Array:
        return _noise_psd(w, spin, np.maximum(frequency, slowest))

    power = find_demodulator("fir", r.rate).pass_power(psd, multiple * spin)
    share = 0.25 if multiple else 0.5  # of the square of the amplitude: of a wave half of it is on average
    return amplitude * float(np.sqrt(share * power)) / k_ggi


def predict_channel_noise(f: Fitted) -> tuple[float, float]:
    """Standard deviation of (inline, cross) that the noise alone would give, Eo; NaN if the low-pass is too long."""
    values = [
        [predict_demodulated_noise(w, k, 2, a) for a in (4.0, 2.0)]
        for w, k in zip(f.prepared, f.scales, strict=True)
        if w.observation.record.turning and _is_long(w)
    ]
    if not values:
        return float("nan"), float("nan")
    inline, cross = np.sqrt(np.mean(np.square(values), axis=0))
    return float(inline), float(cross)


def list_noise_floor(f: Fitted, rms_Eo: float) -> dict[str, float | None]:
    """The noise floor as JSON: before demodulation (Eo), and what the noise alone would give in the channels."""
    inline, cross = predict_channel_noise(f)
    return {"rms_Eo": rms_Eo, "inline_Eo": finite(inline), "cross_Eo": finite(cross)}


def predict_harmonic_noise(f: Fitted, harmonics: Iterable[str]) -> dict[str, float]:
    """The same at harmonics of the spin (const, cos 1 ...), Eo."""
    works = [(w, s) for w, s in zip(f.prepared, f.scales, strict=True) if _is_long(w)]
    found = {}
    for h in harmonics:
        k = series_name.harmonic(h).multiple
        squares = [predict_demodulated_noise(w, s, k, 2.0 if k else 1.0) ** 2 for w, s in works]
        found[h] = float(np.sqrt(np.mean(squares))) if squares else float("nan")
    return found


def _is_long(w: PreparedFlight) -> bool:
    r = w.observation.record
    return len(r.time) >= 2 * len(low_pass(r.rate))


def measure_blocks(w: PreparedFlight, residual: Array, k_ggi: float) -> tuple[Array, Array]:
    """Edges (BLOCKS + 1,) s and rms (BLOCKS,) Eo of a residual in the blocks of time (NaN: no valid sample)."""
    r = w.observation.record
    edges = r.time[np.minimum(w.edges, len(r.time) - 1)]
    rms = np.full(BLOCKS, np.nan)
    for b in range(BLOCKS):
        part = slice(w.edges[b], w.edges[b + 1])
        v = r.valid[part]
        if np.any(v):
            rms[b] = np.sqrt(np.mean(residual[part][v] ** 2)) / k_ggi
    return edges, rms


def find_worst(f: Fitted, residuals: Sequence[Array], most: int) -> list[int]:
    """Positions of the ``most`` flights with the largest error over their noise, in the flights' own order."""
    ratio = []
    for w, e in zip(f.prepared, residuals, strict=True):
        v = w.observation.record.valid
        ratio.append(float(np.sqrt(np.mean(e[v] ** 2))) / compute_noise_rms(w, 1.0))
    return sorted(sorted(range(len(ratio)), key=lambda n: -ratio[n])[:most])
