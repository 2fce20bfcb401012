"""What the page shows, as JSON: results in the words and digits of the reports. No figure is computed here."""

from __future__ import annotations

import math
import shlex
from collections.abc import Mapping, Sequence
from typing import Any

from ragg_runtime.base.errors import one_line
from ragg_runtime.diagnosis.comparison import Comparison
from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.flight.record import left_out
from ragg_runtime.report import diagnose_page, panels, parameters
from ragg_runtime.report.parameters import Piece, Row, Symbol
from ragg_runtime.studio import apply, flights, maths
from ragg_runtime.studio.session import State
from ragg_runtime.wording import numbers
from ragg_runtime.workflow import sheet
from ragg_runtime.workflow.branches import branches, tree
from ragg_runtime.workflow.loop import Loaded, errors_of

Json = dict[str, Any]


def overview(s: State, version: str) -> Json:
    """Everything small, in one answer."""
    return {
        "version": version,
        "model": None if s.loaded is None else _model(s),
        "flights": flights.shown(s),
        "unread": [] if s.flights else [str(p) for p in s.paths],
        "banner": _banner(s),
        "effects": [] if s.diagnosed is None else effects(s.diagnosed),
        "silent": [] if s.diagnosed is None else _silent(s.diagnosed),
        "unexplained": None if s.diagnosed is None else _unexplained(s.diagnosed),
        "next_motion": [] if s.diagnosed is None else [_motion(p) for p in s.diagnosed.next_motion],
        "parameters": None if s.compared is None else _parameters(s.compared),
        "sheet": None if s.loaded is None else sheet.shown(s.loaded.instrument),
        "history": None if s.loaded is None else _history(s.loaded),
        "compensated": None if s.compensated is None else apply.shown_compensation(s.compensated),
        "beside": None if s.beside is None else _beside(*s.beside),
        "trial": None if s.trial is None else _trial(s),
        "before": s.previous is not None and s.compared is not None,
    }


def _model(s: State) -> Json:
    m = s.model
    return {
        "name": m.name,
        "path": str(m.directory.path),
        "notes": list(m.notes),
        "calibrated": apply.kept(m),
        "effects": [_about(e) for e in m.model.effects],
        "spin_Hz": m.instrument.spin_frequency,
    }


def _about(e: Any) -> Json:
    """What an effect of a model (``Model.effect``) is; nothing of one that the model does not know."""
    if e is None:
        return {}
    return {
        "id": e.id,
        "title": numbers.clean(e.title),
        "physics": numbers.clean(e.physics),
        "source": numbers.clean(e.source),
        "limits": numbers.clean(e.limits),
        "equation": maths.mathml(e.equation, block=True),
        "channels": list(e.channels),
        "parameters": [
            {
                "symbol": maths.mathml(q.latex),
                "unit": numbers.unit(q.unit),
                "meaning": numbers.clean(q.meaning),
            }
            for q in e.parameters
        ],
    }


def error(rms: float, told: Mapping[str, object]) -> Json:
    """The error object, as numbers and as text."""
    return {"json": told, "rms_Eo": rms, "text": numbers.number(rms)}


def _banner(s: State) -> Json | None:
    c, d = s.compared, s.diagnosed
    if c is None:
        return None
    state = "wait" if d is None else {"adequate": "good", "missing-effect": "found"}.get(d.verdict, "bad")
    converged = c.as_json().get("converged")
    return {
        "state": state,
        "verdict": None if d is None else d.verdict,
        "headline": "Testing every effect of the catalogue …" if d is None else diagnose_page.headline(d),
        "lead": [] if d is None else diagnose_page.lead(d, "said with each effect"),
        "errors": [
            {"label": label, **error(e.rms_Eo, e.as_json()), "about": about}
            for label, e, about in (
                ("nominal", c.nominal, "with the values of the test sheet"),
                ("calibrated", c.calibrated, "parameters fitted to these flights"),
                ("held out", c.holdout, "fitted on half of the blocks of time, scored on the rest"),
            )
        ],
        "noise": {"rms_Eo": c.noise_floor, "text": numbers.number(c.noise_floor)},
        "converged": converged if isinstance(converged, bool) else None,
        "adequate": c.adequate,
        "k_ggi": c.fitted.k_ggi,
        "kind": c.fitted.observations[0].recorded.kind,
        "table": [
            panels.error_row("nominal", c.nominal),
            panels.error_row("calibrated", c.calibrated),
            panels.error_row("held out", c.holdout),
            panels.noise_row(c.fitted, c.noise_floor),
        ],
        "facts": panels.facts(c.fitted),
    }


def effects(d: Diagnosis) -> list[Json]:
    """The ranking, best first, each with what the catalogue says of it."""
    found, sizes = [], dict(diagnose_page.sizes(d))
    for row, r in zip(diagnose_page.ranking(d), d.ranking, strict=True):
        values = row["fitted"]
        probability = r.as_json().get("probability")
        found.append(
            {
                **_about(d.fitted.model.effect(r.effect)),
                "id": r.effect,
                "found": row["found"],
                "significant": row["significant"],
                "p": row["p"],
                "evidence": -r.log_p / math.log(10.0),
                "probability": probability if isinstance(probability, float) else None,
                "delta_bic": row["delta_bic"],
                "after_Eo": r.after.rms_Eo,
                "holdout_Eo": r.after_holdout.rms_Eo,
                "testable": r.rank > 0 and r.effect in _linear(d),
                "seen_from": sizes.get(r.effect, []),
                "values": []
                if values is None
                else [{"name": v.name, "of": v.of, "text": v.text} for v in values.values],
                "indistinguishable": row["indistinguishable"],
            }
        )
    return found


def _linear(d: Diagnosis) -> set[str]:
    """Effects whose columns are in the triangles, so that what they would do can be foreseen."""
    return {e.id for e in d.fitted.model.candidates if e.kind in ("deterministic", "step")}


def _silent(d: Diagnosis) -> list[Json]:
    found = []
    for n in d.not_testable:
        found.append({**_about(d.fitted.model.effect(n.effect)), "id": n.effect, "why": numbers.clean(n.why)})
    return found


def _unexplained(d: Diagnosis) -> Json:
    return {
        "significant": d.remainder.significant,
        "share": numbers.percent(d.remainder_share),
        "p": numbers.probability(d.remainder.log_p),
        "terms": [
            {**shown, "harmonic": t["harmonic"], "product": t["term"], "how": t["how"]}
            for shown, t in zip(panels.terms(d.terms(), d.after.rms_Eo), d.terms(), strict=True)
        ],
        "expression": d.expression(),
        "needs": d.needs(),
    }


def _motion(p: Any) -> Json:
    return {**p.as_json(), "words": numbers.clean(p.in_words())}


def _symbol(s: Symbol) -> Json:
    return {"pieces": [list(p) for p in s.pieces], "name": s.name, "meaning": numbers.clean(s.meaning)}


def _rows(rows: Sequence[Row]) -> list[Json]:
    return [
        {
            "symbol": _symbol(r.symbol),
            "unit": r.unit,
            "cells": [{"value": c.value, "nominal": c.nominal, "state": c.state} for c in r.cells],
        }
        for r in rows
    ]


def _piece(p: Piece) -> Json:
    return {"sign": p.sign, "factor": p.factor, "pattern": p.pattern, "symbol": _symbol(p.symbol)}


def _parameters(c: Comparison) -> Json:
    f = c.fitted
    v = parameters.visibility(f)
    return {
        "single": _rows(parameters.by_accelerometer(f)),
        "combined": _rows(parameters.by_combination(f)),
        "patterns": [name for name, _ in parameters.PATTERNS],
        "accelerometers": list(f.instrument.layout.names),
        "determined": v.determined,
        "total": v.total,
        "unseen": [{"pattern": k, "symbols": [_symbol(s) for s in symbols]} for k, symbols in v.unseen],
        "groups": [
            {
                "members": [_piece(p) for p in g.members],
                "unseen": g.unseen,
                "seen": [[_piece(p) for p in row] for row in g.seen],
            }
            for g in v.groups
        ],
        "patterned": v.patterns,
        "correlations": [
            {"a": _piece(a), "b": _piece(b), "r": r} for a, b, r in parameters.correlations(f, CORRELATED)
        ],
        "pull": [{"of": _piece(p), "sigma": sigma} for p, sigma in parameters.pulls(f, PULLED)],
    }


PULLED = 16
"""Parameters whose pull is shown, the farthest from their sheet."""

CORRELATED = 16
"""Pairs of correlated parameters that are shown."""


def _history(m: Loaded) -> Json:
    history = m.directory.history
    past, future = branches(history)
    made = tree(history)
    return {
        "now": past[-1] if past else None,
        "tree": [{"n": n, "from": origin, "lane": lane} for n, (origin, lane) in made.items()],
        "steps": [
            {
                "n": n,
                "action": s.action,
                "effect": numbers.clean(s.effect),
                "time": s.time,
                "before": _rms(s.before, "calibrated"),
                "after": _rms(s.after, "calibrated"),
                "holdout": _rms(s.after, "holdout"),
                "flights": sorted(s.flights),
                "present": n in past,
                "kept": bool(s.text),
            }
            for n, s in enumerate(history)
        ],
        "can_undo": len(past) > 1 and bool(history[past[-2]].text),
        "can_redo": bool(future),
    }


def _rms(entry: Any, which: str) -> float | None:
    value = entry.get(which) if isinstance(entry, Mapping) else None
    found = value.get("rms_Eo") if isinstance(value, Mapping) else None
    return float(found) if isinstance(found, int | float) else None


def _beside(step: int, c: Comparison) -> Json:
    return {
        "step": step,
        "effects": [e.id for e in c.fitted.model.effects],
        "errors": errors_of(c),
        "rms_Eo": c.calibrated.rms_Eo,
        "holdout_Eo": c.holdout.rms_Eo,
        "noise_Eo": c.noise_floor,
        "adequate": c.adequate,
    }


def _trial(s: State) -> Json:
    assert s.trial is not None
    effect, add, units, a = s.trial
    return {
        "id": effect,
        "add": add,
        "units": dict(units),
        "before_Eo": None if a.before is None else a.before.calibrated.rms_Eo,
        "after_Eo": None if a.after is None else a.after.calibrated.rms_Eo,
        "holdout_before_Eo": None if a.before is None else a.before.holdout.rms_Eo,
        "holdout_Eo": None if a.after is None else a.after.holdout.rms_Eo,
        "noise_Eo": None if a.after is None else a.after.noise_floor,
        "adequate": a.after is not None and a.after.adequate,
        "values": [
            {
                "name": p.name,
                "of": p.accelerometer_name,
                "text": numbers.with_unit(numbers.plus_minus(p.value, p.std), p.unit),
            }
            for p in (a.combinations or a.parameters)
        ],
    }


def _done(s: State, model: str, flights: str) -> list[str]:
    """The steps of the present branch, as comments: they are in the model already."""
    history = s.model.directory.history
    found = []
    for n in branches(history)[0]:
        step = history[n]
        on = flights if set(step.flights) <= {x.name for x in s.flights} else "FLIGHTS"
        if step.action in ("add", "remove"):
            told = f"ragg {step.action} {model} {shlex.quote(step.effect)}"
            found.append(f"# done: {told}{f' {on}' if step.flights else ''}")
        elif step.action != "new":
            found.append(f"# done: {step.action} {numbers.clean(step.effect)}")
    return [one_line(x) for x in found]  # a name of several lines would go on as a command


def commands(s: State) -> list[str]:
    """What does the same in a shell."""
    if s.loaded is None:
        return []
    model = shlex.quote(str(s.loaded.directory.path))
    files = " ".join(shlex.quote(str(p)) for p in dict.fromkeys(s.paths))
    found = [f"ragg history {model}", f"ragg export {model} model-c --c"]
    if s.paths:
        found = [f"ragg {c} {model} {files}" for c in ("compare", "diagnose")] + found
        chosen = s.diagnosed.found if s.diagnosed is not None else ()
        found[2:2] = [f"ragg add {model} {shlex.quote(e)} {files}" for e in chosen]
        found.insert(-1, f"ragg calibrate {model} {files} --save")
    if s.compensated is not None:
        how = s.compensated.result
        options = f"--calibration {how['calibration']} --demodulator {how['demodulator']['name']}"
        found.append(f"ragg compensate {model} {files} -o compensated.csv {options}")
    cut = [
        one_line(f"# {x.name}: {left_out(*c)}")
        for x, cuts in zip(s.flights, s.cuts, strict=True)
        for c in cuts
    ]
    return [*_done(s, model, files), *cut, *found]
