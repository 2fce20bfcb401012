"""Bar charts: each function returns an inline SVG. All errors in Eo."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ragg_runtime.diagnosis.budget import Contribution
from ragg_runtime.report import draw
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]

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
