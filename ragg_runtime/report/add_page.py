"""The report of ``ragg add``: the loop at a glance, the error after every step, and what is still left."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ragg_runtime.identification import budget, series
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.parameters import calibrated
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.report import diagnose_page, figures, page, panels, parameters
from ragg_runtime.report.figures import Step
from ragg_runtime.report.page import Origin
from ragg_runtime.wording import notebook, numbers

CHANGED = 0.005
"""Share of the error by which it must change to be said to fall or to rise: the figures have three digits."""

OTHER = 0.02
"""Share by which the error at the start of a step may differ from that at the end of the one before, on the same flights."""

STEPS = 14
"""Latest steps of a history that are drawn."""


def add_html(
    history: Sequence[Mapping[str, Any]],
    before: Comparison,
    after: Comparison,
    diagnosis: Diagnosis | None = None,
    *,
    title: str,
    command: str,
    sources: Sequence[tuple[str, str]],
    notes: Sequence[str] = (),
) -> str:
    """The report as one HTML document. ``history`` is all of history.json, this step the last; ``before`` and ``after``
    are the model without and with the effect, each calibrated on the flights.
    """
    f = after.fitted
    context: dict[str, Any] = {
        "kind": "The model, step by step",
        "state": "good" if after.adequate else "found",
        "headline": headline(before, after),
        "lead": lead(before, after),
        "facts": panels.facts(f),
        "errors": errors(before, after),
        "history": _history_table(history),
        "loop": _loop(history, after),
        "sections": [*_sections(before, after), panels.demodulated_panel(f, after.residual, before.residual)],
        "ranking": diagnose_page.ranking(diagnosis) if diagnosis else [],
        "evidence": diagnose_page.evidence(diagnosis, "evidence") if diagnosis else None,
        "budget": _budget(after),
        "headlines": [(e.id, diagnose_page.headlines(*calibrated(f, e.id))) for e in f.model.effects],
        "effects": [r for r in parameters.by_accelerometer(f) if "." in r.symbol.name],
        "combined": [r for r in parameters.by_combination(f) if "." in r.symbol.name],
        "patterns": [name for name, _ in parameters.PATTERNS],
        "still": _still(after),
        "digest": f.model.digest,
    }
    return page.render("add.html.j2", Origin(title, command, sources, notes), context)


def _done(before: Comparison, after: Comparison) -> str:
    """In what two models differ, whatever step led from one to the other."""
    old, new = ([numbers.clean(e.id) for e in c.fitted.model.effects] for c in (before, after))
    added, removed = [e for e in new if e not in old], [e for e in old if e not in new]
    said = [f"{numbers.listed(x)} {how}" for x, how in ((added, "added"), (removed, "removed")) if x]
    return " and ".join(said) or "the test sheet changed"


def headline(before: Comparison, after: Comparison) -> str:
    """What was done and what it did to the error."""
    a, b, n = (
        numbers.number(x) for x in (before.calibrated.rms_Eo, after.calibrated.rms_Eo, after.noise_floor)
    )
    if after.complaint is not None:
        return f"Nothing was added: {numbers.clean(after.complaint)}."
    fell = after.calibrated.rms_Eo < (1.0 - CHANGED) * before.calibrated.rms_Eo
    rose = after.calibrated.rms_Eo > (1.0 + CHANGED) * before.calibrated.rms_Eo
    moved = f"the error falls from {a} to {b} Eo" if fell else f"the error stays {b} Eo"
    if rose:
        moved = f"the error rises from {a} to {b} Eo"
    end = "nothing but noise is left" if after.adequate else "the model is still not adequate"
    return f"With {_done(before, after)}, {moved}; the noise is {n} Eo, and {end}."


def lead(before: Comparison, after: Comparison) -> list[str]:
    said = [
        f"Inline {numbers.number(before.calibrated.inline_Eo_per_rtHz)} → {numbers.number(after.calibrated.inline_Eo_per_rtHz)},"
        f" cross {numbers.number(before.calibrated.cross_Eo_per_rtHz)} → {numbers.number(after.calibrated.cross_Eo_per_rtHz)}"
        f" Eo/√Hz; held out {numbers.number(before.holdout.rms_Eo)} → {numbers.number(after.holdout.rms_Eo)} Eo."
    ]
    if after.holdout.rms_Eo > before.holdout.rms_Eo:
        said.append("On held-out time the error does not fall: the step is not confirmed by this record.")
    return said


def errors(before: Comparison, after: Comparison) -> list[dict[str, Any]]:
    """Rows of the table of errors."""
    return [
        panels.error_row("before", before.calibrated, "calibrated"),
        panels.error_row("before, held out", before.holdout),
        panels.error_row("after", after.calibrated, "calibrated"),
        panels.error_row("after, held out", after.holdout),
        panels.noise_row(after.fitted, after.noise_floor),
    ]


def _value(entry: Mapping[str, Any] | None, which: str) -> float:
    rms = notebook.rms_of(entry, which)
    return float("nan") if rms is None else rms


def _steps(history: Sequence[Mapping[str, Any]]) -> list[Step]:
    steps: list[Step] = []
    last = float("nan")
    for entry in history:
        start, end = _value(entry.get("before"), "calibrated"), _value(entry.get("after"), "calibrated")
        if start == start and not abs(start - last) <= OTHER * start:
            label = "as it was" if not steps else "same model,\nother flights"
            steps.append(Step(label, start, _value(entry.get("before"), "holdout"), strong=False))
        sign = {"add": "+", "remove": numbers.MINUS}.get(str(entry.get("action", "")), "")
        label = f"{sign} {entry.get('effect') or entry.get('action', '')}".strip()
        if end == end:
            steps.append(Step(label, end, _value(entry.get("after"), "holdout")))
            last = end
    return steps[-STEPS:]


def _loop(history: Sequence[Mapping[str, Any]], after: Comparison) -> dict[str, Any] | None:
    steps = _steps(history)
    if not steps:
        return None
    svg = figures.loop(steps, after.noise_floor, "loop", "error after every step")
    caption = (
        "Calibrated error before demodulation after every step, and the noise floor of the present flights."
    )
    return page.figure(svg, caption)


def _history_table(history: Sequence[Mapping[str, Any]]) -> list[dict[str, str]]:
    return [
        {
            "time": str(h.get("time", "")),
            "action": str(h.get("action", "")),
            "effect": str(h.get("effect") or "–"),
            "before": numbers.number(_value(h.get("before"), "calibrated")),
            "after": numbers.number(_value(h.get("after"), "calibrated")),
            "holdout": numbers.number(_value(h.get("after"), "holdout")),
        }
        for h in history
    ]


def _sections(before: Comparison, after: Comparison) -> list[dict[str, Any]]:
    f = after.fitted
    chosen = series.worst(before.fitted, before.residual, panels.FLIGHTS)
    lines = [(figures.BEFORE, before.residual), (figures.AFTER, after.residual)]
    drawn = []
    if spectra := panels.spectrum_panels(f, lines, chosen):
        svg = figures.spectra(spectra, "spectrum", "spectrum of the residual before and after")
        caption = "Amplitude density of the residual before and after. Dotted: multiples of the spin rate."
        drawn.append(page.figure(svg, caption))
    svg = figures.in_time(panels.time_panels(f, lines, chosen), "time", "residual over time")
    drawn.append(
        page.figure(svg, "Residual after this step, and error in 24 blocks of time before and after it.")
    )
    return [
        {"title": "The residual before and after", "text": [], "figures": drawn},
        panels.measured_section(f, after.residual),
    ]


def _budget(after: Comparison) -> dict[str, Any]:
    rows = budget.contributions(after.fitted)
    svg = figures.budget(rows, after.noise_floor, "budget", "what each group of parameters contributes")
    caption = (
        "What each group of calibrated parameters contributes to the output: the change when it is put to zero"
        " and all else stays. Bars: rms before demodulation; marks: standard deviation in the channels. Dark:"
        " added effects."
    )
    table = [
        {
            "label": r.label,
            "rms": numbers.number(r.rms),
            "inline": numbers.number(r.inline),
            "cross": numbers.number(r.cross),
            "strong": r.strong,
        }
        for r in rows
    ]
    return {"figure": page.figure(svg, caption), "rows": table}


def _still(after: Comparison) -> dict[str, Any]:
    rows = panels.terms(after.terms(), after.calibrated.rms_Eo)
    text = "No motion term stands out of what is left." if not rows else ""
    return {"text": text, "terms": rows, "figures": page.figures(panels.where_it_fails(after, "still"))}
