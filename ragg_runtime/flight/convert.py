"""A flight file in another format: the same numbers, names and units, line by line."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import pair
from ragg_runtime.flight.files import write_tables
from ragg_runtime.flight.formats import format_of
from ragg_runtime.flight.mapping import Mapped
from ragg_runtime.flight.source import Source, Written
from ragg_runtime.flight.sources import open_sources

MOST_BYTES = 8 << 30
"""Bytes of columns that are copied at most: they are held in memory."""


@dataclass(frozen=True)
class Converted:
    """What was written: lines (one if the file names none), rows, columns, and what was left out, in sentences."""

    lines: int
    rows: int
    columns: tuple[str, ...]
    notes: tuple[str, ...]


def convert(source: Path, target: Path, mapping: Mapped | None = None) -> Converted:
    """Write the flights of one file to another, in the format of its ending.

    Nothing is resampled, filled in or converted: values are the file's, under the file's names and units, or
    with a mapping under the contract's. Instants become seconds.
    """
    if {p.resolve() for p in pair(source)} & {p.resolve() for p in (target, *pair(target))}:
        raise UserError("a file cannot be converted into itself", where=source, remedy="name another file")
    format_of(target)  # before a long file is read for nothing
    sources = open_sources(source, mapping, lenient=True)
    tables = _tables(sources)
    write_tables(target, lambda: tables)
    notes = list(dict.fromkeys(n for s in sources for n in s.notes))
    bare = [c.name for c in sources[0].columns if not c.unit]
    if bare:
        notes.append(f"without a unit, as in the file: {', '.join(bare)}")
    if sources[0].origin is not None:
        notes.append(f"time counts from {sources[0].origin.isoformat().replace('+00:00', 'Z')}")
    rows = sum(len(t.columns[0][1]) for t in tables if t.columns)
    return Converted(len(tables), rows, tuple(c.name for c in sources[0].columns), tuple(notes))


def _tables(sources: list[Source]) -> list[Written]:
    held = 0
    found = []
    for s in sources:
        batches = []
        for batch in s.batches():
            held += sum(v.nbytes for v in batch.values())
            if held > MOST_BYTES:
                raise UserError(
                    "the file is too long to be converted in one piece",
                    where=s.path,
                    found=f"more than {MOST_BYTES / 1e9:.3g} GB of columns",
                    remedy="cut it into several files",
                )
            batches.append(batch)
        columns = [(c, np.concatenate([np.empty(0), *(b[c.name] for b in batches)])) for c in s.columns]
        found.append(Written(columns, s.line if len(sources) > 1 else None))
    return found
