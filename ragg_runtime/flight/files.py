"""Reading and writing flight files, whole or in parts."""

from __future__ import annotations

import contextlib
import glob
import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.files import file_digest, replacing
from ragg_runtime.flight.angular_acceleration import REACH
from ragg_runtime.flight.assemble import Layout, Whole, enough, layout
from ragg_runtime.flight.formats import ending_of, format_of
from ragg_runtime.flight.gathering import Gathering
from ragg_runtime.flight.mapping import Mapped
from ragg_runtime.flight.record import SI_UNITS, Array, Flight
from ragg_runtime.flight.source import Batch, Column, Source, Written
from ragg_runtime.flight.sources import open_sources
from ragg_runtime.flight.spool import spooled
from ragg_runtime.instrument.layout import PAPER
from ragg_runtime.instrument.layout import Layout as Accelerometers
from ragg_runtime.instrument.units import units

IN_MEMORY = 48 << 20
"""Most memory, bytes, that the columns of a flight may take; those of a longer one are laid down on disk."""

MOST_BYTES = 32 << 30
"""Most bytes that the columns of a flight may take there: what unfolds beyond is no flight."""

UNFOLDS = 200
"""Most times its size on disk that a longer flight may take in memory. Of thirty columns of which two thirds stand still
and the rest is stored to 16 bits it is 20 times: what unfolds to more was made to fill a disc."""

PART = 32768
"""Rows of such a flight that are read at a time."""

_HALO = 2 * REACH
"""Rows of the neighbouring parts that a part is read with: the reach of the derivative and more."""


def read_flight(
    path: Path | str,
    g0: float,
    *,
    need_output: bool = True,
    accelerometers: Accelerometers = PAPER,
    mapping: Mapped | None = None,
    line: str | None = None,
) -> Flight:
    """The flight in a file (see :mod:`ragg_runtime.flight.formats`), in SI.

    Columns are described in :class:`~ragg_runtime.flight.record.Flight`; the header of a CSV column is
    ``name [unit]``, elsewhere the unit is the column's attribute ``units``. Missing samples are filled in
    and marked in ``valid``; ``omegadot`` and ``G_out`` are derived where they are absent; ``notes`` says so.

    Parameters
    ----------
    path
        The file; the ending of its name says the format.
    g0
        The g of the file's units, m/s^2.
    need_output
        False lets a file of motion alone pass.
    accelerometers
        Those of the instrument: which columns are its outputs.
    mapping
        What the columns are, where the file has names and units of its own.
    line
        Which line is meant, where the file has several.

    Raises
    ------
    UserError
        If the file cannot be read as one uniformly sampled flight: what is wrong, where, and what to do.
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
    plan = layout(source.path, source.columns, g0, need_output=need_output, accelerometers=accelerometers)
    with _line_named(source, several):
        gathered = Gathering(plan)
        rest = _bounded(source, gathered)
        head: list[Batch] = []
        held = 0
        for batch in rest:
            head.append(batch)
            held += _bytes(batch)
            if held > IN_MEMORY:
                return _noted(_long(source, plan, gathered, head, rest, several), source)
        whole = gathered.whole()
        rows = {c.name: np.concatenate([np.empty(0), *(b[c.name] for b in head)]) for c in source.columns}
        made = plan.flight(rows, whole, name=_name(source, several), digest=file_digest(source.path))
        return _noted(enough(made, whole.rows), source)


def _long(
    source: Source,
    plan: Layout,
    gathered: Gathering,
    head: list[Batch],
    rest: Iterator[Batch],
    several: bool,
) -> Flight:
    """A flight too long for memory, read once: on the way it is taken for granted that no channel is one of a lower rate,
    and that the first batches say how rates are differentiated.

    Where that was wrong, it is read again. ``head`` are its first batches, ``rest`` those that follow, all counted by
    ``gathered``.
    """
    batches, expected = _given_away(head, rest), gathered.expected()
    made = spooled(_chunks(source, plan, expected, PART, several, batches), source.path, MOST_BYTES)
    whole = gathered.whole()
    if whole.slow or whole.left_out or whole.derivative != expected.derivative:
        del made  # and its place on the disk
        again = _chunks(source, plan, whole, PART, several, source.batches())
        made = spooled(again, source.path, MOST_BYTES)
    return enough(made, whole.rows)


def _given_away(head: list[Batch], rest: Iterator[Batch]) -> Iterator[Batch]:
    """Batches that are kept nowhere once they were given."""
    head.reverse()
    while head:
        yield head.pop()
    yield from rest


def _bytes(batch: Batch) -> int:
    return sum(v.nbytes for v in batch.values())


def _bounded(source: Source, gathered: Gathering) -> Iterator[Batch]:
    """The rows of a source that is no compression bomb, counted on the way. UserError where they become too many."""
    held, size = 0, source.path.stat().st_size
    for batch in source.batches():
        held += _bytes(batch)
        if source.path.is_file() and held > max(IN_MEMORY, UNFOLDS * size):
            raise UserError(
                "the file unfolds to more than a record can be compressed",
                where=source.path,
                found=f"more than {held / 1e9:.3g} GB of numbers in {size / 1e6:.3g} MB on disk",
                expected=f"at most {UNFOLDS} times as much",
                remedy="if it is a record that hardly changes, save it as CSV or without compression",
            )
        gathered.add(batch)
        yield batch


def _noted(made: Flight, source: Source) -> Flight:
    notes = (*source.notes, *made.notes)
    return replace(made, notes=notes, demodulation=source.demodulation)


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


def _name(source: Source, several: bool) -> str:
    return flight_name(source.path) + (f":{source.line}" if several else "")


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


def iter_flight_chunks(
    path: Path | str,
    g0: float,
    rows: int,
    *,
    need_output: bool = True,
    accelerometers: Accelerometers = PAPER,
    mapping: Mapped | None = None,
) -> Iterator[Flight]:
    """The same flight in consecutive parts of ``rows`` (>= 2) file rows, in memory for a few parts only.

    Laid end to end the parts are the flight of :func:`read_flight`, samples missing between two parts
    included; notes tell of the part alone. A column without a number stays, as samples not to be used.
    """
    path = Path(path)
    if rows < 2:
        raise UserError("a part of a flight needs at least two rows", found=rows)
    source = _single(open_sources(path, mapping), path)
    plan = layout(path, source.columns, g0, need_output=need_output, accelerometers=accelerometers)
    gathered = Gathering(plan)
    for batch in source.batches():
        gathered.add(batch)
    yield from _chunks(source, plan, gathered.whole(), rows, False, source.batches())


def _chunks(
    source: Source, plan: Layout, whole: Whole, rows: int, several: bool, batches: Iterable[Batch]
) -> Iterator[Flight]:
    """Consecutive parts of the flight that ``batches`` of rows make up."""
    name, digest = _name(source, several), file_digest(source.path)
    step: float | None = None
    before: Batch | None = None
    done = 0
    parts = _parts([c.name for c in source.columns], batches, max(rows, _HALO))
    part = next(parts, None)
    while part is not None:
        after = next(parts, None)
        if step is None:
            step = plan.step(part)
        size = len(part["time"])
        pieces = [part]
        lead = 0
        if before is not None:
            pieces.insert(0, {n: v[-_HALO:] for n, v in before.items()})
            lead = len(pieces[0]["time"])
        if after is not None:
            pieces.append({n: v[:_HALO] for n, v in after.items()})
        joined = {n: np.concatenate([p[n] for p in pieces]) for n in part}
        flight = plan.flight(joined, whole, name=name, digest=digest, first_row=done - lead + 1, step=step)
        edges = plan.known.to_si(
            joined["time"][[max(lead - 1, 0), lead + size - 1]], _unit(source, "time"), "s", str(source.path)
        )
        first = 0 if before is None else int(np.searchsorted(flight.time, edges[0], "right"))
        yield flight.part(slice(first, int(np.searchsorted(flight.time, edges[1], "right"))))
        done += size
        before, part = part, after


def write_flight(
    flight: Flight, path: Path | str, units_of: Mapping[str, str] | None = None, g0: float | None = None
) -> None:
    """Write a flight in any of the formats, by the ending of the name; whole or not at all.

    In SI, the default, reading it back gives the same numbers to the last bit. ``units_of`` gives some
    columns another unit; ``g0`` (m/s^2) is needed where one is made with g. Samples that are not valid are
    written without output (without motion, if there is no output).
    """
    write_tables(Path(path), lambda: [Written(_columns(flight, units_of or {}, g0))])


def write_tables(path: Path, tables: Callable[[], Sequence[Written]]) -> None:
    """Write tables in the format of the name's ending, whole or not at all (a second file of a pair goes with it)."""
    kind = format_of(path)
    made = tables()
    with replacing(path) as temporary:
        try:
            kind.write_tables(temporary, made)
            for beside in _beside(temporary):
                os.replace(beside, path.with_suffix(beside.suffix))
        finally:
            for beside in _beside(temporary):
                beside.unlink()


def _beside(temporary: Path) -> list[Path]:
    """Files that a writer put beside the one that it was asked for: same name, another ending."""
    found = temporary.parent.glob(f"{glob.escape(temporary.stem)}.*")
    return sorted(p for p in found if p.suffix != temporary.suffix)


def flight_name(path: Path) -> str:
    """The file's name without its ending; the folder's where the file is just called ``flight``."""
    ending = ending_of(path.name)
    stem = path.name[: -len(ending)] if ending is not None else path.name
    folder = path.resolve().parent.name
    # it is told on terminals and in reports: what would steer them, or pass for a line of ours, is written out
    return one_line(f"{folder}/{stem}" if stem == "flight" and folder else stem)


def _parts(names: Sequence[str], batches: Iterable[Batch], rows: int) -> Iterator[Batch]:
    waiting: deque[Batch] = deque()
    count = 0
    for batch in batches:
        waiting.append(batch)
        count += len(batch["time"])
        # The last part must not be too short to stand alone: one more than a full part stays in hand.
        while count >= 2 * rows:
            yield _taken(names, waiting, rows)
            count -= rows
    yield {n: np.concatenate([np.empty(0), *(b[n] for b in waiting)]) for n in names}


def _taken(names: Sequence[str], waiting: deque[Batch], rows: int) -> Batch:
    """The first rows of those that wait, out of them; copied only where they are of several batches."""
    found: list[Batch] = []
    while rows:
        first = waiting.popleft()
        size = len(first["time"])
        if size > rows:
            waiting.appendleft({n: v[rows:] for n, v in first.items()})
            first, size = {n: v[:rows] for n, v in first.items()}, rows
        found.append(first)
        rows -= size
    if len(found) == 1:
        return found[0]
    return {n: np.concatenate([b[n] for b in found]) for n in names}


def _columns(flight: Flight, units_of: Mapping[str, str], g0: float | None) -> list[tuple[Column, Array]]:
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
            (Column(name, unit), known.from_si(values, flight.units[name], unit, f"column {name!r}"))
        )
    return columns


def _unit(source: Source, name: str) -> str:
    return next(c.unit for c in source.columns if c.name == name)
