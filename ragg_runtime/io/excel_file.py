"""Excel flights (.xlsx): a header of names and units, then rows; a sheet for each line. Formulas are not computed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import date, datetime, time
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.io.one_table import line_name
from ragg_runtime.io.source import Heading, Look, Rows, Table, chosen, distinct, heading, units_below

NAME = "Excel"
ENDINGS = (".xlsx", ".xlsm")
MAGIC = (b"PK\x03\x04",)

_SNIFFED = 50

Cells = NDArray[Any]
"""(rows, columns) of a sheet as openpyxl gives them, "" for nothing."""


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The sheets of a workbook that hold tables; several that are alike are lines."""
    import pandas as pd  # slow to import, and only this format needs it

    try:
        # pandas reads the values that Excel has computed, never the formulas
        frames = pd.read_excel(
            path, sheet_name=None, header=None, dtype=object, na_filter=False, engine="openpyxl"
        )
    except Exception as error:  # openpyxl, zipfile and the XML parser each raise their own
        raise UserError(
            "the Excel file is damaged or not .xlsx",
            where=path,
            found=(str(error) or type(error).__name__).split("\n", 1)[0][:200],
            expected="a whole workbook (.xlsx)",
            remedy="save it again, or as CSV",
        ) from None
    sheets = [_sheet(str(name), x.to_numpy(dtype=object), path, look) for name, x in frames.items()]
    return chosen(path, [s for s in sheets if s is not None], look)


def _sheet(name: str, cells: Cells, path: Path, look: Look) -> Table | None:
    """What a sheet holds; ``None`` if there is no table in it."""
    cells = cells[np.any(cells != "", axis=1)] if cells.size else cells
    first = next((n for n, row in enumerate(cells[:_SNIFFED]) if _is_header(row)), None)
    if first is None:
        return None
    words = [str(c).strip() for c in cells[first] if c != ""]
    headings = [heading(w, path, n) for n, w in enumerate(words, 1)]
    cells = cells[first + 1 :, : len(words)]
    if len(cells) and not any(h.unit for h in headings):
        units = units_below([str(c) for c in cells[0]], len(headings))
        if units is not None:
            headings = [replace(h, unit=u) for h, u in zip(headings, units, strict=True)]
            cells = cells[1:]
    if not len(cells):
        return None
    headings = [replace(h, text=_is_text(cells[:_SNIFFED, n])) for n, h in enumerate(headings)]
    distinct(path, headings)
    wanted = [n for n, h in enumerate(headings) if look.wants(h.name)]
    kept = [n for n in wanted if not headings[n].text or look.allows_text(headings[n].name)]
    if len(kept) < len(wanted) and not look.text:
        wrong = next(headings[n].name for n in wanted if n not in kept)
        raise UserError(
            "the column does not hold numbers",
            where=at(path, f"sheet {name!r}", f"column {wrong!r}"),
            found="text",
            expected="numbers",
        )
    columns = tuple(headings[n] for n in kept)
    return Table(path, columns, partial(_rows, path, name, columns, cells[:, kept]), name, name)


def _is_header(row: Cells) -> bool:
    """Whether a row holds names alone, more than one, from the first cell on."""
    words = [isinstance(c, str) and bool(c.strip()) for c in row]
    count = sum(words)
    return count > 1 and all(words[:count]) and all(c == "" for c in row[count:])


def _is_text(cells: Cells) -> bool:
    value = next((c for c in cells if c != ""), 0.0)
    return not isinstance(value, int | float)


def _rows(path: Path, sheet: str, columns: Sequence[Heading], whole: Cells) -> Rows:
    found: dict[str, NDArray[Any]] = {}
    for h, cells in zip(columns, whole.T, strict=True):
        if h.text:
            found[h.name] = np.array([_written(c) for c in cells], dtype=object)
            continue
        for n, c in enumerate(cells, 1):
            if not isinstance(c, int | float) and str(c).strip():
                raise UserError(
                    "not a number",
                    where=at(path, f"sheet {sheet!r}", f"row {n} below the header", f"column {h.name!r}"),
                    found=repr(c)[:60],
                    expected="a number, or nothing where it is missing",
                )
        numbers = [c if isinstance(c, int | float) else np.nan for c in cells]
        found[h.name] = np.array(numbers, dtype=np.float64)
    return found


def _written(cell: Any) -> str:
    """A cell of text; dates and times in ISO 8601."""
    return cell.isoformat() if isinstance(cell, datetime | date | time) else line_name(cell)
