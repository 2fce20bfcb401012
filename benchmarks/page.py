"""Rows as text and as the page of the documentation, with the change since the last committed run."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

from benchmarks import Row

WORSE = 1.25
"""A ratio that is worse by this factor is marked: less is within what a shared machine does to it."""


def changes(rows: Sequence[Row], last: Mapping[str, float]) -> dict[str, str]:
    """Row -> change of its ratio since the last committed run, in words."""
    found = {}
    for r in rows:
        before = last.get(r.name)
        if not r.ratio or not before or not r.value:
            continue
        factor = r.value / before
        worse = {"lower": factor, "higher": 1 / factor}.get(r.better or "", 1.0)
        found[r.name] = f"{100 * (factor - 1):+.0f} %" + (" WORSE" if worse > WORSE else "")
    return found


def number(value: float) -> str:
    """Three digits, without an exponent where that can be helped."""
    if not math.isfinite(value) or value == 0:
        return str(value)
    digits = max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{value:,.{digits}f}" if digits <= 8 else f"{value:.2e}"


def _spread(r: Row) -> str:
    return "" if r.low is None or r.high is None else f"{number(r.low)} ... {number(r.high)}"


def _target(r: Row) -> str:
    return f"{r.target or ''}{'' if r.met is None else ': met' if r.met else ': not met'}"


def text(rows: Sequence[Row], change: Mapping[str, str]) -> str:
    """Rows as lines for a terminal."""
    width = max((len(r.name) for r in rows), default=0)
    lines = []
    for r in rows:
        extra = "; ".join(p for p in (_spread(r), r.note, _target(r), change.get(r.name, "")) if p)
        lines.append(f"  {r.name:<{width}}  {number(r.value):>10} {r.unit:<9} {extra}".rstrip())
    return "\n".join(lines)


def page(everything: Mapping[str, Any], titles: Mapping[str, str], last: Mapping[str, Any]) -> str:
    """docs/benchmarks.md."""
    machine = everything["machine"]
    lines = [
        "# Benchmarks",
        "",
        "Written by `make bench` (all of them, 10 to 20 minutes; numbers also in `build/bench.json`).",
        "One alone: `python -m benchmarks NAME`. Medians, with lower and upper quartile; rivals are timed in",
        "turn with us, in one process, and ratios are taken round by round. The last column is the change of a ratio",
        "since the last run that was committed (`benchmarks/last.json`, renewed by `python -m benchmarks --keep`).",
        "",
        "Machine: " + "; ".join(f"{k} {v}" for k, v in machine.items()) + ".",
        "",
    ]
    for name, result in everything["results"].items():
        lines += _section(name, result, titles, last)
    return "\n".join(lines)


def renewed(old: str, results: Mapping[str, Any], titles: Mapping[str, str], last: Mapping[str, Any]) -> str:
    """The page with the tables of some benchmarks measured anew; everything else stays as it is."""
    head, *parts = re.split(r"^(?=## )", old if old.endswith("\n") else old + "\n", flags=re.MULTILINE)
    known = {part.splitlines()[0].removeprefix("## "): part for part in parts}
    made = {name: "\n".join(_section(name, r, titles, last)) for name, r in results.items()}
    known |= {name: text.rstrip("\n") + "\n\n" for name, text in made.items()}
    return (head + "".join(known[name] for name in sorted(known))).rstrip("\n") + "\n"


def _section(
    name: str, result: Mapping[str, Any], titles: Mapping[str, str], last: Mapping[str, Any]
) -> list[str]:
    rows = [Row(**r) for r in result["rows"]]
    change = changes(rows, last.get(name, {}))
    head = [f"## {name}", "", titles.get(name, ""), ""]
    if "failed" in result:
        return [*head, f"Failed: {result['failed']}.", ""]
    return [
        *head,
        "| what | value | spread | target | note | change |",
        "|---|---:|---|---|---|---|",
        *(
            f"| {r.name} | {number(r.value)} {r.unit} | {_spread(r)} | {_target(r)} | {r.note} "
            f"| {change.get(r.name, '')} |"
            for r in rows
        ),
        "",
        f"{result['seconds']} s in all, load of the machine at the end {result['load']}.",
        "",
    ]
