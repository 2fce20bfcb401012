"""Tables: columns with names and units as files have them, their cells and headings, and the flight lines among them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, count, one_line
from ragg_runtime.instrument.demodulation import Demodulation
from ragg_runtime.instrument.units import units
from ragg_runtime.io.record import SI_UNITS, Array, Mask

MOST_LINES = 20_000
"""Lines of a file, beyond which the column does not name lines: the largest surveys have some thousands."""

INDEX = "index"
"""Name of a column that labels the rows and has none."""

SHARE = 0.5
"""Of the free memory that a table may take: reading and fitting it take as much again."""

_WORDS = (
    "nan NaN NAN NaT NA N/A n/a n.a. <NA> null NULL None -nan nan(ind) -nan(ind) inf -inf Inf -Inf INF -INF"
)
_OF_C = tuple(f"{sign}1.#{word}" for sign in ("", "-") for word in ("IND", "QNAN", "INF"))
_OF_EXCEL = ("#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!")
MISSING = frozenset(
    ("", "?", *(c * k for c in "-*" for k in range(1, 25)), *_WORDS.split(), *_OF_C, *_OF_EXCEL)
)
"""Cells that hold nothing; Fortran writes asterisks for what has no room."""

_HEADING = re.compile(
    r"(?P<name>[^\[\]]*?)\s*\[(?P<inside>[^\[\]]*)\]"
    r"|(?P<other>.*?\S)(?:\s*[({<](?P<round>[^(){}<>]+)[)}>]|\s*[,:]\s*(?P<behind>\S+)| / (?P<over>\S+))"
)
"""``name [unit]``, or ``name (unit)``, ``name {unit}``, ``name <unit>``, ``name, unit``, ``name: unit``, ``name / unit`` (ISO 80000-1)."""

_ALONE = re.compile(r"[({<]([^(){}<>]+)[)}>]")
"""A unit in brackets below a name, or below one for several columns."""

_QUANTITY = re.compile(
    r"\s*(?P<number>[+-]?[.,]?\d[\d.,]*(?:[eE][+-]?\d+)?)\s*(?P<unit>[A-Za-z\u00b5\u03bc\u00b0%\u2103].*?)?\s*"
)
"""A number, perhaps with its unit in the same cell."""

_EXPONENT = re.compile(r"([\d.])[dD]([+-]?\d)")
_GROUPED = re.compile(r"(?<=\d)['\u2019 \u00a0\u202f](?=\d{3}(?:\D|$))")
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+(?:\.\d*)?")
_POINTED = re.compile(r"[+-]?[1-9]\d{0,2}(?:\.\d{3})+,\d*")
"""Numbers with commas between thousands (1,234.5), and with points (1.234,5)."""


@dataclass(frozen=True, eq=False)
class DataColumn:
    """Values (n,) of a column under its name, and their unit (``""``: none given; of instants ``s since 2026-03-01``).

    ``values``: float64 with NaN for nothing, or object: texts with ``""`` for nothing.
    """

    name: str
    unit: str
    values: NDArray[Any]

    @property
    def is_text(self) -> bool:
        return self.values.dtype == object

    @property
    def is_instant(self) -> bool:
        return " since " in self.unit

    @property
    def is_number(self) -> bool:
        return not self.is_text and not self.is_instant


@dataclass(frozen=True, eq=False)
class DataTable:
    """Columns of one length: as a file has them or, once read, those of a flight under the names of the contract.

    ``line`` is the flight line, where there are several; ``part`` the group, structure or sheet; ``index`` the name of
    the column that labels the rows (the index of a DataFrame); ``notes`` what was made of the file. ``counts`` is how
    the file itself counts its rows: its word for them, and the number of the first.

    Of a flight further: ``place`` for messages; ``origin``, the instant at which ``time`` is 0, if it is known (UTC, or
    GPS time where the file counts in that); ``instants``, whether its stamps are instants, not seconds; ``demodulation``,
    how its channels were made, if that is known.
    """

    columns: tuple[DataColumn, ...]
    line: str | None = None
    part: str = ""
    notes: tuple[str, ...] = ()
    index: str | None = None
    counts: tuple[str, int] = ("row", 1)
    place: str = ""
    origin: datetime | None = None
    instants: bool = False
    demodulation: Demodulation | None = None

    def __len__(self) -> int:
        return len(self.columns[0].values) if self.columns else 0

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(c.name for c in self.columns)

    def column(self, name: str) -> DataColumn:
        """The first column of this name; KeyError if there is none."""
        return {c.name: c for c in reversed(self.columns)}[name]

    def row(self, position: int) -> str:
        """A row as the file counts it: ``line 9``."""
        return f"{self.counts[0]} {self.counts[1] + position}"

    def rows(self, chosen: NDArray[Any]) -> DataTable:
        """Some of the rows, by their positions."""
        return replace(self, columns=tuple(replace(c, values=c.values[chosen]) for c in self.columns))


# --- headings ------------------------------------------------------------------------------------------


def read_heading(text: str) -> tuple[str, str]:
    """Name and unit of ``name [unit]``, or of another way in which what should be the unit is one (see above)."""
    text = " ".join(text.split())
    if text.startswith("/'"):  # LabVIEW: /'group'/'name (unit)'
        text = re.sub(r"([\[(][^\[\]()]+[\])])'$", r"'\1", text)
    if (alone := _ALONE.fullmatch(text)) and is_unit(alone[1]):
        return "", alone[1]
    match = _HEADING.fullmatch(text)
    if match and match["inside"] is not None:
        return one_line(match["name"]), match["inside"].strip()
    if match:
        unit = (match["round"] or match["behind"] or match["over"]).strip()
        if is_unit(unit) or match["other"] in SI_UNITS:
            return one_line(match["other"]), unit
    return one_line(text), ""


def read_headings(texts: Sequence[str]) -> list[tuple[str, str]]:
    """Names and units of a header; of ``gyro[0]``, ``gyro[1]``, ``gyro[2]`` the numbers belong to the names."""
    found = [read_heading(t) for t in texts]
    numbered = Counter(name for name, unit in found if unit.isdigit())
    return [
        (one_line(text.strip()), "") if unit.isdigit() and numbered[name] > 1 else (name, unit)
        for text, (name, unit) in zip(texts, found, strict=True)
    ]


def is_unit(text: str) -> bool:
    """Whether the text reads as a unit."""
    try:
        units(9.8).parse(text)  # whether a text is a unit does not depend on the model's g
    except UserError:
        return False
    return bool(text.strip())


# --- cells ---------------------------------------------------------------------------------------------


def write_cell(cell: Any) -> str:
    """A cell as text: dates in ISO 8601, 1010 for 1010.0, nothing for ``None`` and NaN; elapsed times with their days.

    Elapsed times beyond 24 h are dates of 1900 for Excel.
    """
    if str(cell) in ("None", "nan", "NaT", "<NA>"):
        return ""
    if isinstance(cell, bytes):
        cell = cell.decode("utf-8", "replace")
    if isinstance(cell, datetime) and cell.year in (1899, 1900):
        cell = cell.replace(tzinfo=None) - datetime(1899, 12, 31)
    if isinstance(cell, timedelta):
        return f"{cell.days} days {cell - timedelta(cell.days)}"
    if hasattr(cell, "isoformat"):
        return str(cell.isoformat())
    if isinstance(cell, float):
        return str(int(cell)) if cell.is_integer() and abs(cell) < 1e15 else repr(float(cell))
    return str(cell).strip("\0 \t\r\n")


def is_quantity(text: str) -> bool:
    """Whether a cell is a number, however its thousands and decimals are divided, perhaps with a unit."""
    return _QUANTITY.fullmatch(_write_plain(text)) is not None


def is_number(text: str) -> bool:
    """Whether a cell is a number without a unit."""
    match = _QUANTITY.fullmatch(_write_plain(text))
    return match is not None and not match["unit"]


def _write_plain(text: str) -> str:
    """A number with the minus of print, the D of Fortran or blanks between thousands as programs read it."""
    return _GROUPED.sub("", _EXPONENT.sub(r"\1e\2", text.replace("\u2212", "-")))


def parse_quantities(texts: Iterable[str]) -> tuple[Array, str, Mask]:
    """Numbers in cells, with their units if they have such (``0.12 m/s2``).

    Parameters
    ----------
    texts
        n cells.

    Returns
    -------
    numbers : (n,) array
        NaN where a cell holds none.
    unit : str
        Of the numbers: that of the first one; ``""`` where cells have none.
    spoiled : (n,) array
        Where a cell is neither such a number nor one of those that hold nothing.
    """
    texts = [*texts]
    matches = [None if t in MISSING else _QUANTITY.fullmatch(_write_plain(t)) for t in texts]
    given = [*dict.fromkeys(m["unit"] for m in matches if m and m["unit"])]
    known = units(9.8)
    given = given if all(is_unit(u) and known.fits(u, given[0]) for u in given) else []
    own = [(m["unit"] or "") if m else "" for m in matches]
    fits = [m if m and (u in given if given else not u) else None for m, u in zip(matches, own, strict=True)]
    numbers = _parse_numbers([m["number"] if m else "" for m in fits])
    for unit in given[1:]:
        here, si = np.array([u == unit for u in own]), known.base_unit(given[0])
        numbers[here] = known.from_si(known.to_si(numbers[here], unit, si), si, given[0])
    spoiled = np.isnan(numbers) & np.array([t not in MISSING for t in texts], dtype=np.bool_)
    return numbers, given[0] if given else "", spoiled


def _parse_numbers(texts: Sequence[str]) -> NDArray[np.float64]:
    """Numbers of texts, NaN where they are none.

    Where a number has points and then a comma (1.234,5) the comma is decimal in all; where one has a point, commas separate
    thousands. Commas alone are decimal, unless all of them may separate thousands (1,234), which is not decided.
    """

    def parse(text: str) -> float:
        try:
            return float(text)
        except ValueError:
            return np.nan

    if any(map(_POINTED.fullmatch, texts)):
        texts = [t.replace(".", "").replace(",", ".") for t in texts]
    elif any("." in t for t in texts):
        texts = [t.replace(",", "") if _THOUSANDS.fullmatch(t) else t for t in texts]
    elif not all(map(_THOUSANDS.fullmatch, (t for t in texts if "," in t))):
        texts = [t.replace(",", ".") for t in texts]
    return np.array([parse(t) for t in texts])


# --- several tables, several lines ---------------------------------------------------------------------


def choose_tables(
    tables: Sequence[DataTable], where: Path | str, wanted: frozenset[str], part: str | None = None
) -> list[DataTable]:
    """The tables that are meant: those of ``part``, with all columns that are wanted or with time; several alike are lines."""
    inside = f"{(part or '').strip('/')}/".lstrip("/")
    found = [t for t in tables if t.columns and f"{t.part.strip('/')}/".startswith(inside)]
    alike = next((c for n in (wanted, {"time"}) if (c := [t for t in found if n <= {*t.names}])), found)
    if len(alike) == 1:
        return [replace(alike[0], line=None)]
    if len({tuple(sorted(t.names)) for t in alike}) == 1:
        return alike
    parts = [t.part or "/" for t in alike]
    raise UserError(
        "the file holds several tables that differ" if alike else "the file holds no table",
        where=where,
        found=", ".join(parts[:12]) + (" ..." if len(parts) > 12 else "") or None,
        expected=part or "vectors of one length in one place, or in groups of equal structure",
        remedy="choose one in a mapping: [file] part = ...",
    )


def split_lines(tables: Sequence[DataTable], column: str | None, where: Path | str | None) -> list[DataTable]:
    """A table for each line, in the order in which they begin; the rows of one need not be contiguous."""
    if len(tables) != 1:
        return list(tables)
    (table,) = tables
    name = column or next((n for n in table.names if n.casefold() == "line"), None)
    if name is None:
        return [table]
    c = table.column(name)
    different, which = np.unique(c.values.astype(str) if c.is_text else c.values, return_inverse=True)
    if len(different) > MOST_LINES:
        raise UserError(
            "the column does not name lines: its values differ from row to row",
            where=at(where, f"column {name!r}"),
            found=f"{len(different)} values in {len(which)} rows",
            expected=f"at most {MOST_LINES}, or another column in a mapping: [file] line = ...",
        )
    rows_of: dict[str, list[NDArray[Any]]] = {}
    ends = np.cumsum(np.bincount(which, minlength=len(different)))[:-1]
    for value, rows in zip(different, np.split(np.argsort(which, kind="stable"), ends), strict=True):
        rows_of.setdefault(name_line(value), []).append(rows)
    notes = table.notes
    if lost := sum(map(len, rows_of.pop("", []))):
        notes = (*notes, f"{count(lost, 'row')} without the name of a line left out")
    rest = replace(table, columns=tuple(x for x in table.columns if x is not c), notes=notes)
    lines = sorted(((np.sort(np.concatenate(p)), n) for n, p in rows_of.items()), key=lambda x: x[0][0])
    return [replace(rest.rows(rows), line=n) for rows, n in lines]


def name_line(value: object) -> str:
    """The name of a line: 1010 of 1010.0, in numbers or in text; ``""`` where there is none."""
    try:
        number = float(str(value))
    except ValueError:
        return write_cell(value)
    return write_cell(number) if np.isfinite(number) else ""


# --- memory --------------------------------------------------------------------------------------------


def require_memory(path: Path, size: float) -> None:
    """UserError if a table of so many bytes is more than ``SHARE`` of the memory that is free."""
    free = find_free_memory()
    if free is not None and size > SHARE * free:
        raise UserError(
            "the table is too large for the memory of this computer",
            where=path,
            found=f"about {size / 1e9:.3g} GB once it is read",
            expected=f"at most {SHARE * free / 1e9:.3g} GB, half of what is free",
            remedy="divide the file, or leave out columns and lines that are not needed",
        )


def find_free_memory() -> float | None:
    """Bytes that can be had without swapping; ``None`` where the system does not report it."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            return next(float(x.split()[1]) * 1024 for x in lines if x.startswith("MemAvailable:"))
    except (OSError, StopIteration, ValueError):
        return None  # on other systems NumPy raises its own MemoryError
