"""The result of a survey: the records of all flights together."""

from __future__ import annotations

import io
import shlex
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from scipy import special

from ragg_runtime.base import errors
from ragg_runtime.base.false_alarms import PROMISED, SURVEY
from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.survey.examine import Record
from ragg_runtime.wording import describe_other
from ragg_runtime.wording.numbers import clean
from ragg_runtime.wording.sections import Section, render_notebook

# logarithm of a p-value that no flaw of an estimated noise brings about: one flight is enough
CERTAIN = -30.0
BEYOND = -1e6  # the same of an effect that is seen in the values themselves (a saturated output): certain

VERDICTS = {
    "adequate": "adequate",
    "missing-effect": "missing an effect",
    "partly-explained": "partly explained",
    "unexplained": "unexplained",
    "error": "in error",
}

# the errors of a record; None where it does not say
ERRORS = ("nominal", "calibrated", "holdout", "after", "after_holdout")


@dataclass(frozen=True, repr=False)
class Survey:
    """One record per flight, with ``error`` or what ``examine`` found, by name of the flight."""

    records: tuple[Record, ...]

    @property
    def done(self) -> list[Record]:
        """Records of the flights that could be diagnosed."""
        return [r for r in self.records if "verdict" in r]

    def __repr__(self) -> str:
        return f"<Survey: {count_verdicts(self.as_json()['counts'])}>"

    def _repr_html_(self) -> str:
        return render_notebook(self.sections("MODEL_DIR"))

    def sections(self, model_dir: Path | str) -> tuple[Section, ...]:
        """The result of the survey, with the commands that come next."""
        summary = self.as_json()
        headline = f"{count_verdicts(summary['counts'])}."
        return describe_other.describe_survey(summary, headline, _recommend(self.done, summary, model_dir))

    def as_json(self) -> dict[str, Any]:
        """As ``ragg survey --json`` writes it: the summary, lists with the most important first, and the records."""
        done = self.done
        counts = {v: sum(r["verdict"] == v for r in done) for v in VERDICTS if v != "error"}
        floors = [r["noise_floor"]["rms_Eo"] for r in done]
        medians = {k: [r["error"][k]["rms_Eo"] for r in done if r["error"][k]] for k in ERRORS}
        return {
            "counts": counts | {"error": len(self.records) - len(done)},
            "effects": _count_effects(done),
            "recommendation": _advise(done),
            "unexplained_terms": _count_terms(done),
            "median_error": {k: _median(v) for k, v in (medians | {"noise_floor": floors}).items()},
            "parameters": find_trends(done),
            "flights": list(self.records),
        }


def _median(values: Sequence[float | None]) -> float | None:
    numbers = [v for v in values if v is not None]
    return float(np.median(numbers)) if numbers else None


def count_verdicts(counts: Mapping[str, int]) -> str:
    """The verdicts in one line: ``12 flights: 8 adequate, 4 missing an effect``."""
    total = sum(counts.values())
    verdicts = ", ".join(f"{counts[k]} {text}" for k, text in VERDICTS.items() if counts[k])
    return f"{errors.count(total, 'flight')}: {verdicts}"


def _recommend(done: Sequence[Record], s: Mapping[str, Any], model_dir: Path | str) -> list[str]:
    """What to do next, in sentences."""
    firm, chance = ([a for a in s["recommendation"] if a["firm"] is sure] for sure in (True, False))
    lines = []
    for a in firm:
        other = f"; not distinguishable here: {', '.join(a['alternatives'])}" if a["alternatives"] else ""
        lines.append(
            f"recommended: add {a['effect']} (needed by {len(a['flights'])} of {len(done)} flights{other})"
        )
    if chance:
        names = ", ".join(f"{a['effect']} ({len(a['flights'])})" for a in chance)
        lines.append(f"in so few flights that it may be by chance: {names}")
    unexplained = s["counts"]["unexplained"] + s["counts"]["partly-explained"]
    if firm:
        files = [_quote(r) for r in done if r["flight"] in firm[0]["flights"]]
        ellipsis = " ..." if len(files) > 3 else ""
        lines.append(f"next: ragg add {model_dir} {firm[0]['effect']} {' '.join(files[:3])}{ellipsis}")
    elif not chance and done and not unexplained:
        lines.append("The model is adequate for every flight that was diagnosed.")
    if unexplained:
        subject = "1 flight shows" if unexplained == 1 else f"{unexplained} flights show"
        lines.append(f"{subject} something that no known effect explains; to see it: ragg diagnose")
    if not done:
        lines.append("No flight could be diagnosed.")
    return lines


def _quote(r: Record) -> str:
    """The path of a flight, relative if it is below the current folder, quoted for a shell."""
    path = Path(r["file"])
    below = path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path
    return shlex.quote(clean(str(below)))


def _list_claims(r: Record) -> list[tuple[str, frozenset[str]]]:
    """The claims of a flight: an effect, and the group of alternatives that it stands for."""
    return [(e, frozenset({e, *r["indistinguishable"].get(e, ())})) for e in r["found"]]


def _count_effects(done: Sequence[Record]) -> list[Record]:
    """How often an effect was ``found``, would ``perhaps`` do as well, and was ``testable`` on the flight's record."""
    rows = []
    for e in {e for r in done for _, group in _list_claims(r) for e in group}:
        claims = sum(e in r["found"] for r in done)
        either = sum(any(e in group for _, group in _list_claims(r)) for r in done)
        testable = sum(e not in r["not_testable"] for r in done)
        rows.append({"effect": e, "found": claims, "perhaps": either - claims, "testable": testable})
    return sorted(rows, key=lambda x: (-x["found"], -x["perhaps"], x["effect"]))


def _advise(done: Sequence[Record]) -> list[Record]:
    """Effects that together account for all claims, each the one with most claims still open.

    ``log10_chance``: probability of as many false alarms; ``strongest_log10_p``: the least p-value of the ``flights`` that ask for
    it; ``alternatives``: effects that none of them can distinguish from it; ``firm``: so many, or one with such evidence, can hardly be
    false alarms.
    """
    claims = [(r, e, group) for r in done for e, group in _list_claims(r)]
    advice = []
    while claims:
        either = Counter(e for _, _, group in claims for e in group)
        main_claims = Counter(main for _, main, _ in claims)
        best = min(either, key=lambda e: (-either[e], -main_claims[e], e))
        mine = [(r, group) for r, _, group in claims if best in group]
        flights = list(dict.fromkeys(str(r["flight"]) for r, _ in mine))
        chance = float(np.log10(special.bdtrc(len(flights) - 1, len(done), PROMISED)))
        evidence = [
            BEYOND if x["log10_p"] is None else float(x["log10_p"])
            for r, _ in mine
            for x in r["ranking"]
            if x["effect"] == best
        ]
        strongest = min(evidence, default=None)
        advice.append(
            {
                "effect": best,
                "flights": flights,
                "log10_chance": chance,
                "strongest_log10_p": strongest,
                "alternatives": sorted(frozenset.intersection(*(group for _, group in mine)) - {best}),
                "firm": bool(chance < np.log10(SURVEY) or (strongest is not None and strongest < CERTAIN)),
            }
        )
        claims = [c for c in claims if best not in c[2]]
    return advice


def _count_terms(done: Sequence[Record]) -> list[Record]:
    """Motion terms of the unexplained flights, most frequent first."""
    count = Counter(key for r in done for key in {(t["harmonic"], t["term"]) for t in r.get("terms", ())})
    ordered = sorted(count.items(), key=lambda x: (-x[1], x[0]))
    return [{"harmonic": h, "term": t, "flights": n} for (h, t), n in ordered]


def find_trends(done: Sequence[Record]) -> list[Record]:
    """Parameters that two flights or more see, over the flights in the order of their names; those that vary most come first.

    ``values`` and ``stds`` are None where a flight does not see it. ``mean`` is weighted by the variances, ``scatter`` a standard
    deviation, ``chi2`` of ``dof`` the sum of squared deviations; ``slope_z`` is the slope from flight to flight over its standard
    deviation; ``varies``: the values differ by more than their standard deviations let expect (1 %).
    """
    columns: dict[tuple[str, int | None, str], dict[int, tuple[float, float]]] = {}
    for n, r in enumerate(done):
        for p in r["parameters"]:
            if p["value"] is not None and p["std"]:
                key = (p["name"], p["accelerometer"], p["unit"])
                columns.setdefault(key, {})[n] = (p["value"], p["std"])
    trends = [(key, _find_trend(values, len(done))) for key, values in columns.items() if len(values) > 1]
    rows = [{"name": name, "accelerometer": j, "unit": unit, **t} for (name, j, unit), t in trends]
    return sorted(rows, key=lambda t: (log_sf(t["chi2"], t["dof"]), t["name"], t["accelerometer"] or 0))


def _find_trend(values: Mapping[int, tuple[float, float]], count: int) -> Record:
    positions = np.array(sorted(values), dtype=np.float64)
    v, s = np.array([values[int(n)] for n in positions]).T
    w = 1.0 / s**2
    centre = float(v[0])  # of values that agree to many digits, only the differences are summed
    mean = centre + float(np.sum(w * (v - centre)) / np.sum(w))
    x = positions - float(np.sum(w * positions) / np.sum(w))
    chi2, dof = float(np.sum(w * (v - mean) ** 2)), len(v) - 1
    line = float(np.sum(w * x * (v - mean)) / np.sum(w * x**2))
    about = float(np.sum(w * (v - mean - line * x) ** 2))
    wider = max(1.0, about / max(dof - 1, 1)) ** 0.5
    return {
        "values": [values[n][0] if n in values else None for n in range(count)],
        "stds": [values[n][1] if n in values else None for n in range(count)],
        "mean": mean,
        "scatter": float(np.std(v, ddof=1)),
        "chi2": chi2,
        "dof": dof,
        "slope_z": line * float(np.sqrt(np.sum(w * x**2))) / wider if dof > 1 else None,
        "varies": bool(log_sf(chi2, dof) < np.log(SURVEY)),
    }


# --- the table -----------------------------------------------------------------------------------------

KEPT = ("flight", "file", "sha256", "verdict", "error", "samples", "duration_s", "rate_Hz", "found", "ranking",
        "parameters", "terms", "notes")  # fmt: skip
"""Of a record, as they are, columns of the table."""


def make_parquet(records: Sequence[Record]) -> bytes:
    """The table as the bytes of a Parquet file; the same records give the same bytes."""
    stream = io.BytesIO()
    pq.write_table(pa.Table.from_pylist([*map(_make_row, records)]), stream, compression="zstd")
    return stream.getvalue()


def _make_row(r: Record) -> Record:
    done = "verdict" in r
    errors = {**r["error"], "noise_floor": r["noise_floor"]} if done else {}
    scored = {f"{n}_Eo": (errors.get(n) or {}).get("rms_Eo") for n in (*ERRORS, "noise_floor")}
    return {n: r.get(n) for n in KEPT} | {"error": None if done else r["error"]["message"]} | scored
