"""ASEG-GDF2 flights: a table in columns of fixed width (.dat), which a file beside it describes (.dfn).

D. A. Pratt, The ASEG-GDF2 standard for point located data, Australian Society of Exploration Geophysicists,
2003. Read are records of data, with their units and nulls; comments and records of other types are passed over.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.base.files import PAIR, pair
from ragg_runtime.flight.numerals import numbers, shortest
from ragg_runtime.flight.one_table import joined
from ragg_runtime.flight.source import Column, Heading, Look, RawBatch, Table, Written, distinct, not_numbers

NAME = "ASEG-GDF2"
ENDINGS = PAIR
MAGIC = ()

LONGEST_DEFINITION = 1 << 20
"""Bytes of a .dfn file at most."""

_WIDEST = 1 << 16  # characters of a record
_AT_ONCE = 16384  # records that are read at a time
_FIELD = re.compile(r"(\d*)(ES|EN|[AIFEGDX])(\d*)(?:\.(\d+))?", re.IGNORECASE)
_SIZED = re.compile(r"\s*DEFN\s*\d*\s*(.*)", re.IGNORECASE)


@dataclass(frozen=True)
class _Field:
    """A column of the records: from character ``start`` to ``stop``."""

    name: str
    unit: str
    text: bool
    null: float | None
    start: int
    stop: int


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The data records as one table."""
    data, definition = (_of_pair(path, s) for s in PAIR)
    fields, kind = _fields(_text(definition), definition)
    wanted = [f for f in fields if look.wants(f.name) and f.name.upper() != "RT"]
    for f in wanted:
        if f.text and not look.allows_text(f.name):
            raise not_numbers(definition, f.name, "text (A)")
    headings = distinct(definition, [Heading(f.name, f.unit, f.text) for f in wanted])
    return (Table(path, headings, lambda: _batches(data, fields, wanted, kind)),)


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write both files; every number is the shortest that reads back as itself."""
    columns, rows = joined(tables)
    nulls = {c.name: _null(c, tables) for c in columns}
    widths = {c.name: 1 for c in columns}
    exponents: set[str] = set()
    decimals = dict.fromkeys(widths, 0)

    def cells(part: Any) -> list[list[str]]:
        return [_cells(part[c.name], nulls[c.name]) for c in columns]

    for part in rows(_AT_ONCE):
        for c, texts in zip(columns, cells(part), strict=True):
            widths[c.name] = max(widths[c.name], *map(len, texts))
            if c.unit or c.name != "line":
                exponents |= {c.name} if any("e" in t for t in texts) else set()
                decimals[c.name] = max(
                    decimals[c.name], *(len(t.split("e")[0].partition(".")[2]) for t in texts)
                )
    with path.with_suffix(".dat").open("w", encoding="utf-8", newline="\n") as stream:
        for part in rows(_AT_ONCE):
            padded = [
                [t.rjust(widths[c.name] + 1) for t in x] for c, x in zip(columns, cells(part), strict=True)
            ]
            stream.writelines("".join(row) + "\n" for row in zip(*padded, strict=True))
    lines = ["DEFN   ST=RECD,RT=COMM;RT:A4;COMMENTS:A76"]
    for n, c in enumerate(columns, 1):
        kind = "A" if not c.unit and c.name == "line" else "E" if c.name in exponents else "F"
        size = f"{widths[c.name] + 1}" + ("" if kind == "A" else f".{decimals[c.name]}")
        null = nulls[c.name]
        attributes = [f"UNIT={_bare(c.unit)}"] * bool(c.unit) + [f"NULL={null}"] * bool(null)
        lines.append(
            f"DEFN {n} ST=RECD,RT=;{_bare(c.name)}:{kind}{size}"
            + (":" + ",".join(attributes) if attributes else "")
        )
    lines.append(f"DEFN {len(columns) + 1} ST=RECD,RT=;END DEFN")
    path.with_suffix(".dfn").write_text("\n".join(lines) + "\n", "utf-8")


def _null(column: Column, tables: Sequence[Written]) -> str:
    """A number that stands for nothing in this column and for nothing else; ``""`` if none is needed."""
    parts = [np.asarray(v) for t in tables for c, v in t.columns if c.name == column.name]
    if len(parts) == len(tables) and not any(np.isnan(v).any() for v in parts):
        return ""
    null = "-99999999"
    while any((v == float(null)).any() for v in parts):
        null += "9"
    return null


def _cells(values: NDArray[Any], null: str) -> list[str]:
    if values.dtype == object:
        return [str(v) for v in values]
    return shortest(values, null)


def _bare(text: str) -> str:
    """A name or unit without the signs that divide a definition."""
    return re.sub(r"[:;,\s]+", "_", text)


def _of_pair(path: Path, suffix: str) -> Path:
    """The file of the pair with this ending, in any case of letters."""
    for file in pair(path):
        if file.suffix.lower() == suffix:
            return file
    raise UserError(
        f"the file that belongs to it is missing: {path.stem}{suffix}",
        where=path,
        expected="a pair as ASEG-GDF2 has it: .dat with the numbers, .dfn with the names",
        remedy="put both into one folder; a .dat file of another kind can be renamed to .csv or .xyz",
    )


def _text(path: Path) -> str:
    with path.open("rb") as stream:
        data = stream.read(LONGEST_DEFINITION + 1)
    if len(data) > LONGEST_DEFINITION:
        raise UserError("the file is too long", where=path, expected=f"at most {LONGEST_DEFINITION} bytes")
    return data.decode("utf-8", "replace")


def _fields(text: str, path: Path) -> tuple[list[_Field], str]:
    """The columns of the data records, and the type that stands at their beginning, if one does."""
    records: dict[str, list[_Field]] = {}
    for line in text.splitlines():
        sized = _SIZED.fullmatch(line)
        if sized is None:
            continue
        head, *parts = sized[1].split(";")
        match = re.search(r"\bRT\s*=\s*(\w*)", head, re.IGNORECASE)
        kind = (match[1] if match else "").upper()
        fields = records.setdefault("" if kind == "DATA" else kind, [])
        for part in parts:
            if part.strip() and part.strip().upper() != "END DEFN":
                fields += _parts(part, fields[-1].stop if fields else 0, path)
    found = records.get("") or next((f for k, f in records.items() if k not in ("COMM", "PROJ")), [])
    if not found or found[-1].stop > _WIDEST:
        raise UserError(
            "the definition names no data",
            where=path,
            found=", ".join(f"record type {k or '(none)'}" for k in records)
            or "no line that begins with DEFN",
            expected="lines such as: DEFN 1 ST=RECD,RT=;EASTING:F12.2:UNIT=m",
        )
    return found, "DATA" if found[0].name.upper() == "RT" else ""


def _parts(text: str, start: int, path: Path) -> list[_Field]:
    """The columns of one field, ``NAME:3F10.2:UNIT=m,NULL=-999``."""
    name, _, rest = (t.strip() for t in text.partition(":"))
    size, _, more = (t.strip() for t in rest.partition(":"))
    match = _FIELD.fullmatch(size)
    if match is None or not match[3] or int(match[3]) > _WIDEST or int(match[1] or 1) > _WIDEST:
        raise UserError(
            "the format of a field cannot be read",
            where=at(path, name[:40]),
            found=repr(size)[:60],
            expected="a Fortran format such as F12.2, I8, E15.7, A4",
        )
    attributes = dict(re.findall(r"\b(UNITS?|NULL|NAME)\s*=\s*([^,:]*)", more, re.IGNORECASE))
    attributes = {k.upper().rstrip("S"): v.strip() for k, v in attributes.items()}
    width, count, kind = int(match[3]), int(match[1] or 1), match[2].upper()
    if kind == "X":
        return [_Field(name="RT", unit="", text=True, null=None, start=start, stop=start + width * count)]
    try:
        null = float(attributes.get("NULL", ""))
    except ValueError:
        null = None
    return [
        _Field(
            name=name if count == 1 else f"{name}_{k + 1}",
            unit=attributes.get("UNIT", ""),
            text=kind == "A",
            null=null,
            start=start + k * width,
            stop=start + (k + 1) * width,
        )
        for k in range(count)
    ]


def _batches(path: Path, fields: Sequence[_Field], wanted: Sequence[_Field], kind: str) -> Iterator[RawBatch]:
    width = fields[-1].stop
    with path.open("rb") as stream:
        before = 0
        for lines in _records(stream, path, width, kind):
            table = np.array(lines, dtype=f"S{width}").view(np.uint8).reshape(len(lines), width)
            table = np.where(table == 0, np.uint8(32), table)
            found: dict[str, NDArray[Any]] = {}
            for f in wanted:
                cells = np.ascontiguousarray(table[:, f.start : f.stop]).view(f"S{f.stop - f.start}").ravel()
                if f.text:
                    found[f.name] = np.array(
                        [c.decode("utf-8", "replace").strip() for c in cells], dtype=object
                    )
                    continue
                found[f.name] = _numbers(cells, f, path, before)
            before += len(lines)
            yield found


def _numbers(cells: NDArray[np.bytes_], field: _Field, path: Path, before: int) -> NDArray[Any]:
    values = numbers(
        cells,
        lambda n: at(path, f"record {before + n + 1}", f"column {field.name!r}"),
        f"a number in characters {field.start + 1} to {field.stop}, as the .dfn file says",
    )
    return values if field.null is None else np.where(values == field.null, np.nan, values)


def _records(stream: BinaryIO, path: Path, width: int, kind: str) -> Iterator[list[bytes]]:
    """Data records, so many at a time, without their ends of line."""
    waiting: list[bytes] = []
    while raw := stream.readline(_WIDEST + 2):
        line = raw.rstrip(b"\r\n")
        if not line.strip() or (kind and line[:4].strip().upper() in (b"COMM", b"PROJ")):
            continue
        if len(line.rstrip()) > width:
            raise UserError(
                "a record is longer than its definition",
                where=path,
                found=f"{len(line.rstrip())} characters",
                expected=f"{width}, as the .dfn file says",
                remedy="the two files may not belong together",
            )
        waiting.append(line)
        if len(waiting) == _AT_ONCE:
            yield waiting
            waiting = []
    if waiting:
        yield waiting
