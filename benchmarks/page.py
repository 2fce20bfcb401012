"""Rows as text and as the page of the documentation."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from benchmarks import Row


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


def text(rows: Sequence[Row]) -> str:
    """Rows as lines for a terminal."""
    width = max((len(r.name) for r in rows), default=0)
    lines = []
    for r in rows:
        extra = "; ".join(p for p in (_spread(r), r.note, _target(r)) if p)
        lines.append(f"  {r.name:<{width}}  {number(r.value):>10} {r.unit:<9} {extra}".rstrip())
    return "\n".join(lines)


def page(everything: Mapping[str, Any], titles: Mapping[str, str]) -> str:
    """docs/benchmarks.md: values and targets; spreads and notes are in the JSON."""
    lines = [
        "# Benchmarks",
        "",
        "Written by `make bench` (10 to 20 minutes; spreads and notes in `build/bench.json`); one alone: `python -m benchmarks NAME`.",
        "Medians; rivals are timed in turn with ours, in one process, and ratios are taken round by round.",
        "",
        "Machine: " + "; ".join(f"{k} {v}" for k, v in everything["machine"].items()) + ".",
        "",
    ]
    for name, result in everything["results"].items():
        lines += [f"## {name}", "", titles.get(name, ""), ""]
        if "failed" in result:
            lines += [f"Failed: {result['failed']}.", ""]
            continue
        lines += ["| what | value | target |", "|---|---:|---|"]
        lines += [
            f"| {r.name} | {number(r.value)} {r.unit} | {_target(r)} |"
            for r in (Row(**x) for x in result["rows"])
        ]
        lines += [""]
    return "\n".join(lines)
