"""The report of ``ragg survey``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter
from numpy.typing import NDArray

from ragg_runtime.report import draw, page
from ragg_runtime.report.page import Origin
from ragg_runtime.survey.result import Survey, Trend, advised, counted
from ragg_runtime.wording import numbers

DRAWN = 6
"""Parameters that are drawn over the flights."""

TABLED = 8
"""Parameters that stand in the table by flights."""


def survey_html(
    survey: Survey, *, title: str, command: str, digest: str, sources: Sequence[tuple[str, str]]
) -> str:
    """The report as one HTML document; ``digest`` is that of the derived model, the rest as in ``compare_html``."""
    context: dict[str, Any] = {
        "kind": "Survey of flights",
        "errors": [],
        "figures": page.figures(_figures(survey)),
        "terms": [(numbers.harmonic(h), numbers.product(t), n) for h, t, n in survey.summary.terms],
        "by_flight": _by_flight(survey),
        "digest": digest,
    }
    return page.render("survey.html.j2", Origin(title, command, sources), context | shown(survey))


def shown(survey: Survey) -> dict[str, Any]:
    """Verdicts, effects and the tables, in words and digits: of the report and of the studio."""
    x = survey.summary
    return {
        "state": _state(survey),
        "headline": f"{counted(x.counts)}.",
        "lead": _lead(survey),
        "facts": _facts(survey),
        "effects": [asdict(e) for e in x.effects],
        "flights": [_row(n, r) for n, r in enumerate(survey.done)],
        "failed": [(r["flight"], str(r["error"]["message"]).split("\n")) for r in survey.failed],
        "trends": [_trend(t) for t in x.trends],
    }


def _state(s: Survey) -> str:
    counts = s.summary.counts
    if counts["unexplained"] or counts["error"]:
        return "bad"
    return "found" if counts["missing-effect"] else "good"


def _lead(s: Survey) -> list[str]:
    x = s.summary
    said = []
    for a in x.advice:
        if a.firm:
            text = advised(a, len(s.done))
            said.append(f"Recommended: {text}.")
    chance = [a for a in x.advice if not a.firm]
    if chance:
        names = numbers.listed([f"{a.effect} ({len(a.flights)})" for a in chance])
        said.append(f"Found in so few flights that it may be chance: {names}.")
    m = x.median
    if m["calibrated"] is not None and m["after"] is not None and m["noise_floor"] is not None:
        said.append(
            f"Median error of a flight: {numbers.number(m['calibrated'])} Eo as the model is,"
            f" {numbers.number(m['after'])} Eo with the effects found in it; noise {numbers.number(m['noise_floor'])} Eo."
        )
    if s.failed:
        said.append("Flights in error are listed below; they do not affect the others.")
    return said


def _facts(s: Survey) -> list[tuple[str, str]]:
    if not s.done:
        return []
    total = sum(r["duration_s"] for r in s.done)
    return [
        ("flights", f"{len(s.done)} diagnosed, each by itself, of {len(s.records)}"),
        ("flying time", numbers.seconds(float(total))),
    ]


def _figures(s: Survey) -> list[dict[str, str]]:
    if not s.done:
        return []
    before, after = (
        np.array([r["error"][k]["rms_Eo"] for r in s.done], dtype=float) for k in ("calibrated", "after")
    )
    noise = np.array([r["noise_floor"]["rms_Eo"] for r in s.done])
    strange = np.array([r["verdict"] == "unexplained" for r in s.done])
    names = [str(r["flight"]) for r in s.done]
    caption = (
        "Error before demodulation of every flight, calibrated by itself: as the model is, and with the effects"
        " that were found in this flight. Dashed: the flight’s noise."
    )
    return [{"svg": errors(names, before, after, noise, strange), "caption": caption}]


def _row(number: int, r: Mapping[str, Any]) -> dict[str, Any]:
    errors = [(r["error"][k] or {}).get("rms_Eo") for k in ("nominal", "calibrated", "holdout", "after")]
    indistinguishable = [f"{e}: or {', '.join(o)}" for e, o in r["indistinguishable"].items() if o]
    return {
        "number": number,
        "name": r["flight"],
        "verdict": r["verdict"],
        "found": ", ".join(r["found"]),
        "indistinguishable": "; ".join(indistinguishable),
        "first": "" if not r["ranking"] else r["ranking"][0]["effect"],
        "errors": [*errors, r["noise_floor"]["rms_Eo"]],
        "notes": r["notes"],
    }


def _trend(t: Trend) -> dict[str, Any]:
    std = min(s for s in t.stds if s is not None)
    return {
        "label": t.label,
        "unit": numbers.unit(t.unit),
        "count": t.dof + 1,
        "mean": numbers.rounded(t.mean, std),
        "scatter": numbers.number(t.scatter, 2),
        "chi2": numbers.number(t.chi2 / t.dof, 2),
        "slope": numbers.number(t.slope_z, 2),
        "varies": t.varies,
    }


def _by_flight(s: Survey) -> dict[str, Any] | None:
    """The least constant parameters by flights, with a figure."""
    shown = s.summary.trends[:TABLED]
    if not shown:
        return None
    drawn = s.summary.trends[:DRAWN]
    names = list(s.summary.names)
    caption = (
        "The least constant of the calibrated parameters over the flights, less their mean, with one standard"
        " deviation."
    )
    rows = []
    for n, flight in enumerate(names):
        cells = [
            "" if v is None or std is None else numbers.plus_minus(v, std)
            for v, std in ((t.values[n], t.stds[n]) for t in shown)
        ]
        rows.append((flight, cells))
    return {
        "figure": page.figure(trends(names, drawn), caption),
        "heads": [(t.label, numbers.unit(t.unit)) for t in shown],
        "rows": rows,
    }


Array = NDArray[np.float64]

NAMED = 24
"""Flights up to which each one's name stands at the axis."""


def errors(
    flights: Sequence[str], before: Array, after: Array, noise: Array, unexplained: NDArray[np.bool_]
) -> str:
    """Calibrated error of every flight, Eo: before, after and noise floor, (N,) each; ``unexplained``: (N,) bool."""
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
