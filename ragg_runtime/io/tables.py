"""Tables: columns with names and units, as files have them, and the flight lines among them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, count
from ragg_runtime.instrument.demodulation import Demodulation
from ragg_runtime.io.cells import write_cell

MOST_LINES = 20_000
"""Lines of a file, beyond which the column does not name lines: the largest surveys have some thousands."""

INDEX = "index"
"""Name of a column that labels the rows and has none."""

SHARE = 0.5
"""Of the free memory that a table may take: reading and fitting it take as much again."""


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
