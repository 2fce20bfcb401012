"""Results in words, for the terminal, with the command that comes next."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ragg_runtime.base.errors import one_line
from ragg_runtime.flight import Flight
from ragg_runtime.report import in_words
from ragg_runtime.wording import notebook
from ragg_runtime.workflow.after import Compensation, Kept
from ragg_runtime.workflow.loop import Added
from ragg_runtime.workflow.online import Watched


def command(
    verb: str, model_dir: Path, flights: Sequence[Flight], mapping: Path | None = None, effect: str = ""
) -> str:
    """A command on the same model and flights, as a shell takes it: ``ragg add my-model lag day-1/flight.csv``."""
    files = dict.fromkeys(str(x.path) for x in flights if x.path is not None)
    words = [verb, str(model_dir), *([effect] if effect else []), *files]
    words += [] if mapping is None else ["--map", str(mapping)]
    return one_line(f"ragg {shlex.join(words)}{'' if files else ' FLIGHT'}")


def next_add(model_dir: Path, flights: Sequence[Flight], mapping: Path | None, found: Sequence[str]) -> str:
    """The command that adds the first effect that a diagnosis has found; nothing if it has found none."""
    return command("add", model_dir, flights, mapping, found[0]) if found else ""


def with_notes(text: str, flights: Sequence[Flight]) -> str:
    """A result, and below it what the reader did to the flights."""
    return "\n".join([text, *(f"note: {note}" for x in flights for note in x.notes)])


def added(a: Added, flights: Sequence[Flight] = (), mapping: Path | None = None) -> str:
    """The result of ``add``."""
    done = f"added {a.effect}" if a.converged else f"{a.effect} was NOT added"
    lines = [f"{done}; effects: {', '.join(e.id for e in a.loaded.model.effects) or 'none'}"]
    if a.before is not None and a.after is not None:
        rows = (("before", a.before.calibrated), ("after", a.after.calibrated), ("held out", a.after.holdout))
        lines += [
            *in_words.errors_table(rows, a.after.noise_floor, a.after.fitted),
            "",
            *in_words.not_converged(a.after.complaint),
            notebook.NOW_ADEQUATE if a.after.adequate else notebook.STILL_MISSING,
            *in_words.off_sheet(a.after),
        ]
        lines += in_words.parameters(a.parameters, a.combinations)
        if a.converged and not a.after.adequate:
            lines += ["", f"next: {command('diagnose', a.loaded.directory.path, flights, mapping)}"]
    return with_notes("\n".join(lines), flights)


def history(steps: Sequence[Mapping[str, Any]]) -> str:
    """The steps of a model directory."""
    lines = [f"{'when':26} {'step':8} {'effect':28} {'before Eo':>10} {'after Eo':>10}"]
    for s in steps:
        values = []
        for key in ("before", "after"):
            rms = notebook.rms_of(s[key])
            values.append(f"{'-':>10}" if rms is None else f"{rms:10.4g}")
        lines.append(f"{s['time']:26} {s['action']:8} {s['effect'] or '-':28} {' '.join(values)}")
    return "\n".join(lines)


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
        *in_words.errors_table(rows, floor, c.fitted),
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
    return with_notes("\n".join(lines), flights)


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
    return with_notes("\n".join(lines), flights)


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
    return with_notes("\n".join(lines), flights)


def _output(x: Mapping[str, Any], r: Mapping[str, Any]) -> str:
    """Which output it is, if there are several."""
    return f": {x['output']}" if len({y["output"] for y in r["flights"]}) > 1 else ""
