"""Plots of a result as inline SVG: curves, bars, matrices; without fonts, links or dates, the same bytes each time."""

from __future__ import annotations

import html
import io
import re
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import resources
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes as Drawn
from matplotlib.axis import Axis
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from matplotlib.transforms import blended_transform_factory
from numpy.typing import NDArray

from ragg_runtime.wording import numbers
from ragg_runtime.wording.sections import Axes, Bars, Curve, Curves, Matrix, Plot

Array = NDArray[np.float64]

COLOURS = {
    "ink": "#1a1a1a", "quiet": "#6b7075", "rule": "#d9dcdf", "line": "#8a8f94", "grid": "#eceeef", "paper": "#ffffff",
    "residual": "#1f4e79", "envelope": "#b9cde0", "before": "#a3a8ad", "noise": "#b4531f",
}  # fmt: skip
"""The colours by their names in the page's style sheet, which has each for light and for dark. Noise is always dashed, too: it must be
distinguishable in black and white."""

NAMES = {colour: name for name, colour in COLOURS.items()}

# width of a figure, inches: its text is 12 pixels on a page of 500, and 14 where the page is wide (style.css ends its growth there)
WIDTH = 4.8
MARKS_APART = 1.8  # ratio of frequencies whose names do not touch
# matplotlib's settings are the whole process's: the studio is asked for two figures at once
ONE_AT_A_TIME = threading.Lock()
# behind a value that may lie on a line
HALO = {"facecolor": COLOURS["paper"], "edgecolor": "none", "pad": 0.6}


def draw_plot(plot: Plot) -> str:
    """The plot as an inline ``<svg>`` element."""
    with _style():
        if isinstance(plot, Matrix):
            return _draw_matrix(plot)
        return _draw_curves(plot) if isinstance(plot, Curves) else _draw_bars(plot)


def draw_file(plot: Plot) -> str:
    """The plot as an SVG document of its own, in light colours."""
    text = draw_plot(plot)
    for name, colour in COLOURS.items():
        text = text.replace(f"var(--{name})", colour)
    namespaces = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return text.replace(
        "<svg ", f'<svg {namespaces} font-family="sans-serif" style="background: {COLOURS["paper"]}" ', 1
    )


@contextmanager
def _style() -> Iterator[None]:
    """Matplotlib's defaults with the report's look, whatever the user's own settings; names in any script."""
    sheet = resources.files("ragg_runtime.report").joinpath("templates", "report.mplstyle")
    with ONE_AT_A_TIME, warnings.catch_warnings(), matplotlib.rc_context():
        # a glyph missing from the font used for measuring is still drawn by the reader's browser
        warnings.filterwarnings("ignore", message=r"Glyph .* missing from")
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(matplotlib.rc_params_from_file(str(sheet), use_default_template=False))
        yield


def _make_figure(height: float, width: float = WIDTH) -> Figure:
    """A figure so many inches high and wide, in constrained layout."""
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasSVG(figure)
    return figure


# --- curves --------------------------------------------------------------------------------------------


def _draw_curves(plot: Curves) -> str:
    """Axes below each other, each with its curves, the noise dashed."""
    shares = [a.share for a in plot.axes]
    fig = _make_figure(plot.height * sum(shares) + 0.3)
    subplots = fig.subplots(len(plot.axes), 1, squeeze=False, height_ratios=shares)[:, 0]
    noise: dict[str, Any] = {"color": COLOURS["noise"], "linestyle": "--", "linewidth": 1.0, "zorder": 3}
    named_before: list[str] = []
    for ax, axes in zip(subplots, plot.axes, strict=True):
        for curve in axes.curves:
            _draw_curve(ax, curve)
        if np.isfinite(axes.level):
            ax.axhline(axes.level, label="± noise, 1 sigma" if axes.signed else "noise", **noise)
            if axes.signed:
                ax.axhline(-axes.level, **noise)
        _set_limits(ax, axes)
        named = 0.0
        for x, text in axes.marks:
            ax.axvline(x, color=COLOURS["quiet"], linewidth=0.9, linestyle=(0, (1.5, 3.5)), zorder=0.5)
            transform = blended_transform_factory(ax.transData, ax.transAxes)
            away: dict[str, Any] = {"xytext": (3, -2), "textcoords": "offset points", "va": "top"}
            if x >= MARKS_APART * named:
                ax.annotate(text, (x, 1.0), xycoords=transform, fontsize=9, color=COLOURS["quiet"], **away)
                named = x
        ax.set_ylabel(axes.y_label)
        labels = ax.get_legend_handles_labels()[1]
        if labels != named_before:
            _add_legend(ax, 3)
        ax.set_title(
            numbers.short(axes.title, 60), pad=6.0 if labels == named_before else 20.0
        )  # above the legend
        named_before = labels
    subplots[-1].set_xlabel(plot.x_label)
    return _write_svg(fig, plot.key, plot.caption)


def _draw_curve(ax: Drawn, c: Curve) -> None:
    colour = COLOURS[c.role]
    if c.kind == "steps":
        ax.stairs(c.y, c.x, color=colour, linewidth=c.width, label=c.name, baseline=None)
    elif c.kind == "line":
        dashes = "--" if c.role == "noise" else "-"
        ax.plot(c.x, c.y, dashes, color=colour, linewidth=c.width, label=c.name)
    else:
        assert c.high is not None
        ax.fill_between(c.x, c.y, c.high, label=c.name, color=colour, linewidth=0)


def _set_limits(ax: Drawn, axes: Axes) -> None:
    """Limits that show every curve and the noise; of a logarithmic pair of axes a decade at least."""
    values = np.concatenate([x for c in axes.curves for x in (c.y, c.high) if x is not None])
    values = values[np.isfinite(values)]
    if axes.log:
        low, high = _find_log_limits(axes, values[values > 0.0])
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_ylim(low, high)
    else:
        top = max([float(np.max(np.abs(values), initial=0.0)), float(np.nan_to_num(axes.level)), 1e-12])
        if axes.signed and np.isfinite(axes.level):
            ax.set_ylim(-1.2 * top, 1.2 * top)
        elif not axes.signed:
            ax.set_ylim(0.0, 1.3 * top)
    if axes.ends is not None:
        ax.set_xlim(*axes.ends)
    if axes.log:
        _set_log_ticks(ax.xaxis, ax.get_xlim())
        _set_log_ticks(ax.yaxis, ax.get_ylim())


def _find_log_limits(axes: Axes, values: Array) -> tuple[float, float]:
    low, high = float(np.min(values)) / 1.4, float(np.max(values)) * 1.8
    for c in axes.curves:
        if c.role == "noise":
            # where an unknown gradient is projected out, the residual has a notch without meaning
            low = max(low, float(np.min(c.y[c.y > np.max(c.y) / 1e2])) / 4.0)
    spread = max(1.0, float(np.sqrt(10.0 * low / high)))
    return low / spread, high * spread


def _set_log_ticks(axis: Axis, ends: tuple[float, float]) -> None:
    """Plain numbers on a logarithmic axis; 2 and 5 labelled as well where it spans little."""
    axis.set_major_locator(
        LogLocator(10.0, (1.0, 2.0, 5.0) if ends[1] / ends[0] < 1e3 else (1.0,), numticks=12)
    )
    axis.set_major_formatter(FuncFormatter(lambda v, _: numbers.plain(v)))
    axis.set_minor_formatter(NullFormatter())


def _add_legend(ax: Drawn, columns: int) -> None:
    """A legend in one line above the axes, at the right."""
    ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=columns, borderaxespad=0.2)


# --- bars and matrices ---------------------------------------------------------------------------------


def _draw_bars(plot: Bars) -> str:
    """Lying bars with their values beside them, a dashed line or dashed ticks where the noise is."""
    fig = _make_figure(0.75 + 0.245 * len(plot.bars))
    ax = fig.subplots()
    place = np.arange(len(plot.bars), dtype=np.float64)
    value, noise, dot = (np.array([getattr(b, n) for b in plot.bars]) for n in ("value", "noise", "dot"))
    level = np.nan if plot.threshold is None else plot.threshold[0]
    ends = np.nanmax([value, noise, dot], axis=0)
    top = max(float(np.nanmax([*ends, level])), 1e-12)
    low = max(float(np.nanmin([*value[value > 0.0], level])) / 2.0, top / 1e6) if plot.log else 0.0
    colours = [COLOURS["residual" if b.strong else "before"] for b in plot.bars]
    ax.barh(place, np.maximum(value - low, 0.0), 0.6, left=low, color=colours)
    for x, end, at in zip(value, ends, place, strict=True):  # nothing may lie below the text
        beside: dict[str, Any] = {"xytext": (4, 0), "textcoords": "offset points", "va": "center"}
        ax.annotate(numbers.number(x), (end, at), fontsize=9, bbox=HALO, **beside)
    dashed: dict[str, Any] = {"color": COLOURS["noise"], "linestyle": "--"}
    if (noisy := np.isfinite(noise)).any():
        ax.vlines(noise[noisy], place[noisy] - 0.4, place[noisy] + 0.4, label="noise alone", **dashed)
    if plot.threshold is not None:
        ax.axvline(level, linewidth=1.0, label=plot.threshold[1], **dashed)
    if (visible := dot > low).any():
        look: dict[str, Any] = {"color": COLOURS["ink"], "markerfacecolor": COLOURS["paper"]}
        ax.plot(dot[visible], place[visible], "o", markersize=4.5, label=plot.dot, **look)
    _label_bars(ax, plot, low, top)
    return _write_svg(fig, plot.key, plot.caption)


def _label_bars(ax: Drawn, plot: Bars, low: float, top: float) -> None:
    count = len(plot.bars)
    if plot.log:
        ax.set_xscale("log")
        ax.set_xlim(low, top * (top / low) ** 0.14)
        _set_log_ticks(ax.xaxis, ax.get_xlim())
    else:
        ax.set_xlim(0.0, 1.18 * top)
    ax.set_yticks(range(count), [numbers.short(b.label, 28) for b in plot.bars])
    ax.set_ylim(count - 0.4, -0.6)
    ax.set_xlabel(plot.axis)
    ax.tick_params(axis="y", length=0)  # labels of categories need no tick marks and no grid
    ax.yaxis.grid(False)
    if ax.get_legend_handles_labels()[1]:
        _add_legend(ax, 3)


def _draw_matrix(plot: Matrix) -> str:
    """Squares below the diagonal whose areas are the sizes of the entries; those of less than 0.1 are left out."""
    count = len(plot.names)
    side = max(WIDTH, 0.14 * count + 1.4)
    fig = _make_figure(side, side)
    ax = fig.subplots()
    for sign, colour, words in ((1.0, "residual", "positive"), (-1.0, "noise", "negative")):
        entries = [(i, j, float(plot.values[i, j]) * sign) for i in range(count) for j in range(i)]
        sides = [(i, j, 0.94 * np.sqrt(r)) for i, j, r in entries if r > 0.1]
        squares = [Rectangle((j - s / 2, i - s / 2), s, s) for i, j, s in sides]
        ax.add_collection(PatchCollection(squares, facecolor=COLOURS[colour], edgecolor="none"))
        ax.plot([], [], "s", color=COLOURS[colour], label=words)
    names = [numbers.short(x, 24) for x in plot.names]
    ax.set_xticks(range(count), names, rotation=90)
    ax.set_yticks(range(count), names)
    ax.set(xlim=(-0.6, count - 0.4), ylim=(count - 0.4, -0.6), aspect="equal")
    ax.tick_params(length=0, labelsize=8)  # two dozen names below each other
    ax.grid(False)
    _add_legend(ax, 2)
    return _write_svg(fig, plot.key, plot.caption)


# --- the SVG -------------------------------------------------------------------------------------------


def _write_svg(figure: Figure, key: str, label: str) -> str:
    """The figure as an inline ``<svg>`` element; ids begin with ``key``, ``label`` is its alternative text."""
    buffer = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": key}):
        nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
        figure.savefig(buffer, format="svg", metadata=nothing)
    text = buffer.getvalue()
    text = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", text[text.index("<svg") :], flags=re.DOTALL)
    head, body = text.split(">", 1)
    view = re.search(r'viewBox="[^"]*"', head)
    assert view is not None
    body = re.sub(r"<[^>]*>", lambda tag: _rewrite_tag(tag[0], key), body)
    body = re.sub(r"\n\s*", "\n", body)
    return f'<svg {view[0]} role="img" aria-label="{html.escape(numbers.clean(label))}">{body}'


def _rewrite_tag(tag: str, key: str) -> str:
    """A tag with ids of its own figure, colours by name, the reader's own sans-serif, and coordinates to 0.1 pt."""
    tag = re.sub(r'^<g id="[^"]*"', "<g", tag)
    tag = re.sub(r' transform="rotate\(-0 [^"]*"', "", tag)
    tag = re.sub(
        r"(: )(#[0-9a-f]{6})\b", lambda c: f"{c[1]}var(--{NAMES[c[2]]})" if c[2] in NAMES else c[0], tag
    )
    tag = re.sub(r"(\d\.\d)\d+", r"\1", tag)
    tag = re.sub(r'( d=")([^"]*)', lambda d: d[1] + re.sub(r"\s*([A-Za-z])\s*", r"\1", d[2]), tag)
    tag = tag.replace(' id="', f' id="{key}-').replace('href="#', f'href="#{key}-')
    tag = tag.replace("url(#", f"url(#{key}-")
    tag = re.sub(
        r"font: (?:(\d+) )?([\d.]+px) [^;\"]*",
        lambda f: f"font-size: {f[2]}" + (f"; font-weight: {f[1]}" if f[1] else ""),
        tag,
    )
    return re.sub(r"font-family: [^;\"]*(?:; )?", "", tag)
