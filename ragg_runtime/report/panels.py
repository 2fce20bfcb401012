"""From fitted flights to plots: the data of every figure that a report shows, in Eo and seconds since the first sample.

Whiteness is asked of the residual whitened with the estimated noise spectrum. Of N white samples a correlation at any lag has a
standard deviation of 1/sqrt(N), also with a series that is not white (Box, Jenkins, Reinsel, Time Series Analysis, section 12.2);
the bounds hold 99 %. The covariance of parameters is read in the combinations of four accelerometers that G_out depends on: Sigma,
D^12, D^34, D^1234 (Eq. 18-19).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.calibrate import LEARNED, count_directions, list_combinations, list_parameters
from ragg_runtime.estimation.fitted import (
    Fitted,
    compute_noise_psd,
    estimate_variance,
    predict_demodulated_noise,
    predict_harmonic_noise,
)
from ragg_runtime.estimation.observation import BLOCKS, combine_output
from ragg_runtime.estimation.scores import demodulate_residual
from ragg_runtime.estimation.unknown_gradient import is_unknown
from ragg_runtime.estimation.whitening import PreparedFlight
from ragg_runtime.identification import comparison
from ragg_runtime.identification import parameters as combinations
from ragg_runtime.identification.parameters import UNSEEN
from ragg_runtime.io import Flight
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.signals import derivative
from ragg_runtime.signals.demodulators import CUTOFF, WIDTH
from ragg_runtime.wording import describe, describe_other, numbers
from ragg_runtime.wording.sections import Axes, Bar, Bars, Curve, Curves, Matrix, Role, Section

Array = NDArray[np.float64]
Residuals = Sequence[Array]
Lines = Sequence[tuple[str, Residuals]]  # (residual, before or after, residual of every flight)
FLIGHTS = 4  # flights that are drawn one by one, the worst of all that were given
MOST_POINTS = 4000  # points of a line above which its envelope is drawn instead
STEPS = 14  # latest steps of a history that are drawn

SECONDS = "time since the first sample, s"


COLUMNS = 600  # segments of an envelope: about one for every second pixel
LEAST = 16  # samples that are drawn
SEGMENT = 128.0  # length of the segments of a drawn spectrum, s: a resolution of a fraction of the spin rate
BAND = CUTOFF  # Hz up to which the demodulated channels hold the gradient
DRAWN = CUTOFF + WIDTH / 2  # Hz up to which they are drawn: beyond it the low-pass leaves nothing


def find_envelope(time: Array, x: Array) -> tuple[Array, ...]:
    """A series (N,) in as many segments as can be drawn: middle (s), minimum and maximum (NaN: no sample)."""
    edges = np.unique(np.linspace(0, len(x), COLUMNS + 1).astype(np.intp))
    starts = edges[:-1]
    return (
        0.5 * (time[starts] + time[edges[1:] - 1]),
        np.fmin.reduceat(x, starts),
        np.fmax.reduceat(x, starts),
    )


def estimate_spectrum(
    x: Array, valid: NDArray[np.bool_], rate: float, points: int = 260
) -> tuple[Array, Array] | None:
    """Frequencies, Hz, and one-sided amplitude densities, unit/sqrt(Hz), averaged to ``points`` steps of log frequency.

    By Welch's method over the valid segments of 32 samples and more; ``None`` where there is none.
    """
    parts = derivative.runs(valid, 32)
    if not parts:
        return None
    longest = max(r.stop - r.start for r in parts)
    size = min(int(SEGMENT * rate), max(32, longest // 3))
    segments = [r for r in parts if r.stop - r.start >= size]
    total = np.zeros(size // 2 + 1)
    for r in segments:
        f, p = signal.welch(x[r], rate, nperseg=size, detrend="constant")
        total += p * (r.stop - r.start)
    psd = total / sum(r.stop - r.start for r in segments)
    # The lowest bin holds the rest of the mean.
    f, psd = f[2:], psd[2:]
    which = np.digitize(f, np.geomspace(f[0] * 0.999, f[-1] * 1.001, points + 1))
    means = np.array([[np.mean(f[which == k]), np.mean(psd[which == k])] for k in np.unique(which)])
    return means[:, 0], np.sqrt(means[:, 1])


def compute_noise_rms(w: PreparedFlight, k_ggi: float) -> float:
    """rms of the estimated noise as that of a G_out, Eo."""
    return float(np.sqrt(estimate_variance(w))) / abs(k_ggi)


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


def find_worst(f: Fitted, residuals: Sequence[Array], count: int) -> list[int]:
    """Positions of the ``count`` flights with the largest error over their noise, in the flights' own order."""
    ratio = []
    for w, e in zip(f.prepared, residuals, strict=True):
        v = w.observation.record.valid
        ratio.append(float(np.sqrt(np.mean(e[v] ** 2))) / compute_noise_rms(w, 1.0))
    return sorted(sorted(range(len(ratio)), key=lambda n: -ratio[n])[:count])


def pair_lines(before: Residuals, after: Residuals | None) -> Lines:
    """The lines of a figure of a residual, before a step and after it if there was one."""
    return [("residual", before)] if after is None else [("before", before), ("after", after)]


def _role(name: str) -> Role:
    return "before" if name == "before" else "residual"


def _list_worst(f: Fitted, residuals: Residuals) -> Iterator[tuple[int, PreparedFlight, float, str]]:
    """The flights that are drawn: number, flight, V/Eo, and its name where there are several."""
    for n in find_worst(f, residuals, FLIGHTS):
        w = f.prepared[n]
        yield n, w, f.scales[n], w.observation.name if len(f.prepared) > 1 else ""


def plot_blocks(f: Fitted, lines: Lines) -> Curves:
    """The error in blocks of time of every line."""
    axes = []
    for n, w, k, name in _list_worst(f, lines[0][1]):
        blocks = [(label, *measure_blocks(w, residuals[n], k)) for label, residuals in lines]
        steps = tuple(Curve(label, edges, rms, _role(label), "steps") for label, edges, rms in blocks)
        ends = (float(blocks[0][1][0]), float(blocks[0][1][-1]))
        axes.append(Axes(steps, "rms, Eo", name, ends, compute_noise_rms(w, k), signed=False, share=0.85))
    caption = "Error before demodulation in 24 blocks of time."
    if len(f.prepared) > FLIGHTS:
        caption += f" The {FLIGHTS} worst of {len(f.prepared)} flights."
    return Curves("time", caption, tuple(axes), SECONDS, height=1.8)


def plot_window(
    f: Fitted,
    n: int,
    residual: Array,
    window: tuple[float, float] = (-np.inf, np.inf),
    spread: Array | None = None,
) -> Curves:
    """What was measured over the model, and the residual (N,), V, of flight n between two instants, s.

    ``spread`` (2, N), V: least and greatest residual of models within the uncertainty of the parameters.
    """
    w, k = f.prepared[n], f.scales[n]
    r, measured = w.observation.record, combine_output(w.observation, w.observation.data)
    rows = slice(*np.searchsorted(r.time, window))
    if len(r.time[rows]) < LEAST:
        raise UserError("the segment is too short to be drawn", found=f"{len(r.time[rows])} samples")

    def draw(label: str, x: Array, role: Role) -> Curve:
        return _draw_channel(label, r.time[rows], np.where(r.valid, x, np.nan)[rows], role)

    output = draw("measured", measured, "before"), draw("model", measured - residual, "residual")
    curves = [draw("residual", residual / k, "residual")]
    if spread is not None:
        low, high = np.where(r.valid, spread / k, np.nan)[:, rows]
        curves.insert(0, Curve("models within the uncertainty", r.time[rows], low, "envelope", "band", high))
    axes = (
        Axes(
            output,
            f"{f.observations[n].recorded.words}, V",
            w.observation.name if len(f.prepared) > 1 else "",
        ),
        Axes(tuple(curves), "residual, Eo", level=compute_noise_rms(w, k)),
    )
    return Curves(f"window{n}", "Measured over model, and the residual.", axes, SECONDS, height=1.6)


def plot_columns(x: Flight) -> Curves:
    """Every column of a flight over time, SI."""
    step, units = max(1, len(x.time) // MOST_POINTS), x.units
    axes = tuple(
        Axes(
            (Curve(name, x.time[::step], np.asarray(v)[::step], width=0.7),),
            numbers.unit(units.get(name, "")),
            share=0.8,
        )
        for name, v in {**x.channels, **x.outputs}.items()
    )
    return Curves("columns", "Every column over time, in SI.", axes, "time, s", height=1.6)


def plot_spectrum(f: Fitted, lines: Lines) -> Curves | None:
    """Amplitude densities of residuals and of the noise; ``None`` where no part of a record is long enough."""
    axes = []
    for n, w, k, name in _list_worst(f, lines[0][1]):
        r = w.observation.record
        spectra = [(label, estimate_spectrum(x[n] / k, r.valid, r.rate)) for label, x in lines]
        curves = [Curve(label, *s, _role(label)) for label, s in spectra if s is not None]
        if not curves:
            continue
        grid, spin = curves[0].x, abs(r.spin_frequency)
        noise = np.sqrt(compute_noise_psd(w, spin, grid)) / k
        curves.append(Curve("noise, as estimated", grid, noise, "noise"))
        marks = tuple(
            (j * spin, "Ω" if j == 1 else f"{j}Ω") for j in range(1, 5) if grid[0] < j * spin < grid[-1]
        )
        ends = (float(grid[0]), float(grid[-1]))
        axes.append(Axes(tuple(curves), "residual, Eo/√Hz", name, ends, log=True, marks=marks))
    if not axes:
        return None
    caption = "Amplitude density of the residual and the estimated noise."
    if any(a.marks for a in axes):
        caption += " Dotted: multiples of the spin rate."
    if any(a.marks for a in axes) and any(is_unknown(o) for o in f.observations):
        caption += " The notch at 2Ω: the gravity gradient is not recorded, so slow variation there is fitted as gradient."
    return Curves("spectrum", caption, tuple(axes), "frequency before demodulation, Hz", 2.9)


def plot_channels(f: Fitted, lines: Lines) -> Curves | None:
    """The demodulated residual of every line, inline and cross; ``None`` where a record is too short for the low-pass."""
    axes = []
    for n, w, k, name in _list_worst(f, lines[-1][1]):
        r = w.observation.record
        channels = [(label, demodulate_residual(x[n], r, f.scales[n])) for label, x in lines]
        if not np.isfinite(channels[0][1]).any():
            continue
        # four samples a cycle of the low-pass's edge draw the whole of it
        step = max(1, int(r.rate / (4.0 * DRAWN)))
        for channel, part, amplitude in (("inline", np.real, 4.0), ("cross", np.imag, 2.0)):
            level = predict_demodulated_noise(w, k, 2, amplitude)
            curves = tuple(
                _draw_channel(label, r.time[::step], part(x[::step]), _role(label)) for label, x in channels
            )
            ends = (float(r.time[0]), float(r.time[-1]))
            title = f"{channel} of {name}" if name else channel
            axes.append(Axes(curves, "error, Eo", title, ends, level))
    caption = "Demodulated residual: the error of the measured gradients. Dashed: one sigma of the noise."
    return Curves("channels", caption, tuple(axes), SECONDS, height=1.6) if axes else None


def _draw_channel(label: str, time: Array, x: Array, role: Role) -> Curve:
    """A line; its envelope where it has more points than can be drawn."""
    if len(x) <= MOST_POINTS:
        return Curve(label, time, x, role, width=0.8)
    middle, low, high = find_envelope(time, x)
    return Curve(label, middle, low, role, "band", high)


def plot_harmonics(f: Fitted, residuals: Sequence[Array]) -> Bars | None:
    """The slow error at every harmonic of the spin, with what noise alone gives."""
    rows = {str(x["harmonic"]): float(str(x["rms_Eo"])) for x in comparison.measure_harmonics(f, residuals)}
    noise = predict_harmonic_noise(f, rows)
    # four times the relative uncertainty of the rms of noise in the demodulator's bandwidth
    seconds = sum(float(w.observation.record.time[-1]) for w in f.prepared)
    limit = 1.0 + 4.0 / np.sqrt(4.0 * BAND * max(seconds, 1.0))
    bars = tuple(
        Bar(numbers.harmonic(h), rows[h], noise[h], bool(rows[h] > limit * noise[h]))
        for h in noise
        if h in rows
    )
    if len(bars) < 2:  # a disc that does not spin has no harmonics
        return None
    caption = (
        "Residual by harmonic of the spin, multiplied by 1, 2 cos kΩt or 2 sin kΩt and low-passed at 0.2 Hz as the"
        " demodulator does; the demodulator reads harmonic 2 as gradient. Grey: not above the noise."
    )
    return Bars("where-harmonic", caption, bars, "slow error, Eo")


def plot_history(steps: Sequence[Mapping[str, Any]], noise: float) -> Bars | None:
    """The error after every step of a history against the noise floor, held out as dots."""
    bars: list[Bar] = []
    for s in steps:
        before, after = (describe.find_rms(s.get(k)) for k in ("before", "after"))
        if before is not None and not bars:
            bars.append(Bar("before", before, strong=False))
        if after is not None:
            label = f"+ {s['effect']}" if s["action"] == "add" else str(s.get("effect") or s["action"])
            holdout = describe.find_rms(s.get("after"), "holdout")
            bars.append(Bar(label, after, dot=np.nan if holdout is None else holdout))
    bars, has_floor = bars[-STEPS:], np.isfinite(noise)
    if not bars:
        return None
    top = max(b.value for b in bars)
    caption = "Calibrated error before demodulation after every step." + (
        " Dashed: the noise floor." if has_floor else ""
    )
    return Bars(
        "loop",
        caption,
        tuple(bars),
        "calibrated error, Eo rms",
        log=bool(has_floor and top > 8.0 * noise > 0.0),
        threshold=(noise, f"noise floor {numbers.number(noise)} Eo") if has_floor else None,
        dot="held out",
    )


def plot_compensated(series: Sequence[Mapping[str, Array]]) -> Curves | None:
    """The compensated channels (N,) of flights with their uncertainty; ``None`` where there are none."""
    axes = []
    for columns in series[:FLIGHTS]:
        time = np.asarray(columns["time"], dtype=np.float64)
        step = max(1, len(time) // MOST_POINTS)
        for name in (n for n in columns if f"{n}_std" in columns):
            x, std = (np.asarray(columns[k], dtype=np.float64)[::step] for k in (name, f"{name}_std"))
            band = Curve("± 1 sigma", time[::step], x - std, "envelope", "band", x + std)
            axes.append(Axes((band, Curve(name, time[::step], x, width=0.8)), f"{name}, Eo"))
    caption = "Compensated channels with their uncertainty."
    return Curves("compensated", caption, tuple(axes), "time, s") if axes else None


NORMAL_99 = 2.5758  # half width of the interval that holds 99 % of a normal distribution, standard deviations
# longest lag: turns of the disc; seconds, where it stands; and samples at most
TURNS, LONGEST, MOST_LAGS = 4.0, 30.0, 1200
BINS = 40  # bins of a channel, each of as many samples

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


def correlate(x: Array, y: Array, lags: int) -> tuple[Array, Array]:
    """Correlation of x (N,) with y (N,) earlier by 0 ... ``lags`` samples, NaN passed over; and how many pairs each lag has."""

    def lagged(a: Array, b: Array) -> Array:
        return signal.correlate(a, b, method="fft")[len(b) - 1 :][: lags + 1]

    valid = np.isfinite(x), np.isfinite(y)
    u, v = (np.where(k, z - np.mean(z[k]), 0.0) for k, z in zip(valid, (x, y), strict=True))
    pairs = np.maximum(np.round(lagged(*(k.astype(float) for k in valid))), 1.0)
    scale = np.sqrt(np.sum(u**2) / np.sum(valid[0]) * np.sum(v**2) / np.sum(valid[1]))
    return lagged(u, v) / pairs / max(float(scale), 1e-300), pairs


def _bound(x: Array, middle: float, half: Array) -> Curve:
    index = np.unique(np.linspace(0, len(x) - 1, 40).astype(np.intp))  # they vary slowly
    return Curve("99 % of noise", x[index], middle - half[index], "envelope", "band", middle + half[index])


def _count_lags(w: PreparedFlight) -> int:
    r = w.observation.record
    spin = abs(r.spin_frequency)
    seconds = TURNS / spin if spin > 0.0 else LONGEST
    return max(2, min(int(seconds * r.rate), MOST_LAGS, len(r.time) // 4))


def plot_whiteness(f: Fitted, n: int, residual: Array, channels: Sequence[str] = MOTION) -> Curves:
    """Autocorrelation of the whitened residual (N,), V, of flight n, and its cross-correlation with channels, over lags."""
    w = f.prepared[n]
    r, e, longest = w.observation.record, whiten_residual(w, residual), _count_lags(f.prepared[n])
    correlation, pairs = correlate(e, e, longest)
    lag = np.arange(longest + 1) / r.rate
    half = NORMAL_99 / np.sqrt(pairs)
    axes = [
        Axes(
            (_bound(lag[1:], 0.0, half[1:]), Curve("residual", lag[1:], correlation[1:], width=0.9)),
            "autocorrelation",
        )
    ]
    for name in channels:
        x = np.where(r.valid, r.channels[name], np.nan)
        after, before = correlate(e, x, longest)[0], correlate(x, e, longest)[0]
        cross, time = np.concatenate([before[:0:-1], after]), np.concatenate([-lag[:0:-1], lag])
        inside = np.concatenate([half[:0:-1], half])
        curves = (_bound(time, 0.0, inside), Curve("correlation", time, cross, width=0.9))
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
        Axes((_bound(at, 0.0, half), Curve("mean", at, mean)), "mean, σ"),
        Axes((_bound(at, 1.0, half / np.sqrt(2.0)), Curve("rms", at, rms)), "rms, σ"),
    )
    caption = (
        f"The whitened residual against {name}: mean and rms of {BINS} bins of equal counts, in standard deviations of the noise."
        " Pale: 99 % of noise lies inside. A mean outside: a missing term; an rms outside: noise that depends on the channel."
    )
    label = f"{name}{f', {unit}' if unit else ''}"
    return Curves(f"against{n}", caption, axes, label, 1.6)


def _divide(e: Array, x: Array) -> list[NDArray[np.intp]]:
    """The samples at which both have a value, in bins of x with equal counts."""
    index = np.flatnonzero(np.isfinite(e) & np.isfinite(x))
    ordered = index[np.argsort(x[index], kind="stable")]
    return [p for p in np.array_split(ordered, BINS) if len(p) > 2]


def find_worst_channel(f: Fitted, n: int, residual: Array) -> str:
    """The channel of flight n against which the mean of the whitened residual departs most from zero."""
    r = f.prepared[n].observation.record
    e = whiten_residual(f.prepared[n], residual)

    def departs(name: str) -> float:
        x = np.asarray(r.channels[name], dtype=np.float64)
        return float(sum(len(p) * np.mean(e[p]) ** 2 for p in _divide(e, x)))

    return max(sorted(r.channels), key=departs)


SHARE = 0.03  # squared share of what is seen below which a direction is taken not to be seen
MOST_LABELS = 24  # directions of a matrix of correlations: beyond these nobody reads it


def find_directions(f: Fitted) -> tuple[list[str], Array]:
    """Names of directions of the parameters, ``D12 beta_z``, and their (k, n) unit vectors over the fitted ones, in scales.

    They are sums of A1 ... A4 with signs where the record is of the paper's G_out, which depends on these.
    """
    form, columns = f.observations[0].recorded, f.calibration.columns
    patterns = f.instrument.layout.like_paper and not (form.separate or form.demodulated)
    positions: dict[str, list[int]] = {}
    for n, c in enumerate(columns):
        positions.setdefault(c.name, []).append(n)
    names: list[str] = []
    rows = np.zeros((len(columns), len(columns)))
    for places in positions.values():
        together = patterns and len(places) == 4
        for k, n in enumerate(places):
            of, signs = combinations.PATTERNS[k] if together else (columns[n].accelerometer_name, (1.0,))
            rows[len(names), places if together else [n]] = np.array(signs) / np.linalg.norm(signs)
            names.append(f"{of} {numbers.parameter(combinations.own_name(columns[n]))}".strip())
    return names, rows


def list_unseen(f: Fitted) -> list[str]:
    """Names of the directions of the parameters that the record leaves at their prior."""
    names, U = find_directions(f)
    variance, vectors = np.linalg.eigh(U @ f.coefficients(())[1] @ U.T)
    share = np.sum(vectors[:, variance >= LEARNED**2] ** 2, axis=1)
    return [names[n] for n in np.flatnonzero(share > 1.0 - SHARE)]


def describe_parameters(f: Fitted, *, values: bool = True) -> tuple[Section, ...]:
    """What the record determines of the parameters, their ``values``, and their correlations, as folded sections."""
    observable, total = count_directions(f)
    determined = f"{observable} of {total} directions"
    text = [
        f"{determined} of the calibrated parameters are determined by this record; the others stay at their test-sheet values."
    ]
    if unseen := list_unseen(f):
        text.append(f"Not observable: {', '.join(unseen)}.")
    lists = (list_combinations(f), list_parameters(f)) if values else None
    return (
        Section("What the record determines", tuple(text), detail=True, summary=determined),
        *(() if lists is None else describe_other.tabulate_parameters(*lists, detail=True)),
        Section("Correlations of the parameters", plots=(correlate_parameters(f),), detail=True),
    )


def correlate_parameters(f: Fitted) -> Matrix:
    """The matrix of correlations of the directions that the record constrains.

    Of more than can be labelled in it, it has those with the largest correlations.
    """
    names, U = find_directions(f)
    covariance = U @ f.coefficients(())[1] @ U.T
    std = np.sqrt(np.diag(covariance))
    determined = np.flatnonzero(std < UNSEEN)
    r = (covariance / np.outer(std, std))[np.ix_(determined, determined)]
    labels = tuple(names[n] for n in determined)
    caption = "Correlations of the calibrated parameters that this record determines, wholly or in part."
    largest = np.max(np.abs(r - np.eye(len(r))), axis=0, initial=0.0)
    index = np.sort(np.argsort(-largest, kind="stable")[:MOST_LABELS])
    return Matrix("correlations", caption, tuple(labels[n] for n in index), r[np.ix_(index, index)])
