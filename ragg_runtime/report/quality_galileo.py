"""The figures of the package galileoQC, as tables: those of each line, crossovers, repeat lines, gaps."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ragg_runtime.survey.quality.qc import Quality
from ragg_runtime.wording.numbers import number

_OF_A_LINE = {
    "in_line_sum_Eo": ("in-line sum", "Eo, ilsNoiseAnalysis"),
    "in_line_sum_filtered_Eo": ("in-line sum, 0.03 to 0.1 Hz", "Eo, ilsNoiseAnalysis"),
    "difference_noise_UV_Eo": ("difference noise UV", "Eo, diffNoiseVturb"),
    "difference_noise_NE_Eo": ("difference noise NE", "Eo, diffNoiseVturb"),
    "frobenius_Eo": ("Frobenius norm", "Eo, checkFrobenius"),
    "turbulence_of_altitude": ("turbulence of the altitude", "m, ilsNoiseAnalysis"),
}
"""Name in the JSON -> head of the column, unit and galileoQC's function."""


@dataclass(frozen=True)
class Table:
    """A table of texts: ``heads`` are (name, unit or function), the first one of the rows' names."""

    title: str
    heads: tuple[tuple[str, str], ...]
    rows: tuple[tuple[str, ...], ...]


def tables(q: Quality) -> list[Table]:
    """Those that have a row."""
    return [t for t in (_lines(q), _crossovers(q), _repeats(q), _gaps(q)) if t.rows]


def _lines(q: Quality) -> Table:
    there = [n for n in _OF_A_LINE if any(n in f.galileo for f in q.lines)]
    rows = ((f.line.name, *(number(f.galileo.get(n)) for n in there)) for f in q.lines if f.galileo)
    return Table("By line", (("line", ""), *(_OF_A_LINE[n] for n in there)), tuple(rows))


def _crossovers(q: Quality) -> Table:
    found = {(x["line"], x["channel"]): x for x in q.galileo["crossovers"]}
    channels = _once(c for _, c in found)
    rows = []
    for line in _once(n for n, _ in found):
        own = [found.get((line, c)) for c in channels]
        cells = [number(x[k] if x else None) for x in own for k in ("rms", "largest")]
        rows.append((line, str(max(x["count"] for x in own if x)), *cells))
    heads = [(c, what) for c in channels for what in ("rms", "largest")]
    return Table("Crossovers (checkIntersection)", (("line", ""), ("lines met", ""), *heads), tuple(rows))


def _repeats(q: Quality) -> Table:
    found = {(", ".join(x["lines"]), x["channel"]): x for x in q.galileo["repeats"]}
    channels = _once(c for _, c in found)
    rows = []
    for lines in _once(n for n, _ in found):
        own = [found.get((lines, c)) for c in channels]
        spread = [
            (x["all"] if x["all"] is not None else max(x["lines"].values())) if x else None for x in own
        ]
        rows.append((lines, *map(number, spread)))
    heads = [(c, "std, or the larger of two") for c in channels]
    return Table("Repeat lines (checkRepeatLines)", (("lines", ""), *heads), tuple(rows))


def _gaps(q: Quality) -> Table:
    rows = ((x["line"], c, str(k)) for x in q.galileo["gaps"] for c, k in x["missing"].items())
    return Table("Gaps (checkGaps)", (("line", ""), ("channel", ""), ("samples missing", "")), tuple(rows))


def _once(names: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(names))
