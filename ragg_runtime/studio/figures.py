"""The page's figures as SVG: the panels of the reports, and a window on one flight."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.progress import one_thread
from ragg_runtime.compensation.calibrate import information, invert_root
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.report import panels
from ragg_runtime.report.plots import draw_file
from ragg_runtime.studio.session import State, list_present
from ragg_runtime.wording.sections import Plot

MODELS = 12  # models that are drawn from the posterior


@dataclass(frozen=True)
class Asked:
    """A figure by name, of an output of a flight between two instants, s; with the ``spread`` of models."""

    what: str
    flight: int
    output: int
    window: tuple[float, float]
    spread: bool


def draw(s: State, a: Asked) -> bytes:
    """The figure as an SVG document; UserError if there is none."""
    kind, _, channel = a.what.partition(":")
    if not 0 <= a.flight < len(s.flights):
        raise UserError("there is no such flight", found=str(a.flight + 1))
    plot: Plot | None
    match kind:
        case "columns":
            plot = panels.plot_columns(s.flights[a.flight])
        case "steps":
            history = s.model.directory.history
            steps = [history[n].as_json() for n in list_present(history)]
            plot = panels.plot_history(steps, s.require("compared").noise_floor)
        case _:
            plot = _draw_result(s, a, kind, channel)
    if plot is None:
        raise UserError("this record has no such figure", found=repr(kind[:40]))
    return draw_file(plot).encode()


@one_thread
def _draw_result(s: State, a: Asked, kind: str, channel: str) -> Plot | None:
    """A figure of the comparison with the flight, or of the diagnosis."""
    c, flight = s.result_for(a.flight)
    f, residuals = c.fitted, c.residual
    positions = [n for n, o in enumerate(f.observations) if o.flight == flight]
    if not 0 <= a.output < len(positions):
        raise UserError("there is no such output", found=str(a.output + 1))
    n = positions[a.output]
    match kind:
        case "time":
            spread = draw_models(f, n) if a.spread and c is s.compared else None
            return panels.plot_window(f, n, residuals[n], a.window, spread)
        case "correlations":
            return panels.correlate_parameters(f)
        case "whiteness":
            return panels.plot_whiteness(f, n, residuals[n])
        case "against":
            return panels.plot_against(f, n, residuals[n], channel)
    lines, d = panels.pair_lines(residuals, None), s.diagnosed
    if c is s.compared and d is not None and d.found:
        f, residuals, lines = (
            d.outcome.target,
            d.residual_after,
            panels.pair_lines(d.residual, d.residual_after),
        )
    match kind:
        case "spectrum":
            return panels.plot_spectrum(f, lines)
        case "channels":
            return panels.plot_channels(f, lines)
        case "harmonics":
            return panels.plot_harmonics(f, residuals)
    return None


def draw_models(f: Fitted, n: int) -> panels.Array:
    """(2, N) V: least and greatest residual of flight n under models drawn from the posterior, the same ones each time."""
    draws = np.random.default_rng(0).standard_normal((MODELS, f.n_base))
    root = invert_root(information(f))
    residuals = f.prepared[n].residuals(np.stack([f.vector(root @ x) for x in draws]))
    return np.stack([np.min(residuals, axis=0), np.max(residuals, axis=0)])
