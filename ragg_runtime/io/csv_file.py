"""CSV flights: a header of ``name [unit]``, or names and a row of units below; ``.gz`` is read as well."""

from __future__ import annotations

import csv
import gzip
import io
import itertools
import re
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO

import numpy as np
import pyarrow as pa
import pyarrow.csv

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.io.instants import is_instant
from ragg_runtime.io.one_table import floats, joined, texts
from ragg_runtime.io.source import (
    Heading,
    Look,
    Rows,
    Table,
    Written,
    distinct,
    heading,
    is_line,
    units_below,
)

NAME = "csv"
ENDINGS = (".csv", ".csv.gz")
MAGIC = ()

LONGEST_LINE = 1 << 20
"""Characters of a line from which a file is no table."""

_MISSING = ("", "nan", "NaN", "NAN", "NA", "N/A", "null", "NULL", "None")
_NOT_CSV = "the file is not a table of comma-separated values"
_GZIP = b"\x1f\x8b"
_SNIFFED = 50  # rows that are looked at to tell columns of numbers from columns of text

_NO_NUMBER = re.compile(
    r"In CSV column #(\d+): (?:Row #(\d+): )?CSV conversion error to \w+: invalid value (.*)", re.DOTALL
)
_OTHER_WIDTH = re.compile(r"CSV parse error: (?:Row #(\d+): )?Expected (\d+) columns, got (\d+)")
"""How Arrow says that a cell is no number, and that a line has too few cells or too many."""


@dataclass(frozen=True)
class _Layout:
    """Where the table begins in the file, and its columns, all of them."""

    path: Path
    compressed: bool
    delimiter: str
    skip: int
    headings: tuple[Heading, ...]


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The CSV file as one table; UserError if it has no header."""
    with path.open("rb") as stream:
        compressed = stream.read(2) == _GZIP
    layout = _layout(path, compressed, look)
    wanted = tuple(h for h in layout.headings if look.wants(h.name))
    return (Table(path, wanted, lambda: _rows(layout, wanted)),)


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write columns exactly: every number is the shortest that reads back as itself, NaN is left empty."""
    columns, rows = joined(tables)
    header = io.StringIO()
    csv.writer(header, lineterminator="\n").writerow(
        f"{c.name} [{c.unit}]" if c.unit else c.name for c in columns
    )
    table = pa.table({c.name: pa.array(rows[c.name], from_pandas=True) for c in columns})
    with path.open("wb") as raw:
        # Without a name and a time in the gzip header, equal flights give equal files.
        compressed = path.name.lower().endswith(".gz")
        stream: IO[bytes] = gzip.GzipFile("", "wb", 6, raw, mtime=0) if compressed else raw  # type: ignore[assignment]
        stream.write(header.getvalue().encode())
        pyarrow.csv.write_csv(table, stream, pyarrow.csv.WriteOptions(include_header=False))
        if compressed:
            stream.close()


def _layout(path: Path, compressed: bool, look: Look) -> _Layout:
    """Header, units and kinds of the columns, from the first rows."""
    raw: IO[bytes] = gzip.GzipFile(path) if compressed else path.open("rb")  # type: ignore[assignment]
    try:
        with io.TextIOWrapper(raw, "utf-8-sig", newline=None) as stream:
            lines = _lines(stream, path)
            skipped, header = _header(lines, path)
            delimiter = max(",;\t", key=header.count)
            (names,) = csv.reader([header], delimiter=delimiter)
            first = list(csv.reader(itertools.islice(lines, _SNIFFED), delimiter=delimiter))
    except csv.Error as error:
        raise UserError(_NOT_CSV, where=path, found=str(error)) from None
    except (UnicodeDecodeError, OSError, EOFError, zlib.error) as error:
        raise UserError(
            _NOT_CSV,
            where=path,
            found=str(error),
            expected="UTF-8 text: a header of `name [unit]`, then numbers",
            remedy="copy the file again, or save it as CSV, Parquet or NetCDF-4",
        ) from None
    found = [heading(name, path, n) for n, name in enumerate(names, 1)]
    below = 0
    units = units_below(first[0], len(found)) if first and not any(h.unit for h in found) else None
    if units is not None:
        found = [replace(h, unit=u) for h, u in zip(found, units, strict=True)]
        below, first = 1, first[1:]
    headings = [
        replace(h, text=look.allows_text(h.name) and _text(h.name, n, first)) for n, h in enumerate(found)
    ]
    return _Layout(
        path=path,
        compressed=compressed,
        delimiter=delimiter,
        skip=skipped + 1 + below,
        headings=distinct(path, headings),
    )


def _lines(stream: io.TextIOWrapper, path: Path) -> Iterator[str]:
    """The lines of a text; UserError at one too long to be a row of a table."""
    number = 0
    while line := stream.readline(LONGEST_LINE):
        number += 1
        if len(line) == LONGEST_LINE:
            raise UserError(
                _NOT_CSV,
                where=at(path, f"line {number}"),
                found=f"a line of more than {LONGEST_LINE} characters, beginning with {line[:20]!r}",
                expected="one row per line, a number for each column",
                remedy="the file may be damaged, not fully copied, or not a text file",
            )
        yield line


def _header(lines: Iterator[str], path: Path) -> tuple[int, str]:
    """Number of comment or empty lines before the header, and the header."""
    for number, line in enumerate(lines):
        if line.strip() and not line.startswith("#"):
            return number, line.rstrip("\n")
    raise UserError("the flight file has no header", where=path, expected="time [s],a_x [g],...")


def _text(name: str, column: int, rows: Sequence[Sequence[str]]) -> bool:
    """Whether a column holds text: names of lines, or its first value is no number (for ``time``: is an instant)."""
    if is_line(name):
        return True
    value = next((r[column] for r in rows if len(r) > column and r[column] not in _MISSING), "0")
    try:
        float(value)
    except ValueError:
        return name != "time" or is_instant(value)
    return False


def _rows(layout: _Layout, wanted: Sequence[Heading]) -> Rows:
    types = {h.name: pa.string() if h.text else pa.float64() for h in layout.headings}
    try:
        with pa.input_stream(str(layout.path), compression="gzip" if layout.compressed else None) as stream:
            table = pyarrow.csv.read_csv(
                stream,
                # with several threads Arrow does not say in which row it stumbled
                pyarrow.csv.ReadOptions(
                    skip_rows=layout.skip, column_names=list(types), block_size=1 << 22, use_threads=False
                ),
                pyarrow.csv.ParseOptions(delimiter=layout.delimiter),
                pyarrow.csv.ConvertOptions(
                    column_types=types, null_values=_MISSING, include_columns=[h.name for h in wanted]
                ),
            )
    except pa.ArrowInvalid as error:
        if "Empty CSV" in str(error):
            return {h.name: np.empty(0) for h in wanted}
        raise _fault(layout, str(error)) from None
    except (OSError, EOFError) as error:
        raise UserError(
            "the file is damaged or cut off",
            where=layout.path,
            found=str(error),
            expected="a whole file" + (" (gzip)" if layout.compressed else ""),
            remedy="copy it again",
        ) from None
    return {h.name: (texts if h.text else floats)(table.column(h.name)) for h in wanted}


def _fault(layout: _Layout, error: str) -> UserError:
    """What Arrow says, with the line and the column."""
    if match := _OTHER_WIDTH.match(error):
        return UserError(
            "the line has the wrong number of values",
            where=at(layout.path, f"line {match[1]}"),
            found=match[3],
            expected=f"{match[2]}, as the header has",
            remedy="the file may be damaged or cut off",
        )
    if match := _NO_NUMBER.match(error):
        return UserError(
            "not a number",
            where=at(layout.path, f"line {match[2]}", f"column {layout.headings[int(match[1])].name!r}"),
            found=match[3][:60],
            expected="a number with a decimal point, or nothing where it is missing",
        )
    return UserError(_NOT_CSV, where=layout.path, found=error.splitlines()[0][:200])
