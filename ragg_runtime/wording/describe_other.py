"""Results other than comparisons and diagnoses as sections: calibration, compensation, surveys, files, the catalogue."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ragg_runtime.base.errors import count
from ragg_runtime.wording import numbers
from ragg_runtime.wording.describe import (
    CLEAR,
    Columns,
    Json,
    Sections,
    explain_patterns,
    format_error,
    format_value,
    group_notes,
    label_parameter,
    label_term,
    make_floor_row,
    say_plainly,
    significance,
    tabulate_errors,
    write_effects,
    write_errors,
    write_flights,
    write_promise,
)
from ragg_runtime.wording.numbers import number
from ragg_runtime.wording.sections import Section, Table, tabulate

LISTED = 60  # flights of a survey that are listed one by one


FROM = {
    "frozen": "of the saved calibration",
    "self": "fitted to these flights",
    "crossed": "of every block of time fitted to the others",
    "smoothed": "fitted to these flights, drifting from block to block",
}
"""Where the parameters of a compensation come from."""


UNTIMED = (
    "The time stamps do not say how much time lies between the flights: they are taken to follow one another without a gap. With dates, "
    "or an origin in a mapping, parameters drift on between them."
)


def describe_calibration(c: Json, flights: Sequence[str]) -> Sections:
    """The result of ``calibrate``."""
    e, directions, model = c["error"], c["directions"], write_effects(c["effects"])
    head = (
        f"Calibrated on {write_flights(flights)}: {write_errors(e['nominal'], e['calibrated'])}, held out {format_error(e['holdout'])} Eo;"
        f" the noise floor is {format_error(c['noise_floor'])} Eo."
        if c["converged"]
        else "The calibration has NOT converged: do not rely on these values."
    )
    text = (
        f"The record determines {directions['seen']} of {directions['fitted']} directions of the parameters; the rest stay at their"
        f" test-sheet values. {model[:1].upper()}{model[1:]}."
    )
    rows = [("nominal", e["nominal"]), ("calibrated", e["calibrated"]), ("held out", e["holdout"])]
    return (
        Section(sentences=(head, text), state="good" if c["converged"] else "bad"),
        tabulate_errors([*rows, make_floor_row(c)]),
        *tabulate_parameters(c["combinations"], c["parameters"]),
        *(_describe_drift(c["drifting"]) if "drifting" in c else ()),
        *(_describe_certificate(c["certificate"], c["certified"]) if "certificate" in c else ()),
    )


def tabulate_parameters(
    combinations: Sequence[Json], parameters: Sequence[Json], *, detail: bool = False
) -> Sections:
    """The combinations that a record determines, and every parameter next to its test sheet."""
    clear = [p for p in combinations if significance(p) > CLEAR]
    value: Columns = {"parameter": label_parameter, "value": format_value}
    sheet: Columns = {
        "test sheet": lambda p: numbers.plain(p["sheet"]),
        "its uncertainty": lambda p: numbers.plain(p["sheet_sigma"], 3),
        "shift, σ of the sheet": lambda p: numbers.fixed((p["value"] - p["sheet"]) / p["sheet_sigma"], 2),
    }
    note = " ".join(explain_patterns(clear))
    summary = f"all {len(parameters)} parameters"
    best = tabulate(clear, value, words=2, note=note)
    table = tabulate(parameters, value | sheet, words=2)
    return (
        Section("Best-determined combinations", table=best, detail=detail),
        Section("Every parameter", table=table, detail=True, summary=summary),
    )


def _describe_drift(d: Json) -> Sections:
    """Which kinds of parameter drift, and how fast; those of each accelerometer in detail."""
    note = () if d["timed"] else (UNTIMED,)
    if not d["rates"]:
        return say_plainly(
            "No parameter drifts by as much as these flights could show.", *note, title="Drift"
        )
    walks: Columns = {
        "parameter": lambda r: str(r["name"]),
        "walk": lambda r: numbers.with_unit(number(r["per_root_hour"], 2), f"{r['unit']}/√h"),
    }
    states: dict[tuple[str, str], list[Json]] = {}
    for q in d["states"]:
        states.setdefault((q["name"], q["accelerometer"]), []).append(q)
    rows = tuple((label_parameter(q[0]), format_value(q[0]), format_value(q[-1])) for q in states.values())
    ends = Table(("parameter", "at the beginning", "at the end"), rows)
    summary = f"{len(rows)} parameters at the beginning and at the end"
    text = "These kinds of parameter follow random walks, of this standard deviation after an hour."
    return (
        Section("Drift", (text, *note), tabulate(d["rates"], walks)),
        Section("Drift of each parameter", table=ends, detail=True, summary=summary),
    )


def _describe_certificate(rows: Sequence[Json], certified: Json) -> Sections:
    """Planned and reached: channels and combinations, then each parameter, those that were not reached first."""
    columns: Columns = {
        "parameter": label_parameter,
        "value": lambda q: "not determined" if q["value"] is None else format_value({**q, "std": q["std_reached"]}),
        "before": lambda q: number(q["std_before"], 2),
        "planned": lambda q: number(q["std_planned"], 2),
        "": lambda q: "" if q["reached"] else "NOT reached",
    }  # fmt: skip
    text = [
        f"Parameters add {number(x['reached'], 3)} Eo rms to the {name.removesuffix('_Eo')} channel "
        f"(before {number(x['before'], 3)}, planned {number(x['planned'], 3)})."
        for name, x in certified["channels"].items()
    ]
    values = (*certified["combinations"], *rows)
    reached = sum(q["reached"] for q in values)
    text.append(f"{reached} of {len(values)} values are as certain as planned (standard uncertainty).")
    first, second = (
        tabulate(sorted(x, key=lambda q: q["reached"]), columns, words=2)
        for x in (certified["combinations"], rows)
    )
    return (
        Section("Certificate", tuple(text), first),
        Section("Certificate of each parameter", table=second, detail=True, summary=f"all {len(rows)} parameters"),
    )  # fmt: skip


def describe_compensation(r: Json, output: str) -> Sections:
    """The result of ``compensate``, written to a file."""
    d = r["demodulator"]
    lag = f", {number(d['latency_s'])} s late" if d["latency_s"] else ""
    parameters = f"{output}: parameters" if output else "Parameters"
    head = [f"{parameters} {FROM[r['calibration']]}; demodulator: {d['what']}{lag}."]
    if not r["converged"]:
        head.append("The calibration has NOT converged: do not rely on these values.")
    sections = [
        Section(sentences=(*head, *map(str, r.get("notes", ()))), state="good" if r["converged"] else "bad")
    ]
    several = len({x["output"] for x in r["flights"]}) > 1
    meanings = [str(x).split(": ", 1) for x in r["quality"].values()]
    parts: Columns = {
        "": lambda q: str(q["of"]),
        "inline, Eo": lambda q: number(q["inline_Eo"]),
        "cross, Eo": lambda q: number(q["cross_Eo"]),
    }
    for x in r["flights"]:
        name = str(x["flight"]) + (f": {x['output']!s}" if several else "")
        samples, values, good = (numbers.fixed(x[k], 0) for k in ("samples", "values", "good"))
        text = f"{samples} samples: {values} with a value, {good} of them good."
        flags = [f"{x['quality'][flag]} {meaning}." for flag, meaning in meanings if x["quality"][flag]]
        removed, folded = tabulate(x["contributions"], parts, brief=8), several or len(r["flights"]) > 1
        sections.append(Section(name, (text, *flags), _tabulate_channels(x)))
        sections.append(Section("What was removed, rms", table=removed, detail=folded))
    return tuple(sections)


def _tabulate_channels(x: Json) -> Table:
    density, std = x["density"], x["std"]
    columns: dict[str, Callable[[str], str]] = {
        "channel": str,
        "nominal, Eo/√Hz": lambda k: number(density["before"].get(f"{k}_Eo_per_rtHz")),
        "compensated, Eo/√Hz": lambda k: number(density["after"].get(f"{k}_Eo_per_rtHz")),
        "noise, Eo/√Hz": lambda k: number(density["noise"].get(f"{k}_Eo_per_rtHz")),
        "std by noise, Eo": lambda k: number(std["noise"][f"{k}_Eo"]),
        "std by parameters, Eo": lambda k: number(std["parameters"][f"{k}_Eo"]),
    }
    note = "Nominal: the error of compare. Compensated: the gravity gradient and the noise, 0.02 to 0.15 Hz."
    return tabulate(("inline", "cross"), columns, note=note)


def describe_online(r: Json, output: str) -> Sections:
    """The result of ``compensate --calibration online``, written to a file."""
    within, forget = r["follows_within_s"], r["forget_s"]
    follows = "" if within is None else f" (time constant {number(within)} s)"
    return say_plainly(
        f"{output}: sample by sample, starting from the {r['started']}; noise {number(r['noise_Eo_per_rtHz'])} Eo/√Hz.",
        f"The gradient is modelled as a random walk of {number(r['walk_Eo_per_rts'])} Eo/√s{follows}; the parameters"
        f" {'never forget' if forget is None else f'forget within {number(forget)} s'}.",
        *(f"{x['flight']!s}: {x['samples']} samples" for x in r["flights"]),
    )


def describe_catalogue(entries: Sequence[Json]) -> Sections:
    """The catalogue of effects."""
    columns: Columns = {
        "effect": lambda e: str(e["id"]),
        "what it is": lambda e: str(e["title"]),
        "channels it needs": lambda e: ", ".join(e["channels"]),
    }
    return (Section(table=tabulate(entries, columns, words=3)),)


def describe_effect(e: Json) -> Sections:
    """One effect in full."""
    columns: Columns = {
        "name": lambda q: str(q["name"]),
        "unit": lambda q: str(q["unit"]),
        "prior (1 σ)": lambda q: f"{q['plausible']:g}",
        "for": lambda q: "one value" if q["shared"] else "each accelerometer",
        "meaning": lambda q: str(q["meaning"]),
    }
    facts = (
        ("needs", ", ".join(e["channels"]) or "motion only"),
        ("limits", e["limits"] or "none stated"),
        ("source", e["source"]),
    )
    return (
        Section(
            sentences=(f"{e['id']}: {e['title']}", e["physics"]), code=(numbers.equation(e["equation"]),)
        ),
        Section("Parameters", table=tabulate(e["parameters"], columns, words=5)),
        Section(table=Table(("", ""), facts, words=2)),
    )


def describe_survey(s: Json, headline: str, advice: Sequence[str]) -> Sections:
    """The result of ``survey``; ``headline`` counts the verdicts, ``advice`` is what to do, in sentences."""
    done = [r for r in s["flights"] if "verdict" in r]
    failed = [r for r in s["flights"] if "verdict" not in r]
    bad = s["counts"]["error"] or s["counts"]["unexplained"]
    state = "bad" if bad else "good" if s["counts"]["adequate"] == len(done) else "found"
    sections = [Section(sentences=(headline, *advice), state=state)]
    if done:
        sections += [_tabulate_flights(done), *_list_notes(done)]
    if s["effects"]:
        heads = ("effect", "found", "perhaps", "testable")
        counts = tuple(tuple(str(e[k]) for k in heads) for e in s["effects"])
        note = "found: claimed; perhaps: explains as much as what is claimed; testable: the record could have shown it"
        sections.append(Section("Effects", table=Table(heads, counts, note=note)))
    if s["unexplained_terms"]:
        terms: Columns = {"harmonic × motion term": label_term, "flights": lambda t: str(t["flights"])}
        sections.append(
            Section("What no effect explains", table=tabulate(s["unexplained_terms"], terms, brief=8))
        )
    if s["parameters"]:
        sections.append(_tabulate_trends(s["parameters"]))
    if failed:
        wrong: Columns = {
            "flight": lambda r: str(r["flight"]),
            "what is wrong": lambda r: " ".join(str(r["error"]["message"]).split()),
        }
        text = "The other flights are not affected."
        sections.append(Section("Flights in error", (text,), tabulate(failed, wrong, words=2)))
    return tuple(sections)


def _tabulate_flights(done: Sequence[Json]) -> Section:
    """A row a flight."""
    columns: Columns = {
        "flight": lambda r: str(r["flight"]),
        "verdict": lambda r: str(r["verdict"]),
        "nominal, Eo": lambda r: format_error(r["error"]["nominal"]),
        "calibrated, Eo": lambda r: format_error(r["error"]["calibrated"]),
        "held out, Eo": lambda r: format_error(r["error"]["holdout"]),
        "after, Eo": lambda r: format_error(r["error"]["after"]),
        "noise, Eo": lambda r: format_error(r["noise_floor"]),
        "found": lambda r: " ".join(map(str, r["found"])),
    }
    note = f"and {len(done) - LISTED} more" if len(done) > LISTED else ""
    return Section("Flights", table=tabulate(done[:LISTED], columns, words=2, note=note))


def _list_notes(done: Sequence[Json]) -> Sections:
    """Every note once, with the flights that it is about."""
    about = group_notes((str(r["flight"]), str(note)) for r in done for note in r["notes"])
    table = Table(("note", "flights"), tuple((n, write_flights(x)) for n, x in about.items()), words=2)
    summary = f"{count(len(about), 'note')} on the flights"
    return (Section("Notes", table=table, detail=True, summary=summary),) if about else ()


def _tabulate_trends(parameters: Sequence[Json]) -> Section:
    columns: Columns = {
        "parameter": label_parameter,
        "flights": lambda t: str(t["dof"] + 1),
        "mean": lambda t: numbers.with_unit(number(t["mean"], 4), t["unit"]),
        "scatter": lambda t: number(t["scatter"], 2),
        "χ²/dof": lambda t: number(t["chi2"] / t["dof"], 2),
        "slope/sd": lambda t: number(t["slope_z"], 2),
    }
    varying = sum(bool(t["varies"]) for t in parameters)
    text = f"{varying} of {len(parameters)} calibrated parameters differ from flight to flight; the least constant first."
    return Section("Parameters from flight to flight", (text,), tabulate(parameters, columns, brief=12))


def describe_next_motion(r: Json, output: str) -> Sections:
    """The result of ``next-motion``, written to a file."""
    flown = f"{number(r['duration_s'])} s at {numbers.hertz(r['rate_Hz'])}"
    head = f"{output}: {len(r['sinusoids'])} sinusoids, {flown}"
    if "channels" in r:
        now, then = r["channels"]["now"], r["channels"]["planned"]
        gain = ", ".join(
            f"{k} {number(now[f'{k}_Eo'])} → {number(then[f'{k}_Eo'])} Eo" for k in ("inline", "cross")
        )
        return say_plainly(
            head, f"What the parameters' uncertainty adds to the compensated channels: {gain} rms."
        )
    if not r["separations"]:
        return say_plainly(
            head, "No effects remain to be separated: a multisine about all axes, which excites every effect."
        )
    sentences = [
        f"if it is {x['effect']!s}: {x['rival']!s} is ruled out ({number(x['now'], 2)} → {write_promise(x['then'], x['spread'])} σ)"
        if x["then"] > 3.0
        else f"if it is {x['effect']!s}: no motion within the limits rules out {x['rival']!s}, which acts alike"
        f" ({number(x['now'], 2)} → {number(x['then'])} σ)"
        for x in r["separations"]
    ]
    return say_plainly(head, *sentences)


def describe_flight_file(f: Json) -> Sections:
    """What a flight file holds, and what is assumed: the result of ``info``."""
    head = f"{f['path']!s}: {f['format']}, {numbers.fixed(f['bytes'] / 1e6, 2)} MB, {count(len(f['records']), 'record')}."
    state = "bad" if any(r["refused"] for r in f["records"]) else "good"
    sections = [Section(sentences=(head,), state=state)]
    for r in f["records"]:
        sections += _describe_record(r)
    return tuple(sections)


def _describe_record(r: Json) -> list[Section]:
    facts = [f"{numbers.fixed(r['rows'], 0)} rows"]
    if r["rate_Hz"] is not None:
        lasts = f"{numbers.seconds(r['duration_s'])} from {number(r['start_s'], 4)} s on"
        facts.append(f"{numbers.hertz(r['rate_Hz'])}, {lasts}")
    if r["origin"]:
        facts.append(f"time 0 is {r['origin']}")
    text = [f"{'; '.join(facts)}."]
    if r["gap_count"]:
        longest = max(r["gaps"], key=lambda g: g["samples"])
        text.append(
            f"{count(r['gap_count'], 'gap')}, {count(r['missing'], 'sample')} missing; the longest from"
            f" {number(longest['from_s'], 5)} to {number(longest['to_s'], 5)} s."
        )
    text += [f"note: {n!s}" for n in r["notes"]]
    if r["refused"]:
        text += ["This record cannot be used as it is:", *str(r["refused"]).splitlines()]
    columns: Columns = {
        "column": lambda c: str(c["name"]),
        "unit": lambda c: (numbers.unit(c["unit"]) or "1") if c["unit"] else numbers.ABSENT,
        "minimum": lambda c: number(c["minimum"], 4),
        "mean": lambda c: number(c["mean"], 4),
        "maximum": lambda c: number(c["maximum"], 4),
        "missing": lambda c: str(c["missing"]),
    }
    gaps: Columns = {
        "from, s": lambda g: number(g["from_s"], 6),
        "to, s": lambda g: number(g["to_s"], 6),
        "samples": lambda g: str(g["samples"]),
    }
    sections = [Section(str(r["name"]), tuple(text), tabulate(r["columns"], columns, words=2))]
    if r["gaps"]:
        sections.append(Section("Gaps", table=tabulate(r["gaps"], gaps, words=0), detail=True))
    return sections
