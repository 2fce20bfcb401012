"""The look of a figure, and its SVG: inline, without fonts, links or dates, the same bytes for the same input."""

from __future__ import annotations

import html
import io
import json
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import resources
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter

from ragg_runtime.wording import numbers

INK = "#1a1a1a"
QUIET = "#6b7075"
RULE = "#d9dcdf"
LINE = "#8a8f94"
GRID = "#eceeef"
PAPER = "#ffffff"
RESIDUAL = "#1f4e79"
RESIDUAL_LIGHT = "#b9cde0"
BEFORE = "#a3a8ad"
NOISE = "#b4531f"
"""Noise is always this orange-brown and dashed: it must be distinguishable in black and white, too."""

NAMES = {
    INK: "ink",
    QUIET: "quiet",
    RULE: "rule",
    LINE: "line",
    GRID: "grid",
    PAPER: "paper",
    RESIDUAL: "residual",
    RESIDUAL_LIGHT: "envelope",
    BEFORE: "before",
    NOISE: "noise",
}
"""The colours by their names in the page's style sheet, which gives each for light and for dark."""

WIDTH = 9.6
"""Width of every figure, inches: at the page's width a point is a little more than a pixel."""


@contextmanager
def style() -> Iterator[None]:
    """Matplotlib's defaults with the report's look, whatever the user's own settings; names in any script."""
    with warnings.catch_warnings():
        # a glyph that the measuring font lacks is still drawn, by the reader's browser
        warnings.filterwarnings("ignore", message=r"Glyph .* missing from")
        with matplotlib.rc_context():
            matplotlib.rcdefaults()
            sheet = resources.files("ragg_runtime.report").joinpath("templates", "report.mplstyle")
            matplotlib.rcParams.update(matplotlib.rc_params_from_file(str(sheet), use_default_template=False))
            yield


def figure(height: float) -> Figure:
    """A figure ``height`` inches high, in constrained layout."""
    made = Figure(figsize=(WIDTH, height), layout="constrained")
    FigureCanvasSVG(made)
    return made


def live(ax: Axes, unit: str) -> None:
    """Let the page's script read out and zoom all that is drawn in ``ax`` by now; ``unit`` is that of the abscissa."""
    ax.set_gid(unit)


def svg(made: Figure, name: str, label: str) -> str:
    """The figure as an inline ``<svg>`` element; ids begin with ``name``, ``label`` is its alternative text."""
    buffer = io.StringIO()
    chosen = [ax for ax in made.axes if ax.get_gid()]
    units = [str(ax.get_gid()) for ax in chosen]
    curves = [_named(ax, n) for n, ax in enumerate(chosen)]
    with matplotlib.rc_context({"svg.hashsalt": name}):
        nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
        made.savefig(buffer, format="svg", metadata=nothing)
    text = buffer.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    head, body = text.split(">", 1)
    view = re.search(r'viewBox="[^"]*"', head)
    assert view is not None
    body = re.sub(r"<[^>]*>", lambda tag: _own(tag[0], name), body)
    body = re.sub(r"<!--.*?-->", "", body, flags=re.DOTALL)
    body = re.sub(r"\n\s*", "\n", body)
    shown = [_limits(*x) for x in zip(chosen, units, curves, strict=True)]
    data = f' data-live="{html.escape(json.dumps({"name": name, "axes": shown}, separators=(",", ":")))}"'
    text = f'<svg {view[0]} role="img" aria-label="{html.escape(numbers.clean(label))}"'
    return f"{text}{data if shown else ''}>{body}"


def _named(ax: Axes, n: int) -> list[str]:
    """Ids for what moves in an axes (``c0-1`` ...) and for its two scales; the labels, empty where there is none."""
    ax.set_gid(f"a{n}")
    ax.xaxis.set_gid(f"x{n}")
    ax.yaxis.set_gid(f"y{n}")
    artists = [*ax.collections, *ax.patches, *ax.lines]
    for k, artist in enumerate(artists):
        artist.set_gid(f"c{n}-{k}")
    for k, text in enumerate(ax.texts):
        text.set_gid(f"t{n}-{k}")
    return [x if (x := str(a.get_label())) and not x.startswith("_") else "" for a in artists]


def _limits(ax: Axes, unit: str, curves: list[str]) -> dict[str, Any]:
    """Where an axes lies in the drawing, what it spans (first, last, whether logarithmic), and what it holds."""
    figure = ax.get_figure()
    assert isinstance(figure, Figure)
    wide, high = (72.0 * x for x in figure.get_size_inches())
    b = ax.get_position()
    return {
        "box": [round(x, 2) for x in (b.x0 * wide, (1.0 - b.y1) * high, b.width * wide, b.height * high)],
        "x": _span(ax.get_xlim(), ax.get_xscale()),
        "y": _span(ax.get_ylim(), ax.get_yscale()),
        "units": [unit, ax.get_ylabel().rpartition(", ")[2]],
        "curves": curves,
        "texts": len(ax.texts),
    }


def _span(ends: tuple[float, float], scale: str) -> list[float]:
    return [*(float(f"{x:.9g}") for x in ends), float(scale == "log")]


def _own(tag: str, name: str) -> str:
    """A tag with ids of its own figure, colours by name, the reader's own sans-serif, and coordinates to 0.01 pt."""
    tag = re.sub(
        r"(: )(#[0-9a-f]{6})\b", lambda c: f"{c[1]}var(--{NAMES[c[2]]})" if c[2] in NAMES else c[0], tag
    )
    tag = re.sub(r"(\.\d\d)\d+", r"\1", tag)
    tag = re.sub(r'( d=")([^"]*)', lambda d: d[1] + re.sub(r"\s*([A-Za-z])\s*", r"\1", d[2]), tag)
    tag = tag.replace(' id="', f' id="{name}-').replace('href="#', f'href="#{name}-')
    tag = tag.replace("url(#", f"url(#{name}-")
    tag = re.sub(r"font: (?:(\d+) )?([\d.]+px) [^;\"]*", _size, tag)
    return re.sub(r"font-family: [^;\"]*(?:; )?", "", tag)


def _size(found: re.Match[str]) -> str:
    return f"font-size: {found[2]}" + (f"; font-weight: {found[1]}" if found[1] else "")


def set_log_ticks(axes: Axes, which: str) -> None:
    """Plain numbers on a logarithmic axis; 2 and 5 labelled as well where it spans little."""
    axis = axes.xaxis if which == "x" else axes.yaxis
    low, high = axes.get_xlim() if which == "x" else axes.get_ylim()
    decades = high / low
    axis.set_major_locator(
        LogLocator(
            10.0, (1.0, 2.0, 5.0) if decades < (3000.0 if which == "x" else 300.0) else (1.0,), numticks=12
        )
    )
    axis.set_minor_locator(
        LogLocator(10.0, tuple(range(2, 10)), numticks=40) if decades < 1e6 else FixedLocator([])
    )
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}" if 1e-4 < v < 1e5 else numbers.number(v, 1)))
    axis.set_minor_formatter(NullFormatter())


def hide_ticks(axes: Axes, which: str) -> None:
    """Labels of categories need no tick marks and no grid."""
    axes.tick_params(axis="x" if which == "x" else "y", length=0)
    (axes.xaxis if which == "x" else axes.yaxis).grid(False)


def legend(ax: Axes, columns: int) -> None:
    """A legend in one line above the axes, at the right."""
    ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=columns, borderaxespad=0.2)
