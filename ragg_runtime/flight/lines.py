"""A table with a column that names flight lines, as one table for each line."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.one_table import line_name
from ragg_runtime.flight.source import Rows, Table

MOST_LINES = 20_000
"""Lines of a file, beyond which the column does not name lines: the largest surveys have some thousands."""


def split(table: Table, column: str) -> list[Table]:
    """A table for each line, in the order in which they begin; the rows of one need not stand together.

    A column with a single value gives one table without a line. Rows without a line's name are left out.
    """
    import pandas as pd  # slow to import, and only files with lines need it

    headings = tuple(h for h in table.headings if h.name != column)
    whole = dict(table.rows())
    rows, labels = pd.factorize(whole.pop(column))  # numbered as they appear; -1 where nothing stands
    ordinals, names = pd.factorize(np.array([_name(x) for x in labels], dtype=object))
    which = np.where(rows < 0, -1, np.append(ordinals, -1)[rows])
    if len(names) > MOST_LINES:
        raise UserError(
            "the column does not name lines: its values differ from row to row",
            where=f"{table.path}: column {column!r}",
            found=f"{len(names)} values in {len(which)} rows",
            expected=f"at most {MOST_LINES} lines",
            remedy="rename the column, or name another one in a mapping: [file] line = ...",
        )
    if len(names) <= 1 and not np.any(which < 0):
        return [replace(table, headings=headings, rows=lambda: whole)]
    order = np.argsort(which, kind="stable")
    edges = np.searchsorted(which[order], np.arange(len(names) + 1))

    def part(n: int) -> Rows:
        return {h.name: whole[h.name][order[edges[n] : edges[n + 1]]] for h in headings}

    return [
        Table(table.path, headings, lambda n=n: part(n), name)  # type: ignore[misc]
        for n, name in enumerate(names)
        if name
    ]


def _name(label: object) -> str:
    """The name of a line: 1010 of 1010.0, in numbers or in text."""
    try:
        value = float(str(label))
    except ValueError:
        return line_name(label)
    return line_name(value) if np.isfinite(value) else ""
