"""Several lines as one table with a column ``line``, for formats that have nothing better, and back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from ragg_runtime.io.record import Array
from ragg_runtime.io.source import Heading, Rows, Written

LINE = Heading("line", "1")


def joined(tables: Sequence[Written]) -> tuple[list[Heading], Rows]:
    """The columns of all tables, and their rows one table after the other; a column ``line`` tells them apart."""
    columns = union(tables)
    lengths = [len(t.columns[0][1]) if t.columns else 0 for t in tables]
    found: dict[str, NDArray[Any]] = {}
    named = any(t.line is not None for t in tables)
    numbers = [number(t.line) for t in tables]
    numeric = all(n is not None for n in numbers)
    if named and numeric:
        found["line"] = np.repeat(np.array(numbers, dtype=np.float64), lengths)
    elif named:
        found["line"] = np.repeat(np.array([t.line or "" for t in tables], dtype=object), lengths)
    for c in columns:
        parts = [{k.name: v for k, v in t.columns}.get(c.name) for t in tables]
        whole = [
            np.full(n, np.nan) if p is None else np.asarray(p) for p, n in zip(parts, lengths, strict=True)
        ]
        found[c.name] = np.concatenate(whole) if whole else np.empty(0)
    return [*([LINE if numeric else Heading("line", "")] if named else []), *columns], found


def union(tables: Sequence[Written]) -> list[Heading]:
    """Every column of any of the tables, in the order of first appearance."""
    found: dict[str, Heading] = {}
    for table in tables:
        for c, _ in table.columns:
            found.setdefault(c.name, c)
    return list(found.values())


def number(line: str | None) -> float | None:
    """A line's name as a number, where :func:`line_name` gives the name back."""
    try:
        value = float(line or "")
    except ValueError:
        return None
    return value if np.isfinite(value) and line_name(value) == line else None


def line_name(value: object) -> str:
    """The name of a line from what stands in its column: 1010 for 1010.0."""
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(float(value))
    return str(value).strip()


def floats(column: pa.ChunkedArray) -> Array:
    """(N,): a column of numbers, as float64; null becomes NaN. Arrow's own ``to_numpy`` would load pandas."""
    whole = column.cast(pa.float64()).combine_chunks()
    return np.asarray(np.from_dlpack(whole.fill_null(float("nan")) if whole.null_count else whole))


def texts(column: pa.ChunkedArray) -> NDArray[Any]:
    """(N,) str: a column of text; null becomes the empty text. Instants are datetime64."""
    kind = column.type
    if pa.types.is_timestamp(kind) or pa.types.is_date(kind):
        return np.asarray(column.cast(pa.timestamp("ns")).to_numpy(), dtype="datetime64[ns]")
    return np.array(["" if t is None else t for t in column.cast(pa.string()).to_pylist()], dtype=object)
