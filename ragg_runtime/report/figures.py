"""Curves over time and frequency, from plain series: each function returns an inline SVG. All errors in Eo."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.transforms import blended_transform_factory
from numpy.typing import NDArray

from ragg_runtime.identification.budget import Contribution
from ragg_runtime.identification.series import Envelope, Spectrum, envelope, runs
from ragg_runtime.report import draw
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]


MOST_POINTS = 4000
"""Points of a line above which its envelope is drawn instead."""


@dataclass(frozen=True)
class Line:
    """A line of a legend: its label, colour, width and dashes."""

    label: str
    color: str
    width: float = 1.1
    style: str = "-"


AFTER = Line("after", draw.RESIDUAL, 1.2)
BEFORE = Line("before", draw.BEFORE, 1.6)
ONLY = Line("residual", draw.RESIDUAL, 1.2)


@dataclass(frozen=True)
class TimePanel:
    """One flight: its residual's envelope, its blocks of time, and its noise."""

    name: str
    envelope: Envelope
    edges: Array
    blocks: Sequence[tuple[Line, Array]]
    noise: float


def in_time(panels: Sequence[TimePanel], name: str, label: str) -> str:
    """Residual over time with the noise's one sigma, and its rms in blocks of time below it."""
    with draw.style():
        fig = draw.figure(2.9 * len(panels))
        axes = fig.subplots(2 * len(panels), 1, squeeze=False, height_ratios=[1.7, 1.0] * len(panels))[:, 0]
        for n, p in enumerate(panels):
            upper, lower = axes[2 * n], axes[2 * n + 1]
            lower.sharex(upper)
            e = p.envelope
            upper.fill_between(
                e.time, e.low, e.high, color=draw.RESIDUAL_LIGHT, linewidth=0, label="least to greatest value"
            )
            upper.plot(e.time, e.rms, color=draw.RESIDUAL, label="± rms", linewidth=0.9)
            upper.plot(e.time, -e.rms, color=draw.RESIDUAL, linewidth=0.9)
            for sign in (1, -1):
                upper.axhline(
                    sign * p.noise,
                    color=draw.NOISE,
                    linestyle="--",
                    linewidth=1.0,
                    label="± noise, 1 sigma" if sign > 0 else None,
                )
            reach = _reach(e)
            upper.set_ylim(-reach, reach)
            upper.set_ylabel("residual, Eo")
            upper.tick_params(labelbottom=False)
            if len(panels) > 1:
                upper.set_title(numbers.short(p.name, 70))
            upper.legend(loc="upper right", ncols=3, borderaxespad=0.0)
            _steps(lower, p)
            lower.set_ylabel("rms, Eo")
            if len(p.blocks) > 1:
                lower.set_ylim(0.0, 1.3 * lower.get_ylim()[1])
                lower.legend(loc="upper left", ncols=3, borderaxespad=0.0)
            lower.set_xlim(p.edges[0], p.edges[-1])
            draw.live(upper, "s")
            draw.live(lower, "s")
        axes[-1].set_xlabel("time since the first sample, s")
        return draw.svg(fig, name, label)


def in_blocks(panels: Sequence[TimePanel], name: str, label: str) -> str:
    """Only the rms in blocks of time, of several residuals."""
    with draw.style():
        fig = draw.figure(1.9 * len(panels))
        axes = fig.subplots(len(panels), 1, squeeze=False)[:, 0]
        for ax, p in zip(axes, panels, strict=True):
            _steps(ax, p)
            ax.set_ylabel("rms, Eo")
            ax.set_xlim(p.edges[0], p.edges[-1])
            if len(panels) > 1:
                ax.set_title(numbers.short(p.name, 70))
            draw.legend(ax, 3)
            draw.live(ax, "s")
        axes[-1].set_xlabel("time since the first sample, s")
        return draw.svg(fig, name, label)


def _reach(e: Envelope) -> float:
    both = np.concatenate([np.abs(e.low), np.abs(e.high)])
    both = both[np.isfinite(both)]
    return 1.25 * float(np.max(both)) if len(both) and np.max(both) > 0.0 else 1.0


def _steps(ax: Axes, p: TimePanel) -> None:
    top = p.noise
    for line, rms in p.blocks:
        ax.stairs(rms, p.edges, color=line.color, linewidth=line.width, label=line.label, baseline=None)
        finite = rms[np.isfinite(rms)]
        top = max(top, float(np.max(finite))) if len(finite) else top
    ax.axhline(p.noise, color=draw.NOISE, linestyle="--", linewidth=1.0, label="noise")
    ax.set_ylim(0.0, 1.3 * top)


@dataclass(frozen=True)
class SpectrumPanel:
    """Spectra of one flight's residuals and the density of its noise at the same frequencies."""

    name: str
    lines: Sequence[tuple[Line, Spectrum]]
    noise: Spectrum
    spin: float


def spectra(panels: Sequence[SpectrumPanel], name: str, label: str) -> str:
    """Amplitude densities, Eo/sqrt(Hz), with the spin's first four multiples marked."""
    with draw.style():
        fig = draw.figure(3.1 * len(panels))
        axes = fig.subplots(len(panels), 1, squeeze=False)[:, 0]
        for ax, p in zip(axes, panels, strict=True):
            for line, s in p.lines:
                ax.plot(s.frequency, s.density, color=line.color, linewidth=line.width, label=line.label)
            ax.plot(
                p.noise.frequency,
                p.noise.density,
                color=draw.NOISE,
                linestyle="--",
                label="noise, as estimated",
            )
            ax.set_xscale("log")
            ax.set_yscale("log")
            f = p.noise.frequency
            ax.set_xlim(f[0], f[-1])
            every = np.concatenate([p.noise.density, *(s.density for _, s in p.lines)])
            every = every[every > 0.0]
            low, high = float(np.min(every)) / 1.4, float(np.max(every)) * 1.8
            top = float(np.max(p.noise.density))
            # where an unknown gradient is taken out, the residual has a notch that says nothing
            low = max(low, float(np.min(p.noise.density[p.noise.density > top / 1e2])) / 4.0)
            if high / low < 10.0:
                spread = np.sqrt(10.0 * low / high)
                low, high = low / spread, high * spread
            ax.set_ylim(low, high)
            mixed = blended_transform_factory(ax.transData, ax.transAxes)
            for k in range(1, 5):
                if f[0] < k * p.spin < f[-1]:
                    ax.axvline(k * p.spin, color=draw.QUIET, linewidth=0.6, linestyle=":", zorder=0.5)
                    text = numbers.harmonic(f"x {k}")[2:].removesuffix("t")
                    ax.annotate(
                        text,
                        (k * p.spin, 1.0),
                        xycoords=mixed,
                        xytext=(3, -2),
                        textcoords="offset points",
                        va="top",
                        fontsize=7.5,
                        color=draw.QUIET,
                    )
            draw.log_ticks(ax, "x")
            draw.log_ticks(ax, "y")
            ax.set_ylabel("residual, Eo/√Hz")
            if len(panels) > 1:
                ax.set_title(numbers.short(p.name, 60))
            draw.legend(ax, 3)
            draw.live(ax, "Hz")
        axes[-1].set_xlabel("frequency of G_out before demodulation, Hz")
        return draw.svg(fig, name, label)


@dataclass(frozen=True)
class ChannelPanel:
    """Demodulated residuals of one flight: time (s), values (Eo), what noise alone would give, and the record's ends (s)."""

    title: str
    time: Array
    lines: Sequence[tuple[Line, Array]]
    noise: float
    ends: tuple[float, float]


def channels(panels: Sequence[ChannelPanel], name: str, label: str) -> str:
    """Demodulated channels over time, with the noise's one sigma between dashed lines."""
    with draw.style():
        fig = draw.figure(1.55 * len(panels) + 0.2)
        axes = fig.subplots(len(panels), 1, squeeze=False)[:, 0]
        for ax, p in zip(axes, panels, strict=True):
            for line, value in p.lines:
                _channel(ax, p.time, line, value)
            for s in (1, -1):
                own = "± noise, 1 sigma" if s > 0 else None
                ax.axhline(s * p.noise, color=draw.NOISE, linestyle="--", linewidth=1.1, zorder=3, label=own)
            every = [float(np.nanmax(np.abs(v))) for _, v in p.lines]
            reach = 1.15 * max([*every, p.noise if np.isfinite(p.noise) else 0.0])
            ax.set_ylim(-reach, reach)
            ax.set_xlim(*p.ends)
            ax.set_title(numbers.short(p.title, 70))
            ax.set_ylabel("error, Eo")
            draw.legend(ax, 3)
            draw.live(ax, "s")
        axes[-1].set_xlabel("time since the first sample, s")
        return draw.svg(fig, name, label)


def _channel(ax: Axes, time: Array, line: Line, value: Array) -> None:
    label: str | None = line.label
    for run in runs(value):
        t, y = time[run], value[run]
        columns = round(MOST_POINTS / 2 * len(t) / len(time))
        if len(time) > MOST_POINTS and columns > 1:
            e = envelope(t, y, np.ones(len(t), dtype=bool), columns)
            ax.fill_between(e.time, e.low, e.high, color=line.color, linewidth=0.4, label=label)
        else:
            ax.plot(t, y, color=line.color, linewidth=0.6 * line.width, label=label)
        label = None


@dataclass(frozen=True)
class MeasuredPanel:
    """One flight's output and what the model makes of it, V: extremes of all of it (its ends, s), and some samples."""

    measured: Envelope
    modelled: Envelope
    ends: tuple[float, float]
    time: Array
    samples: Array
    model: Array


def measured_over_model(p: MeasuredPanel, name: str, label: str) -> str:
    """The whole record above, a few turns of the disc below, where the samples can be told apart."""
    with draw.style():
        fig = draw.figure(3.5)
        upper, lower = fig.subplots(2, 1, height_ratios=[1.0, 1.25])
        e, m = p.measured, p.modelled
        upper.fill_between(e.time, e.low, e.high, color=draw.BEFORE, linewidth=0, label="measured")
        upper.fill_between(
            m.time, m.low, m.high, facecolor="none", edgecolor=draw.RESIDUAL, linewidth=0.6, label="model"
        )
        upper.set_xlim(*p.ends)
        first, last = p.time[0], p.time[-1]
        upper.axvspan(first, last, facecolor="none", edgecolor=draw.NOISE, linewidth=0.9)
        lower.plot(p.time, p.samples, color=draw.BEFORE, linewidth=3.2, label="measured")
        lower.plot(p.time, p.model, color=draw.RESIDUAL, linewidth=0.9, label="model, calibrated")
        lower.set_xlim(first, last)
        for ax in (upper, lower):
            ax.set_ylabel("G_out, V")
            draw.legend(ax, 3)
            draw.live(ax, "s")
        lower.set_xlabel("time since the first sample, s")
        return draw.svg(fig, name, label)


HALO = {"facecolor": draw.PAPER, "edgecolor": "none", "pad": 0.6}
"""Behind a value that may stand on a line."""


@dataclass(frozen=True)
class Bar:
    """A bar: label, value, and the level that noise alone would give (NaN: none)."""

    label: str
    value: float
    noise: float = float("nan")
    strong: bool = True


def harmonics(bars: Sequence[Bar], name: str, label: str) -> str:
    """Upright bars with a dashed tick at the noise's own level."""
    with draw.style():
        fig = draw.figure(2.2)
        ax = fig.subplots()
        x = np.arange(len(bars), dtype=np.float64)
        _upright(ax, x, bars)
        ax.set_ylabel("slow error, Eo")
        return draw.svg(fig, name, label)


def _upright(ax: Axes, x: Array, bars: Sequence[Bar]) -> None:
    colors = [draw.RESIDUAL if b.strong else draw.BEFORE for b in bars]
    ax.bar(x, [b.value for b in bars], 0.56, color=colors)
    known = [n for n, b in enumerate(bars) if np.isfinite(b.noise)]
    if known:
        level = [bars[n].noise for n in known]
        ax.hlines(
            level, x[known] - 0.4, x[known] + 0.4, color=draw.NOISE, linestyle="--", label="noise alone"
        )
        draw.legend(ax, 1)
    for k, b in enumerate(bars):
        at = (float(x[k]), b.value)
        text = numbers.number(b.value)
        ax.annotate(text, at, xytext=(0, 4), textcoords="offset points", ha="center", fontsize=7.5, bbox=HALO)
    ax.set_ylim(0.0, 1.14 * max([ax.get_ylim()[1] / 1.05, 1e-12]))
    ax.set_xticks(x, [b.label for b in bars])
    ax.set_xlim(-0.6, len(bars) - 0.4)
    draw.no_ticks(ax, "x")


def lying(bars: Sequence[Bar], name: str, label: str, unit: str, threshold: float | None, log: bool) -> str:
    """Lying bars with their values beside them; ``threshold`` as a dashed line."""
    with draw.style():
        fig = draw.figure(0.62 + 0.245 * len(bars) + (0.15 if threshold else 0.0))
        ax = fig.subplots()
        y = np.arange(len(bars))[::-1]
        values = np.array([b.value for b in bars])
        finite = values[np.isfinite(values)]
        top = max([float(np.max(finite)) if len(finite) else 1.0, threshold or 0.0, 1e-12])
        shown = np.where(np.isfinite(values), values, 2.0 * top)
        low = 0.0
        if log:
            smallest = min([*(v for v in shown if v > 0.0), threshold or np.inf])
            low = max(float(smallest) / 2.0, top / 1e6)
            shown = np.maximum(shown, low)
        ax.barh(
            y, shown - low, 0.6, left=low, color=[draw.RESIDUAL if b.strong else draw.BEFORE for b in bars]
        )
        if log:
            ax.set_xscale("log")
            ax.set_xlim(low, max(shown) * (max(shown) / low) ** 0.12)
            draw.log_ticks(ax, "x")
        else:
            ax.set_xlim(0.0, 1.12 * max(shown))
        for k, b in enumerate(bars):
            text = numbers.number(b.value) if np.isfinite(b.value) else "certain"
            ax.annotate(
                text,
                (shown[k], y[k]),
                xytext=(4, 0),
                textcoords="offset points",
                va="center",
                fontsize=7.5,
                bbox=HALO,
            )
        if threshold is not None:
            ax.axvline(threshold, color=draw.NOISE, linestyle="--", linewidth=1.0, label="needed for a claim")
            draw.legend(ax, 1)
        ax.set_yticks(y, [numbers.short(b.label, 56) for b in bars])
        ax.set_ylim(-0.6, len(bars) - 0.4)
        draw.no_ticks(ax, "y")
        ax.set_xlabel(unit)
        return draw.svg(fig, name, label)


@dataclass(frozen=True)
class Step:
    """The error after one step of the loop; not ``strong``: where that step began, if that is another error."""

    label: str
    error: float
    holdout: float
    strong: bool = True


def loop(steps: Sequence[Step], noise: float, name: str, label: str) -> str:
    """The error after every step as bars, held-out errors as dots, against the noise floor."""
    with draw.style():
        fig = draw.figure(3.1)
        ax = fig.subplots()
        x = np.arange(len(steps))
        values = np.array([s.error for s in steps])
        finite = values[np.isfinite(values)]
        top = max(noise, float(np.max(finite)) if len(finite) else 1.0)
        log = top > 8.0 * noise > 0.0
        base = noise / 2.0 if log else 0.0
        colors = [draw.RESIDUAL if s.strong else draw.BEFORE for s in steps]
        ax.bar(x, np.maximum(values - base, 0.0), 0.56, bottom=base, color=colors)
        if log:
            ax.set_yscale("log")
            ax.set_ylim(base, top * 1.6)
            draw.log_ticks(ax, "y")
        else:
            ax.set_ylim(0.0, top * 1.22)
        for k, s in enumerate(steps):
            if np.isfinite(s.error):
                ax.annotate(
                    numbers.number(s.error),
                    (k, s.error),
                    xytext=(0, 4),
                    textcoords="offset points",
                    ha="center",
                )
        held = np.array([s.holdout for s in steps])
        if np.any(np.isfinite(held)):
            ax.plot(
                x + 0.35,
                held,
                "o",
                color=draw.INK,
                markerfacecolor=draw.PAPER,
                markersize=5,
                label="held out",
            )
        ax.axhline(
            noise,
            color=draw.NOISE,
            linestyle="--",
            linewidth=1.2,
            label=f"noise floor {numbers.number(noise)} Eo",
        )
        draw.legend(ax, 2)
        length = 28 if len(steps) < 6 else 16
        ax.set_xticks(
            x, ["\n".join(numbers.short(part, length) for part in s.label.split("\n")) for s in steps]
        )
        ax.set_xlim(-0.6, max(len(steps), 4) - 0.4)
        draw.no_ticks(ax, "x")
        ax.set_ylabel("calibrated error, Eo rms")
        return draw.svg(fig, name, label)


def budget(rows: Sequence[Contribution], noise: float, name: str, label: str) -> str:
    """Contributions on a logarithmic axis: bar before demodulation, marks in the channels."""
    with draw.style():
        fig = draw.figure(0.8 + 0.245 * len(rows))
        ax = fig.subplots()
        y = np.arange(len(rows))[::-1]
        every = np.array([[r.rms, r.inline, r.cross] for r in rows])
        positive = every[np.isfinite(every) & (every > 0.0)]
        top = float(np.max(positive)) if len(positive) else 1.0
        low = max(min(float(np.min(positive)) if len(positive) else 0.1, noise) / 2.0, min(noise, top) / 1e3)
        ax.set_xscale("log")
        values = np.maximum(every[:, 0], low)
        ax.barh(
            y,
            values - low,
            0.6,
            left=low,
            color=[draw.RESIDUAL if r.strong else draw.RESIDUAL_LIGHT for r in rows],
        )
        for column, marker, text in ((1, "o", "inline"), (2, "D", "cross")):
            seen = every[:, column] > low
            ax.plot(
                every[seen, column],
                y[seen],
                marker,
                color=draw.INK,
                markerfacecolor=draw.PAPER,
                markersize=4.5,
                label=text,
            )
        ax.axvline(noise, color=draw.NOISE, linestyle="--", linewidth=1.0, label="noise before demodulation")
        ax.set_xlim(low, top * 2.0)
        draw.log_ticks(ax, "x")
        ax.set_yticks(y, [numbers.short(r.label, 56) for r in rows])
        ax.set_ylim(-0.6, len(rows) - 0.4)
        draw.no_ticks(ax, "y")
        ax.set_xlabel("contribution, Eo")
        draw.legend(ax, 3)
        return draw.svg(fig, name, label)
