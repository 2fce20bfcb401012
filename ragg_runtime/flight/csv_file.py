"""CSV flights: a header of ``name [unit]``, then numbers; ``.gz`` is read as well."""

from __future__ import annotations

import csv
import gzip
import io
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import IO

import pyarrow as pa
import pyarrow.csv

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.flight.arrow import floats
from ragg_runtime.flight.record import Array
from ragg_runtime.flight.source import Batch, Column, Source, columns_of

LONGEST_LINE = 1 << 20
"""Characters of a line from which a file is no table."""

_MISSING = ("", "nan", "NaN", "NAN", "NA", "N/A", "null", "NULL", "None")
# Of damaged or cut off files, compressed ones among them.
_UNREADABLE = (UnicodeDecodeError, OSError, EOFError, zlib.error)
_NOT_CSV = "the file is not a table of comma-separated values"


def open_csv(path: Path, compressed: bool) -> Source:
    """The CSV file as a source; UserError if it has no header of names and units."""
    skipped, header = _header(path, compressed)
    delimiter = max(",;\t", key=header.count)
    try:
        names = next(csv.reader([header], delimiter=delimiter))
    except csv.Error as error:
        raise UserError(_NOT_CSV, where=path, found=str(error)) from None
    columns = columns_of(path, [(name, None) for name in names])
    return Source(path, columns, lambda: _batches(path, compressed, columns, delimiter, skipped + 1))


def write_csv(path: Path, columns: list[tuple[Column, Array]], compressed: bool) -> None:
    """Write columns exactly: every number is the shortest that reads back as itself, NaN is left empty."""
    table = pa.table({c.name: pa.array(v, from_pandas=True) for c, v in columns})
    header = ",".join(_quoted(f"{c.name} [{c.unit}]") for c, _ in columns) + "\n"
    options = pyarrow.csv.WriteOptions(include_header=False)
    with path.open("wb") as raw:
        # Without a name and a time in the gzip header, equal flights give equal files.
        stream: IO[bytes] = gzip.GzipFile("", "wb", 6, raw, mtime=0) if compressed else raw  # type: ignore[assignment]
        stream.write(header.encode())
        pyarrow.csv.write_csv(table, stream, options)
        if compressed:
            stream.close()


def _quoted(header: str) -> str:
    return '"' + header.replace('"', '""') + '"' if any(c in header for c in ',"\n') else header


def _open(path: Path, compressed: bool) -> io.TextIOWrapper:
    raw: IO[bytes] = gzip.GzipFile(path) if compressed else path.open("rb")  # type: ignore[assignment]
    return io.TextIOWrapper(raw, "utf-8-sig", newline=None)


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
                expected="one row a line, a number for each column",
                remedy="the file may be damaged, not fully copied, or not a text file",
            )
        yield line


def _header(path: Path, compressed: bool) -> tuple[int, str]:
    """Number of comment or empty lines before the header, and the header."""
    try:
        with _open(path, compressed) as stream:
            for number, line in enumerate(_lines(stream, path)):
                if line.strip() and not line.startswith("#"):
                    return number, line.rstrip("\n")
    except _UNREADABLE as error:
        raise UserError(
            _NOT_CSV,
            where=path,
            found=str(error),
            expected="UTF-8 text: a header of `name [unit]`, then numbers",
            remedy="copy the file again, or save it as CSV, Parquet or NetCDF-4",
        ) from None
    raise UserError("the flight file has no header", where=path, expected="time [s],a_x [g],...")


def _batches(
    path: Path, compressed: bool, columns: tuple[Column, ...], delimiter: str, skip: int
) -> Iterator[Batch]:
    names = [c.name for c in columns]
    try:
        with pa.input_stream(str(path), compression="gzip" if compressed else None) as stream:
            reader = pyarrow.csv.open_csv(
                stream,
                pyarrow.csv.ReadOptions(skip_rows=skip, column_names=names, block_size=1 << 22),
                pyarrow.csv.ParseOptions(delimiter=delimiter),
                pyarrow.csv.ConvertOptions(
                    column_types={n: pa.float64() for n in names}, null_values=_MISSING
                ),
            )
            for batch in reader:
                yield {n: floats(batch.column(n)) for n in names}
    except pa.ArrowInvalid as error:
        if "Empty CSV" not in str(error):
            raise _fault(path, compressed, columns, delimiter, skip, str(error)) from None
    except (OSError, EOFError) as error:
        raise UserError(
            "the file is damaged or cut off",
            where=path,
            found=str(error),
            expected="a whole file" + (" (gzip)" if compressed else ""),
            remedy="copy it again",
        ) from None


def _fault(
    path: Path, compressed: bool, columns: tuple[Column, ...], delimiter: str, skip: int, error: str
) -> UserError:
    """Say in which line and column the reader stumbled."""
    try:
        with _open(path, compressed) as stream:
            lines = _lines(stream, path)
            for _ in range(skip):
                next(lines)
            rows = csv.reader(lines, delimiter=delimiter)
            for row in rows:
                line = f"line {skip + rows.line_num}"
                if row and len(row) != len(columns):
                    return UserError(
                        "the line has the wrong number of values",
                        where=at(path, line),
                        found=len(row),
                        expected=f"{len(columns)}, as the header has",
                        remedy="the file may be damaged or cut off",
                    )
                for column, text in zip(columns, row, strict=False):
                    if text not in _MISSING and not _is_number(text):
                        return UserError(
                            "not a number",
                            where=at(path, line, f"column {column.name!r}"),
                            found=repr(text),
                            expected="a number with a decimal point, or nothing where it is missing",
                        )
    except (*_UNREADABLE, csv.Error) as fault:
        error = str(fault)
    return UserError(_NOT_CSV, where=path, found=error.splitlines()[0][:200])


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return "_" not in text
