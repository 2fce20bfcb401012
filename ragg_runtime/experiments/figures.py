"""The figures of Section III (Fig. 5 to 10), drawn from our results as PNG files.

matplotlib is imported here alone; the experiments themselves run without it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.experiments.models import Channels, output

if TYPE_CHECKING:
    from ragg_runtime.experiments.dynamic import Dynamic
    from ragg_runtime.experiments.multifrequency import MultiFrequency
    from ragg_runtime.experiments.turbulence import Turbulence

Array = NDArray[np.float64]

_COLOURS = {"numerical": "black", "analytical": "tab:blue", "simplified": "tab:orange", "centre": "tab:green"}
_STYLES = {"numerical": "-", "analytical": "--", "simplified": ":", "centre": "-."}


@contextmanager
def _page(path: Path, panels: int) -> Iterator[Any]:
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


def _lines(axes: Any, time: Array, series: Mapping[str, Array], label: str) -> None:
    for name, values in series.items():
        axes.plot(time, values, label=name, color=_COLOURS.get(name), ls=_STYLES.get(name, "-"), lw=1)
    axes.set(xlabel="time, s", ylabel=label)
    axes.legend(loc="upper right", fontsize="small")


def _pair(path: Path, series: Mapping[str, Channels], log: bool = False) -> Path:
    time = next(iter(series.values())).time
    with _page(path, 2) as axes:
        for axis, channel in zip(axes, ("inline", "cross"), strict=True):
            values = {name: getattr(c, channel) for name, c in series.items()}
            if log:
                values = {name: np.maximum(np.abs(v), 1e-7) for name, v in values.items()}
                axis.set_yscale("log")
            _lines(axis, time, values, f"{channel}, Eo")
    return path


def draw_multifrequency(result: MultiFrequency, folder: Path) -> list[Path]:
    """Fig. 5 (voltages), 6 (demodulated gradients), 7 (differences from the centre, logarithmic)."""
    start = result.run.time < 60
    time = result.run.time[start]
    path = folder / "fig-5-voltages.png"
    with _page(path, 2) as axes:
        _lines(axes[0], time, {f"V_{j + 1}": v[start] for j, v in enumerate(result.run.voltages)}, "V")
        _lines(axes[1], time, {name: G[start] for name, G in result.outputs.items()}, "G_out, V")
    return [
        path,
        _pair(folder / "fig-6-gradients.png", {**result.demodulated, "centre": result.centre}),
        _pair(folder / "fig-7-differences.png", result.differences, log=True),
    ]


def draw_dynamic(result: Dynamic, folder: Path) -> list[Path]:
    """Fig. 8: outputs and model errors over three turns, and the errors after demodulation."""
    run = result.run
    start = run.time < 3 / run.instrument.spin_frequency
    time = run.time[start]
    outputs = {"numerical": run.G_out, **{name: output(name, run) for name in result.errors}}
    path = folder / "fig-8-dynamic.png"
    with _page(path, 4) as axes:
        _lines(axes[0], time, {name: G[start] for name, G in outputs.items()}, "G_out, V")
        _lines(axes[1], time, {name: e[start] for name, e in result.errors.items()}, "model error, V")
        for axis, channel in zip(axes[2:], ("inline", "cross"), strict=True):
            series = {name: getattr(c, channel) for name, c in result.demodulated.items()}
            _lines(axis, result.demodulated["analytical"].time, series, f"{channel} error, Eo")
    return [path]


def draw_turbulence(result: Turbulence, folder: Path) -> list[Path]:
    """Fig. 9 and 10, and the same for experiment 3: motion and model errors of the first seed."""
    paths = []
    for experiment, run in result.runs.items():
        start = run.time < 60
        time, c = run.time[start], run.channels
        errors = {m: result.demodulated[experiment, m] for m in ("analytical", "simplified")}
        path = folder / f"turbulence-{experiment}.png"
        with _page(path, 4) as axes:
            _lines(axes[0], time, {"a_z": c["a_z"][start] / run.instrument.g0 * 1e3}, "mg")
            if experiment == 1:
                axes[1].hist(c["a_z"] / run.instrument.g0 * 1e3, bins=50, color="grey")
                axes[1].set(xlabel="a_z, mg", ylabel="samples")
            else:
                turn = {f"omegadot_{k}": c[f"omegadot_{k}"][start] for k in "xyz"}
                _lines(axes[1], time, turn, "rad/s$^2$")
            for axis, channel in zip(axes[2:], ("inline", "cross"), strict=True):
                series = {m: getattr(e, channel) for m, e in errors.items()}
                _lines(axis, errors["analytical"].time, series, f"{channel} error, Eo")
        paths.append(path)
    return paths
