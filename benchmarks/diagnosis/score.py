"""Scoring: what counts as right, wrong or silent for each kind of flight.

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

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from scipy import stats

from benchmarks.diagnosis import records
from benchmarks.diagnosis.outside import SINCE

Line = Mapping[str, Any]
"""The JSON object of one flight (``fly``), with its ``id``, ``kind`` and ``record``."""

OUTCOMES = ("right", "part", "said", "silent", "unexplained", "wrong", "crash")

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


@dataclass(frozen=True)
class Share:
    """``hits`` of ``total``, with Wilson's 90 % interval."""

    hits: int
    total: int

    @property
    def value(self) -> float:
        return self.hits / self.total if self.total else float("nan")

    def interval(self, confidence: float = 0.9) -> tuple[float, float]:
        found = stats.binomtest(self.hits, self.total).proportion_ci(confidence, "wilson")
        return float(found.low), float(found.high)

    def __str__(self) -> str:
        if not self.total:
            return "-"
        low, high = self.interval()
        return f"{self.hits} of {self.total} ({100 * self.value:.0f} %, {100 * low:.0f}-{100 * high:.0f})"


def share(lines: Iterable[Line], test: Callable[[Line], bool]) -> Share:
    passed = [test(x) for x in lines]
    return Share(sum(passed), len(passed))


def truths(x: Line) -> list[str]:
    return [h["effect"] for h in x["hidden"]]


def group(x: Line, effect: str) -> set[str]:
    """An effect with those that the diagnosis says it cannot tell from it."""
    twins = next((r["twins"] for r in x["ranking"] if r["effect"] == effect), [])
    return {effect, *twins}


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
        if silent or claims:
            return "right"
        return "said" if x["reason"] else "unexplained"
    named = truth & set().union(*claims)
    if not named:
        return "silent" if silent else "unexplained"
    return "right" if named == truth else "part"


def alarm(x: Line) -> bool:
    """Of an effect-free flight: any verdict but ``adequate``, or a claim that is allowed."""
    return "crash" in x or (x["verdict"] != "adequate" and not (outcome(x) == "right" and x["found"]))


def least_p(x: Line) -> tuple[float, float, float]:
    """Family-wise p-values of an effect-free flight: of the effects, of the generic terms, and of both together."""
    best = min((-np.inf if r["log10_p"] is None else r["log10_p"] for r in x["ranking"]), default=0.0)
    effects = min(1.0, x["tested"] * 10.0**best)
    terms = min(1.0, 10.0 ** x["terms_log10_p"])
    return effects, terms, min(1.0, 2.0 * min(effects, terms))


def mean_change(outcomes: Sequence[tuple[str, str]]) -> str:
    """What pairs of outcomes, before and after, are worth: mean change, and its 90 % interval."""
    change = [WORTH[b] - WORTH[a] for a, b in outcomes]
    return f"{np.mean(change):+.3f} ± {1.6449 * float(np.std(change)) / np.sqrt(len(change)):.3f}"


Row = dict[str, str]
"""What is kept of a flight in a file of results, as text."""

COLUMNS = ("id", "kind", "record", "outcome", "verdict", "hidden", "found", "alarm")
COLUMNS += ("p_effects", "p_terms", "p", "probability", "credible", "cpu", "commit")


def row(x: Line) -> Row:
    """A flight in short."""
    found: dict[str, object] = {n: x.get(n, "") for n in ("id", "kind", "record", "verdict", "cpu", "commit")}
    found |= {"outcome": outcome(x), "hidden": "+".join(truths(x)) if "hidden" in x else ""}
    if x.get("outside"):
        found["hidden"] = str(x["outside"][0]).replace(",", ";")
    found["found"] = "+".join(x.get("found", ()))
    if x["kind"] == "quiet":
        found["alarm"] = int(alarm(x))
        if "terms_log10_p" in x:
            found |= dict(zip(("p_effects", "p_terms", "p"), (f"{p:.3g}" for p in least_p(x)), strict=True))
    elif "probability" in x and x.get("hidden"):
        truth = set(truths(x))
        found["probability"] = ";".join(f"{p:g}{'*' * (e in truth)}" for e, p in x["probability"].items())
        found["credible"] = int(any(set(s) == truth for s in x["credible_set"]))
    return {n: str(found.get(n, "")) for n in COLUMNS}


def reliability(rows: Iterable[Row], edges: Sequence[float]) -> list[tuple[float, Share]]:
    """Of all effects of all flights with something hidden, by their stated probability: its mean, and how many are hidden."""
    said = [(float(t.rstrip("*")), t.endswith("*")) for r in rows for t in r["probability"].split(";") if t]
    found = []
    for low, high in pairwise(edges):
        own = [(p, t) for p, t in said if low <= p < high]
        mean = float(np.mean([p for p, _ in own])) if own else float("nan")
        found.append((mean, Share(sum(t for _, t in own), len(own))))
    return found
