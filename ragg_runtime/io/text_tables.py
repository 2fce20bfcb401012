"""CSV, other text and Excel: where the table begins, its names and units, and its cells.

All may have lines before the header, a header over two rows, a row of units below the names, and empty columns behind
the last one. What a column holds is decided by all of its cells.
"""

from __future__ import annotations

import contextlib
import csv
import gzip
import io
import itertools
import json
import re
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, count
from ragg_runtime.io.arrays import convert_arrow, report_damage
from ragg_runtime.io.instants import are_packed, find_parts
from ragg_runtime.io.record import SI_UNITS
from ragg_runtime.io.tables import (
    INDEX,
    MISSING,
    DataColumn,
    DataTable,
    find_decimal,
    is_unit,
    read_heading,
    read_headings,
    require_memory,
    split_quantity,
    write_cell,
)

TWO_ROWS = "the header spans two rows; they are joined"  # a note: of merged cells, for example
_LOOKED_AT = 600  # lines that are looked at to find the header and to separate numbers from text
_CELL_OF_XML = 4  # bytes in memory for one of a sheet's XML: a cell of 25 bytes becomes an object of 100
_NOT_CSV = "the file is not a table of comma-separated values"
_BLANKS = " \t"
_REMARK = re.compile(r"^\s*(?:#|%|//|!|/(?=\s))+\s*")
_LINE = re.compile(r"\s*(?:line|tie)[\s:]+(?=\S*\d)(\S+)\s*", re.IGNORECASE)
"""A row of Geosoft that names the flight line of the rows below it."""
_DATE_CLOCK = re.compile(rb"(\d[/.-]\d\d?[/.-]\d+)[ \t]+(\d\d?:\d\d:)")


# --- where a table begins ------------------------------------------------------------------------------


@dataclass(frozen=True)
class Header:
    """What the columns of a table are called, and where its data begin."""

    titles: tuple[tuple[str, str], ...]  # names and units
    begins: int  # position of the first row of data
    share: float  # of the rows from there on that are data
    notes: tuple[str, ...] = ()


def find_header(rows: Sequence[Sequence[str]]) -> Header | None:
    """The header among the first rows of cells of a table; ``None``: there is none."""
    sizes = Counter(len(r) for r in rows if sum(map(_is_filled, r)) > 1)
    if not sizes:
        return None
    width = max(sizes, key=lambda n: (n > 1) * n * sizes[n])
    alike = [
        k
        for k, r in enumerate(rows)
        if abs(len(r) - width) <= 1 or not any(map(_is_filled, r[width:] or "x"))
    ]
    data = [_is_data(rows[k]) for k in alike]
    # numbers before the header are followed by other text, or have their names in front
    cells = [split_quantity(rows[k][0]) if _is_filled(rows[k][0]) else None for k in alike]
    kinds = [None if c is None else c[0] != "" and not c[1] for c in cells]
    share = np.mean([k for k, yes in zip(kinds, data, strict=True) if yes and k is not None] or [False])
    usual = {None, True, False} if 0.1 < share < 0.9 else {None, share > 0.5}
    first = next((k for k in range(len(alike)) if all(data[k : k + 3]) and kinds[k] in usual), len(alike))
    begins = alike[first] if first < len(alike) else len(rows)
    above = [k for k in alike[:first] if any(map(_is_filled, rows[k]))]
    if not above:
        return None
    size = max(width, *(len(r) for r in rows[begins : begins + 1]), 0)
    padded = [([c.strip() for c in rows[k]] + [""] * size)[:size] for k in above[-3:]]
    if len(rows[above[-1]]) == size - 1 and _are_numbered([rows[k] for k in alike[first:]], size):
        padded[-1] = ["", *padded[-1][:-1]]  # as R writes a table, without a name for the numbers of the rows
    names, units, notes = _read_header(padded)
    titles = [h if h[0] else (n.strip(), "") for n, h in zip(names, read_headings(names), strict=True)]
    return Header(
        titles=tuple((n, inner or u) for (n, inner), u in zip(titles, units, strict=True)),
        begins=begins,
        share=sum(data[first:]) / max(1, len(data) - first),
        notes=notes,
    )


def _read_header(rows: list[list[str]]) -> tuple[list[str], list[str], tuple[str, ...]]:
    """Names with or without units, units of a row below or above them, and a note of the last rows above the data."""
    units = [""] * len(rows[0])
    if not any(all(read_heading(c)) for r in rows for c in r):
        for k in range(len(rows) - 1, -1, -1) if len(rows) > 1 else ():  # below them there may be remarks
            if (row_units := _read_units(rows[k])) is not None:
                units, rows = row_units, rows[:k] or rows[1:]
                break
    if len(rows) > 1 and sum(map(bool, rows[-2])) > 1 and _needs_a_row_above(rows[-1], rows[-2]):
        return _join_rows(rows[-2], rows[-1]), units, (TWO_ROWS,)
    return rows[-1], units, ()


def _read_units(cells: Sequence[str]) -> list[str] | None:
    """The units in a row below the names: each cell is a unit, perhaps in brackets, or empty; not all numbers.

    The first cell may name the row: ``Units``.
    """
    texts = [re.sub(r"\s*(?:\[(.*)\]|\((.*)\)|'(.*)')\s*", r"\1\2\3", c).strip() for c in cells]
    texts[:1] = ["" if re.fullmatch(r"units?:?", c, re.IGNORECASE) else c for c in texts[:1]]
    units = all(not c or is_unit(c) for c in texts) and any(c not in ("", "1") for c in texts)
    return texts if units else None


def _is_filled(cell: str) -> bool:
    return cell.strip() not in MISSING


def _is_data(row: Sequence[str]) -> bool:
    """Whether more cells of a row are numbers or instants than are text."""
    filled = list(filter(_is_filled, row))
    values = sum(split_quantity(c)[0] != "" or any(find_parts(c)) for c in filled)
    return values > 0 and 2 * values > len(filled)


def _are_numbered(rows: Sequence[Sequence[str]], width: int) -> bool:
    """Whether rows as wide as this, without a blank at their end, begin with 1, 2, 3 or the like."""
    if not all(len(r) == width and _is_filled(r[-1]) and r[0].isdecimal() for r in rows):
        return False
    return len({int(r[0]) - k for k, r in enumerate(rows)}) == 1


def _needs_a_row_above(names: Sequence[str], above: Sequence[str]) -> bool:
    """Whether names are parts of names: some are missing below others, or occur twice."""
    bare = [read_heading(n)[0] for n in names]
    filled = [n for n in bare if n]
    return any(a and not n for a, n in zip(above, bare, strict=True)) or len({*filled}) < len(filled)


def _join_rows(above: Sequence[str], below: Sequence[str]) -> list[str]:
    """A header over two rows: ``acceleration [g]`` over x, y, z (of merged cells the first holds the text), ``time`` over ``s``."""
    headings, title = [], ""
    for k, (upper, lower) in enumerate(zip(above, below, strict=True)):
        title = upper or (title if lower else "")
        (name, unit), (part, part_unit) = read_heading(title), read_heading(lower)
        alone = bool(upper) and (k + 1 == len(above) or bool(above[k + 1]))
        if alone and not (unit or part_unit) and is_unit(part):
            part, part_unit = "", part
        whole = part if part in SI_UNITS else "_".join(filter(None, (name, part)))
        headings.append(f"{whole} [{part_unit or unit}]" if part_unit or unit else whole)
    return headings


def _make_table(
    header: Header, columns: Iterable[NDArray[Any]], notes: Iterable[str], **about: Any
) -> DataTable:
    """The columns (n,) below a header; the first may be an index, which pandas writes without a name."""
    data_columns, odd = [], []
    for k, ((name, unit), x) in enumerate(zip(header.titles, columns, strict=True)):
        if name:
            data_columns.append(DataColumn(name, unit, x))
        elif np.any(x != "" if x.dtype == object else np.isfinite(x)):
            data_columns += [DataColumn(INDEX, "", x)] if k == 0 else []
            odd += [f"column {k + 1} has no name; it is skipped"] if k > 0 else []
    return DataTable(tuple(data_columns), notes=(*notes, *odd, *header.notes), index=INDEX, **about)


# --- CSV -----------------------------------------------------------------------------------------------


def read_csv(path: Path) -> list[DataTable]:
    """The text as one table; UserError if it has no header or lines of different widths."""
    data, notes = _read_text(path)
    delimiter, headings, header = _find_layout(data, path)
    if delimiter == _BLANKS and not all(n for n, _ in header.titles):  # a date and a time below one name
        data = _DATE_CLOCK.sub(rb"\1T\2", data)
        delimiter, headings, header = _find_layout(data, path)
    if delimiter == _BLANKS:
        data = re.sub(rb"(?m)^[ \t]+|[ \t]+(?=\r?$)", b"", data)
        data, delimiter = re.sub(rb"[ \t]+", b" ", data), " "
    data = _drop_headers(data, delimiter, headings, notes)
    table, begins = _parse(data, delimiter, len(headings), len(header.titles), path, notes)
    begins = [(0, m[1]) for h in headings[-1:] if (m := _LINE.fullmatch(h.decode()))] + begins
    decimal = find_decimal(table.columns)
    columns = [_read_cells(texts, decimal) for texts in table.columns]
    if begins:
        sizes = np.diff([*(row for row, _ in begins), len(table)], prepend=0)
        columns.append(np.repeat(np.array(["", *(name for _, name in begins)], dtype=object), sizes))
        header = replace(header, titles=(*header.titles, ("line", "")))
    return [_make_table(header, columns, notes, counts=("line", len(headings) + 1), decimal=decimal)]


def _read_cells(texts: pa.ChunkedArray, decimal: str) -> NDArray[Any]:
    """A column as numbers where Arrow reads them, or as its texts."""
    cells = pc.utf8_trim_whitespace(texts)
    missing = pc.is_in(cells, pa.array(sorted(MISSING)), skip_nulls=True)
    numbers, other = pc.if_else(missing, None, cells), "." if decimal == "," else ","
    packed = are_packed(numbers.slice(0, _LOOKED_AT).drop_null().to_pylist())
    if not packed and not pc.any(pc.match_substring(numbers, other)).as_py():
        with contextlib.suppress(pa.ArrowInvalid):
            return convert_arrow(pc.replace_substring(numbers, ",", ".").cast(pa.float64()))
    return convert_arrow(cells)


def _read_text(path: Path) -> tuple[bytes, list[str]]:
    """The file's text in UTF-8, unpacked, and notes."""
    try:
        data = path.read_bytes()
        if data.startswith(b"\x1f\x8b"):  # gzip
            require_memory(path, int.from_bytes(data[-4:], "little"))  # its size unpacked, modulo 2^32
            data = gzip.decompress(data)
        encoding = json.detect_encoding(data)  # of UTF-16 with its mark or without
        if not encoding.startswith("utf-8"):
            return data.decode(encoding).encode(), []
        data = data.removeprefix(b"\xef\xbb\xbf").rstrip(b"\0")  # recorders reserve room ahead
        if (zero := data.find(b"\0")) >= 0:
            line = data.count(b"\n", 0, zero) + 1
            raise UnicodeError(f"bytes of zero in line {line}: another format, or a copy that failed")
        try:
            data.decode()
        except UnicodeDecodeError:
            note = "the file is not UTF-8; read as Windows text (cp1252)"
            return data.decode("cp1252", "replace").encode(), [note]
    except (OSError, EOFError, zlib.error, UnicodeError) as error:
        raise UserError(
            "the file is damaged, cut off, or not text",
            where=path,
            found=str(error)[:200],
            expected="a complete text file: a header of `name [unit]`, then numbers",
            remedy="copy it again, correct the ending of its name, or save it as CSV, Parquet or NetCDF-4",
        ) from None
    return data, []


def _find_layout(data: bytes, path: Path) -> tuple[str, list[bytes], Header]:
    """Delimiter, lines before the first row, and header, from the first lines."""
    stream = io.TextIOWrapper(io.BytesIO(data), "utf-8", newline="")
    lines = list(itertools.islice(stream, _LOOKED_AT))
    best = None
    for delimiter in ("\t", ";", ",", "|", ":", _BLANKS):
        try:
            rows, ends = _read_rows(lines, delimiter)
        except csv.Error as error:
            raise UserError(_NOT_CSV, where=path, found=error) from None
        header = find_header(rows)
        score = (0.0, 0) if header is None else (header.share, len(header.titles))
        if header is not None and (best is None or score > best[0]):
            best = score, delimiter, header, ends
    if best is None:
        raise UserError("the flight file has no header", where=path, expected="time [s],a_x [g],...")
    _, delimiter, header, ends = best
    require_memory(path, len(data) * len(lines) / (sum(map(len, lines)) or 1) * len(header.titles) * 8)
    above = ends[header.begins - 1] if header.begins else 0
    return delimiter, [x.encode() for x in lines[:above]], header


def _read_rows(lines: Sequence[str], delimiter: str) -> tuple[list[list[str]], list[int]]:
    """Rows of cells that are not empty, and the number of each one's last line; the header may be a remark (NumPy's is)."""
    bare = [_REMARK.sub("", x) for x in lines]
    if delimiter == _BLANKS:
        pairs = [(r, n) for n, r in enumerate(_split_at_blanks(bare), 1)]
    else:
        reader = csv.reader(bare, delimiter=delimiter)
        pairs = [(r, reader.line_num) for r in reader]
    pairs = [(r, n) for r, n in pairs if any(c.strip() for c in r)]
    return [r for r, _ in pairs], [n for _, n in pairs]


def _split_at_blanks(lines: Sequence[str]) -> list[list[str]]:
    """Cells between blanks, however many; names of several words are separated by two blanks or a tab."""
    rows = [re.split(r"[ \t]+(?![\[({<])", x.strip()) for x in lines]
    width = Counter(map(len, rows)).most_common(1)[0][0] if rows else 0
    wide = (re.split(r" {2,}|\t+", x.strip()) for x in lines)
    cells = (w if len(w) == width else r for r, w in zip(rows, wide, strict=True))
    return [[c.strip('"') for c in r] for r in cells]


def _drop_headers(data: bytes, delimiter: str, headings: Sequence[bytes], notes: list[str]) -> bytes:
    """The text without repeated headings, as in files that were joined."""
    begins, repeated = sum(map(len, headings)) - 1, 0
    for heading in (b"\n" + h for h in headings if delimiter.encode() in h):
        if again := data.count(heading, max(begins, 0)):
            repeated += again
            data = data[:begins] + data[begins:].replace(heading, b"\n\n")
    if repeated:
        notes.append(f"the header is repeated ({count(repeated, 'line')}): skipped")
    return data


def _parse(
    data: bytes, delimiter: str, lines: int, width: int, path: Path, notes: list[str]
) -> tuple[pa.Table, list[tuple[int, str]]]:
    """The columns as texts, and the rows at which flight lines begin, with their names; UserError where a line with data has another
    width. Others, such as remarks, and a last line that is cut off are skipped.
    """
    passed, begins, wrong = list[str](), list[tuple[int, str]](), list[pyarrow.csv.InvalidRow]()
    cut = data[data.rfind(b"\n") + 1 :].decode()  # a recorder that lost its power ends within a line

    def judge(row: pyarrow.csv.InvalidRow) -> str:
        if row.text == cut and row.actual_columns < row.expected_columns:
            notes.append(f"line {row.number}, the last one, is cut off; it is left out")
        elif m := _LINE.fullmatch(row.text):
            begins.append((row.number - lines - 1 - len(begins) - len(passed), m[1]))
        elif not _REMARK.match(row.text) and _is_data(row.text.split(delimiter)):
            wrong.append(row)
            return "error"
        else:
            passed.append(f"line {row.number} ({row.text[:40]!r})")
        return "skip"

    kinds = {str(k): pa.string() for k in range(width)}
    # with several threads Arrow does not number the rows
    options = pyarrow.csv.ReadOptions(
        skip_rows=lines, column_names=list(kinds), block_size=1 << 22, use_threads=False
    )
    parse = pyarrow.csv.ParseOptions(delimiter=delimiter, invalid_row_handler=judge)
    convert = pyarrow.csv.ConvertOptions(column_types=kinds)
    try:
        table = pyarrow.csv.read_csv(pa.BufferReader(data), options, parse, convert)
    except pa.ArrowInvalid as error:
        if "Empty CSV" in str(error):
            return pa.table({n: pa.array([], k) for n, k in kinds.items()}), []
        if not wrong:
            raise UserError(_NOT_CSV, where=path, found=str(error).splitlines()[0][:200]) from None
        where, what = at(path, f"line {wrong[0].number}"), "the line has the wrong number of values"
        expected = f"{width}, as the header has: the file may be damaged or cut off"
        raise UserError(what, where=where, found=wrong[0].actual_columns, expected=expected) from None
    if passed:
        notes.append(f"{count(len(passed), 'line')} without data skipped: {', '.join(passed[:3])}")
    return table, begins


# --- Excel ---------------------------------------------------------------------------------------------


def read_excel(path: Path) -> list[DataTable]:
    """The sheets of a workbook that hold tables; formulas are not computed, what Excel has computed is read."""
    with report_damage(path, "Excel (.xlsx)"):
        import openpyxl  # slow to import, and only this format needs it

        with path.open("rb") as stream:
            parts = zipfile.ZipFile(stream).infolist()
            size = sum(p.file_size for p in parts if p.filename.startswith("xl/worksheets/"))
            require_memory(path, _CELL_OF_XML * size)
            book = openpyxl.load_workbook(stream, read_only=True, data_only=True)
            tables = []
            for sheet in book.worksheets:
                sheet.reset_dimensions()  # what a file says of them may be wrong
                tables.append(_read_sheet(sheet.title, sheet.values))
        return [t for t in tables if t is not None]


def _read_sheet(name: str, cells: Iterable[Sequence[Any]]) -> DataTable | None:
    """What a sheet holds; ``None`` if there is no table in it."""
    rows = [(n, list(map(write_cell, r))) for n, r in enumerate(cells, 1)]
    width = max((len(r) for _, r in rows), default=0)
    rows = [(n, r + [""] * (width - len(r))) for n, r in rows if any(r)]
    header = find_header([r for _, r in rows[:_LOOKED_AT]])
    if header is None:
        return None
    data = rows[header.begins :]
    columns = (np.array([r[k] for _, r in data], dtype=object) for k in range(len(header.titles)))
    counts = ("row", data[0][0] if data else 1)
    return _make_table(header, columns, (), line=name, part=name, counts=counts)
