"""Several lines as one table with a column ``line``, for formats that have nothing better, and back."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.flight.record import Array
from ragg_runtime.flight.source import Column, Written

Rows = Mapping[str, NDArray[Any]]

LINE = Column("line", "1")


def joined(tables: Sequence[Written]) -> tuple[list[Column], Callable[[int], Iterator[Rows]]]:
    """The columns of all tables, and a function that yields their rows, so many at a time at most.

    Lines of several tables are told apart by a column ``line``: numbers if all are numbers, else text.
    """
    columns = union(tables)
    named = any(t.line is not None for t in tables)
    numbers = [number(t.line) for t in tables]
    numeric = all(n is not None for n in numbers)

    def rows(most: int) -> Iterator[Rows]:
        for table, n in zip(tables, numbers, strict=True):
            values = {c.name: v for c, v in table.columns}
            length = len(table.columns[0][1]) if table.columns else 0
            for start in range(0, length, most):
                part = slice(start, min(start + most, length))
                count = part.stop - part.start
                found: dict[str, NDArray[Any]] = {}
                if named:
                    found["line"] = np.full(count, n) if numeric else _texts(table.line or "", count)
                for c in columns:
                    found[c.name] = np.asarray(values[c.name][part]) if c.name in values else _nothing(count)
                yield found

    return [*([LINE if numeric else Column("line", "")] if named else []), *columns], rows


def union(tables: Sequence[Written]) -> list[Column]:
    """Every column of any of the tables, in the order of first appearance."""
    found: dict[str, Column] = {}
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
        return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    return str(value).strip()


def _texts(text: str, count: int) -> NDArray[Any]:
    return np.full(count, text, dtype=object)


def _nothing(count: int) -> Array:
    return np.full(count, np.nan)
