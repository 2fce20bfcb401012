"""Geosoft XYZ flights: ``/`` comments, the last of which names the columns; ``Line 10``, ``Tie 20``; rows; ``*``.

The format knows no units. Written files have them in square brackets in a comment below the names, which is
read as well; otherwise a mapping gives them.
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
from ragg_runtime.flight.csv_file import LONGEST_LINE
from ragg_runtime.flight.numerals import numbers, parsed, shortest
from ragg_runtime.flight.one_table import union
from ragg_runtime.flight.source import Heading, Look, RawBatch, Table, Written, distinct, heading

NAME = "Geosoft XYZ"
ENDINGS = (".xyz",)
MAGIC = ()

DUMMY = -1e32
"""What Geosoft keeps in the place of a missing number, and sometimes exports."""

_TYPES = {"line": "", "tie": "T", "random": "R", "base": "B", "test": "P", "trend": "Q", "special": "S"}
_MARK = re.compile(rf"\s*({'|'.join(_TYPES)})\s+(\S.*?)\s*", re.IGNORECASE)
_TOLD = re.compile(r"//\s*(flight|date)\s+(\S+).*", re.IGNORECASE)
_BLOCK = 4 << 20  # bytes that are read at a time
_SNIFFED = 20
_AT_ONCE = 65536


@dataclass(frozen=True)
class _Line:
    """A line: its name, where its rows stand in the file, and what was told before them (flight, date)."""

    name: str
    start: int
    stop: int
    header: tuple[tuple[str, str], ...]


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The lines of an XYZ file."""
    lines, comments, rows = _scanned(path)
    if not rows:
        raise UserError(
            "the XYZ file holds no rows", where=path, expected="/ comments, Line 10, then rows of numbers"
        )
    columns = _columns(path, comments, rows)
    there = {what for x in lines for what, _ in x.header}
    header = [
        Heading(f"//{what.capitalize()}", text=what == "date") for what in ("flight", "date") if what in there
    ]
    asked = [h for h in header if look.only is not None and h.name in look.only] if not look.text else header
    wanted = tuple(h for h in (*columns, *asked) if look.wants(h.name))
    wrong = next((h for h in wanted if h.text and not look.allows_text(h.name)), None)
    if wrong is not None:
        text = next(r.split()[columns.index(wrong)] for r in rows)
        raise UserError(
            "not a number", where=at(path, f"column {wrong.name!r}"), found=repr(text), expected="numbers"
        )
    names = _distinct_names(lines)
    return [
        Table(path, wanted, lambda x=x: _batches(path, x, columns, wanted), name)  # type: ignore[misc]
        for x, name in zip(lines, names, strict=True)
    ]


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write lines; every number is the shortest that reads back as itself, what is missing a star."""
    columns = union(tables)
    names = ["_".join(c.name.split()) for c in columns]
    if len(set(names)) < len(names):
        raise UserError(
            "two columns have one name without their blanks",
            where=path,
            found=", ".join(n for n in names if names.count(n) > 1),
            expected="names that differ: an XYZ file has no blanks in them",
        )
    with path.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write("/ " + " ".join(names) + "\n")
        if any(c.unit for c in columns):
            stream.write("/ " + " ".join(f"[{'.'.join(c.unit.split())}]" for c in columns) + "\n")
        for table in tables:
            if table.line is not None:
                tie = re.fullmatch(r"T(\d.*)", table.line)
                stream.write(f"Tie {tie[1]}\n" if tie else f"Line {table.line}\n")
            values = {c.name: v for c, v in table.columns}
            count = len(table.columns[0][1]) if table.columns else 0
            for start in range(0, count, _AT_ONCE):
                part = slice(start, min(start + _AT_ONCE, count))
                cells = [
                    shortest(np.asarray(values[c.name][part]), "*")
                    if c.name in values
                    else ["*"] * (part.stop - start)
                    for c in columns
                ]
                stream.writelines(" ".join(row) + "\n" for row in zip(*cells, strict=True))


def _scanned(path: Path) -> tuple[list[_Line], list[str], list[str]]:
    """The lines of the file, the comments before the first row, and some rows."""
    lines: list[_Line] = []
    comments: list[str] = []
    rows: list[str] = []
    header: dict[str, str] = {}
    name, start, any_row = "", 0, False
    with path.open("rb") as stream:
        place = 0
        while raw := stream.readline(LONGEST_LINE):
            if len(raw) == LONGEST_LINE:
                raise UserError(
                    "the file is not a Geosoft XYZ file", where=path, found="a line of a million characters"
                )
            head = raw[:1]
            if head == b"/" or not (raw[:12].strip()[:1].isdigit() or raw[:12].strip()[:1] in b"-+.*"):
                text = raw.decode("utf-8", "replace")
                mark = _MARK.fullmatch(text.strip("\r\n"))
                if mark is not None:
                    if any_row:
                        lines.append(_Line(name=name, start=start, stop=place, header=tuple(header.items())))
                    name, start, any_row = _name(mark[1], mark[2]), place + len(raw), False
                elif (found := _TOLD.fullmatch(text.strip())) is not None:
                    if any_row:
                        lines.append(_Line(name=name, start=start, stop=place, header=tuple(header.items())))
                        start, any_row = place + len(raw), False
                    header[found[1].lower()] = found[2]
                elif head == b"/" and not rows:
                    comments = [*comments[-200:], text[1:].strip()]
                elif text.strip() and head != b"/":
                    any_row = True
                    rows += [text] * (len(rows) < _SNIFFED)
            else:
                any_row = True
                if len(rows) < _SNIFFED:
                    rows.append(raw.decode("utf-8", "replace"))
            place += len(raw)
        if any_row:
            lines.append(_Line(name=name, start=start, stop=place, header=tuple(header.items())))
    return lines, comments, rows


def _name(kind: str, text: str) -> str:
    letter = _TYPES[kind.lower()]
    return text if text.upper().startswith(letter) else letter + text


def _distinct_names(lines: Sequence[_Line]) -> list[str | None]:
    """Names of the lines, a line that was flown again with its number; ``None`` if the file names none."""
    if len(lines) == 1 and not lines[0].name:
        return [None]
    seen: dict[str, int] = {}
    found: list[str | None] = []
    for x in lines:
        seen[x.name] = seen.get(x.name, 0) + 1
        found.append(x.name if seen[x.name] == 1 else f"{x.name} ({seen[x.name]})")
    return found


def _columns(path: Path, comments: Sequence[str], rows: Sequence[str]) -> tuple[Heading, ...]:
    """Names and units from the comments that have as many words as the rows; what is no number is text."""
    cells = [r.split() for r in rows]
    count = len(cells[0])
    fitting = [w for c in comments if len(w := c.split()) == count]
    units = [""] * count
    if fitting and all(w.startswith("[") and w.endswith("]") for w in fitting[-1]):
        units = [w.strip("[]") for w in fitting.pop()]
    fitting = [w for w in fitting if any(re.search(r"[^\W_]", x) for x in w)]  # not a rule of ====
    names = fitting[-1] if fitting else [f"column_{n}" for n in range(1, count + 1)]
    found = []
    for n, (name, unit) in enumerate(zip(names, units, strict=True)):
        h = heading(name, path, n + 1)
        value = next((c[n] for c in cells if len(c) == count and c[n] != "*"), "0")
        found.append(Heading(h.name, unit or h.unit, not _is_number(value)))
    return distinct(path, found)


def _is_number(text: str) -> bool:
    try:
        parsed(np.array([text.encode()]))
    except ValueError:
        return False
    return True


def _batches(
    path: Path, line: _Line, columns: Sequence[Heading], wanted: Sequence[Heading]
) -> Iterator[RawBatch]:
    header = dict(line.header)
    with path.open("rb") as stream:
        for block in _blocks(stream, line):
            rows = [r for r in block.splitlines() if r.strip() and not r.startswith(b"/")]
            cells = [c for r in rows for c in r.split()]
            if len(cells) != len(rows) * len(columns) or not rows:
                _complain_of_count(path, line, rows, len(columns))
                continue
            found: dict[str, NDArray[Any]] = {}
            for h in wanted:
                if h.name.startswith("//"):
                    found[h.name] = _repeated(header.get(h.name[2:].lower(), ""), h, len(rows))
                    continue
                column = np.array(cells[columns.index(h) :: len(columns)])
                found[h.name] = _decoded(column) if h.text else _numbers(column, path, line, h)
            yield found


def _blocks(stream: BinaryIO, line: _Line) -> Iterator[bytes]:
    stream.seek(line.start)
    left = line.stop - line.start
    while left > 0:
        block = stream.read(min(_BLOCK, left))
        if not block:
            return
        if len(block) < left:
            block += stream.readline(LONGEST_LINE)
        left -= len(block)
        yield block


def _numbers(cells: NDArray[np.bytes_], path: Path, line: _Line, column: Heading) -> NDArray[Any]:
    place = at(path, f"line {line.name}" if line.name else "", f"column {column.name!r}")
    values = numbers(cells, lambda _: place, "a number, or * where it is missing")
    return np.where(values == DUMMY, np.nan, values)


def _decoded(cells: NDArray[np.bytes_]) -> NDArray[Any]:
    texts = [c.decode("utf-8", "replace") for c in cells]
    return np.array(["" if t == "*" else t for t in texts], dtype=object)


def _repeated(text: str, column: Heading, count: int) -> NDArray[Any]:
    if column.text:
        return np.full(count, text, dtype=object)
    try:
        return np.full(count, float(text))
    except ValueError:
        return np.full(count, np.nan)


def _complain_of_count(path: Path, line: _Line, rows: Sequence[bytes], count: int) -> None:
    wrong = next((r for r in rows if len(r.split()) != count), None)
    if wrong is not None:
        raise UserError(
            "the row has the wrong number of values",
            where=at(path, f"line {line.name}" if line.name else ""),
            found=f"{len(wrong.split())}: {wrong[:60].decode('utf-8', 'replace')!r}",
            expected=f"{count}, as the first row has",
            remedy="the file may be damaged or cut off",
        )
