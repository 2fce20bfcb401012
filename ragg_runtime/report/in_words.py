"""Results in words, as a terminal shows them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.score import Error, least
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.parameters import ParameterValue
from ragg_runtime.identification.ranking import Ranked
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.wording import notebook

if TYPE_CHECKING:
    from ragg_runtime.compensation.frozen import Held


def _error(e: Error) -> str:
    values = (
        (e.rms_Eo, 12, 5),
        (e.inline_Eo, 10, 4),
        (e.cross_Eo, 10, 4),
        (e.inline_Eo_per_rtHz, 12, 4),
        (e.cross_Eo_per_rtHz, 12, 4),
    )
    return " ".join(f"{x:{w}.{d}g}" if np.isfinite(x) else f"{'-':>{w}}" for x, w, d in values)


def _missing(errors: Sequence[Error], f: Fitted) -> list[str]:
    """Why some demodulated channels have no value, if any lack one."""
    if all(np.isfinite((e.inline_Eo, e.cross_Eo)).all() for e in errors):
        return []
    if not any(o.record.turning for o in f.observations):
        return ["-: of a disc that stands still nothing is demodulated"]
    longest = max(least(o.record.rate) for o in f.observations)
    return [
        f"-: the demodulator's low-pass needs {longest:.3g} s without a gap or a sample left out; "
        "there is no such stretch"
    ]


def not_converged(complaint: str | None) -> list[str]:
    return [] if complaint is None else [f"NOT CONVERGED: {complaint}"]


_SAID = 3
"""Most parameters beyond their sheet that are named."""


def off_sheet(result: Comparison | Diagnosis) -> list[str]:
    found = result.off_sheet
    more = [f"and {len(found) - _SAID} more"] if len(found) > _SAID else []
    said = [*(x.in_words() for x in found[:_SAID]), *more]
    return [f"note: {'; '.join(said)}"] if said else []


_HEAD = f"{'':12} {'rms Eo':>12} {'inline Eo':>10} {'cross Eo':>10} {'in Eo/rtHz':>12} {'cr Eo/rtHz':>12}"


def errors_table(rows: Sequence[tuple[str, Error]], noise: float, f: Fitted) -> list[str]:
    """Errors, the first before anything was done, above the noise floor; why some have no value."""
    return [
        _HEAD,
        *(f"{label:12} {_error(e)}" for label, e in rows),
        f"{'noise floor':12} {noise:12.5g}",
        *_missing([e for _, e in rows[1:]], f),
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
    names: Sequence[str],
    then: str,
    rows: Sequence[tuple[str, Error]] = (),
    *,
    judged: bool = True,
) -> str:
    """The result of ``compare``; ``then`` is the command that comes next where the model is not adequate.

    ``rows`` are other errors than the usual where nothing was fitted. Not ``judged``: the model's parameters are others
    now.
    """
    f = c.fitted
    lines = [
        f"{', '.join(names)}: {f.calibration.rows} samples, effects in the model: "
        f"{', '.join(e.id for e in f.model.effects) or 'none'}",
        *errors_table(
            rows or (("nominal", c.nominal), ("calibrated", c.calibrated), ("held out", c.holdout)),
            c.noise_floor,
            f,
        ),
        "",
        *not_converged(c.complaint),
        *([] if c.remark is None else [f"note: {c.remark}"]),
        *([notebook.ADEQUATE if c.adequate else notebook.NOT_ADEQUATE] if judged else []),
        *ladder(c),
        *off_sheet(c),
    ]
    where: Any = c.as_json()["where"]
    if where["motion"]:
        lines.append("\nwhere it fails (harmonic x motion term, share of the residual's power):")
        lines += [
            f"  {t['harmonic']:6} {t['term']:28} {100 * t['share']:6.1f} %   {t['z']:+8.1f} sigma"
            for t in where["motion"]
        ]
    if judged and not c.adequate:
        lines += ["", f"next: {then}"]
    return "\n".join(lines)


def _ranked(r: Ranked) -> str:
    p = notebook.p_value(r.log_p / math.log(10.0), r.p_value)
    errors = " ".join(f"{e.rms_Eo:10.4g}" for e in (r.before, r.after, r.after_holdout))
    return f"  {r.effect:28} {p:>8} {r.delta_bic:12.1f} {errors}"


def parameters(parameters: Sequence[ParameterValue], combinations: Sequence[ParameterValue]) -> list[str]:
    lines = [f"  {notebook.parameter(q.as_json())}" for q in parameters]
    if combinations:
        lines.append("  of which the record knows best:")
        lines += [f"  {notebook.parameter(q.as_json())}" for q in combinations]
    return lines


def combinations(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """Combinations of parameters, by their JSON, a line each."""
    return [f"  {notebook.parameter({'accelerometer': None, **q})}" for q in found]


def now(after: Comparison) -> str:
    """Whether anything is left once an effect was added."""
    return notebook.NOW_ADEQUATE if after.adequate else notebook.STILL_MISSING


def diagnosed(d: Diagnosis, then: str) -> str:
    """The result of ``diagnose``; ``then`` is the command that adds what was found."""
    lines = [
        notebook.verdict(d.verdict, d.found, [g.as_json() for g in d.groups]),
        *not_converged(d.complaint),
        *([] if d.remark is None else [f"note: {d.remark}"]),
        f"error {d.before.rms_Eo:.4g} Eo -> {d.after.rms_Eo:.4g} Eo rms, noise floor {d.noise_floor:.4g} Eo",
        "",
        f"  {'effect':28} {'p-value':>8} {'delta BIC':>12} {'before':>10} {'after':>10} {'held out':>10} Eo",
    ]
    lines += [_ranked(r) for r in d.ranking[:8]]
    for r in d.ranking:
        if r.effect in d.found:
            lines.append("")
            lines += parameters(r.parameters, r.combinations)
            if r.indistinguishable_from:
                lines.append(f"  this record cannot tell it from: {', '.join(r.indistinguishable_from)}")
    if d.verdict == "unexplained":
        left: Any = d.as_json()["unexplained"]
        if left["terms"]:
            lines.append("\n  what is left (harmonic x motion term):")
        for t in left["terms"]:
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
        lines += ["", f"next: {then}"]
    lines += off_sheet(d)
    return "\n".join(lines)


MOVED = 3.0
"""Standard deviations from which a combination is shown as moved."""


def held(h: Held, names: Sequence[str], then: str, again: str) -> str:
    """The result of ``compare --frozen``; ``then`` as of :func:`compared`, ``again`` is the command that calibrates anew."""
    rows = sorted(h.drift(), key=lambda r: -abs(r["z"]))
    moved = [r for r in rows if abs(r["z"]) > MOVED]
    errors = (("nominal", h.comparison.nominal), ("frozen", h.comparison.calibrated), ("free", h.free))
    lines = [
        compared(h.comparison, names, then, errors, judged=h.holds),
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
        lines += ["", f"next, if the instrument may have changed so: {again} --save"]
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


def watched(r: Mapping[str, Any], output: Path) -> str:
    """The result of ``compensate --calibration online`` (its JSON), written to a file."""
    within = r["follows_within_s"]
    lines = [
        f"{output}: sample by sample from the {r['started']}, noise {r['noise_Eo_per_rtHz']:.3g} Eo/sqrt(Hz)",
        f"the gradient wanders by {r['walk_Eo_per_rts']:.3g} Eo/sqrt(s)"
        + ("" if within is None else f" and is followed within {within:.3g} s")
        + "; the parameters "
        + ("forget nothing" if r["forget_s"] is None else f"forget within {r['forget_s']:.3g} s"),
    ]
    lines += [f"{x['flight']}: {x['samples']} samples" for x in r["flights"]]
    return "\n".join(lines)


CONTRIBUTIONS = 8
"""Contributions that are listed, the largest."""


def compensated(r: Mapping[str, Any], output: Path) -> str:
    """The result of ``compensate`` (its JSON), written to a file."""
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
    return "\n".join(lines)


def _output(x: Mapping[str, Any], r: Mapping[str, Any]) -> str:
    """Which output it is, if there are several."""
    return f": {x['output']}" if len({y["output"] for y in r["flights"]}) > 1 else ""
