"""From a table to a recording: the columns that are meant under the names of the contract, time in seconds.

The only way for all formats: text that should be numbers is read or refused with its cell, what stands for missing
values is left out, a mapping's names, units, signs and axes are applied.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, one_line
from ragg_runtime.base.names import EXPECTED, is_column
from ragg_runtime.instrument.demodulation import Demodulation
from ragg_runtime.instrument.units import units
from ragg_runtime.io.instants import WAYS, Seconds, count_from, read_stamps
from ragg_runtime.io.mapping import Entry, Mapped, Null
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.io.tables import Column, Table, choose_tables, line_name, split_lines
from ragg_runtime.io.text_tables import MISSING, is_comma, write_plain

Array = NDArray[np.float64]

NEEDED = frozenset(("time", *SPECIFIC_FORCE, *ANGULAR_RATE))
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
_TENSOR = ("xx", "xy", "xz", "yy", "yz", "zz")
_THOUSANDS = re.compile(r"\s*[+-]?[1-9]\d{0,2}(?:,\d{3})+\s*")
_NINES = re.compile(r"-?9{3,}(?:\.(?:0|25|9+))?")


@dataclass(frozen=True, eq=False)
class Recording:
    """A flight: columns of numbers under the names of the contract, each with a unit.

    ``line`` is the flight line, where there are several; ``origin`` the instant at which ``time`` is 0, if it is known
    (UTC, or GPS time where the file counts in that); ``instants`` whether its stamps are instants, not seconds; ``notes``
    say what was made of the file, ``demodulation`` how its channels were made, if that is known; ``passed`` names columns
    that are none of a flight; ``place`` is for messages.
    """

    columns: tuple[Column, ...]
    place: str
    line: str | None = None
    origin: datetime | None = None
    instants: bool = False
    notes: tuple[str, ...] = ()
    demodulation: Demodulation | None = None
    passed: tuple[str, ...] = field(default=())

    def __len__(self) -> int:
        return len(self.columns[0].values) if self.columns else 0


def make_recordings(
    tables: Sequence[Table],
    place: Path | str,
    mapping: Mapped | None = None,
    *,
    lenient: bool = False,
    leave: frozenset[str] = frozenset(),
) -> list[Recording]:
    """The recordings in the tables of one file, one for each line.

    Parameters
    ----------
    tables
        All tables of the file.
    place
        The file, for messages.
    mapping
        What the columns are; ``None``: they have the names of the contract.
    lenient
        Let columns without a unit pass.
    leave
        Channels that are left aside.

    Raises
    ------
    UserError
        If a choice among tables is needed, or a column is missing, has no unit, or holds what is no number.
    """
    if mapping is not None and mapping.kept and not _applies(tables, mapping):
        mapping = None
    if mapping is None:
        lines = split_lines(choose_tables(tables, place, NEEDED), None, place)
    else:
        mapping = mapping.without(leave)
        chosen = choose_tables(tables, place, mapping.columns, mapping.part)
        _require_names(chosen[0], mapping, place)
        lines = split_lines(chosen, mapping.line, place)
        lines = lines if mapping.lines is None else _pick_lines(lines, mapping.lines, place)
    if not lines:
        raise UserError("the file holds no rows", where=place)
    if mapping is None:
        return [_read_plain(t, str(place), lenient, leave) for t in lines]
    return [_read_mapped(t, str(place), mapping) for t in lines]


def _applies(tables: Sequence[Table], mapping: Mapped) -> bool:
    """Whether a file has any column that the mapping gives another name."""
    renamed = {e.column for n, e in mapping.channels.items() if e.column != n}
    renamed |= {n for n in mapping.time.columns if n != "time"}
    return not renamed or any(renamed & {*t.names} for t in tables)


def _require_names(table: Table, mapping: Mapped, place: Path | str) -> None:
    missing = sorted(mapping.columns - {*table.names})
    if missing:
        raise UserError(
            "columns that the mapping names are not in the file",
            where=place,
            found=f"{', '.join(missing)} of {mapping.path}; the file has {', '.join(table.names[:20])}",
            remedy="write a mapping for this file: ragg map FLIGHT -o mapping.toml",
        )


def _pick_lines(lines: Sequence[Table], names: Sequence[str], place: Path | str) -> list[Table]:
    wanted = {line_name(n) for n in names}
    if lost := sorted(wanted - {str(t.line) for t in lines}):
        expected = ", ".join(str(t.line) for t in lines[:20])
        raise UserError("the file has no such line", where=place, found=", ".join(lost), expected=expected)
    return [t for t in lines if t.line in wanted]


def _read_plain(table: Table, place: str, lenient: bool, leave: frozenset[str]) -> Recording:
    """A table whose columns have the names of the contract."""
    notes = list(table.notes)
    time, others = _find_time(table)
    others = [c for c in others if c.name not in leave]
    named = [c for c in others if lenient or is_column(c.name)]
    passed = tuple(c.name[:80] for c in others if c not in named)
    kept, stamps = [], None
    if time is not None:
        read, stamps = _read_time([time], table, place)
        kept.append(read)
    for c in named:
        if c.is_number or c.name in SI_UNITS:
            kept.append(read_numbers(c, table, place))
        else:
            notes.append(f"{c.name} holds {'text' if c.is_text else 'dates'}; it is left out")
    kept = _keep_first(kept, place, notes)
    if not lenient:
        require_units(kept, place)
    if passed:
        notes.append(pass_over(passed))
    return _finish(Recording(tuple(kept), place, table.line, notes=tuple(notes), passed=passed), stamps, {})


def _find_time(table: Table) -> tuple[Column | None, list[Column]]:
    """The column of time and all others; where none is called so the index of the rows is, if it is a time."""
    time = next((c for c in table.columns if c.name == "time"), None)
    index = next((c for c in table.columns if c.name == table.index), None)
    if time is None and index is not None:
        time = index if not index.is_number or units(9.8).fits(index.unit or "1", "s") else None
    return time, [c for c in table.columns if c is not time and c is not index]


def _read_time(
    columns: Sequence[Column],
    table: Table,
    place: str,
    form: str | None = None,
    unit: str = "",
    null: Null = (),
) -> tuple[Column, Seconds | None]:
    """Time as the numbers that it is, or as seconds of the instants that it is; ``form``, ``unit``, ``null``: of a mapping."""
    first = columns[0]
    where = at(place, f"column {first.name!r}")
    numeric = first.is_number or (first.is_text and np.mean(np.isfinite(parse_numbers(first.values))) > 0.5)
    if form == "seconds" or (form is None and numeric):
        remedy = None if numeric else f"say how it is written: [time] format = {', '.join(map(repr, WAYS))}"
        first = read_numbers(first, table, place, null, remedy)
        base, _, epoch = first.unit.partition(" since ")
        first = replace(first, name="time", unit=unit or base)
        stamps = count_from(units(9.8).to_si(first.values, first.unit, "s", where), epoch) if epoch else None
    else:
        stamps = read_stamps([c.values for c in columns], form, where, table.row)
    return (first, None) if stamps is None else (Column("time", "s", stamps.values), stamps)


def _finish(made: Recording, stamps: Seconds | None, nulls: Mapping[str, Null]) -> Recording:
    """Missing-value codes and rows without a time left out and counted; what is known of the instants."""
    notes = list(made.notes)
    columns = tuple(_without_codes(c, nulls.get(c.name, ()), notes) for c in made.columns)
    time = next((c.values for c in columns if c.name == "time"), np.zeros(0))
    there = np.isfinite(time)
    if there.any() and not there.all():
        lost = int(np.sum(~there))
        notes.append(f"{lost} row{'s' * (lost > 1)} without a time left out")
        columns = tuple(replace(c, values=c.values[there]) for c in columns)
    if stamps is not None:
        made = replace(made, origin=stamps.origin, instants=stamps.instants)
        notes += stamps.notes
    return replace(made, columns=columns, notes=tuple(notes))


def _keep_first(columns: Iterable[Column], place: str, notes: list[str]) -> list[Column]:
    """The first column of every name; UserError if a second one has a name of the contract."""
    found: dict[str, Column] = {}
    for c in columns:
        if found.setdefault(c.name, c) is c:
            continue
        if c.name in SI_UNITS:
            raise UserError(f"the column {c.name!r} appears twice", where=place, remedy="rename one")
        notes.append(f"{c.name}: a second column of this name is left out")
    return list(found.values())


def pass_over(names: Sequence[str]) -> str:
    """In words: columns whose names nothing can have."""
    shown = ", ".join(map(repr, names[:6])) + (" ..." if len(names) > 6 else "")
    return one_line(f"passed over for their names ({EXPECTED}): {shown}")


def require_units(columns: Iterable[Column], place: str) -> None:
    """UserError where a unit is missing."""
    for c in columns:
        if not c.unit:
            raise UserError(
                "the column has no unit",
                where=f"{place}: column {c.name!r}",
                found=repr(c.name),
                expected=f"{c.name} [unit], such as {c.name} [{SI_UNITS.get(c.name, 'K')}]",
                remedy="write the unit; a pure number has the unit 1; none is guessed. Or say once for all files "
                "what their columns are: ragg map FLIGHT -o mapping.toml",
            )


# --- numbers -------------------------------------------------------------------------------------------


def read_numbers(c: Column, table: Table, place: str, null: Null = (), remedy: str | None = None) -> Column:
    """A column of text as numbers; UserError at the first cell that is none."""
    if c.is_number:
        return c
    texts = np.array(["" if t in null else t for t in c.values], dtype=object) if null else c.values
    numbers = parse_numbers(texts) if c.is_text else np.full(len(texts), np.nan)
    spoiled = np.flatnonzero(find_spoiled(texts, numbers)) if c.is_text else range(len(texts))
    if len(spoiled):
        raise UserError(
            "not a number" if np.isfinite(numbers).any() else "the column does not hold numbers",
            where=at(place, table.row(int(spoiled[0])), f"column {c.name!r}"),
            found=repr(str(texts[spoiled[0]]))[:60],
            expected="a number with a decimal point, or nothing where it is missing",
            remedy=remedy or "codes of missing values can be named in a mapping: null = [...]",
        )
    return replace(c, values=numbers)


def parse_numbers(texts: NDArray[np.object_]) -> Array:
    """Numbers (n,) of texts, NaN where they are none: with decimal commas, a minus of print or the D of Fortran, too.

    Commas that may stand between thousands (1,234) are not taken for decimal ones.
    """

    def parse(text: str) -> float:
        try:
            return float(text)
        except ValueError:
            return np.nan

    found = np.array([parse(t) for t in texts], dtype=np.float64)
    odd = [k for k in np.flatnonzero(np.isnan(found)) if texts[k] not in MISSING]
    plain = [write_plain(str(texts[k])) for k in odd]
    commas = not any("." in str(t) for t in texts) and not all(
        map(_THOUSANDS.fullmatch, filter(is_comma, plain))
    )
    for k, text in zip(odd, plain, strict=True):
        found[k] = parse(text.replace(",", ".") if commas and is_comma(text) else text)
    return found


def find_spoiled(texts: NDArray[np.object_], numbers: Array) -> NDArray[np.bool_]:
    """Where a text is neither a number nor one of those that stand for nothing."""
    return np.isnan(numbers) & np.array([t not in MISSING for t in texts], dtype=np.bool_)


def _without_codes(c: Column, null: Null, notes: list[str]) -> Column:
    """The column without what stands for missing values, by the mapping or by its looks; said in ``notes``."""
    values, told = c.values, []
    named = [(n, np.isclose(values, n, rtol=1e-6, atol=0.0)) for n in null if isinstance(n, float)]
    for code, hit in named:
        told += [(code, int(np.sum(hit)))] if hit.any() else []
        values = np.where(hit, np.nan, values)
    for code in find_codes(values, known_only=c.name == "time"):
        told.append((code, int(np.sum(values == code))))
        values = np.where(values == code, np.nan, values)
    unit = "" if c.unit in ("", "1") else f" {c.unit}"
    for code, count in told:
        shown = f"{count} value{'s' * (count > 1)} of {code:.10g}{unit}"
        notes.append(f"{c.name}: {shown} stand for missing values: no readings, left out")
    return replace(c, values=values) if told else c


def find_codes(values: Array, *, known_only: bool = False) -> list[float]:
    """Values that stand for missing ones: isolated extremes that repeat, or are usual codes such as -9999.

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
    rest, usual = x, []
    while (
        len(rest)
        and (code := next(filter(_is_usual, (float(rest.min()), float(rest.max()))), None)) is not None
    ):
        usual.append(code)
        rest = rest[rest != code]
    if not len(rest):  # a sensor that was not there
        return [c for c in usual if c < 0 or c >= 1e20]
    found = [c for c in usual if _is_isolated(x[(x == c) | ~np.isin(x, usual)], c, rest, QUIET)]
    x = x[~np.isin(x, found)] if found else x
    while not known_only and len(x) > 2:
        code = next((v for v in (float(x.min()), float(x.max())) if _is_unusual_code(x, v)), None)
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


# --- mapping -------------------------------------------------------------------------------------------


def _read_mapped(table: Table, place: str, mapping: Mapped) -> Recording:
    """A table whose columns are what the mapping says."""
    notes = [f"read by {mapping.path.name} (SHA-256 {mapping.digest[:16]})", *table.notes]
    t, entries = mapping.time, mapping.channels
    time, stamps = _read_time([table.column(n) for n in t.columns], table, place, t.format, t.unit, t.null)
    found = [time]
    for name, e in entries.items():
        c = read_numbers(table.column(e.column), table, place, e.null)
        found.append(replace(c, name=name, unit=e.unit or c.unit))
    require_units(found, place)
    how = mapping.demodulator
    notes += [] if how is None else [f"demodulated: {how.words()}"]
    made = Recording(tuple(found), place, table.line, t.origin, False, tuple(notes), how)
    made = _finish(made, stamps, {n: e.null for n, e in entries.items()} | {"time": t.null})
    scaled = [c if c.name == "time" else _scale(c, entries[c.name]) for c in made.columns]
    return replace(made, columns=tuple(_turn(scaled, mapping)))


def _scale(c: Column, e: Entry) -> Column:
    return c if (e.factor, e.offset) == (1.0, 0.0) else replace(c, values=c.values * e.factor + e.offset)


def _turn(columns: Sequence[Column], mapping: Mapped) -> list[Column]:
    """Columns in the measurement frame."""
    if mapping.axes is None:
        return list(columns)
    by_name = {c.name: c for c in columns}
    found = []
    for c in columns:
        own, sign = _source_of(c.name, mapping.axes)
        if own not in by_name:
            lacking = f"{c.name} comes from {own}, which [columns] does not have"
            what = "a component that the axes need is missing"
            raise UserError(what, where=at(mapping.path, "[axes]"), found=lacking)
        source = by_name[own]
        found.append(replace(source, name=c.name, values=source.values if sign > 0 else -source.values))
    return found


def _source_of(name: str, axes: Sequence[tuple[int, float]]) -> tuple[str, float]:
    """The recorder's column from which a component in the measurement frame comes, and its sign."""
    if match := _VECTOR.fullmatch(name):
        k, sign = axes["xyz".index(match[2])]
        return f"{match[1]}_{'xyz'[k]}", sign
    if name.startswith("Gamma_") and name[6:] in _TENSOR:
        (i, s), (j, t) = (axes["xyz".index(a)] for a in name[6:])
        return "Gamma_" + "".join(sorted("xyz"[i] + "xyz"[j])), s * t
    return name, 1.0
