"""Excel flights (.xlsx): a header of names and units, then rows; a sheet for each line. Formulas are not computed."""

from __future__ import annotations

import contextlib
import re
import shutil
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import date, datetime, time
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.flight.one_table import line_name
from ragg_runtime.flight.source import (
    Heading,
    Look,
    RawBatch,
    Table,
    Written,
    chosen,
    distinct,
    heading,
    units_below,
)

NAME = "Excel"
ENDINGS = (".xlsx", ".xlsm")
MAGIC = (b"PK\x03\x04",)

MOST_BYTES = 2 << 30
"""Bytes that the parts of a workbook may unfold to."""

MOST_ROWS = (1 << 20) - 1
"""Rows of a sheet below the header, as the format has it."""

_SNIFFED = 50
_AT_ONCE = 16384
_DAMAGED = (
    zipfile.BadZipFile,
    KeyError,
    ValueError,
    TypeError,
    AttributeError,
    IndexError,
    OSError,
    EOFError,
)
_FORBIDDEN = re.compile(r"[\[\]:*?/\\\x00-\x1f]")


@dataclass(frozen=True)
class _Sheet:
    place: str
    line: str
    first_row: int
    all_names: tuple[str, ...]
    columns: tuple[Heading, ...]

    def headings(self) -> tuple[Heading, ...]:
        return self.columns


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The sheets of a workbook that hold tables; several that are alike are lines."""
    _check_size(path)
    with _workbook(path) as book:
        sheets = [s for s in (_sheet(book[name], path, look) for name in book.sheetnames) if s is not None]
    found = chosen(path, sheets, look)
    return [
        Table(path, s.columns, lambda s=s: _batches(path, s), s.line if len(found) > 1 else None)  # type: ignore[misc]
        for s in found
    ]


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write columns as numbers of 17 digits, what is missing as empty cells; a sheet for each line."""
    from openpyxl import Workbook  # slow to import, and only this format needs it

    book = Workbook(write_only=True)
    try:
        _fill(book, path, tables)
        book.save(path)
    except OSError:
        for sheet in book.worksheets:  # else they complain on stderr when they are cleared away
            for half in (sheet._rows, sheet._writer.xf):
                with contextlib.suppress(OSError, AttributeError):
                    half.close()
        raise
    _undated(path)


def _fill(book: Any, path: Path, tables: Sequence[Written]) -> None:
    from openpyxl.cell import WriteOnlyCell

    taken: set[str] = set()
    for number, table in enumerate(tables, 1):
        rows = len(table.columns[0][1]) if table.columns else 0
        if rows > MOST_ROWS:
            raise UserError(
                "the flight has more rows than a sheet of Excel",
                where=path,
                found=rows,
                expected=f"at most {MOST_ROWS}",
                remedy="write Parquet, CSV or NetCDF instead",
            )
        sheet = book.create_sheet(_title(table.line or "flight", number, taken))
        _beside(sheet, path, number)
        names = []
        for c, _ in table.columns:
            cell = WriteOnlyCell(sheet, f"{c.name} [{c.unit}]" if c.unit else c.name)
            cell.data_type = "s"  # else a name that begins with = would become a formula
            names.append(cell)
        sheet.append(names)
        for start in range(0, rows, _AT_ONCE):
            part = np.column_stack([np.asarray(v[start : start + _AT_ONCE]) for _, v in table.columns])
            for row in part.tolist():
                sheet.append([_number(sheet, v) if np.isfinite(v) else None for v in row])


def _number(sheet: Any, value: float) -> Any:
    """A cell of a number with all its digits: openpyxl by itself writes 16, and two numbers may share these."""
    from openpyxl.cell import WriteOnlyCell

    cell = WriteOnlyCell(sheet)
    cell._value, cell.data_type = repr(value), "n"
    return cell


def _beside(sheet: Any, path: Path, number: int) -> None:
    """Let a sheet's rows wait beside the workbook, where the next command clears away what a killed one left.

    By itself openpyxl lays them down in the temporary folder, under a name that tells nobody whose they are.
    """
    from openpyxl.worksheet import _writer

    place = str(path.with_name(f"{path.name}.{number}"))
    _writer.ALL_TEMP_FILES.append(place)  # as it does with its own: it removes them
    sheet._writer = _writer.WorksheetWriter(sheet, out=place)
    sheet._writer.write_top()


def _title(name: str, number: int, taken: set[str]) -> str:
    """A name that Excel allows for a sheet: 31 characters, none of a few, each once in any case."""
    title = _FORBIDDEN.sub("_", name).strip("'")[:31] or f"line {number}"
    if title.casefold() in taken:
        title = f"{title[:24]} ({number})"
    taken.add(title.casefold())
    return title


def _undated(path: Path) -> None:
    """Take the date of writing out of a workbook: equal flights give equal files."""
    plain = path.with_name(f"{path.name}.plain")  # whose name tells whose it is, as that of ``path`` does
    try:
        with zipfile.ZipFile(path) as old, zipfile.ZipFile(plain, "w", zipfile.ZIP_DEFLATED) as new:
            for name in old.namelist():
                with old.open(name) as source, new.open(zipfile.ZipInfo(name), "w") as target:
                    if name == "docProps/core.xml":
                        target.write(
                            re.sub(
                                rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", b"2000-01-01T00:00:00Z", source.read()
                            )
                        )
                    else:
                        shutil.copyfileobj(source, target, 1 << 20)
        shutil.copyfile(plain, path)
    finally:
        plain.unlink(missing_ok=True)


def _check_size(path: Path) -> None:
    try:
        with zipfile.ZipFile(path) as archive:
            total = sum(i.file_size for i in archive.infolist())
    except _DAMAGED as error:
        raise _damaged(path, error) from None
    if total > MOST_BYTES:
        raise UserError(
            "the workbook is out of all proportion",
            where=path,
            found=f"{total} bytes when unfolded",
            expected=f"at most {MOST_BYTES} bytes",
            remedy="save the record as CSV or Parquet",
        )


@contextlib.contextmanager
def _workbook(path: Path) -> Iterator[Any]:
    from openpyxl import load_workbook  # slow to import, and only this format needs it

    with path.open("rb") as stream:
        try:
            # The values that Excel has computed are read, never the formulas.
            book = load_workbook(stream, read_only=True, data_only=True, keep_links=False, keep_vba=False)
        except Exception as error:  # openpyxl and the XML parser each raise their own
            raise _damaged(path, error) from None
        try:
            yield book
        finally:
            book.close()


def _damaged(path: Path, error: Exception) -> UserError:
    return UserError(
        "the Excel file is damaged or not .xlsx",
        where=path,
        found=(str(error) or type(error).__name__).split("\n", 1)[0][:200],
        expected="a whole workbook (.xlsx)",
        remedy="save it again, or as CSV",
    )


def _rows(sheet: Any, path: Path, first: int = 1) -> Iterator[tuple[Any, ...]]:
    """The rows of a sheet without what is empty at their ends."""
    try:
        for row in sheet.iter_rows(min_row=first, values_only=True):
            yield tuple(row)
    except (MemoryError, UserError):
        raise
    except Exception as error:  # the XML is parsed while it is read
        raise _damaged(path, error) from None


def _sheet(sheet: Any, path: Path, look: Look) -> _Sheet | None:
    """What the first rows say of a sheet; ``None`` if there is no table in it."""
    if not hasattr(sheet, "iter_rows"):
        return None  # a chart
    first = 0
    found: list[Heading] = []
    sample: list[tuple[Any, ...]] = []
    for number, row in enumerate(_rows(sheet, path), 1):
        if not found:
            if number > _SNIFFED:
                return None
            words = [str(c).strip() if isinstance(c, str) else "" for c in row]
            while words and not words[-1]:
                words.pop()
            if len(words) > 1 and all(words):
                found = [heading(w, path, n) for n, w in enumerate(words, 1)]
                first = number + 1
            continue
        if not sample and not any(h.unit for h in found):
            units = units_below([str(c or "") for c in row[: len(found)]], len(found))
            if units is not None:
                found = [replace(h, unit=u) for h, u in zip(found, units, strict=True)]
                first = number + 1
                continue
        sample.append(row)
        if len(sample) >= _SNIFFED:
            break
    if not sample:
        return None
    columns = [replace(h, text=_is_text(n, sample)) for n, h in enumerate(found)]
    distinct(path, columns)
    names = tuple(h.name for h in columns)
    kept = tuple(h for h in columns if look.wants(h.name) and (not h.text or look.allows_text(h.name)))
    wrong = [h.name for h in columns if look.wants(h.name) and h not in kept]
    if wrong and not look.text:
        raise UserError(
            "the column does not hold numbers",
            where=at(path, f"sheet {sheet.title!r}", f"column {wrong[0]!r}"),
            found="text",
            expected="numbers",
        )
    return _Sheet(place=sheet.title, line=sheet.title, first_row=first, all_names=names, columns=kept)


def _is_text(column: int, rows: Sequence[Sequence[Any]]) -> bool:
    value = next((r[column] for r in rows if len(r) > column and r[column] not in (None, "")), 0.0)
    return not isinstance(value, int | float)


def _batches(path: Path, sheet: _Sheet) -> Iterator[RawBatch]:
    places = [(sheet.all_names.index(h.name), h) for h in sheet.columns]
    with _workbook(path) as book:
        waiting: list[tuple[Any, ...]] = []
        row = sheet.first_row
        for cells in _rows(book[sheet.place], path, sheet.first_row):
            if any(c is not None for c in cells):
                waiting.append(cells)
            if len(waiting) == _AT_ONCE:
                yield _batch(waiting, places, path, sheet, row)
                row += len(waiting)
                waiting = []
        if waiting:
            yield _batch(waiting, places, path, sheet, row)


def _batch(
    rows: Sequence[tuple[Any, ...]],
    places: Sequence[tuple[int, Heading]],
    path: Path,
    sheet: _Sheet,
    first: int,
) -> RawBatch:
    found: dict[str, NDArray[Any]] = {}
    for place, h in places:
        cells = [r[place] if len(r) > place else None for r in rows]
        if h.text:
            found[h.name] = np.array([_written(c) for c in cells], dtype=object)
            continue
        for n, c in enumerate(cells):
            if c is not None and not isinstance(c, int | float) and str(c).strip():
                raise UserError(
                    "not a number",
                    where=at(path, f"sheet {sheet.place!r}", f"row {first + n}", f"column {h.name!r}"),
                    found=repr(c)[:60],
                    expected="a number, or nothing where it is missing",
                )
        found[h.name] = np.array(
            [c if isinstance(c, int | float) else np.nan for c in cells], dtype=np.float64
        )
    return found


def _written(cell: Any) -> str:
    """A cell of text; dates and times in ISO 8601."""
    if isinstance(cell, datetime | date | time):
        return cell.isoformat()
    return "" if cell is None else line_name(cell)
