"""From a file to flights' sources: its tables, divided into lines, under the names of the contract."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from functools import partial
from pathlib import Path

import numpy as np

from ragg_runtime.base.errors import UserError, at, one_line
from ragg_runtime.base.names import is_column
from ragg_runtime.io.formats import open_file
from ragg_runtime.io.instants import WAYS, seconds, way_of
from ragg_runtime.io.mapping import Entry, Mapped
from ragg_runtime.io.one_table import line_name
from ragg_runtime.io.record import SI_UNITS, Array
from ragg_runtime.io.source import (
    Heading,
    Look,
    Rows,
    Source,
    Table,
    check_units,
    is_line,
    not_numbers,
    passed_over,
)

_VECTOR = re.compile(r"(a|omega|omegadot|B)_([xyz])")
_TENSOR = ("xx", "xy", "xz", "yy", "yz", "zz")


def open_sources(
    path: Path,
    mapping: Mapped | None = None,
    *,
    lenient: bool = False,
    leave: frozenset[str] = frozenset(),
) -> list[Source]:
    """The flights in a file, one or one for each line; without a mapping under the names of the contract.

    ``lenient`` lets columns without a unit pass and leaves out those that are no numbers. ``leave``: columns not to be
    read.
    """
    if mapping is not None and mapping.kept and not _applies(path, mapping):
        mapping = None
    if mapping is None:
        look = Look(text=lenient, leave=leave)
        tables = _lines(open_file(path, look), None)
        sources = _plain(tables, lenient)
    else:
        mapping = mapping.without(leave)
        look = Look(only=mapping.columns, text=True, part=mapping.part)
        found = open_file(path, look)
        _check_names(found[0], mapping)
        tables = _lines(found, mapping.line)
        if mapping.lines is not None:
            tables = _chosen(tables, mapping.lines, path)
        sources = _mapped(tables, mapping)
    if not sources:
        raise UserError("the file holds no rows", where=path)
    return sources


def _applies(path: Path, mapping: Mapped) -> bool:
    """Whether a file has any column that the mapping gives another name."""
    renamed = {e.column for n, e in mapping.channels.items() if e.column != n}
    renamed |= {n for n in mapping.time.columns if n != "time"}
    if not renamed:
        return True
    return any(h.name in renamed for t in open_file(path, Look(text=True)) for h in t.headings)


def _lines(tables: Sequence[Table], column: str | None) -> list[Table]:
    if len(tables) > 1 or not tables:
        return list(tables)
    (table,) = tables
    name = column or next((h.name for h in table.headings if is_line(h.name)), None)
    return [table] if name is None else split(table, name)


def _chosen(tables: Sequence[Table], names: Sequence[str], path: Path) -> list[Table]:
    known = [t.line for t in tables]
    missing = [n for n in names if n not in known]
    if missing:
        raise UserError(
            "the file has no such line",
            where=path,
            found=", ".join(missing),
            expected=", ".join(str(n) for n in known[:20]),
        )
    return [t for t in tables if t.line in names]


def _plain(tables: Sequence[Table], lenient: bool) -> list[Source]:
    origin: datetime | None = None
    found = []
    for table in tables:
        named = [h for h in table.headings if lenient or is_column(h.name) or _lacks_unit(h)]
        kept = tuple(h for h in named if not h.text or h.name == "time")
        dropped = [h for h in named if h not in kept]
        if dropped and not lenient:
            raise not_numbers(table.path, dropped[0].name, "text")
        rows = table.rows
        dated, instants = False, False
        if any(h.text for h in kept):
            whole = dict(table.rows())
            where = at(table.path, "column 'time'")
            way = way_of(whole["time"])
            if way is None:
                raise not_numbers(table.path, "time", "text that is no instant")
            whole["time"], origin = seconds(way, [whole["time"]], where, origin)
            rows, dated, instants = partial(dict, whole), way.dated, True
            kept = tuple(Heading("time", "s") if h.text else h for h in kept)
        if not lenient:
            check_units(table.path, kept)
        notes = tuple(f"{h.name} holds text; it is left out" for h in dropped)
        there = {h.name for h in named}
        passed = tuple(one_line(h.name)[:80] for h in table.headings if h.name not in there)
        if passed:
            notes += (passed_over(passed),)
        found.append(
            Source(
                path=table.path,
                columns=kept,
                rows=rows,
                line=table.line,
                origin=origin if dated else None,
                notes=notes,
                passed=passed,
                instants=instants,
            )
        )
    return found


def _lacks_unit(h: Heading) -> bool:
    """Whether a column is one of the contract but for what stands behind its name in the place of a unit."""
    return not h.unit and h.name.partition("(")[0].strip() in SI_UNITS


def _check_names(table: Table, mapping: Mapped) -> None:
    there = {h.name for h in table.headings}
    missing = sorted(mapping.columns - there)
    if missing:
        raise UserError(
            "columns that the mapping names are not in the file",
            where=table.path,
            found=", ".join(missing),
            expected=f"the columns of {mapping.path}",
            remedy="write a mapping for this file: ragg map FLIGHT -o mapping.toml",
        )


def _mapped(tables: Sequence[Table], mapping: Mapped) -> list[Source]:
    time = mapping.time
    way = WAYS.get(time.format)
    origin = time.origin
    found = []
    for table in tables:
        units = {h.name: h.unit for h in table.headings}
        texts = {h.name for h in table.headings if h.text}
        for e in mapping.channels.values():
            if e.column in texts:
                raise not_numbers(table.path, e.column, "text")
        if way is None and time.columns[0] in texts:
            raise UserError(
                "time is text, not seconds",
                where=at(table.path, f"column {time.columns[0]!r}"),
                remedy=f"say in {mapping.path} how it is written: [time] format = "
                + ", ".join(map(repr, WAYS)),
            )
        headings = [Heading("time", "s" if way else time.unit or units[time.columns[0]])]
        headings += [Heading(n, e.unit or units[e.column]) for n, e in mapping.channels.items()]
        check_units(table.path, headings)
        columns, rotation = _rotated(tuple(headings), mapping)
        rows = partial(_mapped_rows, table.rows, mapping, rotation)
        if way is not None:
            raw = table.rows()
            where = at(table.path, f"column {time.columns[0]!r}")
            instants, origin = seconds(way, [raw[n] for n in time.columns], where, origin)
            rows = partial(_mapped_rows, partial(dict, raw), mapping, rotation, instants)
        notes: tuple[str, ...] = (f"read by {mapping.path.name} (SHA-256 {mapping.digest[:16]})",)
        if mapping.demodulator is not None:
            notes += (f"demodulated: {mapping.demodulator.words()}",)
        found.append(
            Source(
                path=table.path,
                columns=columns,
                rows=rows,
                line=table.line,
                origin=origin if way is None or way.dated else None,
                notes=notes,
                demodulation=mapping.demodulator,
                instants=way is not None,
            )
        )
    return found


def _mapped_rows(
    read: Callable[[], Rows],
    mapping: Mapped,
    rotation: Mapping[str, tuple[str, float]],
    time: Array | None = None,
) -> Rows:
    """Columns under the names of the contract; ``time`` is given where it was read from instants."""
    raw = read()
    found = {"time": raw[mapping.time.columns[0]] if time is None else time}
    found |= {n: _scaled(raw[e.column], e) for n, e in mapping.channels.items()}
    return found | {n: found[own] if sign > 0 else -found[own] for n, (own, sign) in rotation.items()}


def _scaled(values: Array, entry: Entry) -> Array:
    if entry.factor != 1.0:
        values = values * entry.factor
    return values + entry.offset if entry.offset else values


def _rotated(
    columns: tuple[Heading, ...], mapping: Mapped
) -> tuple[tuple[Heading, ...], dict[str, tuple[str, float]]]:
    """Columns in the measurement frame, and for each that changes: the recorder's one and its sign."""
    if mapping.axes is None:
        return columns, {}
    units = {c.name: c.unit for c in columns}
    rotation: dict[str, tuple[str, float]] = {}
    for name in units:
        match = _VECTOR.fullmatch(name)
        if match is not None:
            k, sign = mapping.axes["xyz".index(match[2])]
            rotation[name] = (f"{match[1]}_{'xyz'[k]}", sign)
        elif name.startswith("Gamma_") and name[6:] in _TENSOR:
            (i, s), (j, t) = (mapping.axes["xyz".index(a)] for a in name[6:])
            own = "".join(sorted("xyz"[i] + "xyz"[j]))
            rotation[name] = (f"Gamma_{own}", s * t)
    for name, (own, _) in rotation.items():
        if own not in units:
            raise UserError(
                "a component that the axes need is missing",
                where=at(mapping.path, "[axes]"),
                found=f"{name} comes from {own}, which [columns] does not have",
                expected="all components of a vector or a tensor that is turned",
            )
    turned = tuple(replace(c, unit=units[rotation[c.name][0]]) if c.name in rotation else c for c in columns)
    return turned, rotation


MOST_LINES = 20_000
"""Lines of a file, beyond which the column does not name lines: the largest surveys have some thousands."""


def split(table: Table, column: str) -> list[Table]:
    """A table for each line, in the order in which they begin; the rows of one need not stand together."""
    import pandas as pd  # slow to import, and only files with lines need it

    headings = tuple(h for h in table.headings if h.name != column)
    whole = dict(table.rows())
    rows, labels = pd.factorize(whole.pop(column))  # numbered as they appear; -1 where nothing stands
    ordinals, names = pd.factorize(np.array([_name(x) for x in labels], dtype=object))
    which = np.where(rows < 0, -1, np.append(ordinals, -1)[rows])
    if len(names) > MOST_LINES:
        raise UserError(
            "the column does not name lines: its values differ from row to row",
            where=f"{table.path}: column {column!r}",
            found=f"{len(names)} values in {len(which)} rows",
            expected=f"at most {MOST_LINES} lines",
            remedy="rename the column, or name another one in a mapping: [file] line = ...",
        )
    if len(names) <= 1 and not np.any(which < 0):
        return [replace(table, headings=headings, rows=lambda: whole)]
    order = np.argsort(which, kind="stable")
    edges = np.searchsorted(which[order], np.arange(len(names) + 1))

    def part(n: int) -> Rows:
        return {h.name: whole[h.name][order[edges[n] : edges[n + 1]]] for h in headings}

    return [
        Table(table.path, headings, lambda n=n: part(n), name)  # type: ignore[misc]
        for n, name in enumerate(names)
        if name
    ]


def _name(label: object) -> str:
    """The name of a line: 1010 of 1010.0, in numbers or in text."""
    try:
        value = float(str(label))
    except ValueError:
        return line_name(label)
    return line_name(value) if np.isfinite(value) else ""
