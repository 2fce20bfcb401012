"""A table with a column that names flight lines, as one table for each line."""

from __future__ import annotations

import contextlib
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.one_table import line_name
from ragg_runtime.flight.source import Heading, RawBatch, Table

HELD = 256 << 20
"""Most bytes of columns that are held in memory; beyond it they are laid down in a temporary folder."""

MOST_BYTES = 32 << 30
"""Most bytes that they may take there."""

MOST_LINES = 20_000
"""Lines of a file, beyond which the column does not name lines: the largest surveys have some thousands."""

_AT_ONCE = 1 << 16


def split(table: Table, column: str) -> list[Table]:
    """A table for each line, in the order in which they begin; the rows of one need not stand together.

    A column with a single value gives one table without a line. Rows without a line's name are left out.
    """
    headings = tuple(h for h in table.headings if h.name != column)
    labels, columns = _held(table, column, headings)
    names, which = _numbered(labels)
    if len(names) > MOST_LINES:
        raise UserError(
            "the column does not name lines: its values differ from row to row",
            where=f"{table.path}: column {column!r}",
            found=f"{len(names)} values in {len(which)} rows",
            expected=f"at most {MOST_LINES} lines",
            remedy="rename the column, or name another one in a mapping: [file] line = ...",
        )
    if len(names) <= 1:
        return [replace(table, headings=headings, batches=lambda: _batches(columns, None))]
    order = np.argsort(which, kind="stable")
    edges = np.searchsorted(which[order], np.arange(len(names) + 1))
    found = []
    for n, name in enumerate(names):
        rows = order[edges[n] : edges[n + 1]]
        if name:
            found.append(
                Table(table.path, headings, lambda rows=rows: _batches(columns, rows), name)  # type: ignore[misc]
            )
    return found


def _batches(columns: Mapping[str, NDArray[Any]], rows: NDArray[np.int64] | None) -> Iterator[RawBatch]:
    count = len(next(iter(columns.values()))) if rows is None else len(rows)
    for start in range(0, count, _AT_ONCE):
        part: Any = slice(start, start + _AT_ONCE) if rows is None else rows[start : start + _AT_ONCE]
        yield {n: np.asarray(v[part]) for n, v in columns.items()}


def _numbered(labels: NDArray[Any]) -> tuple[list[str], NDArray[np.int64]]:
    """Names of the lines in the order of their first rows, and the number of each row's."""
    if labels.dtype.kind == "f":
        values, which = np.unique(labels, return_inverse=True)
        names = ["" if np.isnan(v) else line_name(float(v)) for v in values]
    else:
        seen: dict[str, int] = {}
        which = np.array([seen.setdefault(str(t).strip(), len(seen)) for t in labels], dtype=np.int64)
        names = list(seen)
    first = np.full(len(names), len(which))
    np.minimum.at(first, which, np.arange(len(which)))
    order = np.argsort(first, kind="stable")
    rank = np.empty(len(names), dtype=np.int64)
    rank[order] = np.arange(len(names))
    return [names[k] for k in order], rank[which]


def _held(
    table: Table, column: str, headings: Sequence[Heading]
) -> tuple[NDArray[Any], Mapping[str, NDArray[Any]]]:
    """The labels of all rows, and all other columns, in memory or in files that vanish with the process."""
    names = [h.name for h in headings]
    parts: dict[str, list[NDArray[Any]]] = {n: [] for n in (column, *names)}
    size = 0
    batches = table.batches()
    for batch in batches:
        for n in parts:
            parts[n].append(batch[n])
        size += sum(v.nbytes for v in batch.values())
        if size > HELD:
            return _spooled(table, column, headings, parts, batches)
    empty = {n: [np.empty(0)] for n, p in parts.items() if not p}
    whole = {n: np.concatenate(p) for n, p in (parts | empty).items()}
    return whole.pop(column), whole


def _spooled(
    table: Table,
    column: str,
    headings: Sequence[Heading],
    parts: dict[str, list[NDArray[Any]]],
    batches: Iterator[RawBatch],
) -> tuple[NDArray[Any], Mapping[str, NDArray[Any]]]:
    """The same with the columns of numbers on disk; texts (names of lines, dates) stay in memory."""
    numbers = [h.name for h in headings if not h.text]
    folder = Path(tempfile.gettempdir())
    room = min(MOST_BYTES, shutil.disk_usage(folder).free // 2)
    written = 0
    with contextlib.ExitStack() as stack:
        # Files without a name: however the process ends, nothing is left of them.
        files: dict[str, IO[bytes]] = {
            n: stack.enter_context(tempfile.TemporaryFile(dir=folder)) for n in numbers
        }
        for n in numbers:
            for part in parts.pop(n):
                written += files[n].write(np.ascontiguousarray(part).data)
        for batch in batches:
            for n in numbers:
                written += files[n].write(np.ascontiguousarray(batch[n]).data)
            for n in parts:
                parts[n].append(batch[n])
            if written > room:
                raise UserError(
                    "the file is too long to be divided into lines",
                    where=table.path,
                    found=f"more than {room / 1e9:.3g} GB of columns",
                    remedy="cut it into several files, or name a larger folder in TMPDIR",
                )
        whole = {n: np.concatenate(p) for n, p in parts.items()}
        labels = whole.pop(column)
        for f in files.values():
            f.flush()
        # What is mapped stays until it is let go, though the file is closed.
        mapped = {n: np.memmap(f, dtype=np.float64, mode="r") for n, f in files.items()}
    return labels, {h.name: mapped[h.name] if h.name in mapped else whole[h.name] for h in headings}
