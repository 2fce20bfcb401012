"""The reports of the commands: sections with figures, each one self-contained HTML document; the same input gives the same bytes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import count
from ragg_runtime.base.files import MISSING, list_versions
from ragg_runtime.compensation.calibrate import Held
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.parameters import Estimates
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io import Flight
from ragg_runtime.report import panels
from ragg_runtime.report.panels import describe_parameters
from ragg_runtime.survey.result import Survey
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import (
    Bar,
    Bars,
    Plot,
    Section,
    make_environment,
    render_html,
)
from ragg_runtime.workspace import Source


def draw_figure(plot: Plot) -> str:
    """The plot as SVG; without matplotlib a line that names the extra."""
    try:
        from ragg_runtime.report.plots import draw_plot
    except ModuleNotFoundError:
        return "<p>no figure without matplotlib: pip install 'ragg[plots]'</p>"
    return draw_plot(plot)


def render_page(kind: str, sections: Sequence[Section], source: Source) -> str:
    """A whole HTML document of sections, the first of which is the verdict.

    ``kind``: what the report is about, in two or three words.
    """
    if notes := tuple(source.notes):
        sections = [*sections, Section("What was done to the record", notes, detail=len(notes) > 3)]
    first, *further = sections
    libraries = ", ".join(f"{n} {v}" for n, v in list_versions().items() if v != MISSING)
    page = make_environment("ragg_runtime.report", html=True).get_template("page.html.j2")
    return numbers.clean(
        page.render(
            kind=kind,
            source=source,
            first=render_html([first], draw_figure),
            others=render_html(further, draw_figure),
            facts=[
                ("derived model", source.m and source.m.model.digest),
                ("versions", libraries),
            ],
        )
    )


Array = np.ndarray[Any, np.dtype[np.float64]]
Json = Mapping[str, Any]


def _add_plots(s: Section, *plots: Plot | None) -> Section:
    return replace(s, plots=tuple(p for p in plots if p is not None))


def _draw(title: str, *plots: Plot | None, detail: bool = False) -> list[Section]:
    """A section of figures alone; none if there is nothing to draw."""
    drawn = tuple(p for p in plots if p is not None)
    return [Section(title=title, plots=drawn, detail=detail)] if drawn else []


# --- the loop ------------------------------------------------------------------------------------------


def write_comparison(c: Comparison, source: Source, frozen: Held | None = None) -> str:
    """The report of ``compare``; ``frozen``: the test of the saved calibration, if that is compared."""
    f, names = c.fitted, [o.name for o in c.fitted.observations]
    if frozen is None:
        summary = describe.describe_comparison(c.as_json(), names)
    else:
        summary = describe.describe_held(frozen.as_json(), names)
    lines, (n,) = panels.pair_lines(c.residual, None), panels.find_worst(f, c.residual, 1)
    sections = [
        _add_plots(summary[0], panels.plot_window(f, n, c.residual[n]), panels.plot_blocks(f, lines)),
        *_add_failures(summary[1:], c),
        *_draw("Spectrum", panels.plot_spectrum(f, lines), detail=True),
        *_draw("Demodulated channels", panels.plot_channels(f, lines), detail=True),
        *_ask_whiteness(f, n, c.residual[n]),
        *describe_parameters(f),
    ]
    return render_page("Model against flight", sections, source)


def _ask_whiteness(f: Fitted, n: int, residual: Array) -> list[Section]:
    """Whether the residual (N,), V, of flight n is noise, folded; nothing where only the channels were recorded."""
    if f.observations[n].recorded.demodulated:
        return []
    channel = panels.find_worst_channel(f, n, residual)
    white = panels.plot_whiteness(f, n, residual)
    against = panels.plot_against(f, n, residual, channel)
    return [
        *_draw("Whiteness of the residual", white, detail=True),
        *_draw(f"Residual against {numbers.product(channel)}", against, detail=True),
    ]


def _add_failures(sections: Sequence[Section], c: Comparison) -> list[Section]:
    """The sections, that on where the model fails with its figures."""
    f = c.fitted
    harmonics = panels.plot_harmonics(f, c.residual)
    if any(s.title == "Where it fails" for s in sections):
        return [_add_plots(s, harmonics) if s.title == "Where it fails" else s for s in sections]
    return [*sections, *_draw("Residual by harmonic of the spin", harmonics)]


def write_diagnosis(d: Diagnosis, source: Source) -> str:
    """The report of ``diagnose``: verdict, one figure, where the model fails, the findings; everything else is folded."""
    f, summary = d.outcome.target, describe.describe_diagnosis(d.as_json())
    lines = panels.pair_lines(d.residual, d.residual_after if d.found else None)
    main = panels.plot_spectrum(f, lines) or panels.plot_blocks(d.fitted, lines)
    parts = {s.title: s for s in summary[1:]}
    open_ = []
    if d.verdict in ("unexplained", "partly-explained"):
        harmonics = panels.plot_harmonics(f, d.residual_after)
        rest = parts.pop("Not explained", Section(title="Not explained"))
        open_.append(_add_plots(rest, harmonics))
    open_ += [parts.pop(name) for name in ("Values", "Next motion") if name in parts]
    effects = [e for e in map(d.fitted.model.effect, d.found) if e is not None]
    physics = [f"{e.id}, {e.title}: {e.physics} Source: {e.source or 'none'}" for e in effects]
    sections = [
        _add_plots(summary[0], main),
        *open_,
        *(replace(s, detail=True) for s in parts.values() if s.title),
        *([Section("Physics of the effects", tuple(physics), detail=True)] if physics else ()),
        *_draw("Error in blocks of time", panels.plot_blocks(d.fitted, lines), detail=True),
        *_draw("Demodulated channels", panels.plot_channels(f, lines), detail=True),
        *(describe_parameters(f) if d.found else ()),
    ]
    return render_page("What is missing", sections, source)


def write_addition(history: Sequence[Json], before: Comparison, after: Comparison, source: Source) -> str:
    """The report of a step: the model without and with an effect, each calibrated on the flights; the step is the last of ``history``."""
    f = after.fitted
    old, new = ([e.id for e in c.fitted.model.effects] for c in (before, after))
    values = []
    for e in new:
        estimates = Estimates.of_calibration(f).select(e)
        parameters = [p.as_json() for p in estimates.list_parameters()]
        combinations = [p.as_json() for p in estimates.list_combinations()]
        values.append({"effect": e, "parameters": parameters, "combinations": combinations})
    added, removed = [e for e in new if e not in old], [e for e in old if e not in new]
    step = describe.describe_step(added, removed, before.as_json(), after.as_json(), values)
    lines = panels.pair_lines(before.residual, after.residual)
    figures = panels.plot_spectrum(f, lines), panels.plot_blocks(f, lines)
    sections = [
        _add_plots(step[0], panels.plot_history(history, after.noise_floor)),
        *step[1:],
        Section(title="History", table=describe.tabulate_history(history), detail=True),
        *_draw("The residual before and after", *figures),
        *_draw("Demodulated channels", panels.plot_channels(f, lines), detail=True),
        *(replace(s, detail=True) for s in _add_failures([], after)),
    ]
    return render_page("A step of the model", sections, source)


def write_history(steps: Sequence[Json], source: Source) -> str:
    """The report of ``history``."""
    first = Section(sentences=(f"{count(len(steps), 'step')}.",))
    table = Section(title="Steps", table=describe.tabulate_history(steps))
    drawn = panels.plot_history(steps, float("nan"))
    return render_page("History", [_add_plots(first, drawn), table], source)


# --- what comes after, and flights ---------------------------------------------------------------------


def write_calibration(summary: Sequence[Section], f: Fitted, source: Source) -> str:
    """The report of ``calibrate``: ``summary`` and the parameters of the fit ``f``."""
    lines = panels.pair_lines(f.residuals(), None)
    drawn = panels.plot_blocks(f, lines), panels.plot_spectrum(f, lines)
    sections = [*summary, *_draw("The residual", *drawn), *describe_parameters(f, values=False)]
    return render_page("Calibration", sections, source)


def write_compensation(summary: Sequence[Section], x: Sequence[Mapping[str, Array]], source: Source) -> str:
    """The report of ``compensate``: ``summary`` and the compensated channels ``x`` of every flight."""
    plot = panels.plot_compensated(x)
    return render_page("Compensation", [*summary, *_draw("Channels", plot)], source)


def write_info(
    summary: Sequence[Section], flights: Sequence[Flight], source: Source, kind: str = "A flight"
) -> str:
    """The report of ``info``, or of another ``kind``: ``summary``, and every column of the flights over time."""
    drawn = (_draw(f"Columns of {x.name}", panels.plot_columns(x)) for x in flights[: panels.FLIGHTS])
    return render_page(kind, [*summary, *(s for d in drawn for s in d)], source)


# --- many flights --------------------------------------------------------------------------------------


def write_survey(s: Survey, source: Source, model_dir: Path | str = "MODEL_DIR") -> str:
    """The report of ``survey``; ``model_dir`` is named in the commands that come next."""
    summary = s.sections(model_dir)
    first = _add_plots(summary[0], _plot_errors(s) if s.done else None)
    return render_page("Survey of flights", [first, *summary[1:]], source)


def _plot_errors(s: Survey) -> Plot:
    """Calibrated error of every flight, before and after the effects that were found in it."""
    bars = []
    for r in s.done:
        before, after = (r["error"][k]["rms_Eo"] for k in ("calibrated", "after"))
        explained = r["verdict"] != "unexplained"
        bars.append(Bar(str(r["flight"]), after, r["noise_floor"]["rms_Eo"], explained, before))
    values = [v for b in bars for v in (b.value, b.dot)]
    caption = "Error before demodulation of every flight, calibrated alone. Bars: with the effects found in it; grey: unexplained."
    log = max(values) > 6.0 * min(values)
    return Bars("errors", caption, tuple(bars), "error, Eo rms", log=log, dot="current model")
