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

from ragg_runtime.base.errors import UserError, at, count
from ragg_runtime.instrument.units import units
from ragg_runtime.io.instants import WAYS, Stamps, are_packed, count_seconds_since, read_stamps
from ragg_runtime.io.mapping import Entry, Mapped, Null, TimeEntry
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE, Array, Mask
from ragg_runtime.io.tables import (
    INDEX,
    MISSING,
    DataColumn,
    DataTable,
    choose_tables,
    is_quantity,
    name_line,
    parse_quantities,
    split_lines,
)

NEEDED = ("time", *SPECIFIC_FORCE, *ANGULAR_RATE)
"""Columns that every flight has."""

PARTS = ("year", "month", "day", "hour", "minute", "second")
"""Columns that are together the time of a sample."""

ISOLATED = 10.0
"""Steps into and out of a missing-value code, over the largest step of all other values: those of readings are at most
a few times it, those of a code (-9999 among temperatures) hundreds or more."""

QUIET = 0.99
"""Share of the steps that are compared with those of a usual code: spikes beside it do not hide it."""

FEWEST_VARYING = 0.5
"""Share of steps other than 0 from which a column varies, so that equal values far outside are no readings: switches and
counters stand still nearly always."""

_LOOKED_AT = 600  # cells that tell whether a column of texts is one of numbers
_COMPONENT = re.compile(r"(?:(a|omega|omegadot|B)_[xyz]|Gamma_[xyz]{2})")
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
    by_name = {c.name: c for c in reversed(table.columns)}
    time, index = by_name.get("time"), by_name.get(table.index or "")
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
        if c.name in found or (c.name == "time" and time is not None):
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


def join_parts(table: DataTable) -> DataTable:
    """A table whose columns ``year`` to ``second`` are one, ``time``, of instants as texts."""
    parts = {c.name.casefold(): c for c in table.columns if c.name.casefold() in PARTS and c.is_number}
    if len(parts) < len(PARTS) or "time" in table.names:
        return table
    rows = zip(*(parts[n].values for n in PARTS), strict=True)
    written = "{:04.0f}-{:02.0f}-{:02.0f}T{:02.0f}:{:02.0f}:{:012.9f}"
    texts = ["" if np.isnan(row).any() else written.format(*row) for row in rows]
    others = (c for c in table.columns if c not in parts.values())
    return replace(table, columns=(DataColumn("time", "", np.array(texts, dtype=object)), *others))


def _read_mapped(table: DataTable, mapping: Mapped) -> DataTable:
    """A table with the columns of the mapping."""
    notes = [f"read by {mapping.path.name} (SHA-256 {mapping.digest[:16]})", *table.notes]
    if mapping.demodulator is not None:
        notes.append(f"demodulated: {mapping.demodulator.words()}")
    named = replace(table, notes=tuple(notes), origin=mapping.time.origin, demodulation=mapping.demodulator)
    entries = mapping.channels.items()
    chosen = {n: (c := table.column(e.column), replace(e, unit=e.unit or c.unit)) for n, e in entries}
    read = _read_columns(named, [table.column(n) for n in mapping.time.columns], mapping.time, chosen)
    return read if mapping.axes is None else _turn(read, mapping.axes, mapping.path)


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
    if stamps is not None:
        table = replace(table, origin=stamps.origin, instants=stamps.instants)
        notes += stamps.notes
    there = np.isfinite(columns[0].values) if times else np.zeros(0, dtype=np.bool_)
    lost = int(np.sum(~there))
    if 0 < lost < len(there):
        notes.append(f"{count(lost, 'row')} without a time left out")
        columns = [replace(c, values=c.values[there]) for c in columns]
    return replace(table, columns=tuple(columns), notes=tuple(notes))


def _read_time(
    columns: Sequence[DataColumn], table: DataTable, t: TimeEntry
) -> tuple[DataColumn, Stamps | None]:
    """Time as the numbers that it is, or as seconds of the instants that it is."""
    first = columns[0]
    where = at(table.place, f"column {first.name!r}")
    few = first.values[:_LOOKED_AT]
    mostly = not first.is_text or float(np.mean(np.isfinite(parse_quantities(few)[0]))) > 0.5
    numeric = mostly and not are_packed(few)
    if t.format != "seconds" and (t.format is not None or not numeric):
        stamps = read_stamps([c.values for c in columns], t.format, where, table.row)
        return DataColumn("time", "s", stamps.values), stamps
    remedy = None if numeric else f"specify the format: [time] format = {', '.join(map(repr, WAYS))}"
    unit, _, epoch = first.unit.partition(" since ")
    time = replace(
        _read_numbers(replace(first, unit=unit), table, t.null, remedy), name="time", unit=t.unit or unit
    )
    if not epoch:
        return time, None
    since = count_seconds_since(units(9.8).to_si(time.values, time.unit, "s", where), epoch)
    return (time, None) if since is None else (DataColumn("time", "s", since.values), since)


# --- numbers -------------------------------------------------------------------------------------------


def read_quantities(c: DataColumn) -> DataColumn:
    """A column of texts that are all numbers, perhaps with units, as numbers; names of lines (10 N) and instants are texts."""
    first = next((t for t in c.values if t not in MISSING), "") if c.is_text else ""
    if not is_quantity(first) or "line" in c.name.casefold() or are_packed(c.values):
        return c
    numbers, unit, spoiled = parse_quantities(c.values)
    return c if spoiled.any() else replace(c, unit=unit or c.unit, values=numbers)


def _read_numbers(c: DataColumn, table: DataTable, null: Null, remedy: str | None = None) -> DataColumn:
    """A column of text as numbers; UserError at the first cell that is none."""
    if c.is_number:
        return c
    texts = ["" if t in null else str(t) for t in c.values]
    numbers, unit, spoiled = parse_quantities(texts)
    if c.is_instant or spoiled.any():
        row = int(np.argmax(spoiled))
        raise UserError(
            "not a number"
            if np.isfinite(numbers).any() and not c.is_instant
            else "the column does not hold numbers",
            where=at(table.place, table.row(row), f"column {c.name!r}"),
            found="dates" if c.is_instant else repr(texts[row])[:60],
            expected="a number with a decimal point, or nothing where it is missing",
            remedy=remedy or "codes of missing values can be named in a mapping: null = [...]",
        )
    return replace(c, unit=unit or c.unit, values=numbers)


def _leave_out_codes(c: DataColumn, null: Null, notes: list[str]) -> DataColumn:
    """The column without codes of missing values, given by the mapping or recognised, which ``notes`` report."""
    values = c.values

    def leave_out(code: float, hit: Mask) -> None:
        nonlocal values
        if hits := int(np.sum(hit)):
            unit = "" if c.unit in ("", "1") else f" {c.unit}"
            notes.append(f"{c.name}: left out as missing: {count(hits, 'value')} of {code:.10g}{unit}")
            values = np.where(hit, np.nan, values)

    for code in (n for n in null if isinstance(n, float)):
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
    usual = _find_extremes(x, lambda _, v: _is_usual(v))
    rest = x[~np.isin(x, usual)]
    if not len(rest):  # a sensor that was not there
        return [c for c in usual if c < 0 or c >= 1e20]
    found = [c for c in usual if _is_isolated(x[(x == c) | ~np.isin(x, usual)], c, rest, QUIET)]
    return found + ([] if known_only else _find_extremes(x[~np.isin(x, found)], _is_unusual_code))


def _find_extremes(x: Array, is_code: Callable[[Array, float], bool]) -> list[float]:
    """Extremes that are codes, one after the other."""
    found: list[float] = []
    while len(x):
        code = next((v for v in (float(x.min()), float(x.max())) if is_code(x, v)), None)
        if code is None:
            break
        found.append(code)
        x = x[x != code]
    return found


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


def _turn(table: DataTable, axes: Sequence[tuple[int, float]], path: Path) -> DataTable:
    """The table with its vectors and its tensor in the measurement frame."""
    found = []
    for c in table.columns:
        own, sign = c.name, 1.0
        if _COMPONENT.fullmatch(c.name):
            stem, _, letters = c.name.rpartition("_")
            turned = [axes["xyz".index(k)] for k in letters]
            own = f"{stem}_{''.join(sorted('xyz'[k] for k, _ in turned))}"
            sign = float(np.prod([s for _, s in turned]))
        if own not in table.names:
            lacking = f"{c.name} comes from {own}, which [columns] does not have"
            what = "a component that the axes need is missing"
            raise UserError(what, where=at(path, "[axes]"), found=lacking)
        source = table.column(own)
        found.append(replace(source, name=c.name, values=source.values if sign > 0 else -source.values))
    return replace(table, columns=tuple(found))
