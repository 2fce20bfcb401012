"""What the page shows, as JSON: results in the words and digits of the reports. Nothing is computed here."""

from __future__ import annotations

import json
import math
import shlex
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ragg_runtime import api
from ragg_runtime.api import Loaded, effects
from ragg_runtime.base import false_alarms
from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io.record import LEFT_OUT
from ragg_runtime.report import pages, panels
from ragg_runtime.studio.session import State, list_present
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.describe_other import describe_effect
from ragg_runtime.wording.sections import Section, render_html

Json = dict[str, Any]


def describe_state(s: State) -> Json:
    """Everything small, in one answer."""
    m, c, d = s.loaded, s.compared, s.diagnosed
    return {
        "commands": list_commands(s),
        "model": None if m is None else _show_model(m),
        "flights": show_flights(s),
        "unread": [] if s.flights else [str(p) for p in s.paths],
        "verdict": None if d is None else d.verdict,
        "error": None if c is None else c.as_json()["error"],
        "result": [] if c is None else _show_result(s, c, d),
        "effects": [] if d is None else show_effects(d),
        "parameters": None
        if c is None
        else render_html(panels.describe_parameters(c.fitted)[:-1]),  # without the matrix
        "validation": None if s.held is None else _show_validation(s),
        "sheet": None if m is None else m.directory.text,
        "history": None if m is None else _show_history(m),
        "before": s.previous is not None and c is not None,
    }


def _show_result(s: State, c: Comparison, d: Diagnosis | None) -> list[str]:
    """Verdict and errors, and all other sections, of the diagnosis; until it is made, of the comparison."""
    if d is None:
        sections = describe.describe_comparison(c.as_json(), [x.name for x in s.fitted])
    else:  # the effects stand beside it, with their evidence
        sections = tuple(x for x in describe.describe_diagnosis(d.as_json()) if x.title != "Evidence")
    return [render_html(sections[:2]), render_html(sections[2:])]


# --- model, sheet, history -----------------------------------------------------------------------------


def _show_model(m: Loaded) -> Json:
    return {
        "name": m.name,
        "path": str(m.directory.path),
        "notes": list(m.notes),
        "effects": [{"id": e.id, "title": e.title} for e in m.model.effects],
    }


def _show_history(m: Loaded) -> Json:
    history = m.directory.history
    table = describe.tabulate_history([s.as_json() for s in history])
    return {
        "steps": render_html([Section("History", table=table)]),
        "can_undo": len(list_present(history)) > 1,
    }


# --- flights and results -------------------------------------------------------------------------------


def show_flights(s: State) -> list[Json]:
    """Every flight that is open, with what was read."""
    return [
        {
            "name": x.name,
            "path": str(p),
            "samples": len(x),
            "valid": int(x.valid.sum()),
            "rate_Hz": x.rate,
            "duration_s": x.duration,
            "notes": list(x.notes),
            "channels": list(x.channels),
            "outputs": list(x.outputs),
            "cuts": [list(c) for c in cuts],
            "kept": n in s.kept,
            "parts": _list_outputs(s, n),
        }
        for n, (x, p, cuts) in enumerate(zip(s.flights, s.paths, s.cuts, strict=False))
    ]


def _list_outputs(s: State, flight: int) -> list[str]:
    """The outputs of a flight that are compared."""
    if s.compared is None:
        return []
    c, position = s.result_for(flight)
    return [o.output.name for o in c.fitted.observations if o.flight == position]


def show_effects(d: Diagnosis) -> list[Json]:
    """The ranking, best first, each with its entry in the catalogue, if it is not an effect of the user's own."""
    level, catalogue = (
        math.log(false_alarms.CATALOGUE / max(1, len(d.ranking))),
        {e["id"]: e for e in effects()},
    )
    results: list[Any] = [r.as_json() for r in d.ranking]
    return [
        {
            "id": r.effect,
            "title": catalogue[r.effect]["title"] if r.effect in catalogue else r.effect,
            "about": render_html(describe_effect(catalogue[r.effect])) if r.effect in catalogue else "",
            "found": r.effect in d.found,
            "significant": r.test.rank > 0 and r.log_p < level,
            "p": numbers.probability(result["log10_p"]),
            "probability": result["probability"],
            "chance": describe.chance(result["probability"], result["log10_p"]),
            "after": numbers.number(r.after.rms_Eo),
            "holdout": numbers.number(r.after_holdout.rms_Eo),
        }
        for r, result in zip(d.ranking, results, strict=True)
    ]


def _show_validation(s: State) -> str:
    """The test of the calibration on the flights kept for validation."""
    result: Any = s.held
    names = [s.flights[n].name for n in sorted(s.kept)]
    return render_html(describe.describe_held(result.as_json(), names))


# --- what one takes along ------------------------------------------------------------------------------


def list_commands(s: State) -> list[str]:
    """The same commands for a shell; first, as comments, the steps that are in the model already."""
    if s.loaded is None:
        return []
    model, files = shlex.quote(str(s.loaded.directory.path)), _join(s.paths)
    fitted = _join([p for n, p in enumerate(s.paths) if n not in s.kept])
    validation = _join([s.paths[n] for n in sorted(s.kept)])
    lines = []
    if s.paths:
        claims = s.diagnosed.found if s.diagnosed is not None else ()
        lines += [f"ragg {c} {model} {fitted}" for c in ("compare", "diagnose")]
        lines += [f"ragg add {model} {shlex.quote(e)} {fitted}" for e in claims]
    lines.append(f"ragg history {model}")
    if s.paths:
        lines.append(f"ragg calibrate {model} {fitted} --save")
    if s.kept:
        lines.append(f"ragg compare {model} {validation} --frozen")
    if s.paths:
        lines.append(f"ragg compensate {model} {files} -o compensated.csv --calibration frozen")
    lines.append(f"ragg export {model} model-c --c")
    cuts = [(x.name, c) for x, cuts in zip(s.flights, s.cuts, strict=True) for c in cuts]
    # a name of several lines would go on as a command
    return [
        *_list_done(s, model, files),
        *(one_line(f"# {name}: {LEFT_OUT.format(*c)}") for name, c in cuts),
        *lines,
    ]


def _join(paths: Sequence[Path]) -> str:
    """The files for a shell, each once."""
    return shlex.join(dict.fromkeys(map(str, paths)))


def _list_done(s: State, model: str, flights: str) -> list[str]:
    """The steps of the present branch, as comments."""
    history, names, lines = s.model.directory.history, {x.name for x in s.flights}, []
    for step in (history[n] for n in list_present(history)):
        if step.action in ("add", "remove"):
            on = f" {flights if set(step.flights) <= names else 'FLIGHTS'}" if step.flights else ""
            lines.append(f"# done: ragg {step.action} {model} {shlex.quote(step.effect)}{on}")
        elif step.action != "new":
            lines.append(f"# done: {step.action} {numbers.clean(step.effect)}")
    return [one_line(x) for x in lines]


def take_away(s: State, what: str) -> tuple[str, str]:
    """(media type, content) of a file to download."""
    if what not in FILES:
        raise UserError("there is no such file", found=what[:40], expected=", ".join(FILES))
    kind, make = FILES[what]
    return kind, make(s)


def _make_source(s: State, command: str) -> api.Source:
    full_command = next((c for c in list_commands(s) if c.startswith(f"ragg {command} ")), f"ragg {command}")
    return api.Source(full_command, s.model, s.fitted)


def _write_steps(s: State) -> str:
    before, after = s.require("previous"), s.require("compared")
    history = s.model.directory.history
    steps = [history[n].as_json() for n in list_present(history)]
    return pages.write_addition(steps, before, after, _make_source(s, "history"))


def _write_json(s: State, name: str, command: str) -> str:
    document = s.require(name).as_json() | _make_source(s, command).as_json()
    return json.dumps(document, indent=1, allow_nan=False) + "\n"


FILES: Mapping[str, tuple[str, Callable[[State], str]]] = {
    "compare.html": ("text/html", lambda s: pages.write_comparison(s.require("compared"), _make_source(s, "compare"))),
    "diagnosis.html": ("text/html", lambda s: pages.write_diagnosis(s.require("diagnosed"), _make_source(s, "diagnose"))),
    "steps.html": ("text/html", _write_steps),
    "compare.json": ("application/json", lambda s: _write_json(s, "compared", "compare")),
    "diagnosis.json": ("application/json", lambda s: _write_json(s, "diagnosed", "diagnose")),
    "model.toml": ("application/toml", lambda s: s.model.directory.text),
    "commands.sh": ("text/plain", lambda s: "#!/bin/sh\n" + "\n".join(list_commands(s)) + "\n"),
}  # fmt: skip
"""Name of a file to download -> its media type, and what makes it."""
