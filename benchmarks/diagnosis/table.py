"""From results in short to the tables of the page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from benchmarks.diagnosis import plan, records, score
from benchmarks.diagnosis.score import OUTCOMES, Row, Share, share

LEVELS = (0.01, 0.05, 0.2)
EDGES = (0.001, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0001)
RULE = {
    "rule": "rule",
    "sentence": "what it does",
    "kinds": "written for",
    "acts": "acts on",
}
RULE |= {n: n for n in ("worse", "better", "other")} | {"change": "mean change", "time": "time"}
"""Columns of the ablation, and their heads."""


def _table(heads: Iterable[str], rows: Iterable[Iterable[object]]) -> list[str]:
    lines = [[*heads], *([str(x) for x in r] for r in rows)]
    lines.insert(1, ["---"] * len(lines[0]))
    return [f"| {' | '.join(line)} |" for line in lines]


def flights(rows: Sequence[Row]) -> list[str]:
    """Everything about flights."""
    of_kind = {k: [r for r in rows if r["kind"] == k] for k in plan.COUNTS}
    counted = {k: Counter(r["outcome"] for r in own) for k, own in of_kind.items() if own}
    hidden = [r for r in rows if r["kind"] not in ("quiet", "outside")]
    tame = [r for r in of_kind["quiet"] if records.KINDS[r["record"]].tame]
    wrong = {
        "nothing hidden": of_kind["quiet"],
        "outside the catalogue": of_kind["outside"],
        "something hidden": [r for r in hidden if r["hidden"]],
    }
    held = share((r for r in hidden if r["credible"]), lambda r: r["credible"] == "1")
    stated = zip(pairwise(EDGES), score.reliability(hidden, EDGES), strict=True)
    alarms = share(tame, lambda r: r["alarm"] == "1")
    tests = {"p_effects": "effects", "p_terms": "generic terms", "p": "both"}
    return [
        *("", "### Outcomes", ""),
        *_table(
            ("kind", "what", *OUTCOMES, "right, 90 % interval"),
            [(k, plan.WHAT[k], *(c[o] or "" for o in OUTCOMES), Share(c["right"], c.total())) for k, c in counted.items()],
        ),
        *("", "### Wrong claims, and sets that hold the truth", ""),
        *_table(
            ("flights", "a claim is wrong"),
            [(n, share(own, lambda r: r["outcome"] == "wrong")) for n, own in wrong.items()],
        ),
        *("", f"The credible set holds what is hidden: {held}.", "", "### Probabilities", ""),
        *_table(
            ("stated", "mean", "hidden"),
            [(f"{a:g} to {min(b, 1.0):g}", f"{mean:.3f}", s) for (a, b), (mean, s) in stated],
        ),
        *("", "### False alarms", ""),
        f"On tame records, for which 5 % are promised: {alarms}. Least family-wise p-values:",
        "",
        *_table(
            ("of", *(f"below {a:g}" for a in LEVELS)),
            [(name, *(_below([r for r in tame if r[n]], n, a) for a in LEVELS)) for n, name in tests.items()],
        ),
        *("", "### By kind of record", "", *_by_record(rows), "", "### What went wrong", "", *_wrong(rows)),
    ]  # fmt: skip


def _below(rows: Sequence[Row], name: str, level: float) -> Share:
    return share(rows, lambda r: float(r[name]) < level)


def _by_record(rows: Sequence[Row]) -> list[str]:
    groups = (("quiet",), ("five", "ten", "strong", "pair"), ("outside",))

    def count(name: str, kinds: Sequence[str]) -> str:
        c = Counter(r["outcome"] for r in rows if r["record"] == name and r["kind"] in kinds)
        return ", ".join(f"{c[o]} {o}" for o in OUTCOMES if c[o])

    flown = {r["record"] for r in rows}
    lines = [(name, *(count(name, g) for g in groups)) for name in records.KINDS if name in flown]
    return _table(("record", "nothing hidden", "one or two effects", "outside"), lines)


def _wrong(rows: Sequence[Row]) -> list[str]:
    bad = [r for r in rows if r["outcome"] not in ("right", "said")]
    order = sorted(bad, key=lambda r: (OUTCOMES[::-1].index(r["outcome"]), r["id"]))
    return _table(
        ("flight", "hidden", "diagnosed", "outcome"),
        [(r["id"], r["hidden"], f"{r['verdict']} {r['found']}".strip(), r["outcome"]) for r in order],
    )


def against(rows: Sequence[Row], before: Sequence[Row]) -> list[str]:
    """What has changed, flight by flight, since other results."""
    old = {r["id"]: r for r in before}
    both = [(old[r["id"]], r) for r in rows if r["id"] in old]
    lines = []
    for k in plan.COUNTS:
        own = [(a["outcome"], b["outcome"]) for a, b in both if a["kind"] == k]
        if own:
            moved = Counter(f"{a} to {b}" for a, b in own if a != b).most_common()
            lines.append((k, len(own), score.mean_change(own), ", ".join(f"{n} {m}" for m, n in moved)))
    cpu = [sum(float(r[side]["cpu"] or 0) for r in both) for side in (0, 1)]
    return [
        *("", "### Against other results, flight by flight", ""),
        *_table(("kind", "flights", "mean change", "outcomes that changed"), lines),
        *("", f"Processor time of the diagnoses: {cpu[0]:.0f} s, now {cpu[1]:.0f} s."),
    ]


def ablation(rows: Sequence[Row]) -> list[str]:
    """A row a rule."""
    details = [f"- `{r['rule']}`: {r['moved']}" for r in rows if r["moved"]]
    return [*_table(RULE.values(), [[r[n] for n in RULE] for r in rows]), "", *details]


def quiet_records(rows: Sequence[Row]) -> list[str]:
    """A line for each kind of record without effects: how many are accused of one, and how many are unexplained."""
    lines = []
    for name in dict.fromkeys(r["record"] for r in rows):
        own = [r for r in rows if r["record"] == name]
        accused = Counter(r["found"] for r in own if r["outcome"] == "wrong")
        told = ", ".join(f"{e} {n}" for e, n in accused.most_common())
        rest = share(own, lambda r: r["alarm"] == "1" and r["outcome"] != "wrong")
        lines.append((name, Share(accused.total(), len(own)), told, rest.hits))
    return _table(("nothing hidden, noise", "accused", "of", "unexplained"), lines)


def ceiling(rows: Sequence[Row]) -> list[str]:
    """How many of each strength an oracle finds."""
    heads = ("kind", "the right effect alone, 5 %", "the right effect, as one of the catalogue, 3 %")
    own = {k: [r for r in rows if r["kind"] == k] for k in dict.fromkeys(r["kind"] for r in rows)}
    counts = [
        [k, *(share(x, lambda r, n=n: r[n] == "1") for n in ("alone", "found"))] for k, x in own.items()
    ]  # type: ignore[misc]
    return _table(heads, counts)


def array(rows: Sequence[Row]) -> list[str]:
    """How many questions hold, of each recording, and claims without evidence."""
    asked = list(dict.fromkeys(r["question"] for r in rows))
    lines = []
    for name in dict.fromkeys(r["recording"] for r in rows):
        own = [r for r in rows if r["recording"] == name]
        holds = [[r["holds"] == "1" for r in own if q in ("", r["question"])] for q in (*asked, "")]
        unfounded = [e for r in own for e in r["unfounded"].split("+") if e]
        lines.append((name, *(f"{sum(x)} of {len(x)}" for x in holds), len(unfounded)))
    return _table(("recording", *asked, "all", "claims without evidence"), lines)


HEAD = """\
# Benchmark of the diagnosis

Flights come from the independent simulator; sheet and flight are written to files and diagnosed as a user would. Strengths are
those for an observer who knows the noise (`strength.py`); right, wrong and silent are defined in `score.py`. A seed has
{flights} flights of {kinds} kinds of record (`records.py`). Seeds of the reference: {seeds}; held back for a final check: {held}. Cases,
seeds and scoring were committed before anything was flown. Intervals are Wilson's at 90 %.
The tables are made from `benchmarks/diagnosis/*.csv`.

    python -m benchmarks.diagnosis --jobs 2 --against benchmarks/diagnosis/reference.csv
    python -m benchmarks.diagnosis --array --real FOLDER
    python -m benchmarks.diagnosis --ceiling
    python -m benchmarks.diagnosis --ablate --jobs 2
"""

SECTIONS = {
    "reference": ("Reference", flights, ""),
    "ceiling": (
        "What an oracle finds",
        ceiling,
        """
An oracle that knows the noise and the true instrument tests the effect that is hidden, by the test of the diagnosis (`ceiling.py`).
""",
    ),
    "array": (
        "Questions asked of real sensors",
        array,
        "\n`python -m examples.mimu.elsewhere RAW.bin.gz` prints the questions and answers.\n",
    ),
    "ablation": (
        "Rules, each switched off",
        ablation,
        """
40 flights a rule (seed of its own): half of the kinds that it was written for, half of others. *Acts*: flights in which the rule
changes anything; only these are repeated without it. *Worse* and *better*: outcomes without the rule; *other*: changes
of equal score. Mean change: right 1, part and said 1/2, silent and unexplained 0, wrong -1.
""",
    ),
}


def page(results: Mapping[str, Sequence[Row]]) -> str:
    """The page, from the results that are committed."""
    seeds, held = (", ".join(map(str, x)) for x in (plan.REFERENCE, plan.HELD))
    count = sum(plan.COUNTS.values())
    text = [HEAD.format(flights=count, kinds=len(records.FIRST), seeds=seeds, held=held)]
    for name, (title, made, words) in SECTIONS.items():
        if rows := results.get(name):
            commits = ", ".join(sorted({r["commit"] for r in rows}))
            text += [f"## {title}: commit {commits}", words, *made(rows), ""]
    return "\n".join(text)
