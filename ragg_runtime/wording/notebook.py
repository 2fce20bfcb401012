"""Results as notebooks show them: fragments of HTML, escaped, from the JSON of a result, in the words of the terminal."""

from __future__ import annotations

import html
import math
import unicodedata
from collections.abc import Mapping, Sequence
from typing import Any

ADEQUATE = "The model is adequate: nothing significant is left."
NOT_ADEQUATE = "The model is NOT adequate. Find what is missing: ragg diagnose"
NOW_ADEQUATE = "The model is now adequate."
STILL_MISSING = "Something is still missing: ragg diagnose"

ERRORS = ("rms_Eo", "inline_Eo", "cross_Eo", "inline_Eo_per_rtHz", "cross_Eo_per_rtHz")
ERROR_HEADS = ("", "rms Eo", "inline Eo", "cross Eo", "in Eo/rtHz", "cr Eo/rtHz")

RANKED = 8
"""Effects of a ranking that are shown."""

FLIGHTS = 60
"""Flights of a survey that are shown one by one."""

_CELL = "padding:.15em .7em;text-align:{};white-space:nowrap"


def verdict(name: str, found: Sequence[str], groups: Sequence[Mapping[str, Any]] = ()) -> str:
    """What a diagnosis says, in one line; of a group that has a name, the name."""
    named = {g["effects"][0]: g for g in groups if g["name"]}
    said = [
        e if e not in named else f"{named[e]['name']} ({' or '.join(named[e]['effects'])})" for e in found
    ]
    return {
        "adequate": "ADEQUATE: nothing significant is missing.",
        "missing-effect": f"MISSING: {' and '.join(said)}",
        "unexplained": "UNEXPLAINED: something is missing that no effect of the catalogue accounts for.",
    }[name]


def parameter(p: Mapping[str, Any]) -> str:
    """A fitted parameter in one line."""
    j = p["accelerometer"]
    which = "" if j is None else f" of {p.get('accelerometer_name', f'A{j}')}"
    own = p["name"].split(" ")[-1]
    sum_ = " ".join(f"{w:+.4g} {own}[{j}]" for j, w in enumerate(p.get("weights", ()), 1) if w)
    return f"{p['name']}{which} = {p['value']:.4g} +- {p['std']:.2g} {p['unit']}{sum_ and f'  ({sum_})'}"


def p_value(log10_p: float | None, value: float) -> str:
    """A p-value, also where it underflows."""
    if log10_p is None or math.isinf(log10_p):
        return "certain"
    return f"1e{log10_p:.0f}" if log10_p < -6.0 / math.log(10.0) else f"{value:.2g}"


def comparison(c: Mapping[str, Any], flights: Sequence[str]) -> str:
    """The result of ``compare``."""
    rows = [
        _error("nominal", c["error"]["nominal"]),
        _error("calibrated", c["error"]["calibrated"]),
        _error("held out", c["error"]["holdout"]),
        _noise(c["noise_floor"]["rms_Eo"]),
    ]
    where = c["where"]["motion"]
    return _fragment(
        _line(
            f"{', '.join(flights)}: {c['samples']} samples, effects in the model:"
            f" {', '.join(c['effects']) or 'none'}"
        ),
        _table(ERROR_HEADS, rows),
        *_not_converged(c),
        _line(ADEQUATE if c["adequate"] else NOT_ADEQUATE, strong=True),
        *(
            [
                _line("where it fails:"),
                _table(
                    ("harmonic", "motion term", "share of the power", "sigma"),
                    [
                        (t["harmonic"], t["term"], f"{100 * t['share']:.1f} %", f"{t['z']:+.1f}")
                        for t in where
                    ],
                    words=2,
                ),
            ]
            if where
            else []
        ),
    )


def _not_converged(x: Mapping[str, Any]) -> list[str]:
    return [] if x.get("converged", True) else [_line(f"NOT CONVERGED: {x['reason']}", strong=True)]


def calibration(c: Mapping[str, Any], flights: Sequence[str]) -> str:
    """The result of ``calibrate``."""
    e = c["error"]
    rows = [_error(label, e[key]) for label, key in (("nominal", "nominal"), ("calibrated", "calibrated"))]
    rows += [_error("held out", e["holdout"]), _noise(c["noise_floor"]["rms_Eo"])]
    seen = c["directions"]
    return _fragment(
        _line(
            f"calibrated on {', '.join(flights)}" + ("" if c["converged"] else ", NOT converged"), strong=True
        ),
        _table(ERROR_HEADS, rows),
        _line(f"the record determines {seen['seen']} of {seen['fitted']} directions:"),
        *(_line(parameter({"accelerometer": None, **q})) for q in c["combinations"]),
    )


def compensation(c: Mapping[str, Any]) -> str:
    """The result of ``compensate``."""
    d = c["demodulator"]
    parts = [_line(f"compensated, calibration {c['calibration']}, {d['what']}", strong=True)]
    rows = []
    for x in c["flights"]:
        density, std = x["density"], x["std"]
        for channel in ("inline", "cross"):
            key = f"{channel}_Eo_per_rtHz"
            shown = (density["before"][key], density["after"][key], density["noise"][key])
            sizes = (std["noise"][f"{channel}_Eo"], std["parameters"][f"{channel}_Eo"])
            rows.append((x["flight"], channel, *(number(v) for v in (*shown, *sizes))))
    heads = ("flight", "channel", "before Eo/rtHz", "after", "noise", "std by noise Eo", "by parameters")
    parts.append(_table(heads, rows, words=2))
    return _fragment(*parts)


def diagnosis(d: Mapping[str, Any]) -> str:
    """The result of ``diagnose``."""
    before, after = d["error"]["before"]["rms_Eo"], d["error"]["after"]["rms_Eo"]
    rows = [
        (
            r["effect"],
            p_value(r["log10_p"], r["p_value"]),
            number(r["delta_bic"], "{:.1f}"),
            *(number(r[k]["rms_Eo"]) for k in ("error_before", "error_after", "error_after_holdout")),
        )
        for r in d["ranking"][:RANKED]
    ]
    parts = [
        _line(verdict(d["verdict"], d["found"], d["groups"]), strong=True),
        *_not_converged(d),
        _line(
            f"error {number(before)} Eo -> {number(after)} Eo rms,"
            f" noise floor {number(d['noise_floor']['rms_Eo'])} Eo"
        ),
        _table(("effect", "p-value", "delta BIC", "before Eo", "after Eo", "held out Eo"), rows, d["found"]),
    ]
    for r in d["ranking"]:
        if r["effect"] in d["found"]:
            parts += _values(r["parameters"], r["combinations"])
            if r["indistinguishable_from"]:
                parts.append(
                    _line(f"this record cannot tell it from: {', '.join(r['indistinguishable_from'])}")
                )
    if d["verdict"] == "unexplained":
        terms = [
            (t["harmonic"], t["term"], f"{t['coefficient']:+.4g}", t["unit"], f"{t['z']:+.1f}")
            for t in d["unexplained"]["terms"]
        ]
        parts += [
            _line("what is left:"),
            _table(("harmonic", "motion term", "coefficient", "unit", "sigma"), terms, words=2),
        ]
        if d["unexplained"]["expression"]:
            parts += [
                _line("to keep it as an effect of your own, put this into effects of model.toml:"),
                f"<pre>{_escaped(d['unexplained']['expression'])}</pre>",
            ]
        if d["unexplained"].get("needs"):
            parts.append(_line(f"and this into the flight: {'; '.join(d['unexplained']['needs'])}"))
    if d["not_testable"]:
        silent = [(n["effect"], n["why"]) for n in d["not_testable"]]
        table = _table(("effect", "why"), silent, words=2)
        parts.append(f"<details><summary>not testable on this record</summary>{table}</details>")
    return _fragment(*parts)


def added(a: Mapping[str, Any], effects: Sequence[str], noise: float | None, adequate: bool) -> str:
    """The result of ``add``; ``noise`` and ``adequate`` are those after it."""
    done = f"added {a['effect']}" if a.get("converged", True) else f"{a['effect']} was NOT added"
    parts = [_line(f"{done}; effects: {', '.join(effects)}", strong=True), *_not_converged(a)]
    if a["before"] is not None and a["after"] is not None and noise is not None:
        rows = [
            _error("before", a["before"]["calibrated"]),
            _error("after", a["after"]["calibrated"]),
            _error("held out", a["after"]["holdout"]),
            _noise(noise),
        ]
        parts += [_table(ERROR_HEADS, rows), _line(NOW_ADEQUATE if adequate else STILL_MISSING)]
        parts += _values(a["parameters"], a["combinations"])
    return _fragment(*parts)


def catalogue(entries: Sequence[Mapping[str, Any]]) -> str:
    """The catalogue of effects."""
    rows = [(e["id"], e["title"], e["equation"], ", ".join(e["channels"])) for e in entries]
    return _fragment(_table(("effect", "what", "equation", "needs"), rows, words=4))


def in_one_line(kind: str, said: str, *errors: tuple[str, float | None]) -> str:
    """The ``repr`` of a result: what it is, what it says, errors in Eo."""
    return f"<{kind}: {said}; {', '.join(f'{name} {number(x)}' for name, x in errors)} Eo>"


def rms_of(error: Mapping[str, Any] | None, which: str = "calibrated") -> float | None:
    """rms_Eo of an error object, or of that one of the three of ``compare``; ``None`` if it has none."""
    inner = error.get(which, error if which == "calibrated" else None) if error else None
    value = inner.get("rms_Eo") if inner else None
    return None if value is None else float(value)


def model(name: str, effects: Sequence[str], steps: Sequence[Mapping[str, Any]]) -> str:
    """A model directory and its history."""
    rows = []
    for s in steps:
        errors = []
        for key in ("before", "after"):
            rms = rms_of(s[key])
            errors.append("-" if rms is None else number(rms))
        rows.append((s["time"], s["action"], s["effect"] or "-", *errors))
    return _fragment(
        _line(f"{name}: effects: {', '.join(effects) or 'none'}", strong=True),
        _table(("when", "step", "effect", "before Eo", "after Eo"), rows, words=3),
    )


def survey(flights: Sequence[Mapping[str, Any]], counted: str, advice: Sequence[str]) -> str:
    """The result of ``survey``: its records, the counts of verdicts and what is recommended, in sentences."""
    done = [r for r in flights if "verdict" in r]
    rows = [
        (
            r["flight"],
            r["verdict"],
            " ".join(r["found"]),
            *(number((r["error"][k] or {}).get("rms_Eo")) for k in ("calibrated", "holdout", "after")),
            number(r["noise_floor"]["rms_Eo"]),
        )
        for r in done[:FLIGHTS]
    ]
    heads = ("flight", "verdict", "found", "calibrated Eo", "held out Eo", "after Eo", "noise Eo")
    failed = [(r["flight"], r["error"]["message"].split("\n")[0]) for r in flights if "verdict" not in r]
    parts = [_line(counted, strong=True), *(_line(text) for text in advice)]
    if rows:
        parts.append(_table(heads, rows, words=3))
    if len(done) > FLIGHTS:
        parts.append(_line(f"and {len(done) - FLIGHTS} more"))
    if failed:
        parts += [_line("flights in error:"), _table(("flight", "what is wrong"), failed, words=2)]
    return _fragment(*parts)


def number(x: float | None, form: str = "{:.4g}") -> str:
    """A number in four digits; a dash for none."""
    return "-" if x is None or not math.isfinite(x) else form.format(x)


def _error(label: str, e: Mapping[str, Any]) -> tuple[str, ...]:
    return (label, *(number(e[k]) for k in ERRORS))


def _noise(x: float) -> tuple[str, ...]:
    return ("noise floor", number(x), *[""] * (len(ERRORS) - 1))


def _values(parameters: Sequence[Mapping[str, Any]], combined: Sequence[Mapping[str, Any]]) -> list[str]:
    found = [_line(parameter(p)) for p in parameters]
    if combined:
        found.append(_line("of which the record knows best:"))
        found += [_line(parameter(p)) for p in combined]
    return found


def _escaped(text: object) -> str:
    """Text of strangers: no markup, no control characters, no marks that reverse the line."""
    plain = "".join(
        "\ufffd" if unicodedata.category(c) in ("Cc", "Cf", "Cs", "Co", "Cn") else c for c in str(text)
    )
    return html.escape(plain)


def _line(text: str, *, strong: bool = False) -> str:
    weight = "font-weight:600;" if strong else ""
    return f'<div style="{weight}margin:.2em 0">{_escaped(text)}</div>'


def _table(
    heads: Sequence[str], rows: Sequence[Sequence[str]], bold: Sequence[str] = (), words: int = 1
) -> str:
    """The first ``words`` columns are text, the others numbers; rows that begin with one of ``bold`` are bold."""

    def cells(tag: str, row: Sequence[str]) -> str:
        return "".join(
            f'<{tag} style="{_CELL.format("left" if k < words else "right")}">{_escaped(x)}</{tag}>'
            for k, x in enumerate(row)
        )

    weight = ("<tr>", '<tr style="font-weight:600">')
    body = "".join(f"{weight[row[0] in bold]}{cells('td', row)}</tr>" for row in rows)
    head = f"<thead><tr>{cells('th', heads)}</tr></thead>"
    return f'<table style="border-collapse:collapse;margin:.4em 0">{head}<tbody>{body}</tbody></table>'


def _fragment(*parts: str) -> str:
    return f'<div class="ragg">{"".join(parts)}</div>'
