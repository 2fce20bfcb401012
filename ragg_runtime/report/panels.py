"""From fitted flights to plots: the data of every figure that a report shows, in Eo and seconds since the first sample."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.scores import demodulate_residual
from ragg_runtime.estimation.unknown_gradient import is_unknown
from ragg_runtime.estimation.whitening import PreparedFlight
from ragg_runtime.identification import comparison, series
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import Axes, Bar, Bars, Curve, Curves

Array = NDArray[np.float64]
Residuals = Sequence[Array]
Lines = Sequence[tuple[str, Residuals]]
"""(``residual``, ``before`` or ``after``, residual of every flight)."""

FLIGHTS = 4
"""Flights that are drawn one by one, the worst of all that were given."""

MOST_POINTS = 4000
"""Points of a line above which its envelope is drawn instead."""

STEPS = 14
"""Latest steps of a history that are drawn."""

SECONDS = "time since the first sample, s"


def pair_lines(before: Residuals, after: Residuals | None) -> Lines:
    """The lines of a figure of a residual, before a step and after it if there was one."""
    return [("residual", before)] if after is None else [("before", before), ("after", after)]


def _role(name: str) -> Any:
    return "before" if name == "before" else "residual"


def _list_worst(f: Fitted, residuals: Residuals) -> Iterator[tuple[int, PreparedFlight, float, str]]:
    """The flights that are drawn: number, flight, V/Eo, and its name where there are several."""
    for n in series.find_worst(f, residuals, FLIGHTS):
        w = f.prepared[n]
        yield n, w, f.scales[n], w.observation.name if len(f.prepared) > 1 else ""


def plot_blocks(f: Fitted, lines: Lines, *, envelope: bool = False) -> Curves:
    """The error in blocks of time of every line; with ``envelope`` also the last residual itself, above it."""
    axes = []
    for n, w, k, name in _list_worst(f, lines[0][1]):
        r = w.observation.record
        edges, level = r.time, series.compute_noise_rms(w, k)
        steps = []
        for label, residuals in lines:
            edges, rms = series.measure_blocks(w, residuals[n], k)
            steps.append(Curve(label, edges, rms, _role(label), "steps"))
        ends = (float(edges[0]), float(edges[-1]))
        if envelope:
            e = series.decimate(r.time, lines[-1][1][n] / k, r.valid)
            band = Curve("min-max", e.time, e.low, "envelope", "band", e.high)
            around = Curve("± rms", e.time, e.rms, width=0.9), Curve("_", e.time, -e.rms, width=0.9)
            axes.append(Axes((band, *around), "residual, Eo", name, ends, level, share=1.3))
        axes.append(
            Axes(tuple(steps), "rms, Eo", "" if envelope else name, ends, level, signed=False, share=0.85)
        )
    caption = "Error before demodulation in 24 blocks of time."
    if len(f.prepared) > FLIGHTS:
        caption += f" The {FLIGHTS} worst of {len(f.prepared)} flights."
    return Curves("time", caption, tuple(axes), SECONDS, height=1.8)


def plot_spectrum(f: Fitted, lines: Lines) -> Curves | None:
    """Amplitude densities of residuals and of the noise; ``None`` where no part of a record is long enough."""
    axes = []
    for n, w, k, name in _list_worst(f, lines[0][1]):
        r = w.observation.record
        found = [(label, series.estimate_spectrum(x[n] / k, r.valid, r.rate)) for label, x in lines]
        curves = [Curve(label, s.frequency, s.density, _role(label)) for label, s in found if s is not None]
        if not curves:
            continue
        grid, spin = curves[0].x, abs(r.spin_frequency)
        curves.append(
            Curve("noise, as estimated", grid, series.compute_noise_density(w, k, spin, grid), "noise")
        )
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
        made = [(label, demodulate_residual(x[n], r, f.scales[n])) for label, x in lines]
        if not np.isfinite(made[0][1]).any():
            continue
        # four samples a cycle of the low-pass's edge draw the whole of it
        step = max(1, int(r.rate / (4.0 * series.DRAWN)))
        for channel, part, amplitude in (("inline", np.real, 4.0), ("cross", np.imag, 2.0)):
            level = series.predict_demodulated_noise(w, k, 2, amplitude)
            curves = tuple(_channel(label, r.time[::step], part(x[::step])) for label, x in made)
            ends = (float(r.time[0]), float(r.time[-1]))
            title = f"{channel} of {name}" if name else channel
            axes.append(Axes(curves, "error, Eo", title, ends, level))
    caption = "Demodulated residual: the error of the measured gradients. Dashed: one sigma of the noise."
    return Curves("channels", caption, tuple(axes), SECONDS, height=1.6) if axes else None


def _channel(label: str, time: Array, x: Array) -> Curve:
    """A line; its envelope where it has more points than can be drawn."""
    if len(x) <= MOST_POINTS:
        return Curve(label, time, x, _role(label), width=0.8)
    e = series.decimate(time, x, np.isfinite(x), MOST_POINTS // 2)
    return Curve(label, e.time, e.low, _role(label), "band", e.high)


def plot_harmonics(f: Fitted, residuals: Sequence[Array]) -> Bars | None:
    """The slow error at every harmonic of the spin, with what noise alone gives."""
    rows = {str(x["harmonic"]): float(str(x["rms_Eo"])) for x in comparison.measure_harmonics(f, residuals)}
    noise = series.predict_harmonic_noise(f, rows)
    # four times the relative uncertainty of the rms of noise in the demodulator's bandwidth
    seconds = sum(float(w.observation.record.time[-1]) for w in f.prepared)
    limit = 1.0 + 4.0 / np.sqrt(4.0 * series.BAND * max(seconds, 1.0))
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


def list_error_steps(steps: Sequence[Mapping[str, Any]], now: float | None = None) -> list[Bar]:
    """The error after every step of a history, held out as dots, and ``now``: pale where the flights, not the model, are others."""
    bars: list[Bar] = []
    made = ""

    def begin(value: float | None, held: float | None) -> None:
        if value is not None and not (bars and abs(value - bars[-1].value) <= 0.02 * value):
            label = made or ("other flights" if bars else "before")
            bars.append(Bar(label, value, strong=bool(made), dots=(np.nan if held is None else held,)))

    for s in steps:
        begin(describe.find_rms(s.get("before")), describe.find_rms(s.get("before"), "holdout"))
        after, held = (describe.find_rms(s.get("after"), k) for k in ("calibrated", "holdout"))
        if after is not None:
            label = f"+ {s['effect']}" if s["action"] == "add" else str(s.get("effect") or s["action"])
            bars.append(Bar(label, after, dots=(np.nan if held is None else held,)))
        removed = {"remove": f"{numbers.MINUS} {s.get('effect')}", "edit": "sheet edited"}
        made = removed.get(str(s["action"]), "")
    begin(now, None)
    return bars


def plot_history(steps: Sequence[Mapping[str, Any]], noise: float) -> Bars | None:
    """The error after every step of a history against the noise floor, held out as dots."""
    bars, known = list_error_steps(steps)[-STEPS:], np.isfinite(noise)
    if not bars:
        return None
    top = max(b.value for b in bars)
    caption = "Calibrated error before demodulation after every step." + (
        " Dashed: the noise floor." if known else ""
    )
    return Bars(
        "loop",
        caption,
        tuple(bars),
        "calibrated error, Eo rms",
        log=bool(known and top > 8.0 * noise > 0.0),
        threshold=(noise, f"noise floor {numbers.number(noise)} Eo") if known else None,
        dots=("held out",),
    )


def plot_compensated(made: Sequence[Mapping[str, Array]]) -> Curves | None:
    """The compensated channels (N,) of flights with their uncertainty; ``None`` where there are none."""
    axes = []
    for columns in made[:FLIGHTS]:
        time = np.asarray(columns["time"], dtype=np.float64)
        step = max(1, len(time) // MOST_POINTS)
        for name in (n for n in columns if f"{n}_std" in columns):
            x, std = (np.asarray(columns[k], dtype=np.float64)[::step] for k in (name, f"{name}_std"))
            band = Curve("± 1 sigma", time[::step], x - std, "envelope", "band", x + std)
            axes.append(Axes((band, Curve(name, time[::step], x, width=0.8)), f"{name}, Eo"))
    caption = "Compensated channels with their uncertainty."
    return Curves("compensated", caption, tuple(axes), "time, s") if axes else None


def describe_record(f: Fitted) -> list[tuple[str, str]]:
    """(name, value) of what was recorded and what was fitted."""
    records = [(o if o.thin is None else o.thin.whole).record for o in f.observations]
    samples, valid = (sum(len(r.time) for r in records), sum(int(np.sum(r.valid)) for r in records))
    used = f"{numbers.fixed(samples, 0)} at {numbers.number(records[0].rate, 4)} Hz"
    if valid < samples:
        used += f", {numbers.fixed(samples - valid, 0)} of them not usable"
    thin = {o.record.rate for o in f.observations if o.thin is not None}
    if thin:
        used += f"; thinned to {numbers.number(min(thin), 4)} Hz without loss of information"
    return [
        ("flights", numbers.join_names([numbers.clean(o.name) for o in f.observations])),
        ("duration", numbers.seconds(sum(float(r.time[-1]) + 1.0 / r.rate for r in records))),
        ("samples", used),
        ("output", f.observations[0].recorded.words),
        ("effects in the model", numbers.join_names([e.id for e in f.model.effects]) or "none"),
        ("k_ggi", f"{numbers.number(f.k_ggi, 4)} V/Eo"),
        ("spin", f"{numbers.number(f.instrument.spin_frequency, 4)} Hz"),
    ]
