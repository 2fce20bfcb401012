"""The report of ``ragg qc``, and what it says in the terminal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ragg_runtime.base import false_alarms
from ragg_runtime.report import page, quality_charts, quality_galileo
from ragg_runtime.report.page import Origin
from ragg_runtime.survey.quality.by_line import IN_BAND, LineFigures
from ragg_runtime.survey.quality.qc import Quality
from ragg_runtime.survey.quality.trends import Day, Dependence
from ragg_runtime.wording import numbers

STEPPED = 5.0
"""Standard deviations of a step from day to day from which on it is pointed out."""

_ARRANGED = {
    "orthogonal": "three discs whose in-line channels add up to the trace, which is zero",
    "complements": "two complements that measure the same",
    "single": "without complements or a third disc: gravity and noise cannot be separated",
}


def quality_html(q: Quality, *, title: str, command: str) -> str:
    """The report as one HTML document."""
    context: dict[str, Any] = {
        "kind": "Quality control",
        "facts": _facts(q),
        "errors": [],
        "digest": "none: quality control needs no model",
        "figures": page.figures(_figures(q)),
        "misfits": q.misfits,
        "repeats": [(r.first, r.second, r.shared / 1e3, list(r.noise.values())) for r in q.repeats],
        "repeated": list(q.repeats[0].noise) if q.repeats else [],
        "dependences": [_dependence(d) for d in q.dependences],
        "days": [_day(d) for d in q.days],
        "galileo": quality_galileo.tables(q),
        "band": f"{IN_BAND[0]:g} to {IN_BAND[1]:g} Hz",
    }
    return page.render(
        "quality.html.j2", Origin(title, command, q.read.files, q.read.notes), context | shown(q)
    )


def shown(q: Quality) -> dict[str, Any]:
    """Verdict, limits and the table by line, in words and digits: of the report and of the studio."""
    return {
        "state": "bad" if q.failed or q.read.refused or q.lacking else "good",
        "headline": headline(q),
        "lead": lead(q),
        "limits": [_limit(q, n) for n in range(len(q.used))],
        "heads": _heads(q),
        "rows": [_row(q, n, f) for n, f in enumerate(q.lines)],
        "refused": [(n, m.split("\n")) for n, m in q.read.refused],
    }


def headline(q: Quality) -> str:
    lines = "1 line" if len(q.lines) == 1 else f"{len(q.lines)} lines"
    wrong = sum(bool(f.failed) for f in q.lines)
    refused = f", {len(q.read.refused)} could not be used" if q.read.refused else ""
    if not q.used:
        return f"{lines}{refused}; the record gives no figure that has a limit."
    lacking = f", {q.lacking} too incomplete for every figure" if q.lacking else ""
    return f"{lines}{refused}{lacking}, {wrong or 'none'} beyond a limit."


def lead(q: Quality) -> list[str]:
    """The survey in sentences."""
    discs = [d for d in q.discs.names if d]
    said = [(f"Discs {', '.join(discs)}: " if discs else "One disc, ") + _ARRANGED[q.discs.arrangement] + "."]
    for name in q.names("noise"):
        noise, density = q.median("noise", name), q.median("densities", name)
        said.append(
            f"Median {name}: {numbers.number(noise)} Eo a line, {numbers.number(density)} Eo/√Hz in the band."
        )
    for name, count in q.failed.items():
        limit = q.limits[name]
        said.append(f"{name}: {count} of {len(q.lines)} lines above {limit.value:g} {limit.unit}.")
    for d in q.dependences:
        if d.p_value < false_alarms.QUALITY:
            said.append(f"The {d.of} depends on {d.on}: {numbers.plus_minus(d.slope, d.std)} {d.unit}.")
    steps = [d for d in q.days if d.step is not None and d.step_std and abs(d.step) > STEPPED * d.step_std]
    if steps:
        worst = max(steps, key=lambda d: abs(d.step or 0.0))
        said.append(
            f"Levels jump between days ({len(steps)} jumps, the largest {numbers.number(worst.step)} Eo in {worst.channel}):"
            " level the lines before the channels are used."
        )
    return said


def quality_text(q: Quality) -> str:
    """What the terminal shows: the sentences, then a table of the lines."""
    heads = [h[0] for h in _heads(q)]
    rows = [[str(c) for c in r["cells"]] for r in (_row(q, n, f) for n, f in enumerate(q.lines))]
    table = [
        ["line", *heads],
        *[[numbers.short(f.line.name), *cells] for f, cells in zip(q.lines, rows, strict=True)],
    ]
    widths = [max(len(r[k]) for r in table) for k in range(len(table[0]))]
    lines = [
        "  ".join(c.rjust(w) if k else c.ljust(w) for k, (c, w) in enumerate(zip(r, widths, strict=True)))
        for r in table
    ]
    marks = ["", *(f"  {', '.join(f.failed)}" if f.failed else "" for f in q.lines)]
    shown = [line + mark for line, mark in zip(lines, marks, strict=True)]
    refused = [f"{numbers.short(n)}: {m}" for n, m in q.read.refused]
    notes = [f"note: {n}" for n in q.read.notes]
    text = "\n".join([headline(q), *lead(q), "", *shown, *refused, *notes])
    return text.replace(numbers.THIN, " ")  # a terminal shows thin spaces as it likes


def _facts(q: Quality) -> list[tuple[str, str]]:
    seconds = sum(len(f.line) / f.line.rate for f in q.lines)
    metres = sum(f.track.length for f in q.lines if f.track is not None)
    found = [("lines", str(len(q.lines))), ("flying time on lines", numbers.seconds(seconds))]
    if metres:
        found.append(("length of lines", f"{numbers.number(metres / 1e3)} km"))
    made = next((f.rough.made_of for f in q.lines if f.rough is not None), None)
    if made is not None:
        found.append(("turbulence", made))
    return found


def _figures(q: Quality) -> list[Mapping[str, str]]:
    drawn = (
        (
            quality_charts.maps(q),
            "The lines, coloured by the noise along them; and by how much they differ where they cross, after one constant for each line.",
        ),
        (
            quality_charts.turbulent(q),
            "Noise of every line against its turbulence. Points above the trend deserve a look.",
        ),
        (
            quality_charts.densities(q),
            "Noise density: the median of the lines, and what 80 % of them lie in.",
        ),
        (
            quality_charts.levels(q),
            "Mean of every channel on each line, in the order of flight. Dashed: a new day.",
        ),
    )
    return [{"svg": svg, "caption": caption} for svg, caption in drawn if svg is not None]


def _heads(q: Quality) -> list[tuple[str, str]]:
    """(head, unit) of the columns of the table by line."""
    found = [("length", "km"), ("heading", "°"), ("turbulence", "m/s²")]
    found += [(n, "Eo") for n in q.names("noise")]
    found += [(f"density {n}", "Eo/√Hz") for n in q.names("densities")]
    if any(f.phase for f in q.lines):
        found.append(("phase", "°"))
    named = [x.name for x in q.used if x.name.startswith("high") or x.name in ("lag", "frobenius")]
    return found + [("high frequency" if n.startswith("high") else n, q.limits[n].unit) for n in named]


def _row(q: Quality, number: int, f: LineFigures) -> dict[str, Any]:
    cells: list[float | None] = [
        None if f.track is None else f.track.length / 1e3,
        None if f.track is None else float(np.degrees(f.track.direction)),
        None if f.rough is None else f.rough.size,
    ]
    cells += [f.noise.get(n) for n in q.names("noise")]
    cells += [f.densities.get(n) for n in q.names("densities")]
    if any(x.phase for x in q.lines):
        cells.append(None if f.phase is None else float(np.degrees(f.phase[0])))
    named = [x.name for x in q.used if x.name.startswith("high") or x.name in ("lag", "frobenius")]
    cells += [f.figures.get(n) for n in named]
    return {
        "number": number,
        "name": f.line.name,
        "file": f.line.flight,
        "cells": [numbers.number(c) if k != 1 else _degrees(c) for k, c in enumerate(cells)],
        "failed": ", ".join(f.failed),
        "missing": f.line.missing,
    }


def _degrees(x: float | None) -> str:
    return numbers.ABSENT if x is None else f"{round(x) % 360:d}"


def _limit(q: Quality, number: int) -> dict[str, Any]:
    x = q.used[number]
    worst = max((f.figures[x.name] for f in q.lines if x.name in f.figures), default=None)
    return {
        "name": x.name,
        "what": x.what,
        "value": numbers.with_unit(f"{x.value:g}", x.unit),
        "median": numbers.number(q.median("figures", x.name)),
        "worst": numbers.number(worst),
        "failed": q.failed.get(x.name, 0),
        "source": x.source,
    }


def _dependence(d: Dependence) -> dict[str, Any]:
    return {
        "of": d.of,
        "on": d.on,
        "slope": numbers.plus_minus(d.slope, d.std),
        "unit": d.unit,
        "p": numbers.number(d.p_value, 2),
        "sure": d.p_value < false_alarms.QUALITY,
    }


def _day(d: Day) -> dict[str, Any]:
    def both(value: float | None, std: float | None) -> str:
        return "" if value is None else numbers.plus_minus(value, std or float("nan"))

    jumped = d.step is not None and d.step_std is not None and abs(d.step) > STEPPED * d.step_std
    cells: Sequence[str] = (both(d.level, d.std), both(d.step, d.step_std), both(d.drift, d.drift_std))
    return {"name": d.name, "channel": d.channel, "lines": d.lines, "cells": cells, "jumped": jumped}
