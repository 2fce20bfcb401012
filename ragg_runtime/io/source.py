"""A flight file as it stands: tables of columns with the file's own names and units."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.names import EXPECTED, is_column
from ragg_runtime.instrument.demodulation import Demodulation
from ragg_runtime.instrument.units import units

Rows = Mapping[str, NDArray[Any]]
"""Name -> (n,) float64, NaN where nothing stands; columns of text are object arrays of str, empty for nothing."""

_PAREN = re.compile(r"\s*(?P<name>.*?\S)\s*\((?P<unit>[^()]+)\)\s*")
_HEADER = re.compile(r"\s*(?P<name>[^\[\]]+?)\s*(?:\[(?P<unit>[^\[\]]*)\]\s*)?")


@dataclass(frozen=True)
class Heading:
    """A column as it stands in a file: name, unit (``""``: none given), whether it holds text."""

    name: str
    unit: str = ""
    text: bool = False


@dataclass(frozen=True)
class Table:
    """One table of a file, in the file's own names and units.

    ``rows`` reads exactly the columns that it is given. ``line`` is the flight line, where the file has several,
    ``place`` the group, structure or sheet.
    """

    path: Path
    headings: tuple[Heading, ...]
    rows: Callable[[], Rows]
    line: str | None = None
    place: str = ""


@dataclass(frozen=True)
class Look:
    """What is wanted of a file.

    ``only``: the columns that are needed; ``None``: all. ``text``: whether columns of text may pass. ``part``: the
    group (HDF5), structure (MATLAB) or sheet (Excel) that is meant. ``leave``: columns that are not to be read.
    """

    only: frozenset[str] | None = None
    text: bool = False
    part: str | None = None
    leave: frozenset[str] = frozenset()

    def wants(self, name: str) -> bool:
        return name not in self.leave and (self.only is None or name in self.only)

    def allows_text(self, name: str) -> bool:
        return self.text or name == "time" or is_line(name) or not is_column(name)


@dataclass(frozen=True)
class Source:
    """A flight: columns of numbers under the names of the contract, each with a unit, and its rows.

    ``line`` is the flight line, where the file has several; ``origin`` the instant at which ``time`` is 0, if
    it is known (UTC, or GPS time where the file counts in that); ``notes`` say what was made of the file,
    ``demodulation`` how its channels were made, if that is known; ``passed`` names columns that are none of a flight;
    ``instants`` whether the file's stamps are instants, not seconds.
    """

    path: Path
    columns: tuple[Heading, ...]
    rows: Callable[[], Rows]
    line: str | None = None
    origin: datetime | None = None
    notes: tuple[str, ...] = ()
    demodulation: Demodulation | None = None
    passed: tuple[str, ...] = ()
    instants: bool = False


def passed_over(names: Sequence[str]) -> str:
    """In words: columns whose names nothing can have."""
    shown = ", ".join(map(repr, names[:6])) + (" ..." if len(names) > 6 else "")
    return f"passed over for their names ({EXPECTED}): {shown}"


@dataclass(frozen=True)
class Written:
    """A table to be written: columns (N,) with their units, and the name of the line, where there are several."""

    columns: Sequence[tuple[Heading, NDArray[Any]]]
    line: str | None = None


def is_line(name: str) -> bool:
    """Whether a column of this name tells flight lines apart."""
    return name.casefold() == "line"


MOST_COLUMNS = 2000
"""Columns of a file beyond which it is no record of an instrument, and would take minutes."""


def heading(text: str, path: Path, number: int = 1) -> Heading:
    """Name and unit of ``name [unit]`` or ``name (unit)``; what stands in round brackets must be a unit."""
    if number > MOST_COLUMNS:
        raise UserError(
            "the file has too many columns for a flight",
            where=path,
            expected=f"at most {MOST_COLUMNS}",
            remedy="keep the columns that the instrument and its effects need",
        )
    match = _HEADER.fullmatch(text)
    if match is None:
        raise UserError(
            f"column {number} has no readable name",
            where=path,
            found=repr(text),
            expected="name [unit], such as a_x [g]",
        )
    if match["unit"] is None:
        paren = _PAREN.fullmatch(match["name"])
        if paren is not None and is_unit(paren["unit"]):
            return Heading(one_line(paren["name"]), paren["unit"].strip())
    return Heading(one_line(match["name"]), (match["unit"] or "").strip())


def units_below(cells: Sequence[str], count: int) -> list[str] | None:
    """The units in a row below the names: each cell is a unit, perhaps in brackets, or empty; not all numbers."""
    found = [re.sub(r"\s*(?:\[(.*)\]|\((.*)\))\s*", r"\1\2", c).strip() for c in cells]
    if len(found) != count or not all(not c or is_unit(c) for c in found):
        return None
    return found if any(c not in ("", "1") for c in found) else None


def is_unit(text: str) -> bool:
    """Whether the text reads as a unit."""
    known = units(9.8)  # whether a text is a unit does not depend on the model's g
    try:
        known.parse(text)
    except UserError:
        return False
    return bool(text.strip())


def distinct(path: Path, headings: Sequence[Heading]) -> tuple[Heading, ...]:
    """The headings; UserError if a name appears twice."""
    seen: set[str] = set()
    for h in headings:
        if h.name in seen:
            raise UserError(f"the column {h.name!r} appears twice", where=path, remedy="remove or rename one")
        seen.add(h.name)
    return tuple(headings)


def chosen(path: Path, found: Sequence[Table], look: Look) -> list[Table]:
    """The tables that are meant: all if they are lines of one kind; UserError where a choice is needed."""
    found = [t for t in found if t.headings]
    if look.part is not None:
        part = look.part.strip("/")
        found = [t for t in found if t.place.strip("/") == part or t.place.strip("/").startswith(part + "/")]
    kinds = {tuple(sorted(h.name for h in t.headings)) for t in found}
    if len(found) == 1:
        return [replace(found[0], line=None)]
    if len(kinds) == 1:
        return found
    everything = [t.place or "/" for t in found]
    raise UserError(
        "the file holds no table" if not found else "the file holds several tables that differ",
        where=path,
        found=", ".join(everything[:12]) + (" ..." if len(everything) > 12 else "") or None,
        expected="vectors of numbers of one length, in one place or in groups that are alike"
        if look.part is None
        else f"a table in {look.part!r}",
        remedy="say in a mapping which is meant: [file] part = ...",
    )


def not_numbers(path: Path, name: str, found: object) -> UserError:
    return UserError(
        "the column does not hold numbers", where=f"{path}: column {name!r}", found=found, expected="float64"
    )


def check_units(path: Path, headings: Sequence[Heading]) -> None:
    """UserError where a unit is missing."""
    for h in headings:
        if not h.unit:
            example = _EXAMPLES.get(h.name.split("_")[0], "K")
            raise UserError(
                "the column has no unit",
                where=f"{path}: column {h.name!r}",
                found=repr(h.name),
                expected=f"{h.name} [unit], such as {h.name} [{example}]",
                remedy="write the unit; a pure number has the unit 1; none is guessed. Or say once for all files "
                "what their columns are: ragg map FLIGHT -o mapping.toml",
            )


_EXAMPLES = {
    "time": "s",
    "a": "g",
    "omega": "deg/h",
    "omegadot": "rad/s^2",
    "Gamma": "Eo",
    "G": "V",
    "V": "V",
    "inline": "Eo",
    "cross": "Eo",
}
