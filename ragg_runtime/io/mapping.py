"""``mapping.toml``: which column of a foreign file is what, in which unit, sign, axis and clock; and what becomes of a table by it.

Its tables and keys, with an example: docs/reference/mapping.md. All formats go this way, with a mapping or without: text that should be
numbers is read or refused with its cell, what stands for missing values is left out, names, units, signs and axes are applied.
"""

from __future__ import annotations

import hashlib
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import (
    UserError,
    at,
    check_keys,
    check_table,
    count,
    did_you_mean,
    is_column,
    one_line,
    read_name,
)
from ragg_runtime.base.files import read_text
from ragg_runtime.instrument.instrument import Demodulation, read_demodulation
from ragg_runtime.instrument.units import read_quantity, read_si, units
from ragg_runtime.io.instants import (
    MIDNIGHT,
    WAYS,
    are_packed,
    count_seconds,
    parse_order,
    read_epoch,
    read_stamps,
)
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.io.sampling import SHARED
from ragg_runtime.io.tables import (
    INDEX,
    MISSING,
    DataColumn,
    DataTable,
    find_codes,
    find_decimal,
    read_numbers,
    split_quantity,
    write_cell,
)

UNKNOWN = "?"  # what ragg map writes where the answer is not in the file

_KEYS: Mapping[str, tuple[str, ...]] = {
    "file": ("line", "lines", "part", "null", "format"),
    "time": ("column", "format", "unit", "rate", "origin", "null"),
    "axes": ("x", "y", "z"),
    "columns": ("column", "unit", "sign", "scale", "offset", "null"),
}

Null = tuple[float | str, ...]  # what stands for a missing value: numbers in the file's unit, or texts


@dataclass(frozen=True)
class Entry:
    """A channel: a value is ``factor`` times the file's, plus ``offset`` (in the unit)."""

    column: str
    unit: str
    factor: float = 1.0
    offset: float = 0.0
    null: Null = ()


@dataclass(frozen=True)
class TimeEntry:
    """The columns of time, and how it is written."""

    columns: tuple[str, ...]
    format: str | None = None  # None: recognised
    unit: str = ""
    rate: float = 1.0  # counts of the column, or rows, in a second
    origin: datetime | None = None  # when plain seconds were 0
    null: Null = ()


@dataclass(frozen=True)
class Mapped:
    """A mapping as it was read; see the module's text for the file."""

    path: Path
    time: TimeEntry
    channels: Mapping[str, Entry]
    axes: tuple[tuple[int, float], ...] | None = None  # for x, y, z: the recorder's axis, its sign
    line: str | None = None
    lines: tuple[str, ...] | None = None
    part: str | None = None
    demodulator: Demodulation | None = None
    digest: str = ""  # SHA-256 of the text
    kept: bool = False  # it is the model's own, and does not apply to files that have none of its columns

    @property
    def columns(self) -> frozenset[str]:
        """Every column of the file that is needed."""
        named = {e.column for e in self.channels.values()} | {*self.time.columns}
        return frozenset(named if self.line is None else {*named, self.line})


def list_codes(m: Mapped) -> dict[str, list[float]]:
    """Column -> the numbers that stand for a missing value in it."""
    columns: dict[str, Entry | TimeEntry] = {"time": m.time, **m.channels}
    return {name: [x for x in e.null if isinstance(x, float)] for name, e in columns.items()}


def read_mapping(path: Path) -> Mapped:
    """The mapping in a file; UserError if something in it cannot be, or is not answered yet."""
    return parse_mapping(read_text(path), path)


def parse_mapping(text: str, path: Path) -> Mapped:
    """The mapping in a text; ``path`` is its file."""
    try:
        data = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # ValueError: numbers of thousands of digits
        raise UserError("not valid TOML", where=path, found=str(error) or "nested too deeply") from None
    check_keys(data, (*_KEYS, "demodulator", "null", "format"), path)
    tables, place = {}, at(path, "[file]")
    for name, keys in _KEYS.items():
        tables[name] = check_table(data.get(name, {}), f"[{name}]", path, f"[{name}]")
        check_keys(tables[name] if name != "columns" else (), keys, at(path, f"[{name}]"))
    file, columns = tables["file"], tables["columns"]
    lines = file.get("lines")
    if not (lines is None or (isinstance(lines, list) and lines and all(isinstance(x, str) for x in lines))):
        raise _refuse("lines is not a list of names", place, lines, '["1010", "1020"]')
    null = _read_null(data, str(path)) + _read_null(file, place)
    if "time" not in data or "time" in columns:
        what = "time has a table of its own" if "time" in columns else "[time] is missing"
        raise UserError(what, where=path, expected='[time] column = "...", unit = "s"; or rate = "16 Hz"')
    format_ = {"format": "seconds", **data, **file, **tables["time"]}["format"]
    return Mapped(
        path=path,
        time=_parse_time(tables["time"], format_, null, at(path, "[time]")),
        channels={n: _parse_entry(n, v, null, at(path, f"[columns] {n}")) for n, v in columns.items()},
        axes=_read_axes(tables["axes"], at(path, "[axes]")) if "axes" in data else None,
        line=_take(file, "line", str, place, None),
        lines=tuple(lines) if lines is not None else None,
        part=_take(file, "part", str, place, None),
        demodulator=read_demodulation(data.get("demodulator"), at(path, "[demodulator]")),
        digest=hashlib.sha256(text.encode()).hexdigest(),
    )


def _refuse(what: str, where: str, value: object, expected: str, remedy: str | None = None) -> UserError:
    return UserError(what, where=where, found=repr(value)[:60], expected=expected, remedy=remedy)


def _take(table: Mapping[str, Any], key: str, kind: type, where: str, default: Any) -> Any:
    """A text, which may have to be a ``unit``, or a number in a table, or its default."""
    raw = table.get(key, "")
    if raw == "":
        return default
    if raw == UNKNOWN:
        expected = "that of the file; 1 for a pure number; none is guessed"
        raise _refuse(f"the {key} is not answered yet", where, raw, expected)
    if kind is str and isinstance(raw, str) and raw.strip():
        if key == "unit":
            units(9.8).parse(raw, where)  # whether a text is a unit does not depend on the model's g
        return raw
    if kind is float and isinstance(raw, int | float) and not isinstance(raw, bool) and abs(raw) < 1e100:
        return float(raw)
    raise _refuse(f"{key} is not a {'text' if kind is str else 'number'}", where, raw, f"{key} = ...")


def _read_null(table: Mapping[str, Any], where: str) -> Null:
    """One or several numbers or texts."""
    raw = table.get("null", [])
    values = raw if isinstance(raw, list) else [raw]
    if any(isinstance(v, bool) or not isinstance(v, int | float | str) for v in values):
        raise _refuse("null is not a list of numbers and texts", where, raw, "null = [-9999]")
    return tuple(v.strip() if isinstance(v, str) else float(v) for v in values)


def _parse_entry(name: str, raw: Any, null: Null, where: str) -> Entry:
    if not is_column(name):
        read_name(name, where, "temperature")
    raw = {"column": raw} if isinstance(raw, str) else raw
    if not isinstance(raw, dict) or "column" not in raw:
        example = f'{name} = {{ column = "its name in the file", unit = "..." }}'
        raise _refuse("the column of the file is not named", where, raw, example)
    check_keys(raw, _KEYS["columns"], where)
    defaults = {"sign": 1.0, "scale": 1.0, "offset": 0.0}
    sign, scale, offset = (_take(raw, n, float, where, usual) for n, usual in defaults.items())
    if sign not in (1.0, -1.0):
        raise _refuse("sign is 1 or -1", where, raw["sign"], "scale for other factors")
    if scale == 0.0:
        raise UserError("the scale must not be zero", where=where)
    column, unit = (_take(raw, n, str, where, "") for n in ("column", "unit"))
    return Entry(column, unit, sign * scale, offset, null + _read_null(raw, where))


def _parse_time(raw: Mapping[str, Any], form: Any, null: Null, where: str) -> TimeEntry:
    columns = raw.get("column")
    names = (columns,) if isinstance(columns, str) else tuple(columns) if isinstance(columns, list) else ()
    written: str = _take({"format": form}, "format", str, where, "seconds")
    ordered = parse_order(written) is not None
    if written not in ("seconds", *WAYS) and not ordered:
        formats = "seconds, " + ", ".join(f"{n} ({example})" for n, (_, example) in WAYS.items())
        near = did_you_mean(written, ("seconds", *WAYS))
        raise _refuse("no such format of time", where, written, formats, near)
    rate = raw.get("rate")
    if rate is not None and ("unit" in raw or written != "seconds"):
        raise _refuse("rate is of a column that counts, or of the rows", where, rate, "no unit, no format")
    needed = WAYS[written][0] if written in WAYS else int(rate is None or columns is not None)
    fits = len(names) == needed or (ordered and len(names) == 2)
    if not fits or not all(isinstance(n, str) and n for n in names):
        how, example = ("two columns", '["DATE", "CLOCK"]') if needed == 2 else ("one column", '"..."')
        raise _refuse(f"time as {written!r} needs {how}", where, columns, f"column = {example}")
    origin = raw.get("origin")
    if origin is not None and (not isinstance(origin, datetime) or written != "seconds"):
        raise _refuse("origin is the instant of second 0", where, origin, "2026-03-01T00:00:00Z, of seconds")
    if origin is not None and origin.tzinfo is None:
        origin = origin.replace(tzinfo=UTC)
    unit: str = _take(raw, "unit", str, where, "")
    hertz = 1.0
    if rate is not None:
        unit, hertz = "s", float(read_si(read_quantity(rate, where, count=1), "Hz", 9.8, where)[0])
    if hertz <= 0.0:
        raise _refuse("the rate is not above zero", where, rate, 'rate = "16 Hz"')
    return TimeEntry(names, written, unit, hertz, origin, null + _read_null(raw, where))


def _read_axes(raw: Mapping[str, Any], where: str) -> tuple[tuple[int, float], ...]:
    texts = {axis: str(raw.get(axis, axis)).strip().lstrip("+") for axis in "xyz"}
    for axis, text in texts.items():
        if not re.fullmatch("-?[xyz]", text):
            raise _refuse("not an axis", at(where, axis), raw.get(axis), '"x", "-y" ...')
    axes = tuple(("xyz".index(t[-1]), -1.0 if t[0] == "-" else 1.0) for t in texts.values())
    volume = round(np.linalg.det([np.eye(3)[k] * sign for k, sign in axes]))
    if volume != 1:
        raise UserError(
            "the axes are a mirror image, not a rotation" if volume else "an axis appears twice",
            where=where,
            found=", ".join(f"{a} = {raw.get(a, a)}" for a in "xyz"),
            expected="a right-handed frame, such as x = y, y = x, z = -z between NED and ENU",
            remedy="if a sensor is reversed, give its column sign = -1",
        )
    return axes


# --- the flights in a file ------------------------------------------------------------------------------

NEEDED = ("time", *SPECIFIC_FORCE, *ANGULAR_RATE)  # columns that every flight has
PARTS = ("year", "month", "day", "hour", "minute", "second")  # columns that are together the time of a sample
# lines of a file, beyond which the column does not name lines: the largest surveys have some thousands
MOST_LINES = 20_000
_LOOKED_AT = 600  # cells that tell whether a column of texts is one of numbers
_COMPONENT = re.compile(r"(?:(a|omega|omegadot|B|mass)_[xyz]|Gamma_[xyz]{2})")


def make_recordings(
    tables: Sequence[DataTable], place: Path | str, mapping: Mapped | None = None
) -> list[DataTable]:
    """The flights in the tables of one file (its ``place``, for messages), one for each line: numbers in the file's units.

    Without a mapping the columns have the names of the contract. UserError if a choice among tables is needed, or a column is missing,
    or holds what is no number.
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
    several = len(lines) > 1
    lines = [replace(t, place=at(place, f"flight line {t.line}" if several else "")) for t in lines]
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
    titles = {name_line(n) for n in names or ()}
    if lost := sorted(titles - {str(t.line) for t in lines}):
        expected = ", ".join(str(t.line) for t in lines[:20])
        raise UserError("the file has no such line", where=place, found=", ".join(lost), expected=expected)
    return lines if names is None else [t for t in lines if t.line in titles]


def _read_plain(table: DataTable) -> DataTable:
    """A table whose columns have the names of the contract; without a column called time the index is used, if it is one."""
    notes, by_name = list(table.notes), {c.name: c for c in reversed(table.columns)}
    time, index = by_name.get("time"), by_name.get(table.index or "")
    if time is None and index is not None:
        if not index.is_number or units(9.8).fits(index.unit or "1", "s"):
            time = index
        elif index.name == INDEX:
            notes.append("skipped, the index: numbers without a unit; if it is the time, name it time [s]")
    chosen: dict[str, tuple[DataColumn, Entry]] = {}
    for c in (c for c in table.columns if c is not time and c is not index):
        if c.name in chosen or (c.name == "time" and time is not None):
            if c.name in SI_UNITS:
                what = f"the column {c.name!r} appears twice"
                raise UserError(what, where=table.place, remedy="rename one")
            notes.append(f"{c.name}: a second column of this name is left out")
        elif c.is_number or c.name in SI_UNITS:
            chosen[c.name] = c, Entry(c.name, c.unit)
        else:
            notes.append(f"{c.name} holds {'text' if c.is_text else 'dates'}; it is left out")
    named = replace(table, notes=tuple(notes))
    return _read_columns(named, [] if time is None else [time], TimeEntry(()), chosen)


def join_parts(table: DataTable) -> DataTable:
    """A table whose columns ``year`` to ``second`` are one, ``time``, of seconds since the first midnight."""
    names = {c.name: re.sub("^(utc|gps)_", "", c.name.casefold()) for c in table.columns}
    parts = {names[c.name]: c for c in table.columns if names[c.name] in PARTS and c.is_number}
    if len(parts) < len(PARTS) or "time" in table.names:
        return table
    import pandas as pd  # slow to import, and few files need it

    stamps = pd.to_datetime(pd.DataFrame({n: parts[n].values for n in PARTS}), errors="coerce")
    seconds, unit = count_seconds(stamps.to_numpy())
    others = (c for c in table.columns if c not in parts.values())
    return replace(table, columns=(DataColumn("time", unit, seconds), *others))


def _read_mapped(table: DataTable, mapping: Mapped) -> DataTable:
    """A table with the columns of the mapping."""
    notes = [f"read by {mapping.path.name} (SHA-256 {mapping.digest[:16]})", *table.notes]
    if mapping.demodulator is not None:
        notes.append(f"demodulated: {mapping.demodulator.words()}")
    named = replace(table, notes=tuple(notes), origin=mapping.time.origin, demodulation=mapping.demodulator)
    entries = mapping.channels.items()
    chosen = {n: (c := table.column(e.column), replace(e, unit=e.unit or c.unit)) for n, e in entries}
    rows = [DataColumn("row", "", np.arange(float(len(table))))]
    times = [table.column(n) for n in mapping.time.columns] or rows
    read = _read_columns(named, times, mapping.time, chosen)
    return read if mapping.axes is None else _turn(read, mapping.axes, mapping.path)


def _read_columns(
    table: DataTable,
    times: Sequence[DataColumn],
    t: TimeEntry,
    chosen: Mapping[str, tuple[DataColumn, Entry]],
) -> DataTable:
    """Time and channels as numbers: codes and rows without a time left out and counted, factors applied."""
    columns, notes = [], list[str]()
    if times:
        time, table = _read_time(times, table, t)
        time = _leave_out_codes(time, t.null, notes)
        time, fraction = _add_fraction(time, table.columns, notes)
        columns.append(replace(time, values=time.values / t.rate))
        chosen = {n: (c, e) for n, (c, e) in chosen.items() if c is not fraction}
    for name, (c, e) in chosen.items():
        read = replace(_require_numbers(c, table, e.null), name=name, unit=e.unit)
        read = _leave_out_codes(read, e.null, notes)
        if (e.factor, e.offset) != (1.0, 0.0):
            read = replace(read, values=read.values * e.factor + e.offset)
        columns.append(read)
    lost = np.isnan(columns[0].values) if times else np.zeros(0, dtype=np.bool_)
    if lost.any() and not lost.all():
        notes.append(f"{count(int(np.sum(lost)), 'row')} without a time left out")
        columns = [replace(c, values=c.values[~lost]) for c in columns]
    return replace(table, columns=tuple(columns), notes=(*table.notes, *notes))


def _read_time(columns: Sequence[DataColumn], table: DataTable, t: TimeEntry) -> tuple[DataColumn, DataTable]:
    """Time as the numbers that it is, or as seconds of the instants that it is; and the table with what they count from."""
    first = columns[0]
    where = at(table.place, f"column {first.name!r}")
    few = replace(first, values=first.values[:_LOOKED_AT])
    mostly = not first.is_text or np.mean(np.isfinite(read_numbers(few, table.decimal)[0].values)) > 0.5
    numeric = mostly and not are_packed(few.values)
    if t.format != "seconds" and (t.format is not None or not numeric):
        seconds, written, notes = read_stamps([c.values for c in columns], t.format, where, table.row)
        unit, _, epoch = written.partition(" since ")
        time, table = DataColumn("time", unit, seconds), replace(table, notes=table.notes + notes)
    else:
        remedy = None if numeric else f"specify the format: [time] format = {', '.join(map(repr, WAYS))}"
        unit, _, epoch = first.unit.partition(" since ")
        read = _require_numbers(replace(first, unit=unit), table, t.null, remedy)
        time = replace(read, name="time", unit=t.unit or unit)
    origin = read_epoch(epoch)
    if origin is None and epoch != MIDNIGHT:
        return time, table
    seconds = units(9.8).to_si(time.values, time.unit, "s", where)
    return DataColumn("time", "s", seconds), replace(table, origin=origin, instants=True)


def _add_fraction(
    time: DataColumn, columns: Sequence[DataColumn], notes: list[str]
) -> tuple[DataColumn, DataColumn | None]:
    """Stamps of whole seconds with the fraction that a column of its own holds, in whatever unit, and that column: with it
    the steps are alike, within a second and from one to the next.
    """
    steps = np.diff(time.values)
    coarse = np.sum(steps == 0.0) > SHARED * len(steps) and np.any(steps > 0.0)
    for c in columns if coarse and units(9.8).fits(time.unit or "1", "s") else ():
        if not c.is_number or not 0.0 <= np.min(c.values) < np.max(c.values) < 1e10:
            continue
        scale = 10.0 ** -np.ceil(np.log10(np.max(c.values)))
        values = time.values + scale * c.values
        usual, between = np.median(np.diff(values)), np.median(np.diff(values)[steps > 0.0])
        alike = np.abs(np.diff(values) - usual) < 0.5 * usual
        if np.mean(alike) > 1 - SHARED and abs(between - usual) < 0.5 * usual:
            notes.append(f"time: {c.name}, in units of {scale:g} s, is the fraction of its seconds")
            return replace(time, values=values), c
    return time, None


# --- several tables, several lines ----------------------------------------------------------------------


def choose_tables(
    tables: Sequence[DataTable], where: Path | str, needed: frozenset[str], part: str | None = None
) -> list[DataTable]:
    """The tables that are meant: those of ``part``, with all columns that are wanted or with time; several alike are lines."""
    inside = f"{(part or '').strip('/')}/".lstrip("/")
    branch = [t for t in tables if t.columns and f"{t.part.strip('/')}/".startswith(inside)]
    alike = next((c for n in (needed, {"time"}) if (c := [t for t in branch if n <= {*t.names}])), branch)
    if len(alike) == 1:
        others = (t for t in tables if t is not alike[0] and {*t.names} & SI_UNITS.keys())
        spare = [f"{t.part or '/'} ({', '.join(t.names[:8])})" for t in others]
        note = [f"skipped, further tables: {one_line('; '.join(spare[:6]))}"] * bool(spare and not part)
        return [replace(alike[0], line=None, notes=(*alike[0].notes, *note))]
    if len({tuple(sorted(t.names)) for t in alike}) == 1:
        return alike
    parts = [t.part or "/" for t in alike]
    raise UserError(
        "the file holds several tables that differ" if alike else "the file holds no table",
        where=where,
        found=", ".join(parts[:12]) + (" ..." if len(parts) > 12 else "") or None,
        expected=part or "vectors of one length in one place, or in groups of equal structure",
        remedy="choose one in a mapping: [file] part = ...; save a table of MATLAB as a structure, by table2struct",
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
    import pandas as pd  # slow to import, and few files need it

    labels = pd.Series(np.array([name_line(v) for v in different], dtype=object)[which])
    once = np.sum(labels == "") > 0.5 * len(labels)  # in the first row of each
    labels = labels.where(labels != "").ffill().fillna("") if once else labels
    rows = {str(n): part.index.to_numpy() for n, part in labels.groupby(labels, sort=False)}
    lost = len(rows.pop("", ()))
    note = [f"{count(lost, 'row')} without the name of a line left out"] * bool(lost)
    note += ["a line is named in its first row, and goes on to the next name"] * bool(once)
    others = tuple(x for x in table.columns if x is not c)
    rest = replace(table, columns=others, notes=(*table.notes, *note))
    return [replace(rest.rows(r), line=n) for n, r in rows.items()]


def name_line(value: object) -> str:
    """The name of a line: 1010 of 1010.0, in numbers or in text; ``""`` where there is none."""
    try:
        number = float(str(value))
    except ValueError:
        return write_cell(value)
    return write_cell(number) if np.isfinite(number) else ""


# --- numbers and codes -------------------------------------------------------------------------------------------


def read_quantities(table: DataTable) -> DataTable:
    """A table with columns of texts that are all numbers, perhaps with units, as numbers; names of lines (10 N) and instants stay texts."""
    decimal = table.decimal or find_decimal(c.values for c in table.columns if c.is_text)
    columns = []
    for c in table.columns:
        first = next((t for t in c.values if t not in MISSING), "") if c.is_text else ""
        if split_quantity(first)[0] and "line" not in c.name.casefold() and not are_packed(c.values):
            read, spoiled = read_numbers(c, decimal)
            c = c if spoiled.any() else read
        columns.append(c)
    return replace(table, columns=tuple(columns), decimal=decimal)


def _require_numbers(c: DataColumn, table: DataTable, null: Null, remedy: str | None = None) -> DataColumn:
    """A column of text as numbers; UserError at the first cell that is none."""
    if c.is_number:
        return c
    read, spoiled = read_numbers(c, table.decimal, null)
    if c.is_instant or spoiled.any():
        row, some = int(np.argmax(spoiled)), np.isfinite(read.values).any() and not c.is_instant
        raise UserError(
            "not a number" if some else "the column does not hold numbers",
            where=at(table.place, table.row(row), f"column {c.name!r}"),
            found="dates" if c.is_instant else repr(c.values[row])[:60],
            expected="a number with a decimal point, or nothing where it is missing",
            remedy=remedy or "codes of missing values can be named in a mapping: null = [...]",
        )
    return read


def _leave_out_codes(c: DataColumn, null: Null, notes: list[str]) -> DataColumn:
    """The column without codes of missing values, given by the mapping or recognised, which ``notes`` report."""
    codes = [x for x in null if isinstance(x, float)]
    hits = [(x, np.isclose(c.values, x, rtol=1e-6, atol=0.0)) for x in codes]
    values = np.where(np.any([hit for _, hit in hits], axis=0), np.nan, c.values) if hits else c.values
    hits += [(x, values == x) for x in find_codes(values, known_only=c.name == "time")]
    unit = "" if c.unit in ("", "1") else f" {c.unit}"
    for code, hit in hits:
        if hit.any():
            notes.append(
                f"{c.name}: left out as missing: {count(int(np.sum(hit)), 'value')} of {code:.10g}{unit}"
            )
            values = np.where(hit, np.nan, values)
    return replace(c, values=values)


# --- axes ----------------------------------------------------------------------------------------------


def _turn(table: DataTable, axes: Sequence[tuple[int, float]], path: Path) -> DataTable:
    """The table with its vectors and its tensor in the measurement frame."""
    columns = []
    for c in table.columns:
        name, sign = c.name, 1.0
        if _COMPONENT.fullmatch(c.name):
            stem, _, letters = c.name.rpartition("_")
            turned = [axes["xyz".index(k)] for k in letters]
            name = f"{stem}_{''.join(sorted('xyz'[k] for k, _ in turned))}"
            sign = float(np.prod([s for _, s in turned]))
        if name not in table.names:
            lacking = f"{c.name} comes from {name}, which [columns] does not have"
            what = "a component that the axes need is missing"
            raise UserError(what, where=at(path, "[axes]"), found=lacking)
        source = table.column(name)
        columns.append(replace(source, name=c.name, values=source.values if sign > 0 else -source.values))
    return replace(table, columns=tuple(columns))
