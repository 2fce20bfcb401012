"""Every result, from its JSON, as sections: the terminal, the pages, notebooks and the studio show these and format nothing themselves."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from ragg_runtime.base.errors import count
from ragg_runtime.wording import numbers
from ragg_runtime.wording.numbers import join_names, number
from ragg_runtime.wording.sections import Section, Table, tabulate

Json = Mapping[str, Any]
Sections = tuple[Section, ...]
Columns = dict[str, Callable[[Json], str]]

ERROR_HEADS = {
    "rms_Eo": "rms, Eo",
    "inline_Eo": "inline, Eo",
    "cross_Eo": "cross, Eo",
    "inline_Eo_per_rtHz": "inline, Eo/√Hz",
    "cross_Eo_per_rtHz": "cross, Eo/√Hz",
}
"""Key of an error object -> the head of its column."""

RANKED = 6  # effects of a ranking that a terminal shows unless it is asked for all
# the combinations of four accelerometers that the paper's output depends on (Eq. 18-19).
PATTERNS = {"Sigma": "A1 + A2 + A3 + A4", "D1234": "A1 + A2 − A3 − A4", "D12": "A1 − A2", "D34": "A3 − A4"}
# standard deviations below which a value is shown on request alone; of a single accelerometer, where combinations are known
CLEAR, CLEAR_ALONE = 1.0, 3.0


def format_error(e: Json | None) -> str:
    """The error before demodulation of an error object."""
    return number((e or {}).get("rms_Eo"))


def format_value(p: Json) -> str:
    """Value, uncertainty and unit of a parameter, the last digits matching."""
    return numbers.with_unit(numbers.plus_minus(p["value"], p["std"]), p["unit"])


def label_parameter(p: Json) -> str:
    """``D34 of dK1/dT``, ``K_iii of A1``, ``tau``."""
    of, _, name = str(p["name"]).rpartition(" ")
    j = p.get("accelerometer")
    if of:
        return f"{of} of {numbers.parameter(name)}"
    which = "" if j is None else f" of {p.get('accelerometer_name') or f'A{j}'}"
    if single := re.fullmatch(r"(.*)\[(\d+)\]", name):  # of a combination of one
        name, which = single[1], f" of A{single[2]}"
    return f"{numbers.parameter(name)}{which}"


def write_parameter(p: Json) -> str:
    """A fitted parameter in one line."""
    return f"{label_parameter(p)} = {format_value(p)}"


def write_errors(before: Json | None, after: Json | None) -> str:
    """The error before and after a step."""
    return f"error {format_error(before)} → {format_error(after)} Eo"


def write_flights(names: Sequence[str]) -> str:
    return join_names([str(n) for n in names]) if len(names) < 4 else f"{len(names)} flights"


def write_effects(names: Sequence[str]) -> str:
    return f"effects in the model: {', '.join(map(str, names)) or 'none'}"


def group_notes(notes: Iterable[tuple[str, str]]) -> dict[str, list[str]]:
    """Every note once, with the flights that it is about, of (flight, note)."""
    about: dict[str, list[str]] = {}
    for flight, note in notes:
        about.setdefault(note, []).append(flight)
    return about


def tabulate_errors(rows: Sequence[tuple[str, Json | None]]) -> Section:
    """The table of errors, before demodulation and of both channels; a dash where there is none."""
    errors = [e for _, e in rows if e is not None]
    keys = [k for k in ERROR_HEADS if k == "rms_Eo" or any(e.get(k) is not None for e in errors)]
    cells = tuple((label, *(number((e or {}).get(k)) for k in keys)) for label, e in rows)
    reason = "the disc does not spin, or no part of the record is as long as the demodulator's low-pass."
    missing = bool(errors) and all(e.get("inline_Eo") is None for e in errors)
    note = f"No demodulated channels: {reason}" if missing else ""
    return Section("Errors", table=Table(("error", *(ERROR_HEADS[k] for k in keys)), cells, note=note))


def make_floor_row(c: Json) -> tuple[str, Json]:
    """The noise floor as a row of the table of errors; its densities are those of the demodulator's band."""
    floor = dict(c["noise_floor"])
    channels = {k: floor.get(f"{k}_Eo") for k in ("inline", "cross")}
    return "noise floor", floor | {f"{k}_Eo_per_rtHz": v and v / math.sqrt(0.2) for k, v in channels.items()}


def say_plainly(*sentences: str, title: str = "") -> Sections:
    return (Section(title, sentences),)


def label_term(t: Json) -> str:
    """``cos 2Ωt × ω_z``; ``cos 2Ωt`` of a harmonic without motion."""
    harmonic, motion = numbers.harmonic(str(t["harmonic"])), numbers.product(str(t["term"]))
    return harmonic if motion == "1" else f"{harmonic} × {motion}"


def tabulate_terms(terms: Sequence[Json]) -> Table:
    """Generic terms of a residual, the most significant first."""
    columns: Columns = {
        "harmonic × motion term": label_term,
        "coefficient": lambda t: numbers.plus_minus(float(t["coefficient"]), float(t["std"])),
        "unit": lambda t: numbers.unit_of_term(str(t["unit"])),
        "σ": lambda t: number(abs(float(t["z"]))),
        "share of the power": lambda t: numbers.percent(float(t["share"])),
    }
    return tabulate(terms, columns, brief=5)


def _describe_off_sheet(parameters: Sequence[Json]) -> Sections:
    """Parameters that the record puts far from their test sheet."""
    lines = [
        f"{label_parameter(x)} is {number(abs(x['sigmas']))} σ off its test sheet: {numbers.plain(x['value'])} instead of"
        f" {numbers.with_unit(numbers.plain(x['sheet']), x['unit'])}"
        for x in parameters
    ]
    summary = f"{len(lines)} parameters are far from their test sheet"
    title, long = "Far from the test sheet", len(lines) > 3
    return (Section(title, tuple(lines), detail=long, summary=summary),) if lines else ()


def excess(error: float, noise: float) -> float:
    """The part of an error beyond noise, Eo: the root of the difference of squares."""
    return math.sqrt(max(0.0, error**2 - noise**2))


def describe_comparison(
    c: Json, flights: Sequence[str], rows: Sequence[tuple[str, Json]] = (), *, judged: bool = True
) -> Sections:
    """The result of ``compare``; ``rows`` replace the usual errors, not ``judged``: the parameters are others now."""
    e, where = c["error"], c["where"]
    usual = [("nominal", e["nominal"]), ("calibrated", e["calibrated"]), ("held out", e["holdout"])]
    sentences = [
        *([write_comparison_headline(c)] if judged else []),
        f"{write_flights(flights)}: {numbers.fixed(c['samples'], 0)} samples at {numbers.hertz(c['rate_Hz'])};"
        f" {write_effects(c['effects'])}.",
        *([f"Note: {c['reason']!s}."] if c["converged"] and c["reason"] else []),
    ]
    sections = [
        Section(sentences=tuple(sentences), state="good" if c["adequate"] else "bad"),
        tabulate_errors([*(rows or usual), make_floor_row(c)]),
    ]
    if where["motion"]:
        worst = [
            f"The worst block of time: {number(b['from_s'], 4)} to {number(b['to_s'], 4)} s of {b['flight']!s},"
            f" {number(b['rms_Eo'])} Eo."
            for b in where["time"][:1]
            if b["over_noise"] > 1.15
        ]
        sections.append(Section("Where it fails", tuple(worst), tabulate_terms(where["motion"])))
    return (*sections, *_describe_off_sheet(c["off_sheet"]))


def write_comparison_headline(c: Json) -> str:
    """Whether the model is adequate, with the error, the noise and the tests."""
    if not c["converged"]:
        return f"The calibration has not converged: {c['reason']!s}."
    grounds = "" if c["adequate"] else "; ".join(map(str, c.get("grounds", ())))
    reason = f" ({grounds})" if grounds else ""
    return (
        f"The model is {'adequate' if c['adequate'] else 'NOT adequate'}: after calibration the error is"
        f" {format_error(c['error']['calibrated'])} Eo, the noise floor {format_error(c['noise_floor'])} Eo{reason}."
    )


def describe_held(c: Json, flights: Sequence[str]) -> Sections:
    """The result of ``compare --frozen``."""
    h = c["frozen"]
    frozen, free = c["error"]["calibrated"], h["free"]["calibrated"]
    holds, on = "holds" if h["holds"] else "does NOT hold", write_flights(list(h["flights"]))
    head = (
        f"The calibration on {on} {holds} here: its error is {format_error(frozen)} Eo, with parameters fitted to this record"
        f" {format_error(free)} Eo; the noise floor is {format_error(c['noise_floor'])} Eo.",
        f"It was made {h['made'][:16].replace('T', ' ')} UTC. Test against parameters fitted to this record: chi-square"
        f" {number(h['chi2'])} in {h['degrees_of_freedom']} directions ({numbers.equate_probability(h['log10_p'])}).",
    )
    rows = (("nominal", c["error"]["nominal"]), ("frozen", frozen), ("free", free))
    first, *others = describe_comparison(c, flights, rows, judged=False)
    sections = [Section(sentences=(*head, *first.sentences), state="good" if h["holds"] else "bad"), *others]
    if h["suspects"]:
        single: Columns = {
            "parameter": label_parameter,
            "change": lambda x: numbers.with_unit(number(x["change"], 3), x["unit"]),
            "explains": lambda x: numbers.percent(x["share"]),
        }
        title = "Single parameters whose change would explain it"
        sections.append(Section(title, table=tabulate(h["suspects"], single)))
    return tuple(sections)


def write_verdict(d: Json) -> str:
    """The verdict of a diagnosis, with its numbers, in one sentence or two."""
    before, after, noise = d["error"]["before"], d["error"]["after"], d["noise_floor"]
    terms, floor = d["unexplained"]["terms"], f"the noise floor is {format_error(noise)} Eo"
    claims = join_names([_name_alternatives(e, d["groups"]) for e in d["found"]])
    mostly = f", mostly at {label_term(terms[0])}" if terms else ""
    remain, left = (excess(e["rms_Eo"], noise["rms_Eo"]) for e in (before, after))
    clearly = 0.05 * noise["rms_Eo"]
    rest = f"{number(left)} Eo" if left > clearly else "less than the noise"
    other = f"the other {number(remain)} Eo" if remain > clearly else "the systematic part of it"
    it = "it" if len(d["found"]) == 1 else "them"
    falls = f"With {it} the error falls from {format_error(before)} to {format_error(after)} Eo"
    if not after["rms_Eo"] < before["rms_Eo"] * (1.0 - 1e-6):
        falls = f"The error stays {format_error(before)} Eo"
    if not d["converged"] and d["verdict"] != "partly-explained":
        return f"No verdict: {d['remark']!s}."
    sentences = {
        "adequate": f"Adequate: this record shows no missing effect. After calibration the error is {format_error(before)} Eo,"
        f" the noise floor {format_error(noise)} Eo.",
        "missing-effect": f"Missing: {claims}. {falls}; {floor}.",
        "partly-explained": f"Partly explained: {claims}. {falls}. Not yet explained: {rest}{mostly}.",
        "unexplained": f"Unexplained: {format_error(before)} Eo remain where {floor}, and no effect of the catalogue accounts for"
        f" {other}{mostly}.",
    }
    return sentences[d["verdict"]]


def _name_alternatives(effect: str, groups: Sequence[Json]) -> str:
    """The effect, or those of which the record shows one."""
    same = next((g["effects"] for g in groups if g["effects"][0] == effect), [effect])
    return f"one of {join_names(list(map(str, same)), 'or')}" if len(same) > 1 else str(effect)


def choose_values(r: Json) -> list[Json]:
    """One value of every parameter of an effect: of its combinations, or single values, the most significant one."""
    groups: dict[str, list[Json]] = {}
    for q in _list_values(r):
        groups.setdefault(str(q["name"]).rpartition(" ")[2], []).append(q)
    best = [max([q for q in same if q.get("weights")] or same, key=significance) for same in groups.values()]
    clear = [q for q in best if significance(q) > CLEAR]
    return sorted(clear or best, key=significance, reverse=True)


def significance(p: Json) -> float:
    return abs(p["value"]) / p["std"] if p["std"] > 0.0 else math.inf


def describe_finding(r: Json) -> str:
    """An effect in one line: what, its value, the error before and after, held out."""
    values = ", ".join(write_parameter(p) for p in choose_values(r)[:3])
    holdout = r.get("error_after_holdout")
    errors = f"{write_errors(r['error_before'], r['error_after'])}, held out {format_error(holdout)} Eo"
    return f"{r['effect']!s}: {values}{'; ' if values else ''}{errors}"


def _list_values(effect: Json) -> list[Json]:
    return [*effect["combinations"], *effect["parameters"]]


def _is_clear(p: Json, effect: Json) -> bool:
    alone = p["accelerometer"] is not None and bool(effect["combinations"])
    return significance(p) > (CLEAR_ALONE if alone else CLEAR)


def explain_patterns(values: Sequence[Json]) -> list[str]:
    """The definition of each combination that appears among the values."""
    named = {str(p["name"]).rpartition(" ")[0] for p in values}
    patterns = [f"{name} = {PATTERNS[name]}" for name in PATTERNS if name in named]
    return [f"{', '.join(patterns)}, each accelerometer weighted by its scale factor."] if patterns else []


def describe_values(effects: Sequence[Json], *, explained: bool = False) -> Sections:
    """All values of effects (name, parameters, combinations): those that are larger than their uncertainty, and the others.

    ``explained``: their combinations have been explained.
    """
    values = [(e, p) for e in effects for p in _list_values(e)]
    if not values:
        return ()
    ordered = [(e, p) for e in effects for p in sorted(_list_values(e), key=significance, reverse=True)]
    clear = [(e, p) for e, p in ordered if _is_clear(p, e)]
    columns: dict[str, Callable[[tuple[Json, Json]], str]] = {
        "effect": lambda x: str(x[0]["effect"]),
        "parameter": lambda x: label_parameter(x[1]),
        "value": lambda x: format_value(x[1]),
    }
    note = "" if explained else " ".join(explain_patterns([p for _, p in clear]))
    sections = [Section("Values", table=tabulate(clear, columns, words=3, note=note))] if clear else []
    if hidden := len(values) - len(clear):
        summary = f"also {count(hidden, 'value')} of little significance"
        table = tabulate(values, columns, words=3)
        sections.append(Section("All values", table=table, detail=True, summary=summary))
    return tuple(sections)


def describe_diagnosis(d: Json) -> Sections:
    """The result of ``diagnose``."""
    claimed = [r for r in d["ranking"] if r["effect"] in d["found"]]
    values = [p for e in claimed for p in _list_values(e) if _is_clear(p, e)]
    lines = (write_verdict(d), *map(describe_finding, claimed), *_list_remarks(d), *explain_patterns(values))
    state = {"adequate": "good", "unexplained": "bad"}.get(d["verdict"], "found")
    first = Section(sentences=lines, state=state)
    rows = [("current model", d["error"]["before"])]
    if d["found"]:
        rows.append((f"with {join_names([str(e) for e in d['found']])}", d["error"]["after"]))
    sections = [first, tabulate_errors([*rows, make_floor_row(d)]), *describe_values(claimed, explained=True)]
    terms = d["unexplained"]["terms"]
    if terms and d["verdict"] in ("unexplained", "partly-explained"):
        sections.append(Section(title="Not explained", table=tabulate_terms(terms)))
        sections += _suggest_own_effect(d["unexplained"])
    sections += _describe_evidence(d)
    if d["next_motion"]:
        sections.append(Section("Next motion", tuple(map(write_motion, d["next_motion"]))))
    sections += _list_untestable(d)
    return (*sections, *_describe_off_sheet(d["off_sheet"]))


def _list_remarks(d: Json) -> list[str]:
    """Remarks on the verdict: its reason, groups, flights that disagree, from when on the model fails."""
    judged = d["converged"] or d["verdict"] == "partly-explained"
    remarks = [f"Note: {text}." for text in d["notes"]] if judged else []
    for g in d["groups"]:
        main, *others = map(str, g["effects"])
        if others:
            term = f"; {g['name']!s} explains as much" if g["name"] else ""
            remarks.append(
                f"This record cannot distinguish {main} from {join_names(others, 'or')}{term}: they are one finding."
            )
    for x in d.get("disagree") or ():
        unknown = [] if x["explained"] else ["something that no effect explains"]
        what = join_names([*map(str, x["found"]), *unknown]) or "no effect"
        remarks.append(
            f"Alone, {write_flights(x['flights'])} {'needs' if len(x['flights']) == 1 else 'need'} {what}."
        )
    if d["holds_until_s"] is not None:
        remarks.append(
            f"The fit fails from {number(d['holds_until_s'], 4)} s of {d['holds_until_flight']!s} on."
        )
    nearest = d["ranking"][:1] if d["verdict"] == "unexplained" and d["converged"] else ()
    for best in (r for r in nearest if r["log10_p"] is not None and r["log10_p"] < -4.0):
        remarks.append(
            f"The nearest effect of the catalogue is {best['effect']!s} (error {format_error(best['error_after'])} Eo with it), which is"
            " not claimed: probabilities compare the effects of the catalogue only, and the cause may be another one."
        )
    return remarks


def _describe_evidence(d: Json) -> Sections:
    if not d["ranking"]:
        return say_plainly("No effect of the catalogue could be tested on this record.")
    columns: Columns = {
        "effect": lambda r: str(r["effect"]),
        "p-value": lambda r: numbers.probability(r["log10_p"]),
        "probability": lambda r: chance(r["probability"]),
        "error with it, Eo": lambda r: format_error(r["error_after"]),
        "held out, Eo": lambda r: format_error(r["error_after_holdout"]),
    }
    note = "p-value: chance of so much evidence without the effect; probability: among the effects of the catalogue."
    brief, strong = max(RANKED, len(d["found"])), frozenset(d["found"])
    return (
        Section("Evidence", table=tabulate(d["ranking"], columns, strong=strong, brief=brief, note=note)),
    )


def chance(p: float | None, log10_p: float | None = None) -> str:
    """A probability: two digits, never 1 and never 0 for what is neither; where there is none, the p-value if that is given."""
    if p is None:
        return numbers.ABSENT if log10_p is None else f"p {numbers.probability(log10_p)}"
    return "> 0.99" if p > 0.995 else "< 0.01" if p < 0.005 else f"{p:.2f}"


def _suggest_own_effect(u: Json) -> Sections:
    if not u["expression"]:
        return ()
    sentences = [
        "To make the strongest term an effect of your own, put this line into effects = [...] of model.toml, then add it:"
    ]
    if u.get("needs"):
        sentences.append(f"The flight then needs further columns: {join_names(list(u['needs']))}.")
    return (Section("As an effect of your own", tuple(sentences), code=(u["expression"],)),)


def write_motion(p: Json) -> str:
    """The effects that a motion would separate, from the JSON of a proposal."""
    if not p["separates"]:
        return (
            f"No sinusoid about one axis within the limits separates {p['effect']} from {p['rival']} (at best"
            f" {number(p['separation_then'], 2)} σ)."
        )
    size = (
        f"{number(p['amplitude'] / 9.80665e-3)} mg"
        if p["unit"] == "m/s^2"
        else f"{number(math.degrees(p['amplitude']) * 3600)} deg/h"
    )
    return (
        f"To separate {p['effect']} from {p['rival']}: {number(p['duration_s'])} s of {p['axis']} = {size} at"
        f" {number(p['frequency_Hz'])} Hz ({p['frequency_over_spin']:g} times the spin), {number(p['separation_now'], 2)} →"
        f" {write_promise(p['separation_then'], p['separation_spread'])} σ."
    )


def write_promise(sigmas: float, spread: float) -> str:
    """A separation that a motion promises, with its spread where that shows."""
    return number(sigmas) if spread < 0.05 * sigmas else numbers.plus_minus(sigmas, spread)


def write_size(s: Json) -> str:
    """``dK1/dT = 8.4 × 10⁻⁹ 1/K``: the least size of a parameter that a record would have shown."""
    size = numbers.with_unit(number(s["three_sigma"], 2), s["unit"])
    return f"{numbers.parameter(s['name'])}{numbers.NO_BREAK}={numbers.NO_BREAK}{size}"


def _list_untestable(d: Json) -> Sections:
    """Effects that this record cannot test, and how large the others would have to be."""
    silent = tuple((str(n["effect"]), str(n["why"])) for n in d["not_testable"])
    sizes: dict[str, list[str]] = {}
    for s in d["detectable"]:
        sizes.setdefault(s["effect"], []).append(write_size(s))
    sections = []
    if silent:
        summary = f"{count(len(silent), 'effect')} of the catalogue cannot be tested on this record"
        table = Table(("effect", "why"), silent, words=2)
        sections.append(Section("Not testable", table=table, detail=True, summary=summary))
    if sizes:
        rows = tuple((str(e), ", ".join(v)) for e, v in sizes.items())
        note = "Size that would be significant at three standard deviations, in the accelerometer that shows it best."
        table = Table(("effect", "detection limit (3 σ)"), rows, words=2, note=note)
        sections.append(Section("Detection limits", table=table, detail=True))
    return tuple(sections)


def describe_step(
    added: Sequence[str], removed: Sequence[str], before: Json, after: Json, values: Sequence[Json]
) -> Sections:
    """What a step of the model did to the error; ``before`` and ``after``: errors, noise floor, whether it is adequate.

    ``values`` are the effects of the model afterwards with their parameters.
    """
    did = (("added", added), ("removed", removed))
    done = [f"{what} {join_names([str(e) for e in names])}" for what, names in did if names]
    old, new = (x.get("error", x) for x in (before, after))
    end = "the model is now adequate" if after["adequate"] else "the model is still NOT adequate"
    head = join_names(done) or "the test sheet changed"
    text = [
        f"{head[:1].upper()}{head[1:]}: {write_errors(old['calibrated'], new['calibrated'])}, held out {format_error(new['holdout'])} Eo;"
        f" the noise floor is {format_error(after['noise_floor'])} Eo, and {end}."
    ]
    if new["holdout"]["rms_Eo"] > old["holdout"]["rms_Eo"]:
        text.append("Held out, the error does not fall: this record does not confirm the step.")
    rows = [("before", old["calibrated"]), ("after", new["calibrated"]), ("held out", new["holdout"])]
    first = Section(sentences=tuple(text), state="good" if after["adequate"] else "found")
    return (first, tabulate_errors([*rows, make_floor_row(after)]), *describe_values(values))


def describe_addition(a: Json, effects: Sequence[str]) -> Sections:
    """The result of ``add``; ``effects`` are those of the model afterwards."""
    if not a.get("converged", True):
        return say_plainly(f"{a['effect']!s} was NOT added: {a['reason']!s}.")
    if a["before"] is None or a["after"] is None:
        return say_plainly(f"Added {a['effect']!s}; {write_effects(effects)}.")
    return (
        *describe_step([a["effect"]], [], a["before"], a["after"], [a]),
        *say_plainly(f"{write_effects(effects)}."),
        *_describe_off_sheet(a["off_sheet"]),
    )


def find_rms(entry: Json | None, which: str = "calibrated") -> float | None:
    """rms_Eo of a step of a history; ``None`` if it has none."""
    entry = entry or {}
    value = (entry.get(which, entry if which == "calibrated" else None) or {}).get("rms_Eo")
    return None if value is None else float(value)


def tabulate_history(steps: Sequence[Json]) -> Table:
    """The error before and after every step."""
    columns: Columns = {
        "when, UTC": lambda s: str(s["time"])[:16].replace("T", " "),
        "step": lambda s: str(s["action"]),
        "effect": lambda s: str(s["effect"] or numbers.ABSENT),
        "before, Eo": lambda s: number(find_rms(s.get("before"))),
        "after, Eo": lambda s: number(find_rms(s.get("after"))),
        "held out, Eo": lambda s: number(find_rms(s.get("after"), "holdout")),
    }
    return tabulate(steps, columns, words=3)


def describe_model(name: str, effects: Sequence[str], steps: Sequence[Json]) -> Sections:
    """A model directory and its history."""
    return (Section(sentences=(f"{name!s}; {write_effects(effects)}",), table=tabulate_history(steps)),)


def summarize(kind: str, verdict: str, *errors: tuple[str, float | None]) -> str:
    """The ``repr`` of a result: its kind, its headline, errors in Eo."""
    text = ", ".join(f"{name} {number(x)}" for name, x in errors)
    return numbers.to_ascii(f"<{kind}: {verdict}; {text} Eo>")
