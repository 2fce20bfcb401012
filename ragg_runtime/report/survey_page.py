"""The report of ``ragg survey``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from ragg_runtime.report import page, survey_charts
from ragg_runtime.report.page import Origin
from ragg_runtime.survey.result import Survey, advised, counted
from ragg_runtime.survey.summary import Trend
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
        np.array([_nan(r["error"][k]["rms_Eo"]) for r in s.done]) for k in ("calibrated", "after")
    )
    noise = np.array([r["noise_floor"]["rms_Eo"] for r in s.done])
    strange = np.array([r["verdict"] == "unexplained" for r in s.done])
    names = [str(r["flight"]) for r in s.done]
    caption = (
        "Error before demodulation of every flight, calibrated by itself: as the model is, and with the effects"
        " that were found in this flight. Dashed: the flight’s noise."
    )
    return [{"svg": survey_charts.errors(names, before, after, noise, strange), "caption": caption}]


def _nan(x: float | None) -> float:
    return float("nan") if x is None else x


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
        "figure": page.figure(survey_charts.trends(names, drawn), caption),
        "heads": [(t.label, numbers.unit(t.unit)) for t in shown],
        "rows": rows,
    }
