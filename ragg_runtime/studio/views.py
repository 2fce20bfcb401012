"""What the page shows, as JSON: results in the words and digits of the reports. No figure is computed here."""

from __future__ import annotations

import html
import io
import json
import math
import re
import shlex
import tempfile
import zipfile
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime import api
from ragg_runtime.api import Loaded, errors_of
from ragg_runtime.base import false_alarms
from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.compensation.result import Compensation
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.io.record import WIDEST_SPIKE, left_out
from ragg_runtime.report import pages, panels, parameters
from ragg_runtime.report.page import Origin
from ragg_runtime.signals.derivative import runs
from ragg_runtime.studio.session import State, branches, lineage
from ragg_runtime.wording import describe, describe_other, numbers
from ragg_runtime.wording.sections import Section

Json = dict[str, Any]


def overview(s: State) -> Json:
    """Everything small, in one answer."""
    d = s.diagnosed
    return {
        "version": metadata.version("ragg"),
        "commands": commands(s),
        "model": None if s.loaded is None else _model(s),
        "flights": shown(s),
        "unread": [] if s.flights else [str(p) for p in s.paths],
        "banner": _banner(s),
        "effects": [] if d is None else effects(d),
        "untestable": [] if d is None else _untestable(d),
        "unexplained": None if d is None else _unexplained(d),
        "next_motion": [] if d is None else [describe.motion_sentence(p.as_json()) for p in d.next_motion],
        "parameters": None
        if s.compared is None
        else shown_sections(parameters.describe_parameters(s.compared.fitted)),
        "sheet": None if s.loaded is None else shown_sheet(s.loaded.instrument) | {"discs": _discs(s.loaded)},
        "history": None if s.loaded is None else _history(s.loaded),
        "error_steps": _error_steps(s),
        "compensated": None if s.compensated is None else _compensation(s.compensated),
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
        "calibrated": _kept(m),
        "effects": [_about(e) for e in m.model.effects],
        "spin_Hz": m.instrument.spin_frequency,
    }


def shown_sheet(i: Instrument) -> Json:
    """Names of the accelerometers, and of each parameter values, sigmas and plausible errors in its display unit."""
    known, rows = i.units, []
    for q in PARAMETERS:
        v = i.accelerometers[q.name]

        def of(x: Any, digits: int, unit: str = q.si_unit, to: str = q.display_unit) -> list[float]:
            return [float(f"{y:.{digits}g}") for y in known.from_si(np.asarray(x), unit, to)]

        rows.append(
            {
                "name": q.name,
                "symbol": [list(p) for p in numbers.symbol(q.symbol)],
                "meaning": q.description,
                "unit": q.display_unit,
                "unit_shown": numbers.unit(q.display_unit),
                "values": of(v, 12),
                "plausible": of(q.plausible_si(v, i.g0), 4),
                "sigma": of(i.sigmas[q.name], 12) if q.name in i.sigmas else None,
            }
        )
    return {"names": list(i.layout.names), "rows": rows}


def _kept(m: Loaded) -> str | None:
    """Where the calibration comes from that is kept with the model, or why it does not count; ``None``: there is none."""
    if m.directory.calibration is None:
        return None
    try:
        saved = api.saved_calibration(m)
    except UserError as e:
        return f"not used: {e.what}"
    return f"of {saved.time[:16].replace('T', ' ')} UTC, on {numbers.listed([numbers.clean(n) for n in saved.flights])}"


def _discs(m: Loaded) -> Json:
    """The discs and what sits on them, as a table."""
    layout = m.instrument.layout
    rows = []
    for k, d in enumerate(layout.discs):
        own = [(n, p) for n, p in zip(layout.names, layout.places, strict=True) if p.disc == k]
        on = ", ".join(f"{n} at {math.degrees(p.angle):.4g}°" for n, p in own)
        radii = sorted({p.radius for _, p in own})
        rows.append(
            [
                numbers.clean(d.name),
                f"{d.spin_frequency:g}",
                ", ".join(f"{r:g}" for r in radii),
                ", ".join(f"{x:g}" for x in d.axis),
                numbers.clean(on),
                ", ".join(dict.fromkeys(layout.output_names[p.output] for _, p in own)),
            ]
        )
    return {
        "heads": ["disc", "spin, Hz", "radius, m", "axis", "accelerometers", "output"],
        "rows": rows,
        "words": 6,
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
        "equation": mathml(e.equation, block=True),
        "channels": list(e.channels),
        "parameters": [
            {"symbol": mathml(q.latex), "unit": numbers.unit(q.unit), "meaning": numbers.clean(q.meaning)}
            for q in e.parameters
        ],
    }


def shown_error(rms: float, error: Mapping[str, object]) -> Json:
    """The error object, as numbers and as text."""
    return {"json": error, "rms_Eo": rms, "text": numbers.number(rms)}


def _banner(s: State) -> Json | None:
    c, d = s.compared, s.diagnosed
    if c is None:
        return None
    first = None if d is None else describe.describe_diagnosis(d.as_json())[0]
    said = [] if first is None else [numbers.clean(x) for x in first.sentences]
    errors = c.as_json()
    return {
        "state": "wait" if first is None else first.state,
        "verdict": None if d is None else d.verdict,
        "headline": "Testing every effect of the catalogue …" if first is None else said[0],
        "lead": said[1:],
        "errors": [
            {"label": label, **shown_error(e.rms_Eo, e.as_json()), "about": about}
            for label, e, about in (
                ("nominal", c.nominal, "with the values of the test sheet"),
                ("calibrated", c.calibrated, "parameters fitted to these flights"),
                ("held out", c.holdout, "fitted on half of the blocks of time, scored on the rest"),
            )
        ],
        "noise": {"rms_Eo": c.noise_floor, "text": numbers.number(c.noise_floor)},
        "converged": c.converged,
        "adequate": c.adequate,
        "k_ggi": c.fitted.k_ggi,
        "kind": c.fitted.observations[0].recorded.kind,
        "table": _table(describe.describe_comparison(errors, [])[1]),
        "facts": panels.describe_record(c.fitted),
    }


def effects(d: Diagnosis) -> list[Json]:
    """The ranking, best first, each with what the catalogue says of it."""
    found: list[Json] = []
    level = math.log(false_alarms.CATALOGUE / max(1, len(d.ranking)))
    for r in d.ranking:
        own: Any = r.as_json()
        significant = r.rank > 0 and r.log_p < level
        found.append(
            {
                **_about(d.fitted.model.effect(r.effect)),
                "id": r.effect,
                "found": r.effect in d.found,
                "significant": significant,
                "p": numbers.probability(own["log10_p"]),
                "probability": own["probability"],
                "chance": describe.chance(own["probability"], own["log10_p"]),
                "after_Eo": r.after.rms_Eo,
                "holdout_Eo": r.after_holdout.rms_Eo,
                "testable": r.rank > 0 and r.effect in _linear(d),
                "seen_from": [str(s) for s in d.sizes if s.effect == r.effect],
                "values": _values(own) if significant or r.effect in d.found else [],
                "indistinguishable": list(r.indistinguishable_from),
            }
        )
    return found


def _values(own: Mapping[str, Any]) -> list[list[str]]:
    """(name, value) of the parameters of an effect that are larger than their uncertainty, the clearest first."""
    best = describe.best_values(own)
    return [[describe.parameter_label(p), describe.with_uncertainty(p)] for p in best]


def _table(s: Section) -> Json:
    """A section's table for the page."""
    t = s.table
    if t is None:
        return {}
    rows = [[numbers.clean(x) for x in row] for row in t.rows]
    return {"heads": t.heads, "rows": rows, "words": t.words, "note": t.note}


def shown_sections(sections: Sequence[Section]) -> list[Json]:
    """Sections for the page, which shows them as they are."""
    return [
        {
            "title": numbers.clean(s.title),
            "sentences": [numbers.clean(x) for x in s.sentences],
            "table": _table(s),
            "detail": s.detail,
            "summary": s.summary,
        }
        for s in sections
    ]


def _linear(d: Diagnosis) -> set[str]:
    """Effects whose columns are in the triangles, so that what they would do can be predicted."""
    return {e.id for e in d.fitted.model.candidates if e.kind in ("deterministic", "step")}


def _untestable(d: Diagnosis) -> list[Json]:
    found = []
    for n in d.not_testable:
        found.append({**_about(d.fitted.model.effect(n.effect)), "id": n.effect, "why": numbers.clean(n.why)})
    return found


def _unexplained(d: Diagnosis) -> Json:
    return {
        "significant": d.remainder.significant,
        "share": numbers.percent(d.remainder_share),
        "p": numbers.probability(d.remainder.log_p / math.log(10.0)),
        "terms": [
            {
                "label": describe.term_label(t),
                "z": numbers.number(abs(float(str(t["z"])))),
                "harmonic": t["harmonic"],
                "product": t["term"],
            }
            for t in d.terms()
        ],
        "expression": d.expression(),
        "needs": d.needs(),
    }


def _history(m: Loaded) -> Json:
    history = m.directory.history
    past, future = branches(history)
    present = lineage(history)
    return {
        "now": present[-1] if present else None,
        "steps": [
            {
                "n": n,
                "action": s.action,
                "effect": numbers.clean(s.effect),
                "time": s.time,
                "before": describe.rms_of(s.before),
                "after": describe.rms_of(s.after),
                "holdout": describe.rms_of(s.after, "holdout"),
                "flights": sorted(s.flights),
                "present": n in present,
                "kept": bool(s.text),
            }
            for n, s in enumerate(history)
        ],
        "can_undo": len(past) > 1 and bool(history[past[-2]].text),
        "can_redo": bool(future),
    }


def _error_steps(s: State) -> list[Json]:
    """The error after every step of the present branch, ending with what the flights that are open show now."""
    if s.compared is None:
        return []
    history = s.model.directory.history
    bars = panels.error_steps([history[n].as_json() for n in lineage(history)], s.compared.calibrated.rms_Eo)
    kinds = {True: "step", False: "start"}
    return [{"label": numbers.clean(b.label), "value": b.value, "kind": kinds[b.strong]} for b in bars]


def _compensation(c: Compensation) -> Json:
    r = c.as_json()
    return {
        "calibration": r["calibration"],
        "demodulator": r["demodulator"]["name"],
        "channels": [n for n, unit in c.units.items() if unit == "Eo" and f"{n}_std" in c.units],
        "sections": shown_sections(describe_other.describe_compensation(r, "")),
    }


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
        "values": [describe.parameter_line(p.as_json()) for p in (a.combinations or a.parameters)],
    }


def _done(s: State, model: str, flights: str) -> list[str]:
    """The steps of the present branch, as comments: they are in the model already."""
    history = s.model.directory.history
    found = []
    for n in lineage(history):
        step = history[n]
        on = flights if set(step.flights) <= {x.name for x in s.flights} else "FLIGHTS"
        if step.action in ("add", "remove"):
            command = f"ragg {step.action} {model} {shlex.quote(step.effect)}"
            found.append(f"# done: {command}{f' {on}' if step.flights else ''}")
        elif step.action not in ("new", "restore"):
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


def shown(s: State) -> list[Json]:
    """Every flight that is open; before it is compared, what a first look tells."""
    if not s.flights:  # they are being read
        return []
    observed = () if s.compared is None else s.compared.fitted.observations
    return [
        {
            "name": numbers.clean(x.name),
            "path": str(p),
            "samples": len(x),
            "valid": int(x.valid.sum()),
            "rate_Hz": x.rate,
            "start_s": 0.0,  # figures count from the first sample
            "duration_s": x.duration,
            "notes": [numbers.clean(n) for n in x.notes],
            "channels": [{"name": n, "unit": x.units[n]} for n in x.channels],
            "outputs": list(x.outputs),
            "cuts": [list(c) for c in cuts],
            "parts": [
                {"name": o.output.name, "spin_Hz": abs(o.record.spin_frequency) * o.record.turning}
                for o in seen
            ],
            "missing": missing(seen[0].record.valid if seen else x.valid, x.rate),
        }
        for n, (x, p, cuts) in enumerate(zip(s.flights, s.paths, s.cuts, strict=True))
        for seen in [[o for o in observed if o.flight == n]]
    ]


_ABSENT = re.compile(r"\\(bm|boldsymbol)\b")
_OPERATOR = re.compile(r"\\mathrel\{([+-])\}=")


@lru_cache(maxsize=512)
def mathml(latex: str, *, block: bool = False) -> str:
    """``latex`` as a ``<math>`` element; as plain text where it is none (an expression of the user's own)."""
    from latex2mathml.converter import convert

    plain = f"<code>{html.escape(latex)}</code>"
    if ("\\" not in latex and "*" in latex) or set("<>&") & set(latex):  # the converter passes markup on
        return plain
    try:
        made = convert(
            _OPERATOR.sub(r"\1=", _ABSENT.sub(r"\\mathbf", latex)), display="block" if block else "inline"
        )
    except Exception:  # whatever a stranger's text does to the converter, the text can be shown
        return plain
    return str(made) if "\\" not in made else plain


def take_away(s: State, what: str) -> tuple[str, bytes]:
    """(media type, content) of a file to download."""
    if what not in FILES:
        raise UserError("there is no such file", found=what[:40], expected=", ".join(FILES))
    kind, make = FILES[what]
    content = make(s)
    return kind, content.encode() if isinstance(content, str) else content


def _origin(s: State, command: str) -> Origin:
    m, flights = s.model, s.flights
    title = f"{m.name} and {', '.join(x.name for x in flights)}"
    return Origin(title, _command(s, command), api.sources(m, flights), api.notes(m, flights))


def _command(s: State, name: str) -> str:
    return next((c for c in commands(s) if c.startswith(f"ragg {name} ")), f"ragg {name}")


def _compared(s: State) -> Comparison:
    if s.compared is None:
        raise UserError("there is no result yet", remedy="open a flight and wait until it is compared")
    return s.compared


def _diagnosed(s: State) -> Diagnosis:
    if s.diagnosed is None:
        raise UserError("there is no result yet", remedy="open a flight and wait until it is diagnosed")
    return s.diagnosed


def _steps_report(s: State) -> str:
    if s.compared is None or s.previous is None:
        raise UserError("there is no step to report yet", remedy="derive an effect into the model first")
    history = s.model.directory.history
    steps = [history[n].as_json() for n in branches(history)[0]]
    return pages.add_page(steps, s.previous, s.compared, _origin(s, "history"), s.diagnosed)


def _compensated(s: State, name: str) -> bytes:
    if s.compensated is None:
        raise UserError("nothing is compensated yet", remedy="do it under Apply")
    with tempfile.TemporaryDirectory(prefix="ragg-") as folder:
        path = Path(folder, name)
        s.compensated.write(path)
        return path.read_bytes()


def _exported(s: State, form: str) -> bytes:
    """The model to run elsewhere, with the saved calibration: what ``ragg export`` writes, as one file."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as z:
        for path, text in api.FORMS[form](api.contents(s.model)).items():
            z.writestr(zipfile.ZipInfo(f"model-{form}/{path}"), text, zipfile.ZIP_DEFLATED)
    return made.getvalue()


def _dumped(s: State, result: Json, command: str) -> str:
    origin = api.origin(s.model, s.flights, _command(s, command))
    return json.dumps(result | origin, indent=1, allow_nan=False) + "\n"


FILES: Mapping[str, tuple[str, Callable[[State], str | bytes]]] = {
    "compare.html": ("text/html", lambda s: pages.compare_page(_compared(s), _origin(s, "compare"))),
    "diagnosis.html": ("text/html", lambda s: pages.diagnose_page(_diagnosed(s), _origin(s, "diagnose"))),
    "steps.html": ("text/html", _steps_report),
    "compare.json": ("application/json", lambda s: _dumped(s, _compared(s).as_json(), "compare")),
    "diagnosis.json": ("application/json", lambda s: _dumped(s, _diagnosed(s).as_json(), "diagnose")),
    "compensated.csv": ("text/csv", lambda s: _compensated(s, "compensated.csv")),
    "compensated.parquet": (
        "application/vnd.apache.parquet",
        lambda s: _compensated(s, "compensated.parquet"),
    ),
    "model.toml": ("application/toml", lambda s: s.model.directory.text),
    "model-c.zip": ("application/zip", lambda s: _exported(s, "c")),
    "model-numpy.zip": ("application/zip", lambda s: _exported(s, "numpy")),
    "commands.sh": ("text/plain", lambda s: "#!/bin/sh\n" + "\n".join(commands(s)) + "\n"),
}
"""Name of a file to download -> its media type, and what makes it."""


MOST_MARKS = 300
"""Marks of either kind on a timeline, the longest and the first: it has no more pixels for them."""


def missing(valid: NDArray[np.bool_], rate: float) -> dict[str, Any]:
    """Stretches (from, to, s since the first sample) without usable samples, and instants of those too short for a gap."""
    lacking = runs(~valid)
    gaps = [x for x in lacking if x.stop - x.start > WIDEST_SPIKE]
    longest = sorted(gaps, key=lambda x: x.start - x.stop)[:MOST_MARKS]
    return {
        "gaps": [[x.start / rate, x.stop / rate] for x in sorted(longest, key=lambda x: x.start)],
        "alone": [x.start / rate for x in lacking if x.stop - x.start <= WIDEST_SPIKE][:MOST_MARKS],
    }
