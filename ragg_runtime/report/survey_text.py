"""A survey in words, for the terminal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ragg_runtime.survey.result import Survey, Trend, counted, recommended
from ragg_runtime.wording.numbers import clean

SHOWN = 12
"""Parameters of which the behaviour over the flights is printed."""

WIDTH = 28
"""Longest name of a flight that is printed whole."""


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
