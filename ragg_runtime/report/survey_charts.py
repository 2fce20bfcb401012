"""Figures of a survey: errors of every flight before and after, and parameters over the flights."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter
from numpy.typing import NDArray

from ragg_runtime.report import draw
from ragg_runtime.survey.summary import Trend
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]

NAMED = 24
"""Flights up to which each one's name stands at the axis."""


def errors(
    flights: Sequence[str], before: Array, after: Array, noise: Array, unexplained: NDArray[np.bool_]
) -> str:
    """Calibrated error of every flight before and after the effects found in it, Eo, and its noise floor.

    Parameters
    ----------
    before, after, noise
        (N,) Eo, in the order of ``flights``.
    unexplained
        (N,) bool: flights in which something is left that no effect explains.
    """
    with draw.style():
        fig = draw.figure(3.0 + (0.5 if len(flights) <= NAMED else 0.0))
        ax = fig.subplots()
        x = np.arange(len(flights), dtype=np.float64)
        fell = before > after * 1.0005
        size = float(np.clip(300.0 / len(flights), 2.0, 5.0))
        ax.vlines(x[fell], after[fell], before[fell], color=draw.BEFORE, linewidth=min(1.2, size / 3.0))
        ax.plot(
            x[fell],
            before[fell],
            "o",
            color=draw.BEFORE,
            markersize=size,
            label="calibrated, as the model is",
        )
        good = ~unexplained
        ax.plot(
            x[good], after[good], "o", color=draw.RESIDUAL, markersize=size, label="with the effects found"
        )
        if np.any(unexplained):
            ax.plot(
                x[unexplained],
                after[unexplained],
                "X",
                color=draw.NOISE,
                markersize=size + 2.0,
                label="unexplained",
            )
        edges = np.concatenate([x - 0.5, [len(x) - 0.5]])
        ax.stairs(
            noise, edges, baseline=None, color=draw.NOISE, linestyle="--", linewidth=1.0, label="noise floor"
        )
        _flights_axis(ax, flights)
        every = np.concatenate([before, after, noise])
        every = every[np.isfinite(every) & (every > 0.0)]
        if len(every) and float(np.max(every)) > 6.0 * float(np.min(every)):
            ax.set_yscale("log")
            ax.set_ylim(float(np.min(every)) / 1.4, float(np.max(every)) * 1.4)
            draw.log_ticks(ax, "y")
        elif len(every):
            ax.set_ylim(0.0, 1.12 * float(np.max(every)))
        ax.set_ylabel("error, Eo rms")
        draw.legend(ax, 4)
        return draw.svg(fig, "errors", "error of every flight before and after the effects found in it")


def trends(flights: Sequence[str], shown: Sequence[Trend]) -> str:
    """Values of some parameters over the flights, with standard deviations, one panel each."""
    with draw.style():
        rows = (len(shown) + 1) // 2
        fig = draw.figure(0.4 + 1.55 * rows)
        panels = fig.subplots(rows, min(2, len(shown)), squeeze=False)
        for k, ax in enumerate(panels.flat):
            if k >= len(shown):
                ax.set_visible(False)
                continue
            t = shown[k]
            at = np.array([n for n, v in enumerate(t.values) if v is not None], dtype=np.float64)
            v = np.array([v for v in t.values if v is not None])
            s = np.array([v for v in t.stds if v is not None])
            ax.errorbar(at, v - t.mean, s, fmt="o", color=draw.RESIDUAL, markersize=3.0, elinewidth=0.7)
            ax.axhline(0.0, color=draw.NOISE, linestyle="--", linewidth=0.9)
            middle = numbers.with_unit(numbers.rounded(t.mean, float(np.min(s))), t.unit)
            ax.set_title(f"{numbers.short(t.label, 44)}  −  {middle}", fontsize=7.5)
            ax.set_xlim(-0.7, len(flights) - 0.3)
            ax.locator_params(axis="y", nbins=4)
            ax.set_ylabel(numbers.unit(t.unit))
            ax.locator_params(axis="x", integer=True, nbins=8)
            ax.yaxis.set_major_formatter(FuncFormatter(lambda y, _: numbers.plain(y, 3)))
            ax.set_xlabel("flight, by number in the table" if k >= len(shown) - 2 else "")
        return draw.svg(fig, "trends", "calibrated parameters over the flights")


def _flights_axis(ax: Axes, flights: Sequence[str]) -> None:
    ax.set_xlim(-0.7, len(flights) - 0.3)
    if len(flights) <= NAMED:
        ax.set_xticks(range(len(flights)), [numbers.short(f, 24) for f in flights], rotation=40, ha="right")
        draw.no_ticks(ax, "x")
    else:
        ax.locator_params(axis="x", integer=True, nbins=12)
        ax.set_xlabel("flight, by number in the table")
