"""Results in words, for the terminal."""

from __future__ import annotations

import math
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import one_line
from ragg_runtime.diagnosis.comparison import Comparison
from ragg_runtime.diagnosis.parameters import ParameterValue
from ragg_runtime.diagnosis.ranking import Ranked
from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.fit.score import Error, least
from ragg_runtime.flight import Flight
from ragg_runtime.wording import notebook
from ragg_runtime.workflow.loop import Added
from ragg_runtime.workflow.origin import notes as notes
from ragg_runtime.workflow.origin import origin as origin


def command(
    verb: str, model_dir: Path, flights: Sequence[Flight], mapping: Path | None = None, effect: str = ""
) -> str:
    """A command on the same model and flights, as a shell takes it: ``ragg add my-model lag day-1/flight.csv``."""
    files = dict.fromkeys(str(x.path) for x in flights if x.path is not None)
    words = [verb, str(model_dir), *([effect] if effect else []), *files]
    words += [] if mapping is None else ["--map", str(mapping)]
    return one_line(f"ragg {shlex.join(words)}{'' if files else ' FLIGHT'}")


def _error(e: Error) -> str:
    values = (
        (e.rms_Eo, 12, 5),
        (e.inline_Eo, 10, 4),
        (e.cross_Eo, 10, 4),
        (e.inline_Eo_per_rtHz, 12, 4),
        (e.cross_Eo_per_rtHz, 12, 4),
    )
    return " ".join(f"{x:{w}.{d}g}" if np.isfinite(x) else f"{'-':>{w}}" for x, w, d in values)


def _missing(errors: Sequence[Error], flights: Sequence[Flight], f: Fitted) -> list[str]:
    """Why some demodulated channels have no value, if any lack one."""
    if all(np.isfinite((e.inline_Eo, e.cross_Eo)).all() for e in errors) or not flights:
        return []
    if not any(o.record.turning for o in f.observations):
        return ["-: of a disc that stands still nothing is demodulated"]
    longest = max(least(x.rate) for x in flights)
    return [
        f"-: the demodulator's low-pass needs {longest:.3g} s without a gap or a sample left out; "
        "there is no such stretch"
    ]


def _not_converged(complaint: str | None) -> list[str]:
    return [] if complaint is None else [f"NOT CONVERGED: {complaint}"]


_SAID = 3
"""Most parameters beyond their sheet that are named."""


def _off_sheet(result: Comparison | Diagnosis) -> list[str]:
    found = result.off_sheet
    more = [f"and {len(found) - _SAID} more"] if len(found) > _SAID else []
    said = [*(x.in_words() for x in found[:_SAID]), *more]
    return [f"note: {'; '.join(said)}"] if said else []


_HEAD = f"{'':12} {'rms Eo':>12} {'inline Eo':>10} {'cross Eo':>10} {'in Eo/rtHz':>12} {'cr Eo/rtHz':>12}"


def errors_table(
    rows: Sequence[tuple[str, Error]], noise: float, flights: Sequence[Flight], f: Fitted
) -> list[str]:
    """Errors, the first before anything was done, above the noise floor; why some have no value."""
    return [
        _HEAD,
        *(f"{label:12} {_error(e)}" for label, e in rows),
        f"{'noise floor':12} {noise:12.5g}",
        *_missing([e for _, e in rows[1:]], flights, f),
    ]


def ladder(c: Comparison) -> list[str]:
    """What each simplification of the model is worth, one line per form, if that was asked for."""
    if not c.ladder:
        return []
    names = [r.form.in_short() for r in c.ladder]
    width = max(map(len, names))
    lines = [
        "",
        "what simplifications cost, Eo (step: what a form changes in the prediction of the one before it):",
        f"{'':{width}} {'nominal':>10} {'calibrated':>10} {'step':>10} {'inline':>10} {'cross':>10}",
    ]
    for name, r in zip(names, c.ladder, strict=True):
        step = "" if r.step is None else _columns((r.step.rms_Eo, r.step.inline_Eo, r.step.cross_Eo))
        here = "  <- model.toml" if r.form == c.fitted.instrument.form else ""
        lines.append(f"{name:{width}} {_columns((r.nominal.rms_Eo, r.calibrated.rms_Eo))} {step}{here}")
    return lines


def _columns(values: Sequence[float]) -> str:
    return " ".join(f"{x:10.4g}" if np.isfinite(x) else f"{'-':>10}" for x in values)


def compared(
    c: Comparison,
    flights: Sequence[Flight],
    model_dir: Path,
    mapping: Path | None = None,
    rows: Sequence[tuple[str, Error]] = (),
    *,
    judged: bool = True,
) -> str:
    """The result of ``compare``; other ``rows`` of errors than the usual where nothing was fitted.

    Not ``judged``: that there is an error says nothing of the model, since its parameters are others now.
    """
    f = c.fitted
    lines = [
        f"{', '.join(x.name for x in flights)}: {f.calibration.rows} samples, effects in the model: "
        f"{', '.join(e.id for e in f.model.effects) or 'none'}",
        *errors_table(
            rows or (("nominal", c.nominal), ("calibrated", c.calibrated), ("held out", c.holdout)),
            c.noise_floor,
            flights,
            f,
        ),
        "",
        *_not_converged(c.complaint),
        *([] if c.remark is None else [f"note: {c.remark}"]),
        *([notebook.ADEQUATE if c.adequate else notebook.NOT_ADEQUATE] if judged else []),
        *ladder(c),
        *_off_sheet(c),
    ]
    where: Any = c.as_json()["where"]
    if where["motion"]:
        lines.append("\nwhere it fails (harmonic x motion term, share of the residual's power):")
        lines += [
            f"  {t['harmonic']:6} {t['term']:28} {100 * t['share']:6.1f} %   {t['z']:+8.1f} sigma"
            for t in where["motion"]
        ]
    if judged and not c.adequate:
        lines += ["", f"next: {command('diagnose', model_dir, flights, mapping)}"]
    lines += [f"note: {note}" for x in flights for note in x.notes]
    return "\n".join(lines)


def _ranked(r: Ranked) -> str:
    p = notebook.p_value(r.log_p / math.log(10.0), r.p_value)
    errors = " ".join(f"{e.rms_Eo:10.4g}" for e in (r.before, r.after, r.after_holdout))
    return f"  {r.effect:28} {p:>8} {r.delta_bic:12.1f} {errors}"


def _parameters(parameters: Sequence[ParameterValue], combinations: Sequence[ParameterValue]) -> list[str]:
    lines = [f"  {notebook.parameter(q.as_json())}" for q in parameters]
    if combinations:
        lines.append("  of which the record knows best:")
        lines += [f"  {notebook.parameter(q.as_json())}" for q in combinations]
    return lines


def diagnosed(
    d: Diagnosis, model_dir: Path, flights: Sequence[Flight] = (), mapping: Path | None = None
) -> str:
    """The result of ``diagnose``."""
    lines = [
        notebook.verdict(d.verdict, d.found, [g.as_json() for g in d.groups]),
        *_not_converged(d.complaint),
        *([] if d.remark is None else [f"note: {d.remark}"]),
        f"error {d.before.rms_Eo:.4g} Eo -> {d.after.rms_Eo:.4g} Eo rms, noise floor {d.noise_floor:.4g} Eo",
        "",
        f"  {'effect':28} {'p-value':>8} {'delta BIC':>12} {'before':>10} {'after':>10} {'held out':>10} Eo",
    ]
    lines += [_ranked(r) for r in d.ranking[:8]]
    for r in d.ranking:
        if r.effect in d.found:
            lines.append("")
            lines += _parameters(r.parameters, r.combinations)
            if r.indistinguishable_from:
                lines.append(f"  this record cannot tell it from: {', '.join(r.indistinguishable_from)}")
    if d.verdict == "unexplained":
        terms: Any = d.as_json()["unexplained"]
        lines.append("\n  what is left (harmonic x motion term):")
        for t in terms["terms"]:
            lines.append(
                f"  {t['harmonic']:6} {t['term']:28} {t['coefficient']:+.4g} +- {t['std']:.2g} {t['unit']},"
                f" {t['z']:+.1f} sigma{', ' + t['how'] if t['how'] else ''}"
            )
        if d.expression():
            lines += [
                "\n  to keep it as an effect of your own, put this into `effects` of model.toml:",
                f"  {d.expression()}",
            ]
        if d.needs():
            lines.append(f"  and this into the flight: {'; '.join(d.needs())}")
    if d.change is not None:
        lines.append(f"\n  the model holds until {d.change.until:.6g} s of {d.change.flight}, not beyond")
    if d.next_motion:
        lines.append("\n  next motion:")
        lines += [f"  {p.in_words()}" for p in d.next_motion]
    if d.not_testable:
        lines.append("\n  not testable on this record:")
        lines += [f"  {n.effect:28} {n.why}" for n in d.not_testable]
    if d.found and d.verdict == "missing-effect":
        lines += ["", f"next: {command('add', model_dir, flights, mapping, d.found[0])}"]
    lines += _off_sheet(d)
    lines += [f"note: {note}" for x in flights for note in x.notes]
    return "\n".join(lines)


def added(a: Added, flights: Sequence[Flight] = (), mapping: Path | None = None) -> str:
    """The result of ``add``."""
    done = f"added {a.effect}" if a.converged else f"{a.effect} was NOT added"
    lines = [f"{done}; effects: {', '.join(e.id for e in a.loaded.model.effects) or 'none'}"]
    if a.before is not None and a.after is not None:
        rows = (("before", a.before.calibrated), ("after", a.after.calibrated), ("held out", a.after.holdout))
        lines += [
            *errors_table(rows, a.after.noise_floor, flights, a.after.fitted),
            "",
            *_not_converged(a.after.complaint),
            notebook.NOW_ADEQUATE if a.after.adequate else notebook.STILL_MISSING,
            *_off_sheet(a.after),
        ]
        lines += _parameters(a.parameters, a.combinations)
        if a.converged and not a.after.adequate:
            lines += ["", f"next: {command('diagnose', a.loaded.directory.path, flights, mapping)}"]
    lines += [f"note: {note}" for x in flights for note in x.notes]
    return "\n".join(lines)


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
