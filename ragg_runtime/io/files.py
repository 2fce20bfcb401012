"""Reading and writing flight files."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import timedelta
from pathlib import Path

import numpy as np

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.files import file_digest, replacing
from ragg_runtime.instrument.layout import PAPER
from ragg_runtime.instrument.layout import Layout as Accelerometers
from ragg_runtime.instrument.units import units
from ragg_runtime.io.assemble import enough, layout
from ragg_runtime.io.formats import ending_of, writable
from ragg_runtime.io.mapping import Mapped
from ragg_runtime.io.record import SI_UNITS, Array, Flight
from ragg_runtime.io.source import Heading, Rows, Source, Written
from ragg_runtime.io.sources import open_sources


def read_flight(
    path: Path | str,
    g0: float,
    *,
    need_output: bool = True,
    accelerometers: Accelerometers = PAPER,
    mapping: Mapped | None = None,
    line: str | None = None,
) -> Flight:
    """The flight in a file (see :mod:`ragg_runtime.io.formats`), in SI; UserError if it is no uniformly sampled
    one.

    Missing samples are filled in and marked in ``valid``; ``omegadot`` and ``G_out`` are derived where they are absent.
    ``g0``: the g of the file's units, m/s^2. ``need_output`` False lets a file of motion alone pass. ``accelerometers``
    are the instrument's. ``mapping``: where the file has names of its own. ``line``: which is meant, where the file has
    several.
    """
    path = Path(path)
    sources = open_sources(path, mapping)
    if line is not None:
        sources = [s for s in sources if s.line == line] or sources
    return _flight(_single(sources, path), g0, need_output, accelerometers, line is not None)


def read_flights(
    path: Path | str,
    g0: float,
    *,
    need_output: bool = True,
    accelerometers: Accelerometers = PAPER,
    mapping: Mapped | None = None,
    leave: frozenset[str] = frozenset(),
) -> list[Flight]:
    """The flights in a file, one for each line; ``leave`` names columns that are not read, the other arguments are
    those of :func:`read_flight`.
    """
    sources = open_sources(Path(path), mapping, leave=leave)
    return [_flight(s, g0, need_output, accelerometers, len(sources) > 1) for s in sources]


def _flight(
    source: Source, g0: float, need_output: bool, accelerometers: Accelerometers, several: bool
) -> Flight:
    plan = layout(
        source.path,
        source.columns,
        g0,
        need_output=need_output,
        accelerometers=accelerometers,
        passed=source.passed,
    )
    name = flight_name(source.path) + (f":{source.line}" if several else "")
    with _line_named(source, several):
        rows = source.rows()
        made = enough(plan.flight(rows, name=name, digest=file_digest(source.path)), len(rows["time"]))
    notes = (*source.notes, *made.notes)
    return replace(made, notes=notes, demodulation=source.demodulation, instants=source.instants)


@contextlib.contextmanager
def _line_named(source: Source, several: bool) -> Iterator[None]:
    """Say in the message which of several lines is at fault."""
    try:
        yield
    except UserError as error:
        if not several:
            raise
        raise UserError(
            f"line {source.line}: {error.what}",
            where=error.where,
            found=error.found,
            expected=error.expected,
            remedy=error.remedy,
        ) from None


def _single(sources: Sequence[Source], path: Path) -> Source:
    if len(sources) == 1:
        return sources[0]
    names = [str(s.line) for s in sources]
    raise UserError(
        "the file holds several lines",
        where=path,
        found=", ".join(names[:12]) + (" ..." if len(names) > 12 else ""),
        expected="one flight",
        remedy="name the line that is meant in a mapping: [file] lines = [...]; or convert it first",
    )


def write_flight(
    flight: Flight, path: Path | str, units_of: Mapping[str, str] | None = None, g0: float | None = None
) -> None:
    """Write a flight as CSV, Parquet or NetCDF, by the ending of the name; whole or not at all.

    In SI, the default, reading it back gives the same bits. ``units_of`` gives some columns another unit; ``g0``:
    m/s^2.
    """
    write_tables(Path(path), [Written(_columns(flight, units_of or {}, g0))])


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write tables in the format of the name's ending, whole or not at all."""
    kind = writable(path)
    with replacing(path) as temporary:
        kind.write_tables(temporary, tables)


def flight_name(path: Path) -> str:
    """The file's name without its ending; the folder's where the file is just called ``flight``."""
    ending = ending_of(path.name)
    stem = path.name[: -len(ending)] if ending is not None else path.name
    folder = path.resolve().parent.name
    # it is told on terminals and in reports: what would steer them, or pass for a line of ours, is written out
    return one_line(f"{folder}/{stem}" if stem == "flight" and folder else stem)


def _columns(flight: Flight, units_of: Mapping[str, str], g0: float | None) -> list[tuple[Heading, Array]]:
    known = units(1.0 if g0 is None else g0)
    ordered = [n for n in SI_UNITS if n in flight.channels]
    ordered += [n for n in flight.channels if n not in SI_UNITS]
    blanked = flight.outputs or flight.channels
    columns = []
    for name in ("time", *ordered, *flight.outputs):
        values = flight.time if name == "time" else flight.channels.get(name, flight.outputs.get(name))
        assert values is not None
        if name in blanked and not flight.valid.all():
            values = np.where(flight.valid, values, np.nan)
        unit = units_of.get(name, flight.units[name])
        if g0 is None and known.uses_g(unit):
            raise ValueError(f"{name} in {unit}: g0 is needed")
        columns.append(
            (Heading(name, unit), known.from_si(values, flight.units[name], unit, f"column {name!r}"))
        )
    return columns


@dataclass(frozen=True)
class Converted:
    """What was written: lines (one if the file names none), rows, columns, and what was left out, in sentences."""

    lines: int
    rows: int
    columns: tuple[str, ...]
    notes: tuple[str, ...]


def convert(source: Path, target: Path, mapping: Mapped | None = None) -> Converted:
    """Write the flights of one file to another, in the format of its ending; values as they are.

    Instants become seconds since the first of them, of every line its own: the angle of a disc without an encoder counts from there,
    in the new file and in what is cut out of it.
    """
    if source.resolve() == target.resolve():
        raise UserError("a file cannot be converted into itself", where=source, remedy="name another file")
    writable(target)  # before a long file is read for nothing
    sources = open_sources(source, mapping, lenient=True)
    tables, begins = [], []
    for s in sources:
        rows, zero = _from_first(s)
        begins += [zero] if zero is not None else []
        tables.append(Written([(c, rows[c.name]) for c in s.columns], s.line if len(sources) > 1 else None))
    write_tables(target, tables)
    notes = list(dict.fromkeys(n for s in sources for n in s.notes))
    bare = [c.name for c in sources[0].columns if not c.unit]
    if bare:
        notes.append(f"without a unit, as in the file: {', '.join(bare)}")
    notes += dict.fromkeys(begins)
    count = sum(len(t.columns[0][1]) for t in tables if t.columns)
    return Converted(len(tables), count, tuple(c.name for c in sources[0].columns), tuple(notes))


def _from_first(s: Source) -> tuple[Rows, str | None]:
    """Rows with instants as seconds since the first; and when ``time`` is 0, in words, if that is known."""
    rows = s.rows()
    time, line = rows["time"], "" if s.line is None else f"line {s.line}: "
    there = time[np.isfinite(time)]
    first = float(there[0]) if s.instants and len(there) else 0.0
    if s.origin is not None:
        zero = (s.origin + timedelta(seconds=first)).isoformat().replace("+00:00", "Z")
        return {**rows, "time": time - first}, f"{line}time counts from {zero}"
    if s.instants:
        return {**rows, "time": time - first}, f"{line}time counts from {first:.10g} s after midnight"
    return rows, None
