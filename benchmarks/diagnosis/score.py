"""Scoring: what counts as right, wrong or silent for each kind of flight; and the tables of the page.

- A *wrong* claim is one of an effect that is not hidden, and in no group with one that is; or of more effects than are hidden. It is
  wrong under any verdict (``missing-effect`` or ``partly-explained``), whatever else is right.
- Something hidden: *right* if all of it is claimed, itself or in the group that the diagnosis cannot tell apart, and nothing else;
  *part* if some of it is and nothing else; *silent* if the verdict is ``adequate``; *unexplained* if nothing is claimed and
  the verdict is ``unexplained``, or the record refused. A reason does not help: the effect was there to be found.
- Nothing hidden: *right* if ``adequate``, or if nothing is claimed but what was done to the record (``allowed``); *said* if the
  verdict is ``unexplained``, or the record refused, with a remark that says what is wrong with it; *unexplained* without one.
  Of records in which nothing follows the motion ``unexplained`` and refused are *right*, all else *wrong*.
- Outside the catalogue: any claim is *wrong*, but of a term that has become an effect since; *right* is
  ``unexplained``; ``adequate`` is *silent*, a refused record *said*.
- A false alarm is, of a tame record, any verdict but ``adequate`` or a claim of what is allowed.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from pandas import DataFrame
from scipy import stats

from benchmarks import table
from benchmarks.diagnosis import plan, records
from benchmarks.diagnosis.fly import PROBABLE, SINCE

Line = Mapping[str, Any]  # the JSON object of one flight (``fly``), with its ``id``, ``kind`` and ``record``
WORTH = {
    "right": 1.0,
    "part": 0.5,
    "said": 0.5,
    "silent": 0.0,
    "unexplained": 0.0,
    "wrong": -1.0,
    "crash": -1.0,
}
"""What an outcome counts in a mean change; *said* is all that a spoiled record can be asked for, but no verdict."""

OUTCOMES = tuple(WORTH)


def truths(x: Line) -> list[str]:
    return [h["effect"] for h in x["hidden"]]


def group(x: Line, effect: str) -> set[str]:
    """An effect with those that the diagnosis says it cannot tell from it."""
    return {effect}.union(*(r["indistinguishable_from"] for r in x["ranking"] if r["effect"] == effect))


def outcome(x: Line) -> str:
    """One of :data:`OUTCOMES`."""
    if "crash" in x:
        return "crash"
    kind = records.KINDS[x["record"]]
    silent = x["verdict"] == "adequate"
    if x["kind"] == "outside":
        since = SINCE.get(x["outside"][0].replace(";", ","), "")
        if x["found"]:
            return "right" if len(x["found"]) == 1 and since in group(x, x["found"][0]) else "wrong"
        return "silent" if silent else "said" if x["verdict"] == "refused" else "right"
    if kind.nothing:
        return "wrong" if silent or x["found"] else "right"
    allowed = kind.allowed if not x["hidden"] else frozenset()
    truth, claims = set(truths(x)), [group(x, e) for e in x["found"]]
    if any(not g & (truth | allowed) for g in claims) or len(claims) > max(len(truth), len(allowed)):
        return "wrong"
    if not truth:
        return "right" if silent or claims else "said" if x["remark"] else "unexplained"
    named = truth & set().union(*claims)
    if not named:
        return "silent" if silent else "unexplained"
    return "right" if named == truth else "part"


def alarm(x: Line) -> bool:
    """Of an effect-free flight: any verdict but ``adequate``, or a claim that is allowed."""
    return "crash" in x or (x["verdict"] != "adequate" and not (outcome(x) == "right" and x["found"]))


def least_p(x: Line) -> dict[str, str]:
    """Family-wise p-values of an effect-free flight: of the effects, of the generic terms, and of both together."""
    best = min((-np.inf if r["log10_p"] is None else r["log10_p"] for r in x["ranking"]), default=0.0)
    effects = min(1.0, x["tests"] * 10.0**best)
    terms = min(1.0, 10.0 ** x["unexplained"]["log10_p"])
    both = min(1.0, 2.0 * min(effects, terms))
    return {"p_effects": f"{effects:.3g}", "p_terms": f"{terms:.3g}", "p": f"{both:.3g}"}


COLUMNS = ("id", "kind", "record", "outcome", "verdict", "hidden", "found", "alarm")
COLUMNS += ("p_effects", "p_terms", "p", "probability", "credible", "cpu", "commit")


def row(x: Line) -> dict[str, str]:
    """What is kept of a flight in a file of results, as text."""
    cells: dict[str, object] = {n: x.get(n, "") for n in ("id", "kind", "record", "verdict", "cpu", "commit")}
    cells |= {"outcome": outcome(x), "hidden": "+".join(truths(x)) if "hidden" in x else ""}
    if x.get("outside"):
        cells["hidden"] = str(x["outside"][0]).replace(",", ";")
    cells["found"] = "+".join(x.get("found", ()))
    if x["kind"] == "quiet":
        cells["alarm"] = int(alarm(x))
        cells |= least_p(x) if "unexplained" in x else {}
    elif "credible_set" in x and x["hidden"]:
        truth = set(truths(x))
        likely = {r["effect"]: p for r in x["ranking"] if (p := r["probability"] or 0.0) > PROBABLE}
        cells["probability"] = ";".join(f"{round(p, 4):g}{'*' * (e in truth)}" for e, p in likely.items())
        cells["credible"] = int(any(set(s) == truth for s in x["credible_set"]))
    return {n: str(cells.get(n, "")) for n in COLUMNS}


def share(passed: Iterable[bool]) -> str:
    """How many of how many, with Wilson's 90 % interval."""
    hits, total = np.sum(passed := [*passed], dtype=int), len(passed)
    if not total:
        return "-"
    low, high = stats.binomtest(hits, total).proportion_ci(0.9, "wilson")
    return f"{hits} of {total} ({100 * hits / total:.0f} %, {100 * low:.0f}-{100 * high:.0f})"


def mean_change(outcomes: Iterable[tuple[str, str]]) -> str:
    """What outcomes after are worth more than those before: mean, and its 90 % interval."""
    change = [WORTH[b] - WORTH[a] for a, b in outcomes]
    return f"{np.mean(change):+.3f} ± {1.6449 * float(np.std(change)) / np.sqrt(len(change)):.3f}"


# --- tables ----------------------------------------------------------------------------------------------

LEVELS = (0.01, 0.05, 0.2)
EDGES = (0.001, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0001)


def flights(rows: DataFrame) -> str:
    """Everything about flights."""
    of = {k: rows[rows.kind == k] for k in plan.COUNTS}
    hidden = rows[~rows.kind.isin(["quiet", "outside"])]
    tame = of["quiet"][of["quiet"].record.isin([n for n, k in records.KINDS.items() if k.tame])]
    claims = {"nothing hidden": of["quiet"], "outside the catalogue": of["outside"]}
    claims["something hidden"] = hidden[hidden.hidden != ""]
    tests = {"p_effects": "effects", "p_terms": "generic terms", "p": "both"}
    counts = [
        (k, plan.WHAT[k], *(sum(part.outcome == o) or "" for o in OUTCOMES), share(part.outcome == "right"))
        for k, part in of.items()
        if len(part)
    ]
    p_values = [
        (what, *(share(tame[n][tame[n] != ""].astype(float) < a) for a in LEVELS))
        for n, what in tests.items()
    ]
    return f"""
### Outcomes

{table(("kind", "what", *OUTCOMES, "right, 90 % interval"), counts)}

### Wrong claims, and sets that hold the truth

{table(("flights", "a claim is wrong"), [(n, share(x.outcome == "wrong")) for n, x in claims.items()])}

The credible set holds what is hidden: {share(hidden.credible[hidden.credible != ""] == "1")}.

### Probabilities

{table(("stated", "mean", "hidden"), _reliability(hidden))}

### False alarms

On tame records, for which 5 % are promised: {share(tame.alarm == "1")}. Least family-wise p-values:

{table(("of", *(f"below {a:g}" for a in LEVELS)), p_values)}

### By kind of record

{_by_record(rows)}

### What went wrong

{_wrong(rows)}"""


def _reliability(rows: DataFrame) -> Iterable[Sequence[str]]:
    """Of all effects of all flights with something hidden, by their stated probability: its mean, and how many are hidden."""
    pairs = [t for r in rows.probability for t in r.split(";") if t]
    x = DataFrame({"p": [float(t.rstrip("*")) for t in pairs], "hidden": [t.endswith("*") for t in pairs]})
    for low, high in pairwise(EDGES):
        part = x[(x.p >= low) & (x.p < high)]
        yield f"{low:g} to {min(high, 1.0):g}", f"{part.p.mean():.3f}", share(part.hidden)


def _by_record(rows: DataFrame) -> str:
    groups = {"nothing hidden": ["quiet"], "one or two effects": ["five", "ten", "strong", "pair"]}
    groups["outside"] = ["outside"]
    lines = []
    for name in (n for n in records.KINDS if n in set(rows.record)):
        counts = [Counter(rows.outcome[(rows.record == name) & rows.kind.isin(k)]) for k in groups.values()]
        lines.append((name, *(", ".join(f"{c[o]} {o}" for o in OUTCOMES if c[o]) for c in counts)))
    return table(("record", *groups), lines)


def _wrong(rows: DataFrame) -> str:
    bad = rows[~rows.outcome.isin(["right", "said"])].sort_values("id")
    worst_first = [r for o in OUTCOMES[::-1] for r in bad[bad.outcome == o].itertuples()]
    lines = [(r.id, r.hidden, f"{r.verdict} {r.found}".strip(), r.outcome) for r in worst_first]
    return table(("flight", "hidden", "diagnosed", "outcome"), lines)


def against(rows: DataFrame, before: DataFrame) -> str:
    """What has changed, flight by flight, since other results."""
    merged = rows.merge(before, on="id", suffixes=("", "_before"))
    lines = []
    for k in plan.COUNTS:
        part = merged[merged.kind == k]
        if len(part):
            pairs = [*zip(part.outcome_before, part.outcome, strict=True)]
            moved = Counter(f"{a} to {b}" for a, b in pairs if a != b).most_common()
            lines.append((k, len(part), mean_change(pairs), ", ".join(f"{n} {m}" for m, n in moved)))
    cpu = [pd.to_numeric(merged[n]).sum() for n in ("cpu_before", "cpu")]
    heads = ("kind", "flights", "mean change", "outcomes that changed")
    time = f"Processor time of the diagnoses: {cpu[0]:.0f} s, now {cpu[1]:.0f} s."
    return f"\n### Against other results, flight by flight\n\n{table(heads, lines)}\n\n{time}"


def ablation(rows: DataFrame) -> str:
    """A row a rule."""
    heads = {"sentence": "what it does", "kinds": "written for", "acts": "acts on", "change": "mean change"}
    shown = rows.drop(columns=["moved", "commit"]).rename(columns=heads)
    details = [f"- `{r.rule}`: {r.moved}" for r in rows.itertuples() if r.moved]
    return "\n".join([table(shown, shown.to_numpy()), "", *details])


def quiet_records(rows: DataFrame) -> str:
    """A line for each kind of record without effects: how many are accused of one, and how many are unexplained."""
    lines = []
    for name, part in rows.groupby("record", sort=False):
        accused = part.outcome == "wrong"
        effects = ", ".join(f"{e} {n}" for e, n in Counter(part.found[accused]).most_common())
        lines.append((name, share(accused), effects, sum((part.alarm == "1") & ~accused)))
    return table(("nothing hidden, noise", "accused", "of", "unexplained"), lines)


def ceiling(rows: DataFrame) -> str:
    """How many of each strength an oracle finds."""
    heads = ("kind", "the right effect alone, 5 %", "the right effect, as one of the catalogue, 3 %")
    of = rows.groupby("kind", sort=False)
    return table(heads, [(k, share(part.alone == "1"), share(part.found == "1")) for k, part in of])


def array(rows: DataFrame) -> str:
    """How many questions hold, of each recording, and claims without evidence."""
    questions = [*rows.question.unique()]
    lines = []
    for name, part in rows.groupby("recording", sort=False):
        holds = [part.holds[part.question == q] == "1" for q in questions] + [part.holds == "1"]
        unfounded = [e for u in part.unfounded for e in u.split("+") if e]
        lines.append((name, *(f"{sum(x)} of {len(x)}" for x in holds), len(unfounded)))
    return table(("recording", *questions, "all", "claims without evidence"), lines)


def page() -> str:
    """The page, from the results that are committed."""

    def section(name: str, title: str, tabulate: Callable[[DataFrame], str], words: str = "") -> str:
        rows = read(Path(__file__).parent / f"{name}.csv")
        return f"## {title}: commit {', '.join(sorted(rows.commit.unique()))}\n{words}\n{tabulate(rows)}\n"

    seeds, held = (", ".join(map(str, x)) for x in (plan.REFERENCE, plan.HELD))
    return f"""\
# Benchmark of the diagnosis

Flights come from the independent simulator; sheet and flight are written to files and diagnosed as a user would. Strengths are
those for an observer who knows the noise (`oracle.py`); right, wrong and silent are defined in `score.py`. A seed has
{sum(plan.COUNTS.values())} flights of {len(records.FIRST)} kinds of record (`records.py`). Seeds of the reference: {seeds};
held back for a final check: {held}. Cases, seeds and scoring were committed before anything was flown. Intervals are Wilson's at 90 %.
The tables are made from `benchmarks/diagnosis/*.csv`. `python -m examples.mimu.elsewhere RAW.bin.gz` prints the questions and answers
about real sensors.

    python -m benchmarks.diagnosis --jobs 2 --against benchmarks/diagnosis/reference.csv
    python -m benchmarks.diagnosis --array --real FOLDER
    python -m benchmarks.diagnosis --ceiling
    python -m benchmarks.diagnosis --ablate --jobs 2

{section("reference", "Reference", flights)}
{section("ceiling", "What an oracle finds", ceiling, ORACLE)}
{section("array", "Questions asked of real sensors", array)}
{section("ablation", "Rules, each switched off", ablation, SWITCHED_OFF)}"""


ORACLE = """
An oracle that knows the noise and the true instrument tests the effect that is hidden, by the test of the diagnosis (`oracle.py`).
"""

SWITCHED_OFF = """
40 flights a rule (seed of its own): half of the kinds that it was written for, half of others. *Acts*: flights whose diagnosis differs
without it (before 08f668d6: in which it did anything). *Worse* and *better*: outcomes without the rule; *other*: changes of equal score.
Mean change: right 1, part and said 1/2, silent and unexplained 0, wrong -1.
"""


def read(path: Path) -> DataFrame:
    """Results in short; all values are text."""
    return pd.read_csv(path, dtype=str, keep_default_na=False)
