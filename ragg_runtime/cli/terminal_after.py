"""Results of what comes after a model in words, for the terminal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ragg_runtime.cli.terminal import command, compared, errors_table
from ragg_runtime.flight import Flight
from ragg_runtime.report.held import Held
from ragg_runtime.wording import notebook
from ragg_runtime.workflow.after import Compensation, Kept
from ragg_runtime.workflow.online import Watched

MOVED = 3.0
"""Standard deviations from which a combination is shown as moved."""


def calibrated(k: Kept, flights: Sequence[Flight]) -> str:
    """The result of ``calibrate``."""
    c = k.calibrated
    seen, of = c.directions
    found: dict[str, Any] = k.as_json()
    floor = found["noise_floor"]["rms_Eo"]
    rows = (("nominal", c.nominal), ("calibrated", c.error), ("held out", c.holdout))
    lines = [
        f"{', '.join(x.name for x in flights)}: {c.fitted.calibration.rows} samples, effects in the model: "
        f"{', '.join(found['effects']) or 'none'}",
        *errors_table(rows, floor, flights, c.fitted),
        "" if c.converged else "\nThe fit has NOT converged: do not rely on these values.",
        f"the record determines {seen} of {of} directions of the parameters; the sheet alone says the others:",
        *(f"  {notebook.parameter({'accelerometer': None, **q})}" for q in found["combinations"]),
    ]
    if found["drift"]:
        lines.append("\neach flight alone:")
        lines += [
            f"  {q['flight']:28} {q['name']} = {q['value']:.4g} +- {q['std']:.2g} {q['unit']}"
            for q in found["drift"]
        ]
    if k.saved:
        d = k.loaded.directory.path
        use = f"{command('compensate', d, flights)} -o compensated.csv --calibration frozen"
        lines += ["", f"kept in {d}; use it with: {use}"]
    lines += [f"note: {note}" for x in flights for note in x.notes]
    return "\n".join(lines)


def held(h: Held, flights: Sequence[Flight], model_dir: Path, mapping: Path | None = None) -> str:
    """The result of ``compare --frozen``."""
    rows = sorted(h.drift(), key=lambda r: -abs(r["z"]))
    moved = [r for r in rows if abs(r["z"]) > MOVED]
    errors = (("nominal", h.comparison.nominal), ("frozen", h.comparison.calibrated), ("free", h.free))
    lines = [
        compared(h.comparison, flights, model_dir, mapping, errors, judged=h.holds),
        "",
        h.in_words(),
    ]
    if moved:
        lines.append("what moved since (frozen, now):")
        lines += [
            f"  {r['flight']:24} {r['name']}: {r['frozen']:.5g} -> {r['value']:.5g} {r['unit']}, {r['z']:+.1f} sigma"
            for r in moved
        ]
    suspects = h.suspects()
    if suspects:
        lines.append("the change of one parameter that would explain it, and how much of it:")
        lines += [
            f"  {x['name']:32} {x['change']:+.4g} {x['unit']}   {100 * x['share']:.1f} %" for x in suspects
        ]
    if not h.holds:
        again = command("calibrate", model_dir, flights, mapping)
        lines += ["", f"next, if the instrument may have changed so: {again} --save"]
    return "\n".join(lines)


def watched(w: Watched, output: Path, flights: Sequence[Flight]) -> str:
    """The result of ``online``."""
    r = w.as_json()
    within = r["follows_within_s"]
    lines = [
        f"{output}: sample by sample from the {r['started']}, noise {r['noise_Eo_per_rtHz']:.3g} Eo/sqrt(Hz)",
        f"the gradient wanders by {r['walk_Eo_per_rts']:.3g} Eo/sqrt(s)"
        + ("" if within is None else f" and is followed within {within:.3g} s")
        + "; the parameters "
        + ("forget nothing" if r["forget_s"] is None else f"forget within {r['forget_s']:.3g} s"),
    ]
    lines += [f"{x['flight']}: {x['samples']} samples" for x in r["flights"]]
    lines += [f"note: {note}" for x in flights for note in x.notes]
    return "\n".join(lines)


CONTRIBUTIONS = 8
"""Contributions that are listed, the largest."""


def compensated(c: Compensation, output: Path, flights: Sequence[Flight]) -> str:
    """The result of ``compensate``."""
    r = c.as_json()
    d = r["demodulator"]
    lag = f", {d['latency_s']:.3g} s late" if d["latency_s"] else ""
    lines = [f"{output}: calibration {r['calibration']}, {d['what']}{lag}"]
    if not r["converged"]:
        lines.append("The calibration has NOT converged: do not rely on these values.")
    lines += [f"note: {text}" for text in r.get("notes", ())]
    for x in r["flights"]:
        lines += ["", f"{x['flight']}{_output(x, r)}: {x['good']} of {x['samples']} samples good"]
        lines.append(
            f"  {'':8} {'before':>12} {'after':>10} {'noise':>10} Eo/rtHz   std by noise, parameters, Eo"
        )
        for channel in ("inline", "cross"):
            numbers = [x["density"][k][f"{channel}_Eo_per_rtHz"] for k in ("before", "after", "noise")]
            sizes = [x["std"][k][f"{channel}_Eo"] for k in ("noise", "parameters")]
            a, b, n, s, p = (notebook.number(v) for v in (*numbers, *sizes))
            lines.append(f"  {channel:8} {a:>12} {b:>10} {n:>10} {'':9} {s:>10} {p:>10}")
        lines.append("  removed (rms inline, cross, Eo):")
        lines += [
            f"    {q['of']:28} {q['inline_Eo']:10.4g} {q['cross_Eo']:10.4g}"
            for q in x["contributions"][:CONTRIBUTIONS]
        ]
        counts = [f"{name} {n}" for name, n in x["quality"].items() if n]
        if counts:
            lines.append(f"  quality: {', '.join(counts)} samples")
    lines += [f"note: {note}" for x in flights for note in x.notes]
    return "\n".join(lines)


def _output(x: Mapping[str, Any], r: Mapping[str, Any]) -> str:
    """Which output it is, if there are several."""
    return f": {x['output']}" if len({y["output"] for y in r["flights"]}) > 1 else ""
