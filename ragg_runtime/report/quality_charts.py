"""Figures of quality control: maps, noise against turbulence, densities, levels from line to line."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PathCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.ticker import FuncFormatter
from numpy.typing import NDArray

from ragg_runtime.report import draw
from ragg_runtime.survey.quality.by_line import LineFigures
from ragg_runtime.survey.quality.discs import Discs, combinations, ne, uv
from ragg_runtime.survey.quality.galileo import WINDOW
from ragg_runtime.survey.quality.qc import Quality
from ragg_runtime.survey.quality.spectra import density, filled, rolling_std
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]

MOST_PIECES = 6_000
"""Coloured pieces of all lines on a map: more would be finer than the page's points."""

SHADES = 32
"""Colours of the map: nearer ones are not told apart."""

DRAWN = 6
"""Channels whose levels are drawn."""

_COLOURS = LinearSegmentedColormap.from_list("noise", ["#dfe8f1", "#7fa6c9", "#1f4e79", "#b4531f", "#6b1f0a"])
_BINS = 60


def maps(q: Quality) -> str | None:
    """Where it is noisy, and by how much lines differ where they cross; ``None`` without positions."""
    placed = [f for f in q.lines if f.track is not None]
    if not placed:
        return None
    crossed = next(((n, d) for n, d in q.differences.items() if n != "altitude"), None)
    with draw.style():
        fig = draw.figure(5.2)
        panels = fig.subplots(1, 2 if crossed is not None else 1, squeeze=False)[0]
        _noise_map(fig, panels[0], placed, q.discs)
        if crossed is not None:
            _crossing_map(fig, panels[1], q, placed, *crossed)
        for ax in panels:
            ax.set_aspect("equal", adjustable="datalim")
            ax.set_xlabel("east, km")
            ax.locator_params(nbins=6)
        panels[0].set_ylabel("north, km")
        return draw.svg(fig, "maps", "maps of the lines")


def _noise_map(fig: Figure, ax: Axes, placed: Sequence[LineFigures], discs: Discs) -> None:
    pieces: list[Array] = []
    values: list[Array] = []
    each = max(4, MOST_PIECES // len(placed))
    for f in placed:
        assert f.track is not None
        series = local_noise(f, discs)
        step = max(1, -(-len(series) // each))
        places = np.arange(0, len(series), step)
        points = np.column_stack([f.track.east, f.track.north])[np.append(places, len(series) - 1)] / 1e3
        pieces.append(np.stack([points[:-1], points[1:]], axis=1))
        values.append(series[places])
    colours = np.concatenate(values)
    seen = colours[np.isfinite(colours)]
    norm = Normalize(0.0, float(np.quantile(seen, 0.98)) if len(seen) else 1.0)
    shades = ScalarMappable(norm, _COLOURS.resampled(SHADES))
    ax.add_collection(_by_shade(np.concatenate(pieces)[np.isfinite(colours)], seen, shades))
    ax.autoscale()
    bar = fig.colorbar(shades, ax=ax, orientation="horizontal", shrink=0.8, aspect=40, pad=0.02)
    bar.set_label(f"noise along the line ({WINDOW} samples), Eo")


def _by_shade(pieces: Array, values: Array, shades: ScalarMappable) -> PathCollection:
    """All pieces (n, 2, 2) of a shade in one path: a tenth of the text of one path for each."""
    number = np.clip((np.asarray(shades.norm(values)) * SHADES).astype(int), 0, SHADES - 1)
    used = np.unique(number)
    paths = [
        Path(own.reshape(-1, 2), np.tile([Path.MOVETO, Path.LINETO], len(own)))
        for own in (pieces[number == k] for k in used)
    ]
    colours = shades.get_cmap()((used + 0.5) / SHADES)
    return PathCollection(paths, facecolors="none", edgecolors=colours, linewidths=1.4)


def _crossing_map(
    fig: Figure, ax: Axes, q: Quality, placed: Sequence[LineFigures], name: str, differences: Array
) -> None:
    for f in placed:
        assert f.track is not None
        step = max(1, len(f.track.east) // 50)
        ax.plot(
            f.track.east[::step] / 1e3, f.track.north[::step] / 1e3, color=draw.RULE, linewidth=0.7, zorder=1
        )
    there = np.isfinite(differences)
    east = np.array([c.east for c in q.crossings])[there] / 1e3
    north = np.array([c.north for c in q.crossings])[there] / 1e3
    size = np.abs(differences[there])
    norm = Normalize(0.0, float(np.quantile(size, 0.98)))
    points = ax.scatter(east, north, c=size, s=7.0, cmap=_COLOURS, norm=norm, linewidths=0.0, zorder=2)
    bar = fig.colorbar(points, ax=ax, orientation="horizontal", shrink=0.8, aspect=40, pad=0.02)
    bar.set_label(f"difference of {numbers.short(name, 24)} where lines cross, levelled, Eo")


def local_noise(f: LineFigures, discs: Discs) -> Array:
    """(N,) Eo: rolling standard deviation of the combination, or of the second differences of UV, NaN at the ends."""
    made = combinations(f.line, discs)
    series = [w for c in made if (w := filled(c.values)) is not None]
    if not made:
        channels = [of(f.line, d) for d in discs.names for of in (uv, ne) if _has(f, of, d)]
        # Gravity is smooth: second differences leave sqrt(6) times white noise.
        series = [
            np.diff(w, 2, prepend=w[0], append=w[-1]) / np.sqrt(6.0)
            for v in channels
            if (w := filled(v)) is not None
        ]
    found = np.full(len(f.line), np.nan)
    window = min(WINDOW, len(f.line) // 3)
    for values in series:
        rolled = rolling_std(values, window)
        start = window // 2
        stretch = found[start : start + len(rolled)]
        found[start : start + len(rolled)] = np.fmax(stretch, rolled)
    return found


def _has(f: LineFigures, of: object, disc: str) -> bool:
    kind = "inline" if of is uv else "cross"
    return (f"{kind}_{disc}" if disc else kind) in f.line.channels


def turbulent(q: Quality) -> str | None:
    """Noise of every line against its turbulence; ``None`` without either."""
    rough = np.array([np.nan if f.rough is None else f.rough.size for f in q.lines])
    names = q.names("noise")
    if not names or not np.isfinite(rough).any():
        return None
    with draw.style():
        fig = draw.figure(2.8)
        ax = fig.subplots()
        for name, colour, marker in zip(names, (draw.RESIDUAL, draw.NOISE), "oD", strict=False):
            noise = [f.noise.get(name, np.nan) for f in q.lines]
            ax.plot(rough, noise, marker, color=colour, markersize=3.5, label=name, linestyle="none")
        limit = q.limits["in-line-sum" if "in-line sum" in names else "difference-noise"].value
        top = ax.get_ylim()[1]
        if limit < 2.5 * top:
            ax.axhline(limit, color=draw.QUIET, linestyle="--", linewidth=0.9, label="limit")
        ax.set_ylim(0.0)
        ax.set_xlim(0.0)
        ax.set_xlabel("turbulence, m/s²")
        ax.set_ylabel("noise, Eo")
        draw.legend(ax, 3)
        return draw.svg(fig, "turbulence", "noise of the lines against turbulence")


def densities(q: Quality) -> str | None:
    """Noise densities of the combinations, or of the channels where there are none: median and spread of the lines."""
    pieces: dict[str, list[tuple[Array, Array]]] = {}
    for f in q.lines:
        made = [(c.name, c.values) for c in combinations(f.line, q.discs)]
        if not made:
            made = [(f"UV {d}".strip(), uv(f.line, d)) for d in q.discs.names if _has(f, uv, d)]
        for name, values in made:
            frequency, power = density(values, f.line.rate)
            if np.any(power > 0.0):  # a channel that stands still has no density
                pieces.setdefault(name, []).append((frequency, np.sqrt(power)))
    if not pieces:
        return None
    low = min(float(p[0][0]) for group in pieces.values() for p in group)
    high = max(float(p[0][-1]) for group in pieces.values() for p in group)
    grid = np.geomspace(low, high, _BINS)
    with draw.style():
        fig = draw.figure(2.8)
        ax = fig.subplots()
        for (name, group), colour in zip(
            pieces.items(), (draw.RESIDUAL, draw.NOISE, draw.QUIET), strict=False
        ):
            table = np.array([np.interp(grid, f, p, left=np.nan, right=np.nan) for f, p in group])
            seen = np.isfinite(table).sum(axis=0) > len(table) / 2
            tenth, middle, ninth = np.nanquantile(table[:, seen], (0.1, 0.5, 0.9), axis=0)
            ax.fill_between(grid[seen], tenth, ninth, color=colour, alpha=0.18, linewidth=0.0)
            ax.plot(grid[seen], middle, color=colour, label=name)
        ax.set_xscale("log")
        ax.set_yscale("log")
        draw.log_ticks(ax, "x")
        draw.log_ticks(ax, "y")
        ax.set_xlabel("frequency, Hz")
        ax.set_ylabel("Eo/√Hz")
        draw.legend(ax, 3)
        return draw.svg(fig, "densities", "noise densities")


def levels(q: Quality) -> str | None:
    """Mean of each channel on every line, in the order of flight, with the days divided; ``None`` with few lines."""
    names = q.names("levels")[:DRAWN]
    if len(q.lines) < 3 or not names:
        return None
    day = [d.name for d in q.days if d.channel == names[0]]
    counts = [d.lines for d in q.days if d.channel == names[0]]
    with draw.style():
        rows = (len(names) + 1) // 2
        fig = draw.figure(0.4 + 1.45 * rows)
        panels = fig.subplots(rows, min(2, len(names)), squeeze=False, sharex=True)
        for k, ax in enumerate(panels.flat):
            if k >= len(names):
                ax.set_visible(False)
                continue
            y = [f.levels.get(names[k], np.nan) for f in q.lines]
            ax.plot(np.arange(len(y)), y, "o", color=draw.RESIDUAL, markersize=2.2)
            for edge in np.cumsum(counts)[:-1]:
                ax.axvline(edge - 0.5, color=draw.NOISE, linestyle="--", linewidth=0.7)
            ax.set_title(numbers.short(names[k], 30), fontsize=7.5)
            ax.set_ylabel("Eo")
            ax.locator_params(axis="y", nbins=4)
            ax.yaxis.set_major_formatter(FuncFormatter(lambda v, _: numbers.plain(v, 4)))
            if k >= len(names) - 2:
                ax.set_xlabel("line, in the order of flight" + (f" ({len(day)} days)" if day else ""))
        return draw.svg(fig, "levels", "mean of the channels on every line")
