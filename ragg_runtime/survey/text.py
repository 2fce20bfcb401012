"""A survey in words, for the terminal."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ragg_runtime.report.words import clean
from ragg_runtime.survey.run import Survey
from ragg_runtime.survey.summary import Advice, Trend

SHOWN = 12
"""Parameters of which the behaviour over the flights is printed."""

WIDTH = 28
"""Longest name of a flight that is printed whole."""

_VERDICTS = {
    "adequate": "adequate",
    "missing-effect": "missing an effect",
    "unexplained": "unexplained",
    "error": "in error",
}


def counted(counts: Mapping[str, int]) -> str:
    """The verdicts in one line: ``12 flights: 8 adequate, 4 missing an effect``."""
    total = sum(counts.values())
    said = ", ".join(f"{counts[k]} {text}" for k, text in _VERDICTS.items() if counts[k])
    return f"{total} flight{'' if total == 1 else 's'}: {said}"


def surveyed(s: Survey, model_dir: Path | str) -> str:
    """The result of ``survey``."""
    x = s.summary
    lines = [counted(x.counts)]
    if s.done:
        lines += ["", _head(), *map(_row, s.done), "", *_effects(s)]
    if x.terms:
        lines += ["", "what no effect explains (harmonic x motion term, flights):"]
        lines += [f"  {h:6} {t:28} {n:5}" for h, t, n in x.terms[:8]]
    if x.trends:
        lines += ["", *_trends(x.trends)]
    if s.failed:
        lines += ["", "flights in error (the others are not affected):"]
        lines += [_failed(r) for r in s.failed]
    lines += ["", *recommended(s, model_dir)]
    return "\n".join(lines)


def _head() -> str:
    heads = "".join(f" {h:>10}" for h in ("nominal", "calibrated", "held out", "after", "noise"))
    return f"  {'flight':{WIDTH}} {'verdict':14}{heads} Eo  found"


def _row(r: Mapping[str, Any]) -> str:
    errors = [(r["error"][k] or {}).get("rms_Eo") for k in ("nominal", "calibrated", "holdout", "after")]
    values = "".join(
        f" {'-':>10}" if v is None else f" {v:10.4g}" for v in (*errors, r["noise_floor"]["rms_Eo"])
    )
    return f"  {name(r):{WIDTH}} {r['verdict']:14}{values}     {' '.join(r['found'])}".rstrip()


def name(r: Mapping[str, Any]) -> str:
    """A flight's name as far as it fits, its ending rather than its beginning left out."""
    text = clean(str(r["flight"]))
    return text if len(text) <= WIDTH else f"{text[: WIDTH - 3]}..."


def _effects(s: Survey) -> list[str]:
    if not s.summary.effects:
        return ["no effect was found in any flight"]
    lines = [f"  {'effect':{WIDTH}} {'found':>6} {'perhaps':>8} {'testable':>9}"]
    lines += [f"  {e.effect:{WIDTH}} {e.found:6} {e.perhaps:8} {e.testable:9}" for e in s.summary.effects]
    return lines


def _trends(trends: Sequence[Trend]) -> list[str]:
    varying = [t for t in trends if t.varies]
    said = f"{len(varying)} of {len(trends)} calibrated parameters differ from flight to flight"
    lines = [
        f"{said}; the least constant ones:",
        f"  {'parameter':58} {'flights':>7} {'mean':>12} {'scatter':>10} {'chi2/dof':>9} {'slope/sd':>9}",
    ]
    for t in trends[:SHOWN]:
        slope = f"{t.slope_z:+9.1f}" if t.slope_z is not None else f"{'-':>9}"
        label = t.label if len(t.label) <= 58 else t.label[:55] + "..."
        lines.append(
            f"  {label:58} {t.dof + 1:7} {t.mean:12.5g} {t.scatter:10.3g} {t.chi2 / t.dof:9.3g} {slope} {t.unit}"
        )
    return lines


def _failed(r: Mapping[str, Any]) -> str:
    first, *rest = clean(str(r["error"]["message"])).split("\n")
    return "\n".join([f"  {name(r)}: {first}", *(f"    {line.strip()}" for line in rest)])


def recommended(s: Survey, model_dir: Path | str) -> list[str]:
    """What to do next, in sentences."""
    x = s.summary
    lines = []
    for a in x.advice:
        if a.firm:
            lines.append(f"recommended: {advised(a, len(s.done))}")
    chance = [a for a in x.advice if not a.firm]
    if chance:
        names = ", ".join(f"{a.effect} ({len(a.flights)})" for a in chance)
        lines.append(f"in so few flights that it may be chance: {names}")
    firm = [a for a in x.advice if a.firm]
    if firm:
        files = [_place(r) for r in s.done if r["flight"] in firm[0].flights]
        more = " ..." if len(files) > 3 else ""
        lines.append(f"next: ragg add {model_dir} {firm[0].effect} {' '.join(files[:3])}{more}")
    elif not x.advice and s.done and not x.counts["unexplained"]:
        lines.append("The model is adequate for every flight that was diagnosed.")
    if x.counts["unexplained"]:
        lines.append(
            f"{x.counts['unexplained']} flight(s) show something that no known effect explains: ragg diagnose them"
        )
    if not s.done:
        lines.append("No flight could be diagnosed.")
    return lines


def advised(a: Advice, done: int) -> str:
    """An advice in one sentence."""
    other = f" (or {', '.join(a.alternatives)}: these flights cannot tell)" if a.alternatives else ""
    return f"add {a.effect}, which {len(a.flights)} of {done} flights ask for{other}"


def _place(r: Mapping[str, Any]) -> str:
    """Where a flight is, from here if it is below, as a shell wants it."""
    path = Path(r["file"])
    below = path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path
    return shlex.quote(clean(str(below)))
