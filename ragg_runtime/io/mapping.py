"""``mapping.toml``: which column of a foreign file is what, in which unit, sign, axis and clock. Plain data.

Its tables and keys, with an example: docs/reference/mapping.md.
"""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from ragg_runtime.base.errors import UserError, at, check_keys, did_you_mean, is_column, read_name
from ragg_runtime.base.files import read_text
from ragg_runtime.instrument.demodulation import Demodulation, read_demodulation
from ragg_runtime.instrument.units import units
from ragg_runtime.io.instants import WAYS, parse_order

UNKNOWN = "?"
"""What ``ragg map`` writes where the answer is not in the file."""

_TABLES = ("file", "time", "columns", "axes", "demodulator", "null", "format")
_KEYS: Mapping[str, tuple[str, ...]] = {
    "file": ("line", "lines", "part", "null", "format"),
    "time": ("column", "format", "unit", "origin", "null"),
    "axes": ("x", "y", "z"),
    "columns": ("column", "unit", "sign", "scale", "offset", "null"),
}

Null = tuple[float | str, ...]
"""What stands for a missing value: numbers in the file's unit, or texts."""


@dataclass(frozen=True)
class Entry:
    """A channel: the file's column and unit; a value is ``factor`` times the file's, plus ``offset`` (in the unit)."""

    column: str
    unit: str
    factor: float = 1.0
    offset: float = 0.0
    null: Null = ()


@dataclass(frozen=True)
class TimeEntry:
    """The columns of time and how it is written (``None``: recognised); ``origin``: when plain seconds were 0."""

    columns: tuple[str, ...]
    format: str | None = None
    unit: str = ""
    origin: datetime | None = None
    null: Null = ()


@dataclass(frozen=True)
class Mapped:
    """A mapping as it was read; see the module's text for the file.

    ``axes``: for x, y, z of the measurement frame, the recorder's axis (0, 1, 2) and its sign. ``digest``: SHA-256 of
    the text. ``kept``: it is the model's own, and does not apply to files that have none of its columns.
    """

    path: Path
    time: TimeEntry
    channels: Mapping[str, Entry]
    axes: tuple[tuple[int, float], ...] | None = None
    line: str | None = None
    lines: tuple[str, ...] | None = None
    part: str | None = None
    demodulator: Demodulation | None = None
    digest: str = ""
    kept: bool = False

    @property
    def columns(self) -> frozenset[str]:
        """Every column of the file that is needed."""
        named = {e.column for e in self.channels.values()} | {*self.time.columns}
        return frozenset(named if self.line is None else {*named, self.line})


def read_mapping(path: Path) -> Mapped:
    """The mapping in a file; UserError if something in it cannot be, or is not answered yet."""
    return parse_mapping(read_text(path), path)


def parse_mapping(text: str, path: Path) -> Mapped:
    """The mapping in a text; ``path`` is its file."""
    try:
        data = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # ValueError: numbers of thousands of digits
        raise UserError("not valid TOML", where=path, found=str(error) or "nested too deeply") from None
    check_keys(data, _TABLES, path)
    for key, value in data.items():
        if not isinstance(value, dict) and key not in ("null", "format"):
            raise UserError(f"[{key}] is not a table", where=path, found=repr(value)[:60])
        if key in _KEYS and key != "columns":
            check_keys(value, _KEYS[key], at(path, f"[{key}]"))
    file, place = data.get("file", {}), at(path, "[file]")
    lines = file.get("lines")
    if not (lines is None or (isinstance(lines, list) and lines and all(isinstance(x, str) for x in lines))):
        raise _refuse("lines is not a list of names", place, lines, '["1010", "1020"]')
    null = _read_null(data.get("null"), str(path)) + _read_null(file.get("null"), place)
    columns = data.get("columns", {})
    if "time" not in data or "time" in columns:
        what = "time has a table of its own" if "time" in columns else "[time] is missing"
        raise UserError(what, where=path, expected='[time] column = "...", unit = "s"')
    formats = [x["format"] for x in (data["time"], file, data) if "format" in x]
    return Mapped(
        path=path,
        time=_read_time(data["time"], next(iter(formats), "seconds"), null, at(path, "[time]")),
        channels=MappingProxyType(
            {n: _read_entry(n, v, null, at(path, f"[columns] {n}")) for n, v in columns.items()}
        ),
        axes=_read_axes(data["axes"], at(path, "[axes]")) if "axes" in data else None,
        line=_read_word(file.get("line"), "line", place),
        lines=tuple(lines) if lines is not None else None,
        part=_read_word(file.get("part"), "part", place),
        demodulator=read_demodulation(data.get("demodulator"), at(path, "[demodulator]")),
        digest=hashlib.sha256(text.encode()).hexdigest(),
    )


def _refuse(what: str, where: str, found: object, expected: str, remedy: str | None = None) -> UserError:
    return UserError(what, where=where, found=repr(found)[:60], expected=expected, remedy=remedy)


def _read_null(raw: Any, where: str) -> Null:
    """One or several numbers or texts."""
    values = raw if isinstance(raw, list) else [] if raw is None else [raw]
    if any(isinstance(v, bool) or not isinstance(v, int | float | str) for v in values):
        raise _refuse("null is not a list of numbers and texts", where, raw, "null = [-9999]")
    return tuple(v.strip() if isinstance(v, str) else float(v) for v in values)


def _read_entry(name: str, raw: Any, null: Null, where: str) -> Entry:
    if not is_column(name):
        read_name(name, where, "temperature")
    if isinstance(raw, str):
        raw = {"column": raw}
    if not isinstance(raw, dict) or "column" not in raw:
        example = f'{name} = {{ column = "its name in the file", unit = "..." }}'
        raise _refuse("the column of the file is not named", where, raw, example)
    check_keys(raw, _KEYS["columns"], where)
    sign, scale, offset = (
        _read_number(raw.get(key, default), key, where)
        for key, default in (("sign", 1), ("scale", 1), ("offset", 0))
    )
    if sign not in (1.0, -1.0):
        raise _refuse("sign is 1 or -1", where, raw["sign"], "scale for other factors")
    if scale == 0.0:
        raise UserError("the scale must not be zero", where=where)
    return Entry(
        column=_read_word(raw["column"], "column", where) or "",
        unit=_read_unit(raw.get("unit", ""), where),
        factor=sign * scale,
        offset=offset,
        null=null + _read_null(raw.get("null"), where),
    )


def _read_time(raw: Mapping[str, Any], form: Any, null: Null, where: str) -> TimeEntry:
    columns = raw.get("column")
    names = (columns,) if isinstance(columns, str) else tuple(columns) if isinstance(columns, list) else ()
    written = _read_word(form, "format", where) or ""
    if written not in ("seconds", *WAYS) and parse_order(written) is None:
        known = "seconds, " + ", ".join(f"{n} ({example})" for n, (_, example) in WAYS.items())
        near = did_you_mean(written, ("seconds", *WAYS))
        raise _refuse("no such format of time", where, written, known, near)
    count = WAYS[written][0] if written in WAYS else 1
    both = parse_order(written) is not None and len(names) == 2  # the date and the time of the day
    if (len(names) != count and not both) or not all(isinstance(n, str) and n for n in names):
        how, example = ("two columns", '["DATE", "CLOCK"]') if count == 2 else ("one column", '"..."')
        raise _refuse(f"time as {written!r} needs {how}", where, columns, f"column = {example}")
    origin = raw.get("origin")
    if origin is not None and (not isinstance(origin, datetime) or written != "seconds"):
        raise _refuse("origin is the instant of second 0", where, origin, "2026-03-01T00:00:00Z, of seconds")
    if origin is not None and origin.tzinfo is None:
        origin = origin.replace(tzinfo=UTC)
    unit = _read_unit(raw.get("unit", ""), where)
    return TimeEntry(names, written, unit, origin, null + _read_null(raw.get("null"), where))


def _read_axes(raw: Mapping[str, Any], where: str) -> tuple[tuple[int, float], ...]:
    found, turned = [], np.zeros((3, 3))
    for k, axis in enumerate("xyz"):
        text = str(raw.get(axis, axis)).strip().lstrip("+")
        bare = text.removeprefix("-")
        if bare not in ("x", "y", "z"):
            raise _refuse("not an axis", at(where, axis), raw.get(axis), '"x", "-y" ...')
        found.append(("xyz".index(bare), -1.0 if text != bare else 1.0))
        turned[k, found[-1][0]] = found[-1][1]
    volume = round(np.linalg.det(turned))
    if volume != 1:
        raise UserError(
            "the axes are a mirror image, not a rotation" if volume else "an axis appears twice",
            where=where,
            found=", ".join(f"{a} = {raw.get(a, a)}" for a in "xyz"),
            expected="a right-handed frame, such as x = y, y = x, z = -z between NED and ENU",
            remedy="if a sensor is reversed, give its column sign = -1",
        )
    return tuple(found)


def _read_unit(raw: Any, where: str) -> str:
    if raw == UNKNOWN:
        expected = "the unit of the column in the file; 1 for a pure number; none is guessed"
        raise _refuse("the unit is not answered yet", where, raw, expected)
    unit = _read_word(raw, "unit", where) or ""
    if unit:
        units(9.8).parse(unit, where)  # whether a text is a unit does not depend on the model's g
    return unit


def _read_word(raw: Any, key: str, where: str) -> str | None:
    if raw is not None and (not isinstance(raw, str) or (raw.strip() in ("", UNKNOWN) and key != "unit")):
        what = f"{key} is not answered" if raw == UNKNOWN else f"{key} is not a text"
        raise UserError(what, where=where, found=repr(raw)[:60])
    return raw


def _read_number(raw: Any, key: str, where: str) -> float:
    if isinstance(raw, bool) or not isinstance(raw, int | float) or not abs(raw) < 1e100:
        raise UserError(f"{key} is not a number", where=where, found=repr(raw)[:60])
    return float(raw)
