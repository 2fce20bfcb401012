"""From results in short to the tables of the page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np

from benchmarks.diagnosis import plan, records, score
from benchmarks.diagnosis.score import OUTCOMES, Row, Share

LEVELS = (0.01, 0.05, 0.2)
EDGES = (0.001, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0001)


def _table(heads: Sequence[str], rows: Sequence[Sequence[object]]) -> list[str]:
    lines = [[*heads], ["---"] * len(heads), *([str(x) for x in r] for r in rows)]
    return [f"| {' | '.join(line)} |" for line in lines]


def flights(rows: Sequence[Row]) -> list[str]:
    """Everything about flights."""
    text = ["", "### Outcomes", ""]
    kinds = [k for k in plan.COUNTS if any(r["kind"] == k for r in rows)]
    heads = ("kind", "what", *OUTCOMES, "right, 90 % interval")
    counted = {k: Counter(r["outcome"] for r in rows if r["kind"] == k) for k in kinds}
    text += _table(
        heads,
        [
            (k, plan.WHAT[k], *(c[o] or "" for o in OUTCOMES), Share(c["right"], c.total()))
            for k, c in counted.items()
        ],
    )
    hidden = [r for r in rows if r["kind"] not in ("quiet", "outside")]
    text += ["", "### Wrong claims, and sets that hold the truth", ""]
    wrong = {
        "nothing hidden": [r for r in rows if r["kind"] == "quiet"],
        "outside the catalogue": [r for r in rows if r["kind"] == "outside"],
        "something hidden": [r for r in hidden if r["hidden"]],
    }
    text += _table(
        ("flights", "a claim is wrong"),
        [(n, score.share(own, lambda r: r["outcome"] == "wrong")) for n, own in wrong.items()],
    )
    told = [r for r in hidden if r["credible"]]
    text += [
        "",
        f"The credible set holds what is hidden: {score.share(told, lambda r: r['credible'] == '1')}.",
    ]
    text += ["", "### Probabilities", ""]
    found = score.reliability(hidden, EDGES)
    text += _table(
        ("stated", "mean", "hidden"),
        [
            (f"{low:g} to {min(high, 1.0):g}", f"{mean:.3f}", s)
            for low, high, (mean, s) in zip(EDGES[:-1], EDGES[1:], found, strict=True)
        ],
    )
    tame = [r for r in rows if r["kind"] == "quiet" and records.KINDS[r["record"]].tame]
    text += ["", "### False alarms", ""]
    text.append(
        f"On tame records, for which 5 % are promised: {score.share(tame, lambda r: r['alarm'] == '1')}. Least family-wise p-values:"
    )
    text.append("")
    names = {"p_effects": "effects", "p_terms": "generic terms", "p": "both"}
    text += _table(
        ("of", *(f"below {a:g}" for a in LEVELS)),
        [(name, *(_below([r for r in tame if r[n]], n, a) for a in LEVELS)) for n, name in names.items()],
    )
    return [
        *text,
        "",
        "### By kind of record",
        "",
        *_by_record(rows),
        "",
        "### What went wrong",
        "",
        *_wrong(rows),
    ]


def _below(rows: Sequence[Row], name: str, level: float) -> Share:
    return score.share(rows, lambda r: float(r[name]) < level)


def _by_record(rows: Sequence[Row]) -> list[str]:
    def counts(own: Sequence[Row]) -> str:
        c = Counter(r["outcome"] for r in own)
        return ", ".join(f"{c[o]} {o}" for o in OUTCOMES if c[o])

    lines = []
    for name in records.KINDS:
        own = [r for r in rows if r["record"] == name]
        quiet = [r for r in own if r["kind"] == "quiet"]
        outside = [r for r in own if r["kind"] == "outside"]
        rest = [r for r in own if r["kind"] not in ("quiet", "outside", "off-sheet")]
        if own:
            lines.append((name, counts(quiet), counts(rest), counts(outside)))
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
    text = ["", "### Against other results, flight by flight", ""]
    lines = []
    for k in plan.COUNTS:
        own = [(a, b) for a, b in both if a["kind"] == k]
        if own:
            change = [score.WORTH[b["outcome"]] - score.WORTH[a["outcome"]] for a, b in own]
            half = 1.6449 * float(np.std(change)) / np.sqrt(len(change))
            moved = Counter(
                f"{a['outcome']} to {b['outcome']}" for a, b in own if a["outcome"] != b["outcome"]
            )
            said = ", ".join(f"{n} {m}" for m, n in moved.most_common())
            lines.append((k, len(own), f"{np.mean(change):+.3f} ± {half:.3f}", said))
    text += _table(("kind", "flights", "mean change", "outcomes that changed"), lines)
    cpu = [sum(float(r[side]["cpu"] or 0) for r in both) for side in (0, 1)]
    return [*text, "", f"Processor time of the diagnoses: {cpu[0]:.0f} s, now {cpu[1]:.0f} s."]


def ablation(rows: Sequence[Row]) -> list[str]:
    """A row a rule."""
    heads = (
        "rule",
        "what it does",
        "lines",
        "written for",
        "acts on",
        "worse",
        "better",
        "other",
        "mean change",
        "time",
    )
    text = _table(
        heads,
        [
            [
                r[n]
                for n in (
                    "rule",
                    "sentence",
                    "lines",
                    "kinds",
                    "acts",
                    "worse",
                    "better",
                    "other",
                    "change",
                    "time",
                )
            ]
            for r in rows
        ],
    )
    details = [f"- `{r['rule']}`: {r['moved']}" for r in rows if r["moved"]]
    return [*text, "", *details]


def array(rows: Sequence[Row]) -> list[str]:
    """How many questions hold, of each recording, and claims without evidence."""
    names = list(dict.fromkeys(r["recording"] for r in rows))
    asked = list(dict.fromkeys(r["question"] for r in rows))
    lines = []
    for name in names:
        own = [r for r in rows if r["recording"] == name]
        of = [[r["holds"] == "1" for r in own if r["question"] == q] for q in asked]
        unfounded = [e for r in own for e in r["unfounded"].split("+") if e]
        lines.append(
            (
                name,
                *(f"{sum(x)} of {len(x)}" for x in of),
                f"{sum(r['holds'] == '1' for r in own)} of {len(own)}",
                len(unfounded),
            )
        )
    return _table(("recording", *asked, "all", "claims without evidence"), lines)


def page(results: Mapping[str, Sequence[Row]]) -> str:
    """The page, from the results that are committed."""
    text = [
        "# How well the diagnosis does",
        "",
        "Written by `python -m benchmarks.diagnosis --page` from `benchmarks/diagnosis/*.csv`; do not edit. For contributors.",
        "",
        "Flights come from the independent simulator, sheet and flight go through files and are diagnosed as a user would. Strengths are",
        "what an oracle sees who knows the noise (`strength.py`); what counts as right, wrong or silent stands in `score.py`. A seed has",
        f"{sum(plan.COUNTS.values())} flights over {len(records.KINDS)} kinds of record (`records.py`); seeds of the reference:",
        f"{', '.join(map(str, plan.REFERENCE))}; nobody has looked at {', '.join(map(str, plan.HELD))}. Cases, seeds and scoring were",
        "committed before anything was flown. Intervals are Wilson's at 90 %.",
        "",
        "    python -m benchmarks.diagnosis --jobs 2 --against benchmarks/diagnosis/reference.csv",
        "    python -m benchmarks.diagnosis --array --real FOLDER",
        "    python -m benchmarks.diagnosis --ablate --jobs 2",
    ]
    if rows := results.get("reference"):
        text += ["", f"## Reference: commit {_commits(rows)}", *flights(rows)]
    if rows := results.get("array"):
        text += ["", f"## Questions asked of real sensors: commit {_commits(rows)}", ""]
        text += ["`python -m examples.mimu.elsewhere RAW.bin.gz` says what counts.", "", *array(rows)]
    if rows := results.get("ablation"):
        text += ["", f"## Rules, each switched off: commit {_commits(rows)}", ""]
        text += [
            "40 flights a rule (seed of its own): half of the kinds that it was written for, half of others. *Acts*: where it does",
            "anything with the rule on, the others are as they were. *Worse* and *better*: outcomes without the rule; *other*: changes",
            "that count alike. Mean change: right 1, part and said 1/2, silent and unexplained 0, wrong -1.",
            "",
            *ablation(rows),
        ]
    return "\n".join(text) + "\n"


def _commits(rows: Sequence[Row]) -> str:
    return ", ".join(sorted({r["commit"] for r in rows}))
