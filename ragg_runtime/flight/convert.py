"""A flight file in another format: the same numbers, names and units, line by line."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.files import write_tables
from ragg_runtime.flight.formats import writable
from ragg_runtime.flight.mapping import Mapped
from ragg_runtime.flight.source import Written
from ragg_runtime.flight.sources import open_sources


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
    if source.resolve() == target.resolve():
        raise UserError("a file cannot be converted into itself", where=source, remedy="name another file")
    writable(target)  # before a long file is read for nothing
    sources = open_sources(source, mapping, lenient=True)
    tables = []
    for s in sources:
        rows = s.rows()
        tables.append(Written([(c, rows[c.name]) for c in s.columns], s.line if len(sources) > 1 else None))
    write_tables(target, tables)
    notes = list(dict.fromkeys(n for s in sources for n in s.notes))
    bare = [c.name for c in sources[0].columns if not c.unit]
    if bare:
        notes.append(f"without a unit, as in the file: {', '.join(bare)}")
    if sources[0].origin is not None:
        notes.append(f"time counts from {sources[0].origin.isoformat().replace('+00:00', 'Z')}")
    count = sum(len(t.columns[0][1]) for t in tables if t.columns)
    return Converted(len(tables), count, tuple(c.name for c in sources[0].columns), tuple(notes))
