"""The reports of the commands: what :mod:`ragg_runtime.wording.describe` says of a result, with figures between, as one page each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ragg_runtime.base import false_alarms
from ragg_runtime.compensation.frozen import Held
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.identification import series
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.parameters import calibrated
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io import Flight
from ragg_runtime.report import panels, whiteness
from ragg_runtime.report.page import Origin, render_page
from ragg_runtime.report.parameters import describe_parameters
from ragg_runtime.survey.result import Survey, find_trends
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import Axes, Bar, Bars, Curve, Curves, Plot, Section

Array = np.ndarray[Any, np.dtype[np.float64]]
Json = Mapping[str, Any]


def compare_page(c: Comparison, origin: Origin, frozen: Held | None = None) -> str:
    """The report of ``compare``; ``frozen``: how a saved calibration holds, where it is that which is compared."""
    f, names = c.fitted, [o.name for o in c.fitted.observations]
    said = (
        describe.describe_comparison(c.as_json(), names)
        if frozen is None
        else describe.describe_held(frozen.as_json(), names)
    )
    lines = panels.before_and_after(c.residual, None)
    sections = [
        _with_plots(said[0], panels.plot_blocks(f, lines, envelope=True)),
        *_with_failures(said[1:], c),
        Section(title="Measured over model", plots=(panels.plot_measured(f, c.residual),)),
        *_figure("Spectrum", panels.plot_spectrum(f, lines)),
        *_figure("Demodulated channels", panels.plot_channels(f, lines)),
        *_whiteness(f, c.residual),
        *describe_parameters(f),
    ]
    return render_page("Model against flight", sections, _of(origin, f), panels.describe_record(f))


def _of(origin: Origin, f: Any) -> Origin:
    return replace(origin, digest=f.model.digest)


def _with_plots(s: Section, *plots: Plot | None) -> Section:
    return replace(s, plots=tuple(p for p in plots if p is not None))


def _figure(title: str, *plots: Plot | None, detail: bool = False) -> list[Section]:
    """A section of figures alone; none if there is nothing to draw."""
    drawn = tuple(p for p in plots if p is not None)
    return [Section(title=title, plots=drawn, detail=detail)] if drawn else []


def _whiteness(f: Fitted, residual: Sequence[Array]) -> list[Section]:
    """Whether the residual of the worst flight is noise, folded; nothing where only the channels were recorded."""
    (n,) = series.worst(f, residual, 1)
    if f.observations[n].recorded.demodulated:
        return []
    channel = whiteness.worst_channel(f, n, residual[n])
    white, against = (
        whiteness.plot_whiteness(f, n, residual[n]),
        whiteness.plot_against(f, n, residual[n], channel),
    )
    return [
        *_figure("Whiteness of the residual", white, detail=True),
        *_figure(f"Residual against {numbers.product(channel)}", against, detail=True),
    ]


def _with_failures(sections: Sequence[Section], c: Comparison) -> list[Section]:
    """The sections, the one that says where the model fails with its figures."""
    f = c.fitted
    plots = (
        panels.plot_harmonics(f, f.vector(np.zeros(f.n_base)), "where"),
        panels.plot_terms(c.terms(), c.calibrated.rms_Eo, "where"),
    )
    found = [_with_plots(s, *plots) if s.title == "Where it fails" else s for s in sections]
    if not any(s.title == "Where it fails" for s in sections):
        found += _figure("Residual by harmonic of the spin", plots[0])
    return found


def diagnose_page(d: Diagnosis, origin: Origin) -> str:
    """The report of ``diagnose``: verdict, one figure, where the model fails, the findings; everything else is folded."""
    f, said = d.target, describe.describe_diagnosis(d.as_json())
    after = d.residual_after if d.found else None
    lines = panels.before_and_after(d.residual, after)
    remains = d.verdict in ("unexplained", "partly-explained")
    main = panels.plot_spectrum(f, lines) or panels.plot_blocks(d.fitted, lines)
    where = [
        panels.plot_terms(d.terms(), d.after.rms_Eo, "where") if remains else None,
        panels.plot_harmonics(f, d.coefficients, "where") if remains else None,
    ]
    parts = {s.title: s for s in said[1:]}
    open_ = [
        _with_plots(parts.pop("Not explained", Section(title="Not explained")), *where) if remains else None,
        parts.pop("Values", None),
        parts.pop("Next motion", None),
    ]
    level = -(np.log(false_alarms.CATALOGUE / max(1, len(d.ranking))) / np.log(10.0))
    evidence = panels.plot_evidence([r.as_json() for r in d.ranking], d.found, float(level))
    if "Evidence" in parts:
        parts["Evidence"] = _with_plots(parts["Evidence"], evidence)
    sections = [
        _with_plots(said[0], main),
        *(s for s in open_ if s is not None),
        *(replace(s, detail=True) for s in parts.values() if s.title),
        *_physics(d),
        *_figure("Error in blocks of time", panels.plot_blocks(d.fitted, lines), detail=True),
        *_figure("Demodulated channels", panels.plot_channels(f, lines), detail=True),
        *(describe_parameters(f) if d.found else ()),
    ]
    return render_page("What is missing", sections, _of(origin, d.fitted), panels.describe_record(d.fitted))


def _physics(d: Diagnosis) -> list[Section]:
    """What the claimed effects are, from the catalogue."""
    known = [e for e in map(d.fitted.model.effect, d.found) if e is not None]
    said = [f"{e.id}, {e.title}: {e.physics} Source: {e.source or 'none'}" for e in known]
    return [Section(title="Physics of the effects", sentences=tuple(said), detail=True)] if said else []


def add_page(
    history: Sequence[Json],
    before: Comparison,
    after: Comparison,
    origin: Origin,
    diagnosis: Diagnosis | None = None,
) -> str:
    """The report of a step: the model without and with an effect, each calibrated on the flights; the step is the last of ``history``."""
    f = after.fitted
    old, new = ([e.id for e in c.fitted.model.effects] for c in (before, after))
    values = []
    for e in new:
        parameters, combinations = calibrated(f, e)
        own = {"effect": e, "parameters": [p.as_json() for p in parameters]}
        values.append(own | {"combinations": [p.as_json() for p in combinations]})
    step = describe.describe_step(
        [e for e in new if e not in old],
        [e for e in old if e not in new],
        before.as_json(),
        after.as_json(),
        values,
    )
    lines = panels.before_and_after(before.residual, after.residual)
    sections = [
        _with_plots(step[0], panels.plot_history(history, after.noise_floor)),
        *step[1:],
        Section(title="History", table=describe.history_table(history), detail=True),
        *_figure(
            "The residual before and after", panels.plot_spectrum(f, lines), panels.plot_blocks(f, lines)
        ),
        *_figure("Demodulated channels", panels.plot_channels(f, lines)),
        *_with_failures([], after),
        *_figure("What each group of parameters contributes", panels.plot_budget(f, after.noise_floor)),
    ]
    if diagnosis is not None:
        said = describe.describe_diagnosis(diagnosis.as_json())
        sections += [replace(s, detail=True) for s in said if s.title == "Evidence"]
    return render_page("A step of the model", sections, _of(origin, f), panels.describe_record(f))


def calibrate_page(said: Sequence[Section], f: Any, origin: Origin) -> str:
    """The report of ``calibrate``: ``said`` and the parameters of the fit ``f``."""
    lines = panels.before_and_after(f.residuals(np.zeros(f.n_base)), None)
    figures = _figure(
        "The residual", panels.plot_blocks(f, lines, envelope=True), panels.plot_spectrum(f, lines)
    )
    return render_page(
        "Calibration", [*said, *figures, *describe_parameters(f)], _of(origin, f), panels.describe_record(f)
    )


def compensate_page(said: Sequence[Section], made: Sequence[Mapping[str, Array]], origin: Origin) -> str:
    """The report of ``compensate``: ``said`` and the compensated channels of every flight."""
    axes = []
    for columns in made[: panels.FLIGHTS]:
        time = np.asarray(columns["time"], dtype=np.float64)
        step = max(1, len(time) // panels.MOST_POINTS)
        for name in columns:
            if f"{name}_std" in columns:
                x, std = (np.asarray(columns[k], dtype=np.float64)[::step] for k in (name, f"{name}_std"))
                band = Curve("± 1 sigma", time[::step], x - std, "envelope", "band", x + std)
                axes.append(Axes((band, Curve(name, time[::step], x, width=0.8)), f"{name}, Eo"))
    plot = Curves(
        "compensated",
        "compensated channels over time",
        "Compensated channels with their uncertainty.",
        tuple(axes),
        "time, s",
    )
    return render_page("Compensation", [*said, *_figure("Channels", plot if axes else None)], origin)


def info_page(said: Sequence[Section], flights: Sequence[Flight], origin: Origin) -> str:
    """The report of ``info``: ``said``, and every column of the flights over time."""
    sections = list(said)
    for n, x in enumerate(flights[: panels.FLIGHTS]):
        step = max(1, len(x.time) // panels.MOST_POINTS)
        columns = {**x.channels, **x.outputs}
        axes = tuple(
            Axes(
                (Curve(name, x.time[::step], np.asarray(v)[::step], width=0.7),),
                numbers.unit(x.units.get(name, "")),
                share=0.8,
            )
            for name, v in columns.items()
        )
        plot = Curves(
            f"columns{n}",
            f"columns of {x.name}",
            "Every column over time, in SI.",
            axes,
            "time, s",
            height=1.6,
        )
        sections += _figure(f"Columns of {x.name}", plot)
    return render_page("A flight", sections, origin)


def history_page(steps: Sequence[Json], origin: Origin) -> str:
    """The report of ``history``."""
    said = [
        Section(sentences=(f"{len(steps)} steps.",)),
        Section(title="Steps", table=describe.history_table(steps)),
    ]
    return render_page(
        "History", [_with_plots(said[0], panels.plot_history(steps, float("nan"))), said[1]], origin
    )


def survey_page(s: Survey, origin: Origin) -> str:
    """The report of ``survey``."""
    said = s.sections("MODEL_DIR")
    drawn = [plot_errors(s)] if s.done else []
    trends = find_trends(s.done)[:6]
    sections = [_with_plots(said[0], *drawn), *said[1:]]
    if trends:
        sections += _figure(
            "The least constant parameters", *(plot_trend(t, n) for n, t in enumerate(trends))
        )
    return render_page("Survey of flights", sections, origin)


def plot_errors(s: Survey) -> Plot:
    """Calibrated error of every flight, before and after the effects that were found in it."""
    bars = tuple(
        Bar(str(r["flight"]), after, r["noise_floor"]["rms_Eo"], r["verdict"] != "unexplained", (before,))
        for r in s.done
        for before, after in [[r["error"][k]["rms_Eo"] for k in ("calibrated", "after")]]
    )
    every = [b.value for b in bars] + [b.dots[0] for b in bars]
    caption = "Error before demodulation of every flight, calibrated alone. Bars: with the effects found in it; grey: unexplained."
    return Bars(
        "errors",
        "error of every flight",
        caption,
        bars,
        "error, Eo rms",
        log=max(every) > 6.0 * min(every),
        dots=("as the model is",),
    )


def plot_trend(t: Json, n: int) -> Plot:
    """A calibrated parameter over the flights, less its mean, with one standard deviation."""
    at = np.array([k for k, v in enumerate(t["values"]) if v is not None], dtype=np.float64)
    v, std = (np.array([x for x in t[k] if x is not None]) for k in ("values", "stds"))
    middle = numbers.with_unit(numbers.rounded(t["mean"], float(np.min(std))), t["unit"])
    name = t["name"] if t["accelerometer"] is None else f"{t['name']}[{t['accelerometer']}]"
    label, away = numbers.short(name, 44), v - t["mean"]
    band = Curve("± 1 sigma", at, away - std, "envelope", "band", away + std)
    axes = Axes((band, Curve("value", at, away)), numbers.unit(t["unit"]), f"{label} − {middle}")
    return Curves(
        f"trend{n}",
        f"{label} over the flights",
        f"{label} over the flights.",
        (axes,),
        "flight, by number in the table",
        "",
        1.5,
    )
