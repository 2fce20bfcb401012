"""The figures of Section III (Fig. 5 to 10), drawn from our results as PNG files.

matplotlib is imported here alone; the experiments themselves run without it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.experiments.models import Channels

Array = NDArray[np.float64]

_COLOURS = {"numerical": "black", "analytical": "tab:blue", "simplified": "tab:orange", "centre": "tab:green"}
_STYLES = {"numerical": "-", "analytical": "--", "simplified": ":", "centre": "-."}


@contextmanager
def page(path: Path, panels: int) -> Iterator[Any]:
    """Axes of a figure, one above the other, saved to ``path`` at the end; no window system needed."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError as problem:
        raise UserError(
            "figures need the library matplotlib, which is not installed",
            remedy="pip install matplotlib, or leave out --figures",
        ) from problem
    figure = Figure(figsize=(7, 2.6 * panels), layout="constrained")
    FigureCanvasAgg(figure)
    yield np.atleast_1d(figure.subplots(panels, 1))
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        # Without the date and the library's version the file depends on the numbers alone.
        figure.savefig(path, dpi=120, metadata={"Software": None})
    except OSError as problem:
        raise UserError("the figure cannot be written", where=path, found=problem.strerror) from problem


def lines(axes: Any, time: Array, series: Mapping[str, Array], label: str) -> None:
    """Draw series (N,) over time (N,), s, each in the colour and style of its model."""
    for name, values in series.items():
        axes.plot(time, values, label=name, color=_COLOURS.get(name), ls=_STYLES.get(name, "-"), lw=1)
    axes.set(xlabel="time, s", ylabel=label)
    axes.legend(loc="upper right", fontsize="small")


def pair(path: Path, series: Mapping[str, Channels], log: bool = False) -> Path:
    """Draw inline over cross, Eo; with ``log`` their moduli, logarithmically."""
    time = next(iter(series.values())).time
    with page(path, 2) as axes:
        for axis, channel in zip(axes, ("inline", "cross"), strict=True):
            values = {name: getattr(c, channel) for name, c in series.items()}
            if log:
                values = {name: np.maximum(np.abs(v), 1e-7) for name, v in values.items()}
                axis.set_yscale("log")
            lines(axis, time, values, f"{channel}, Eo")
    return path
