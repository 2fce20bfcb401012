"""From a file's tables to those of flights: the columns that are meant under the names of the contract, time in seconds.

The only way for all formats: text that should be numbers is read or refused with its cell, what stands for missing
values is left out, a mapping's names, units, signs and axes are applied.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, count
from ragg_runtime.instrument.units import units
from ragg_runtime.io.instants import WAYS, Stamps, are_packed, count_seconds_since, read_stamps
from ragg_runtime.io.mapping import Entry, Mapped, Null, TimeEntry
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.io.tables import (
    INDEX,
    MISSING,
    DataColumn,
    DataTable,
    choose_tables,
    is_unit,
    name_line,
    split_lines,
)
from ragg_runtime.io.text_tables import QUANTITY, write_plain

Array = NDArray[np.float64]

NEEDED = ("time", *SPECIFIC_FORCE, *ANGULAR_RATE)
"""Columns that every flight has."""

ISOLATED = 10.0
"""Steps into and out of a missing-value code, over the largest step of all other values: those of readings are at most
a few times it, those of a code (-9999 among temperatures) hundreds or more."""

QUIET = 0.99
"""Share of the steps that are compared with those of a usual code: spikes beside it do not hide it."""

FEWEST_VARYING = 0.5
"""Share of steps other than 0 from which a column varies, so that equal values far outside are no readings: switches and
counters stand still nearly always."""

_VECTOR = re.compile(r"(a|omega|omegadot|B)_([xyz])")
_TENSOR = re.compile(r"Gamma_([xyz])([xyz])")
_THOUSANDS = re.compile(r"\s*[+-]?[1-9]\d{0,2}(?:,\d{3})+(?:\.\d*)?\s*")
_POINTED = re.compile(r"\s*[+-]?[1-9]\d{0,2}(?:\.\d{3})+,\d*\s*")
"""Numbers with commas between thousands (1,234.5), and with points (1.234,5)."""
_NINES = re.compile(r"-?9{3,}(?:\.(?:0|25|9+))?")


def make_recordings(
    tables: Sequence[DataTable],
    place: Path | str,
    mapping: Mapped | None = None,
) -> list[DataTable]:
    """The flights in the tables of one file, one for each line: numbers in the file's units.

    Parameters
    ----------
    tables
        All tables of the file.
    place
        The file, for messages.
    mapping
        What the columns are; ``None``: they have the names of the contract.

    Raises
    ------
    UserError
        If a choice among tables is needed, or a column is missing, or holds what is no number.
    """
    if mapping is not None and mapping.kept and not _applies(tables, mapping):
        mapping = None
    if mapping is None:
        lines = split_lines(choose_tables(tables, place, frozenset(NEEDED)), None, place)
    else:
        chosen = choose_tables(tables, place, mapping.columns, mapping.part)
        _require_names(chosen[0], mapping, place)
        lines = _pick_lines(split_lines(chosen, mapping.line, place), mapping.lines, place)
    if not lines:
        raise UserError("the file holds no rows", where=place)
    lines = [replace(t, place=str(place)) for t in lines]
    return [_read_plain(t) if mapping is None else _read_mapped(t, mapping) for t in lines]


def _applies(tables: Sequence[DataTable], mapping: Mapped) -> bool:
    """Whether a file has any column that the mapping gives another name."""
    renamed = {e.column for n, e in mapping.channels.items() if e.column != n}
    renamed |= {n for n in mapping.time.columns if n != "time"}
    return not renamed or any(renamed & {*t.names} for t in tables)


def _require_names(table: DataTable, mapping: Mapped, place: Path | str) -> None:
    missing = sorted(mapping.columns - {*table.names})
    if missing:
        raise UserError(
            "columns that the mapping names are not in the file",
            where=place,
            found=f"{', '.join(missing)} of {mapping.path}; the file has {', '.join(table.names[:20])}",
            remedy="write a mapping for this file: ragg map FLIGHT -o mapping.toml",
        )


def _pick_lines(lines: list[DataTable], names: Sequence[str] | None, place: Path | str) -> list[DataTable]:
    wanted = {name_line(n) for n in names or ()}
    if lost := sorted(wanted - {str(t.line) for t in lines}):
        expected = ", ".join(str(t.line) for t in lines[:20])
        raise UserError("the file has no such line", where=place, found=", ".join(lost), expected=expected)
    return lines if names is None else [t for t in lines if t.line in wanted]


def _read_plain(table: DataTable) -> DataTable:
    """A table whose columns have the names of the contract; without a column called time the index is used, if it is one."""
    notes = list(table.notes)
    time = next((c for c in table.columns if c.name == "time"), None)
    index = next((c for c in table.columns if c.name == table.index), None)
    if (
        time is None
        and index is not None
        and (not index.is_number or units(9.8).fits(index.unit or "1", "s"))
    ):
        time = index
    elif time is None and index is not None and index.name == INDEX:
        notes.append("skipped, the index: numbers without a unit; if it is the time, name it time [s]")
    found: dict[str, DataColumn] = {}
    for c in table.columns:
        if c is time or c is index:
            continue
        if c.name in (found if time is None else {**found, "time": time}):
            if c.name in SI_UNITS:
                what = f"the column {c.name!r} appears twice"
                raise UserError(what, where=table.place, remedy="rename one")
            notes.append(f"{c.name}: a second column of this name is left out")
        elif c.is_number or c.name in SI_UNITS:
            found[c.name] = c
        else:
            notes.append(f"{c.name} holds {'text' if c.is_text else 'dates'}; it is left out")
    chosen = {n: (c, Entry(n, c.unit)) for n, c in found.items()}
    named = replace(table, notes=tuple(notes))
    return _read_columns(named, [] if time is None else [time], TimeEntry(()), chosen)


def _read_mapped(table: DataTable, mapping: Mapped) -> DataTable:
    """A table with the columns of the mapping."""
    notes = [f"read by {mapping.path.name} (SHA-256 {mapping.digest[:16]})", *table.notes]
    if mapping.demodulator is not None:
        notes.append(f"demodulated: {mapping.demodulator.words()}")
    named = replace(table, notes=tuple(notes), origin=mapping.time.origin, demodulation=mapping.demodulator)
    entries = mapping.channels.items()
    chosen = {n: (c := table.column(e.column), replace(e, unit=e.unit or c.unit)) for n, e in entries}
    read = _read_columns(named, [table.column(n) for n in mapping.time.columns], mapping.time, chosen)
    if mapping.axes is None:
        return read
    return replace(read, columns=_turn(read.columns, mapping.axes, mapping.path))


def _read_columns(
    table: DataTable,
    times: Sequence[DataColumn],
    t: TimeEntry,
    chosen: Mapping[str, tuple[DataColumn, Entry]],
) -> DataTable:
    """Time and channels as numbers: codes and rows without a time left out and counted, factors applied."""
    notes = list(table.notes)
    stamps, columns = None, []
    if times:
        time, stamps = _read_time(times, table, t)
        columns.append(_leave_out_codes(time, t.null, notes))
    for name, (c, e) in chosen.items():
        read = replace(_read_numbers(c, table, e.null), name=name, unit=e.unit)
        read = _leave_out_codes(read, e.null, notes)
        if (e.factor, e.offset) != (1.0, 0.0):
            read = replace(read, values=read.values * e.factor + e.offset)
        columns.append(read)
    there = np.isfinite(columns[0].values) if times else np.zeros(0, dtype=np.bool_)
    if there.any() and not there.all():
        lost = int(np.sum(~there))
        notes.append(f"{count(lost, 'row')} without a time left out")
        columns = [replace(c, values=c.values[there]) for c in columns]
    if stamps is not None:
        table = replace(table, origin=stamps.origin, instants=stamps.instants)
        notes += stamps.notes
    return replace(table, columns=tuple(columns), notes=tuple(notes))


def _read_time(
    columns: Sequence[DataColumn], table: DataTable, t: TimeEntry
) -> tuple[DataColumn, Stamps | None]:
    """Time as the numbers that it is, or as seconds of the instants that it is."""
    first = columns[0]
    where = at(table.place, f"column {first.name!r}")
    numeric = first.is_number or (first.is_text and np.mean(np.isfinite(parse_numbers(first.values))) > 0.5)
    numeric = numeric and not are_packed(first.values)
    if t.format == "seconds" or (t.format is None and numeric):
        remedy = None if numeric else f"specify the format: [time] format = {', '.join(map(repr, WAYS))}"
        first = _read_numbers(first, table, t.null, remedy)
        unit, _, epoch = first.unit.partition(" since ")
        first = replace(first, name="time", unit=t.unit or unit)
        stamps = (
            count_seconds_since(units(9.8).to_si(first.values, unit, "s", where), epoch) if epoch else None
        )
    else:
        stamps = read_stamps([c.values for c in columns], t.format, where, table.row)
    return (first, None) if stamps is None else (DataColumn("time", "s", stamps.values), stamps)


# --- numbers -------------------------------------------------------------------------------------------


def _read_numbers(c: DataColumn, table: DataTable, null: Null, remedy: str | None = None) -> DataColumn:
    """A column of text as numbers; UserError at the first cell that is none."""
    if c.is_number:
        return c
    texts = np.array(["" if t in null else t for t in c.values], dtype=object) if null else c.values
    numbers = parse_numbers(texts) if c.is_text else np.full(len(texts), np.nan)
    spoiled = np.flatnonzero(find_spoiled(texts, numbers)) if c.is_text else range(len(texts))
    if len(spoiled):
        raise UserError(
            "not a number" if np.isfinite(numbers).any() else "the column does not hold numbers",
            where=at(table.place, table.row(int(spoiled[0])), f"column {c.name!r}"),
            found=repr(str(texts[spoiled[0]]))[:60],
            expected="a number with a decimal point, or nothing where it is missing",
            remedy=remedy or "codes of missing values can be named in a mapping: null = [...]",
        )
    return replace(c, values=numbers)


def read_quantities(c: DataColumn) -> DataColumn:
    """A column of texts that are numbers with their units (``0.12 m/s2``) as numbers, in the unit of the first one."""
    first = next((t for t in c.values if t not in MISSING), "") if c.is_text else ""
    if not QUANTITY.fullmatch(first) or "line" in c.name.casefold():  # 10 N is a name
        return c
    parts = [QUANTITY.fullmatch(t) for t in c.values]
    given = list(dict.fromkeys(m[2] for m in parts if m))
    known = units(9.8)
    if not all(map(is_unit, given)) or not all(known.fits(u, given[0]) for u in given):
        return c
    if any(m is None and t not in MISSING for m, t in zip(parts, c.values, strict=True)):
        return c
    numbers = parse_numbers(np.array([m[1] if m else "" for m in parts], dtype=object))
    si = known.base_unit(given[0])
    for unit in given[1:]:
        here = np.array([m is not None and m[2] == unit for m in parts])
        numbers[here] = known.from_si(known.to_si(numbers[here], unit, si), si, given[0], c.name)
    return replace(c, unit=given[0], values=numbers)


def parse_numbers(texts: NDArray[np.object_]) -> Array:
    """Numbers (n,) of texts, NaN where they are none: with decimal commas, a minus of print or the D of Fortran, too.

    Where a number has points and then a comma (1.234,5) the comma is decimal in all; where one has a point, commas separate
    thousands. Commas alone are decimal, unless all of them may separate thousands (1,234).
    """

    def parse(text: str) -> float:
        try:
            return float(text)
        except ValueError:
            return np.nan

    plain = [write_plain(str(t)) for t in texts]
    if any(map(_POINTED.fullmatch, plain)):
        return np.array([parse(t.replace(".", "").replace(",", ".")) for t in plain])
    if any("." in t for t in plain):
        return np.array([parse(t.replace(",", "") if _THOUSANDS.fullmatch(t) else t) for t in plain])
    if all(map(_THOUSANDS.fullmatch, (t for t in plain if "," in t))):
        return np.array([parse(t) for t in plain])
    return np.array([parse(t.replace(",", ".")) for t in plain])


def find_spoiled(texts: NDArray[np.object_], numbers: Array) -> NDArray[np.bool_]:
    """Where a text is neither a number nor one of the usual codes of missing values."""
    return np.isnan(numbers) & np.array([t not in MISSING for t in texts], dtype=np.bool_)


def _leave_out_codes(c: DataColumn, null: Null, notes: list[str]) -> DataColumn:
    """The column without codes of missing values, given by the mapping or recognised, which ``notes`` report."""
    values = c.values
    named = [n for n in null if isinstance(n, float)]

    def leave_out(code: float, hit: NDArray[np.bool_]) -> None:
        nonlocal values
        hits, unit = int(np.sum(hit)), "" if c.unit in ("", "1") else f" {c.unit}"
        if hits:
            shown = f"{count(hits, 'value')} of {code:.10g}{unit}"
            notes.append(f"{c.name}: left out as missing: {shown}")
            values = np.where(hit, np.nan, values)

    for code in named:
        leave_out(code, np.isclose(values, code, rtol=1e-6, atol=0.0))
    for code in find_codes(values, known_only=c.name == "time"):
        leave_out(code, values == code)
    return replace(c, values=values)


def find_codes(values: Array, *, known_only: bool = False) -> list[float]:
    """Codes of missing values: isolated extremes that repeat, or are usual codes such as -9999.

    Parameters
    ----------
    values
        (n,), NaN for nothing.
    known_only
        Only usual codes.

    Returns
    -------
    The codes, in the order in which they were found.
    """
    x = values[np.isfinite(values)]
    usual: list[float] = []
    rest = _strip_extremes(x, lambda _, v: _is_usual(v), usual)
    if not len(rest):  # a sensor that was not there
        return [c for c in usual if c < 0 or c >= 1e20]
    found = [c for c in usual if _is_isolated(x[(x == c) | ~np.isin(x, usual)], c, rest, QUIET)]
    if not known_only:
        _strip_extremes(x[~np.isin(x, found)] if found else x, _is_unusual_code, found)
    return found


def _strip_extremes(x: Array, is_code: Callable[[Array, float], bool], found: list[float]) -> Array:
    """The values that are left when extremes that are codes are taken out, one after the other, into ``found``."""
    while (
        len(x)
        and (code := next((v for v in (float(x.min()), float(x.max())) if is_code(x, v)), None)) is not None
    ):
        found.append(code)
        x = x[x != code]
    return x


def _is_unusual_code(x: Array, code: float) -> bool:
    """Whether an extreme of no usual form is a code: it repeats, far from values that vary."""
    hit = x == code
    if not 1 < np.sum(hit) < len(x) / 2:
        return False
    rest = x[~hit]
    return bool(np.mean(np.diff(rest) != 0) > FEWEST_VARYING) and _is_isolated(x, code, rest, 1.0)


def _is_isolated(x: Array, code: float, rest: Array, share: float) -> bool:
    """Whether a value lies outside all others, and every step into and out of it is far larger than ``share`` of theirs."""
    if len(rest) < 2 or rest.min() <= code <= rest.max():
        return False
    hit = x == code
    steps, own = np.abs(np.diff(x)), np.abs(np.diff(rest))
    into = np.min(steps[hit[1:] != hit[:-1]], initial=np.inf)
    return bool(into > ISOLATED * np.quantile(own, share, method="lower"))


def _is_usual(value: float) -> bool:
    """-999, -9999, -999.25, 99999.9, -32768, 1e20 and beyond: what programs write where nothing was measured."""
    size = abs(value)
    if size >= 1e20 or size in (32767.0, 32768.0, 2147483647.0, 2147483648.0):
        return True
    digits = (f"{value:.10g}", f"{value:.7g}")  # in single precision, too
    return 999 <= size < 1e12 and any(map(_NINES.fullmatch, digits))


# --- axes ----------------------------------------------------------------------------------------------


def _turn(
    columns: Sequence[DataColumn], axes: Sequence[tuple[int, float]], path: Path
) -> tuple[DataColumn, ...]:
    """Columns in the measurement frame."""
    by_name = {c.name: c for c in columns}
    found = []
    for c in columns:
        own, sign = _find_source(c.name, axes)
        if own not in by_name:
            lacking = f"{c.name} comes from {own}, which [columns] does not have"
            what = "a component that the axes need is missing"
            raise UserError(what, where=at(path, "[axes]"), found=lacking)
        source = by_name[own]
        found.append(replace(source, name=c.name, values=source.values if sign > 0 else -source.values))
    return tuple(found)


def _find_source(name: str, axes: Sequence[tuple[int, float]]) -> tuple[str, float]:
    """The recorder's column from which a component in the measurement frame comes, and its sign."""
    if match := _VECTOR.fullmatch(name):
        k, sign = axes["xyz".index(match[2])]
        return f"{match[1]}_{'xyz'[k]}", sign
    if match := _TENSOR.fullmatch(name):
        (i, s), (j, t) = (axes["xyz".index(a)] for a in match.groups())
        return "Gamma_" + "".join(sorted("xyz"[i] + "xyz"[j])), s * t
    return name, 1.0
