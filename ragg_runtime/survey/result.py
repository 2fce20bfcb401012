"""The result of a survey."""

from __future__ import annotations

import io
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from scipy import special

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.false_alarms import PROMISED, SURVEY
from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.survey.task import Record
from ragg_runtime.wording import describe_other
from ragg_runtime.wording.numbers import clean
from ragg_runtime.wording.sections import Section, render_notebook


@dataclass(frozen=True, repr=False)
class Survey:
    """The result: one record per flight, with ``error`` or what ``examine`` tells, by name of the flight; and their summary."""

    records: tuple[Record, ...]

    @property
    def done(self) -> tuple[Record, ...]:
        """Records of the flights that could be diagnosed."""
        return tuple(r for r in self.records if "verdict" in r)

    @property
    def failed(self) -> tuple[Record, ...]:
        """Records of the others."""
        return tuple(r for r in self.records if "verdict" not in r)

    @cached_property
    def summary(self) -> Summary:
        return summarised(self.records)

    def __repr__(self) -> str:
        return f"<Survey: {counted(self.summary.counts)}>"

    def _repr_html_(self) -> str:
        return render_notebook(self.sections("MODEL_DIR"))

    def sections(self, model_dir: Path | str) -> tuple[Section, ...]:
        """What the survey says, with the commands that come next."""
        return describe_other.describe_survey(
            self.as_json(), f"{counted(self.summary.counts)}.", recommended(self, model_dir)
        )

    def as_json(self) -> dict[str, object]:
        return {**self.summary.as_json(), "flights": list(self.records)}


_VERDICTS = {
    "adequate": "adequate",
    "missing-effect": "missing an effect",
    "partly-explained": "partly explained",
    "unexplained": "unexplained",
    "error": "in error",
}


def counted(counts: Mapping[str, int]) -> str:
    """The verdicts in one line: ``12 flights: 8 adequate, 4 missing an effect``."""
    total = sum(counts.values())
    said = ", ".join(f"{counts[k]} {text}" for k, text in _VERDICTS.items() if counts[k])
    return f"{total} flight{'' if total == 1 else 's'}: {said}"


def recommended(s: Survey, model_dir: Path | str) -> list[str]:
    """What to do next, in sentences."""
    x = s.summary
    firm, chance = ([a for a in x.advice if a.firm is sure] for sure in (True, False))
    lines = [f"recommended: {advised(a, len(s.done))}" for a in firm]
    if chance:
        names = ", ".join(f"{a.effect} ({len(a.flights)})" for a in chance)
        lines.append(f"in so few flights that it may be chance: {names}")
    open_flights = x.counts["unexplained"] + x.counts["partly-explained"]
    if firm:
        files = [_place(r) for r in s.done if r["flight"] in firm[0].flights]
        more = " ..." if len(files) > 3 else ""
        lines.append(f"next: ragg add {model_dir} {firm[0].effect} {' '.join(files[:3])}{more}")
    elif not x.advice and s.done and not open_flights:
        lines.append("The model is adequate for every flight that was diagnosed.")
    if open_flights:
        lines.append(
            f"{open_flights} flight(s) show something that no known effect explains: ragg diagnose them"
        )
    if not s.done:
        lines.append("No flight could be diagnosed.")
    return lines


def advised(a: Advice, done: int) -> str:
    """An advice in one sentence."""
    other = f" (or {', '.join(a.alternatives)}: these flights cannot tell)" if a.alternatives else ""
    return f"add {a.effect}, which {len(a.flights)} of {done} flights ask for{other}"


def _place(r: Mapping[str, Any]) -> str:
    """Where a flight is, from here if it is below, as a shell wants it."""
    path = Path(r["file"])
    below = path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path
    return shlex.quote(clean(str(below)))


CERTAIN = -30.0
"""Logarithm of a p-value that no flaw of an estimated noise brings about: one flight is enough."""

BEYOND = -1e6
"""The same of an effect that is seen in the values themselves (a saturated output): certain."""

VERDICTS = ("adequate", "missing-effect", "partly-explained", "unexplained")


@dataclass(frozen=True)
class EffectCount:
    """How often an effect was ``found``, would ``perhaps`` do as well, and was ``testable`` on the flight's record."""

    effect: str
    found: int
    perhaps: int
    testable: int


@dataclass(frozen=True)
class Advice:
    """An effect to add, and the flights that ask for it.

    ``log10_chance``: probability of as many false alarms; ``strongest_log10_p``: the least p-value of these flights;
    ``alternatives``: effects that none of them can tell from it.
    """

    effect: str
    flights: tuple[str, ...]
    log10_chance: float
    strongest_log10_p: float | None
    alternatives: tuple[str, ...]

    @property
    def firm(self) -> bool:
        """Whether so many flights, or one with such evidence, can hardly be false alarms."""
        strong = self.strongest_log10_p is not None and self.strongest_log10_p < CERTAIN
        return bool(strong or self.log10_chance < np.log10(SURVEY))


@dataclass(frozen=True)
class Trend:
    """A calibrated parameter over the flights that see it, in the order of their names (``None``: not seen).

    ``mean`` is weighted by the variances, ``scatter`` a standard deviation, ``chi2`` of ``dof`` the sum of squared
    deviations; ``slope_z`` is the slope from flight to flight over its standard deviation.
    """

    name: str
    accelerometer: int | None
    unit: str
    values: tuple[float | None, ...]
    stds: tuple[float | None, ...]
    mean: float
    scatter: float
    chi2: float
    dof: int
    slope_z: float | None

    @property
    def label(self) -> str:
        return self.name if self.accelerometer is None else f"{self.name}[{self.accelerometer}]"

    @property
    def varies(self) -> bool:
        """Whether the values differ by more than their standard deviations let expect (1 %)."""
        return bool(self.log_p < np.log(SURVEY))

    @property
    def log_p(self) -> float:
        """Logarithm of the probability that a constant parameter scatters so much."""
        return log_sf(self.chi2, self.dof)


@dataclass(frozen=True)
class Summary:
    """What all records say together. Tuples are sorted, most telling first."""

    counts: Mapping[str, int]
    effects: tuple[EffectCount, ...]
    advice: tuple[Advice, ...]
    terms: tuple[tuple[str, str, int], ...]
    trends: tuple[Trend, ...]
    names: tuple[str, ...]
    median: Mapping[str, float | None]

    def as_json(self) -> dict[str, object]:
        return {
            "counts": dict(self.counts),
            "effects": [asdict(e) for e in self.effects],
            "recommendation": [asdict(a) | {"firm": a.firm} for a in self.advice],
            "unexplained_terms": [{"harmonic": h, "term": t, "flights": n} for h, t, n in self.terms],
            "median_error": dict(self.median),
            "parameters": [_trend_json(t) for t in self.trends],
        }


def _trend_json(t: Trend) -> dict[str, Any]:
    whole = asdict(t)
    return {k: list(v) if isinstance(v, tuple) else v for k, v in whole.items()} | {"varies": t.varies}


def summarised(records: Sequence[Mapping[str, Any]]) -> Summary:
    """Summary of records in the order of their flights' names."""
    done = [r for r in records if "verdict" in r]
    counts = {v: sum(r["verdict"] == v for r in done) for v in VERDICTS}
    counts["error"] = len(records) - len(done)
    return Summary(
        counts=counts,
        effects=tuple(_effects(done)),
        advice=tuple(_advice(done)),
        terms=tuple(_terms(done)),
        trends=tuple(_trends(done)),
        names=tuple(str(r["flight"]) for r in done),
        median={k: _median(done, k) for k in ("nominal", "calibrated", "holdout", "after", "after_holdout")}
        | {"noise_floor": float(np.median([r["noise_floor"]["rms_Eo"] for r in done])) if done else None},
    )


def _median(done: Sequence[Mapping[str, Any]], which: str) -> float | None:
    values = [r["error"][which]["rms_Eo"] for r in done if r["error"][which]]
    known = [v for v in values if v is not None]
    return float(np.median(known)) if known else None


def _claims(r: Mapping[str, Any]) -> list[frozenset[str]]:
    """What a flight asks for: one effect out of each of these."""
    return [frozenset({e, *r["indistinguishable"].get(e, ())}) for e in r["found"]]


def _effects(done: Sequence[Mapping[str, Any]]) -> list[EffectCount]:
    names = sorted({e for r in done for group in _claims(r) for e in group})
    found = []
    for e in names:
        own = sum(e in r["found"] for r in done)
        either = sum(any(e in group for group in _claims(r)) for r in done)
        testable = sum(e not in r["not_testable"] for r in done)
        found.append(EffectCount(e, own, either - own, testable))
    return sorted(found, key=lambda x: (-x.found, -x.perhaps, x.effect))


def _advice(done: Sequence[Mapping[str, Any]]) -> list[Advice]:
    """Effects that together account for all claims, each the one with most claims still open."""
    open_claims = [
        (n, group, e) for n, r in enumerate(done) for group, e in zip(_claims(r), r["found"], strict=True)
    ]
    found = []
    while open_claims:
        score: dict[str, tuple[int, int]] = {}
        for _, group, main in open_claims:
            for e in sorted(group):
                either, own = score.get(e, (0, 0))
                score[e] = (either + 1, own + (e == main))
        best = min(score, key=lambda e: (-score[e][0], -score[e][1], e))
        mine = [(n, group) for n, group, _ in open_claims if best in group]
        flights = list(dict.fromkeys(n for n, _ in mine))
        shared = frozenset.intersection(*(group for _, group in mine)) - {best}
        chance = float(np.log10(special.bdtrc(len(flights) - 1, len(done), PROMISED)))
        names = tuple(str(done[n]["flight"]) for n in flights)
        evidence = [_log10_p(done[n], best) for n in flights]
        strongest = min((p for p in evidence if p is not None), default=None)
        found.append(
            Advice(
                effect=best,
                flights=names,
                log10_chance=chance,
                strongest_log10_p=strongest,
                alternatives=tuple(sorted(shared)),
            )
        )
        open_claims = [c for c in open_claims if best not in c[1]]
    return found


def _log10_p(r: Mapping[str, Any], effect: str) -> float | None:
    """Of one flight; ``None`` if its record does not tell (the effect is far down its ranking)."""
    for x in r["ranking"]:
        if x["effect"] == effect:
            return BEYOND if x["log10_p"] is None else float(x["log10_p"])
    return None


def _terms(done: Sequence[Mapping[str, Any]]) -> list[tuple[str, str, int]]:
    """Motion terms of the unexplained flights: (harmonic, term, flights), most frequent first."""
    count: dict[tuple[str, str], int] = {}
    for r in done:
        for key in dict.fromkeys((t["harmonic"], t["term"]) for t in r.get("terms", ())):
            count[key] = count.get(key, 0) + 1
    return [(h, t, n) for (h, t), n in sorted(count.items(), key=lambda x: (-x[1], x[0]))]


def _trends(done: Sequence[Mapping[str, Any]]) -> list[Trend]:
    """Parameters that two flights or more see; those that vary most come first."""
    columns: dict[tuple[str, int | None, str], dict[int, tuple[float, float]]] = {}
    for n, r in enumerate(done):
        for p in r["parameters"]:
            if p["value"] is not None and p["std"]:
                key = (p["name"], p["accelerometer"], p["unit"])
                columns.setdefault(key, {})[n] = (p["value"], p["std"])
    found = [_trend(key, seen, len(done)) for key, seen in columns.items() if len(seen) > 1]
    return sorted(found, key=lambda t: (t.log_p, t.name, t.accelerometer or 0))


def _trend(key: tuple[str, int | None, str], seen: Mapping[int, tuple[float, float]], count: int) -> Trend:
    at = np.array(sorted(seen), dtype=np.float64)
    v, s = (np.array([seen[int(n)][k] for n in at]) for k in (0, 1))
    w = 1.0 / s**2
    centre = float(v[0])  # of values that agree to many digits, only the differences are summed
    mean = centre + float(np.sum(w * (v - centre)) / np.sum(w))
    x = at - float(np.sum(w * at) / np.sum(w))
    values, stds = ([seen[n][k] if n in seen else None for n in range(count)] for k in (0, 1))
    chi2 = float(np.sum(w * (v - mean) ** 2))
    line = float(np.sum(w * x * (v - mean)) / np.sum(w * x**2))
    about = float(np.sum(w * (v - mean - line * x) ** 2))
    wider = max(1.0, about / max(len(v) - 2, 1)) ** 0.5
    slope = line * float(np.sqrt(np.sum(w * x**2))) / wider if len(v) > 2 else None
    return Trend(*key, tuple(values), tuple(stds), mean, float(np.std(v, ddof=1)), chi2, len(v) - 1, slope)


TOGETHER = 512
"""Flights of a row group: so many are in memory as a table at once."""

ERRORS = ("nominal", "calibrated", "holdout", "after", "after_holdout")
"""Of these a row has the rms, ``nominal_Eo`` and so on; None where a record does not tell."""


def _lists_of(**fields: pa.DataType) -> pa.DataType:
    return pa.list_(pa.struct(fields))


_TEXT, _NUMBER, _COUNT = pa.string(), pa.float64(), pa.int64()
_SCHEMA = pa.schema(
    dict.fromkeys(("flight", "file", "sha256", "verdict", "error"), _TEXT)
    | {"samples": _COUNT, "duration_s": _NUMBER, "rate_Hz": _NUMBER, "found": pa.list_(_TEXT)}
    | dict.fromkeys((f"{n}_Eo" for n in (*ERRORS, "noise_floor")), _NUMBER)
    | {
        "ranking": _lists_of(effect=_TEXT, log10_p=_NUMBER, delta_bic=_NUMBER),
        "parameters": _lists_of(name=_TEXT, accelerometer=_COUNT, unit=_TEXT, value=_NUMBER, std=_NUMBER),
        "terms": _lists_of(harmonic=_TEXT, term=_TEXT),
        "notes": pa.list_(_TEXT),
    }
)


def parquet(records: Sequence[Record]) -> bytes:
    """The table as the bytes of a Parquet file; the same records give the same bytes."""
    stream = io.BytesIO()
    with pq.ParquetWriter(stream, _SCHEMA, compression="zstd") as writer:
        for start in range(0, max(len(records), 1), TOGETHER):
            rows = [_row(r) for r in records[start : start + TOGETHER]]
            writer.write_table(pa.Table.from_pylist(rows, schema=_SCHEMA))
    return stream.getvalue()


def check_place(path: Path) -> None:
    """UserError if a file stands there that is neither empty nor such a table: a record may be a Parquet file too."""
    if not path.is_file() or not path.stat().st_size:
        return
    try:
        known = pq.read_schema(path).names == _SCHEMA.names
    except (OSError, pa.ArrowException):
        known = False
    if not known:
        raise UserError(
            "a table would be written over something else",
            where=path,
            found="a file that is no table of a survey",
            remedy="name another file, or delete this one first",
        )


def _row(r: Record) -> dict[str, Any]:
    row = {name: r.get(name) for name in _SCHEMA.names}
    if "verdict" not in r:
        return row | {"error": r["error"]["message"]}
    scored = {f"{n}_Eo": r["error"][n]["rms_Eo"] if r["error"][n] else None for n in ERRORS}
    return row | scored | {"error": None, "noise_floor_Eo": r["noise_floor"]["rms_Eo"]}
