"""Plots of a result as inline SVG: curves over time or frequency, and bars."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes as Drawn
from matplotlib.collections import PatchCollection
from matplotlib.patches import Rectangle
from matplotlib.transforms import blended_transform_factory
from numpy.typing import NDArray

from ragg_runtime.report import draw
from ragg_runtime.wording import numbers
from ragg_runtime.wording.sections import Axes, Bars, Curve, Curves, Matrix, Plot

Array = NDArray[np.float64]

COLOURS = {
    "residual": draw.RESIDUAL,
    "envelope": draw.RESIDUAL_LIGHT,
    "before": draw.BEFORE,
    "noise": draw.NOISE,
}

HALO = {"facecolor": draw.PAPER, "edgecolor": "none", "pad": 0.6}
"""Behind a value that may lie on a line."""


def draw_plot(plot: Plot) -> str:
    """The plot as an inline ``<svg>`` element."""
    with draw.style():
        if isinstance(plot, Matrix):
            return draw_matrix(plot)
        return draw_curves(plot) if isinstance(plot, Curves) else draw_bars(plot)


def draw_file(plot: Plot) -> str:
    """The plot as an SVG document of its own, in light colours."""
    text = draw_plot(plot)
    for colour, name in draw.NAMES.items():
        text = text.replace(f"var(--{name})", colour)
    own = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return text.replace("<svg ", f'<svg {own} font-family="sans-serif" style="background: {draw.PAPER}" ', 1)


def draw_curves(plot: Curves) -> str:
    """Axes below each other, each with its curves, the noise dashed."""
    shares = [a.share for a in plot.axes]
    fig = draw.figure(plot.height * sum(shares) + 0.3)
    found = fig.subplots(len(plot.axes), 1, squeeze=False, height_ratios=shares)[:, 0]
    for ax, axes in zip(found, plot.axes, strict=True):
        for curve in axes.curves:
            _draw_curve(ax, curve)
        if np.isfinite(axes.level):
            for sign in (1, -1) if axes.signed else (1,):
                label = None if sign < 0 else "± noise, 1 sigma" if axes.signed else "noise"
                ax.axhline(
                    sign * axes.level, color=draw.NOISE, linestyle="--", linewidth=1.0, zorder=3, label=label
                )
        _limit(ax, axes)
        for x, text in axes.marks:
            _mark(ax, x, text)
        if axes.frame is not None:
            ax.axvspan(*axes.frame, facecolor="none", edgecolor=draw.NOISE, linewidth=0.9)
        ax.set_ylabel(axes.y_label)
        if axes.title:
            ax.set_title(numbers.short(axes.title, 70))
        draw.legend(ax, 3)
        draw.live(ax, plot.unit)
    found[-1].set_xlabel(plot.x_label)
    return draw.svg(fig, plot.key, plot.caption)


def _draw_curve(ax: Drawn, c: Curve) -> None:
    colour = COLOURS[c.role]
    dashes = "--" if c.role == "noise" else "-"
    if c.kind == "steps":
        ax.stairs(c.y, c.x, color=colour, linewidth=c.width, label=c.name, baseline=None)
        return
    if c.kind == "line":
        ax.plot(c.x, c.y, dashes, color=colour, linewidth=c.width, label=c.name)
        return
    assert c.high is not None
    if c.kind == "band":
        ax.fill_between(c.x, c.y, c.high, color=colour, linewidth=0, label=c.name)
    else:
        ax.fill_between(c.x, c.y, c.high, facecolor="none", edgecolor=colour, linewidth=0.6, label=c.name)


def _limit(ax: Drawn, axes: Axes) -> None:
    """Limits that show every curve and the noise; of a logarithmic pair of axes a decade at least."""
    if axes.ends is not None:
        ax.set_xlim(*axes.ends)
    every = np.concatenate([x for c in axes.curves for x in (c.y, c.high) if x is not None])
    every = every[np.isfinite(every)]
    if axes.log:
        _limit_log(ax, axes, every[every > 0.0])
        return
    top = max([float(np.max(np.abs(every))) if len(every) else 0.0, np.nan_to_num(axes.level), 1e-12])
    if axes.signed and np.isfinite(axes.level):
        ax.set_ylim(-1.2 * top, 1.2 * top)
    elif not axes.signed:
        ax.set_ylim(0.0, 1.3 * top)


def _limit_log(ax: Drawn, axes: Axes, every: Array) -> None:
    low, high = float(np.min(every)) / 1.4, float(np.max(every)) * 1.8
    for c in axes.curves:
        if c.role == "noise":
            # where an unknown gradient is taken out, the residual has a notch that says nothing
            low = max(low, float(np.min(c.y[c.y > np.max(c.y) / 1e2])) / 4.0)
    if high / low < 10.0:
        spread = np.sqrt(10.0 * low / high)
        low, high = low / spread, high * spread
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_ylim(low, high)
    if axes.ends is not None:
        ax.set_xlim(*axes.ends)
    draw.set_log_ticks(ax, "x")
    draw.set_log_ticks(ax, "y")


def _mark(ax: Drawn, x: float, text: str) -> None:
    ax.axvline(x, color=draw.QUIET, linewidth=0.6, linestyle=":", zorder=0.5)
    at = blended_transform_factory(ax.transData, ax.transAxes)
    ax.annotate(
        text,
        (x, 1.0),
        xycoords=at,
        xytext=(3, -2),
        textcoords="offset points",
        va="top",
        fontsize=9,
        color=draw.QUIET,
    )


def draw_bars(plot: Bars) -> str:
    """Bars with their values beside them, a dashed line or dashed ticks where the noise is."""
    count = len(plot.bars)
    fig = draw.figure(2.8 if plot.upright else 0.75 + 0.245 * count)
    ax = fig.subplots()
    place = np.arange(count, dtype=np.float64) if plot.upright else np.arange(count, dtype=np.float64)[::-1]
    values = np.array([b.value for b in plot.bars])
    low, shown = _scale(plot, values)
    colours = [draw.RESIDUAL if b.strong else draw.BEFORE for b in plot.bars]
    if plot.upright:
        ax.bar(place, shown - low, 0.56, bottom=low, color=colours)
    else:
        ax.barh(place, shown - low, 0.6, left=low, color=colours)
    for k, b in enumerate(plot.bars):
        text = numbers.number(b.value) if np.isfinite(b.value) else "certain"
        # beside a lying bar nothing may lie below the value
        end = shown[k] if plot.upright else max([shown[k], *(d for d in b.dots if np.isfinite(d))])
        at = (place[k], end) if plot.upright else (end, place[k])
        away: dict[str, Any] = (
            {"xytext": (0, 4), "ha": "center"} if plot.upright else {"xytext": (4, 0), "va": "center"}
        )
        ax.annotate(text, at, textcoords="offset points", fontsize=9, bbox=HALO, **away)
    _draw_levels(ax, plot, place)
    _draw_dots(ax, plot, place, low)
    _label_bars(ax, plot, place, low, float(np.max(shown, initial=1e-12)))
    return draw.svg(fig, plot.key, plot.caption)


def _scale(plot: Bars, values: Array) -> tuple[float, Array]:
    """Where bars begin, and where they end: what is infinite is drawn beyond the others."""
    finite = values[np.isfinite(values)]
    top = max([float(np.max(finite, initial=0.0)), plot.threshold[0] if plot.threshold else 0.0, 1e-12])
    shown = np.where(np.isfinite(values), values, 2.0 * top)
    if not plot.log:
        return 0.0, np.nan_to_num(shown)
    least = min([*(v for v in shown if v > 0.0), plot.threshold[0] if plot.threshold else np.inf])
    low = max(float(least) / 2.0, top / 1e6)
    return low, np.maximum(shown, low)


def _draw_levels(ax: Drawn, plot: Bars, place: Array) -> None:
    known = [n for n, b in enumerate(plot.bars) if np.isfinite(b.noise)]
    if known:
        level = [plot.bars[n].noise for n in known]
        line = ax.hlines if plot.upright else ax.vlines
        line(
            level,
            place[known] - 0.4,
            place[known] + 0.4,
            color=draw.NOISE,
            linestyle="--",
            label="noise alone",
        )
    if plot.threshold is not None:
        value, text = plot.threshold
        across = ax.axhline if plot.upright else ax.axvline
        across(value, color=draw.NOISE, linestyle="--", linewidth=1.0, label=text)


def _draw_dots(ax: Drawn, plot: Bars, place: Array, low: float) -> None:
    for j, (name, marker) in enumerate(zip(plot.dots, "oD", strict=False)):
        value = np.array([b.dots[j] if j < len(b.dots) else np.nan for b in plot.bars])
        kept = np.isfinite(value) & (value > low)
        x, y = (place[kept] + 0.35, value[kept]) if plot.upright else (value[kept], place[kept])
        ax.plot(x, y, marker, color=draw.INK, markerfacecolor=draw.PAPER, markersize=4.5, label=name)


def _label_bars(ax: Drawn, plot: Bars, place: Array, low: float, top: float) -> None:
    limit, scale = (ax.set_ylim, ax.set_yscale) if plot.upright else (ax.set_xlim, ax.set_xscale)
    if plot.log:
        scale("log")
        limit(low, top * (top / low) ** 0.14)
        draw.set_log_ticks(ax, "y" if plot.upright else "x")
    else:
        limit(0.0, 1.18 * max(top, plot.threshold[0] if plot.threshold else 0.0))
    across = "x" if plot.upright else "y"
    length = 56 if not plot.upright else 28 if len(plot.bars) < 6 else 16
    texts = ["\n".join(numbers.short(part, length) for part in b.label.split("\n")) for b in plot.bars]
    if plot.upright:
        ax.set_xticks(place, texts)
        ax.set_xlim(-0.6, max(len(place), 4) - 0.4)
        ax.set_ylabel(plot.axis)
    else:
        ax.set_yticks(place, texts)
        ax.set_ylim(-0.6, len(place) - 0.4)
        ax.set_xlabel(plot.axis)
    draw.hide_ticks(ax, across)
    if ax.get_legend_handles_labels()[1]:
        draw.legend(ax, 3)


def draw_matrix(plot: Matrix) -> str:
    """Squares below the diagonal whose areas are the sizes of the entries; those of less than 0.1 are left out."""
    count = len(plot.names)
    fig = draw.figure(max(2.0, 0.17 * count + 1.4))
    ax = fig.subplots()
    for sign, colour, words in ((1.0, draw.RESIDUAL, "positive"), (-1.0, draw.NOISE, "negative")):
        found = [(i, j, float(plot.values[i, j]) * sign) for i in range(count) for j in range(i)]
        sides = [(i, j, 0.94 * np.sqrt(r)) for i, j, r in found if r > 0.1]
        squares = [Rectangle((j - s / 2, i - s / 2), s, s) for i, j, s in sides]
        ax.add_collection(PatchCollection(squares, facecolor=colour, edgecolor="none"))
        ax.plot([], [], "s", color=colour, label=words)
    names = [numbers.short(x, 24) for x in plot.names]
    ax.set_xticks(range(count), names, rotation=90)
    ax.set_yticks(range(count), names)
    ax.set(xlim=(-0.6, count - 0.4), ylim=(count - 0.4, -0.6), aspect="equal")
    ax.tick_params(labelsize=7, length=0)
    ax.grid(False)
    draw.legend(ax, 2)
    return draw.svg(fig, plot.key, plot.caption)
