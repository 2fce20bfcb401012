"""Reading and writing flight files, whole or in parts."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import replacing
from ragg_runtime.flight.assemble import layout
from ragg_runtime.flight.csv_file import open_csv, write_csv
from ragg_runtime.flight.netcdf_file import open_netcdf, write_netcdf
from ragg_runtime.flight.parquet_file import open_parquet, write_parquet
from ragg_runtime.flight.record import SI_UNITS, Array, Flight
from ragg_runtime.flight.source import FORMATS, Batch, Column, Source, check_content, format_of
from ragg_runtime.flight.spool import spooled
from ragg_runtime.instrument.units import Units, units
from ragg_runtime.signals.derivative import WINDOW

IN_MEMORY = 48 << 20
"""Most memory, bytes, that the columns of a flight may take; those of a longer one are laid down on disk."""

MOST_BYTES = 32 << 30
"""Most bytes that the columns of a flight may take there: what unfolds beyond is no flight."""

PART = 32768
"""Rows of such a flight that are read at a time."""

_HALO = WINDOW
"""Rows of the neighbouring parts that a part is read with: the reach of the derivative and more."""


def read_flight(path: Path | str, g0: float, *, need_output: bool = True) -> Flight:
    """The flight in a CSV (``.csv``, ``.csv.gz``), Parquet or NetCDF-4 file, in SI.

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

    Raises
    ------
    UserError
        If the file cannot be read as a uniformly sampled flight: what is wrong, where, and what to do.
    """
    path = Path(path)
    source = open_source(path)
    plan = layout(path, source.columns, g0, need_output=need_output)
    batches: list[Batch] = []
    held = 0
    for batch in source.batches():
        held += sum(v.nbytes for v in batch.values())
        if held > IN_MEMORY:
            batches.clear()
            parts = iter_flight_chunks(path, g0, PART, need_output=need_output)
            return spooled(parts, path, MOST_BYTES)
        batches.append(batch)
    rows = {c.name: np.concatenate([np.empty(0), *(b[c.name] for b in batches)]) for c in source.columns}
    return plan.flight(rows, name=flight_name(path), digest=file_digest(path))


def iter_flight_chunks(
    path: Path | str, g0: float, rows: int, *, need_output: bool = True
) -> Iterator[Flight]:
    """The same flight in consecutive parts of ``rows`` (>= 2) file rows, in memory for a few parts only.

    Laid end to end the parts are the flight of :func:`read_flight`, samples missing between two parts
    included; notes tell of the part alone. A column without a number stays, as samples not to be used.
    """
    path = Path(path)
    if rows < 2:
        raise UserError("a part of a flight needs at least two rows", found=rows)
    source = open_source(path)
    plan = layout(path, source.columns, g0, need_output=need_output)
    name, digest = flight_name(path), file_digest(path)
    step: float | None = None
    before: Batch | None = None
    done = 0
    parts = _parts(source, max(rows, _HALO))
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
        flight = plan.flight(joined, name=name, digest=digest, first_row=done - lead + 1, step=step)
        edges = plan.known.to_si(
            joined["time"][[max(lead - 1, 0), lead + size - 1]], _unit(source, "time"), "s", str(path)
        )
        first = 0 if before is None else int(np.searchsorted(flight.time, edges[0], "right"))
        yield flight.part(slice(first, int(np.searchsorted(flight.time, edges[1], "right"))))
        done += size
        before, part = part, after


def write_flight(
    flight: Flight, path: Path | str, units_of: Mapping[str, str] | None = None, g0: float | None = None
) -> None:
    """Write a flight to CSV (``.csv``, ``.csv.gz``), Parquet or NetCDF-4, by the ending; whole or not at all.

    In SI, the default, reading it back gives the same numbers to the last bit. ``units_of`` gives some
    columns another unit; ``g0`` (m/s^2) is needed where one is made with g. Samples that are not valid are
    written without output (without motion, if there is no output).
    """
    path = Path(path)
    kind = format_of(path)
    columns = _columns(flight, units_of or {}, g0)
    with replacing(path) as temporary:
        if kind == "csv":
            write_csv(temporary, columns, path.name.lower().endswith(".gz"))
        elif kind == "parquet":
            write_parquet(temporary, columns)
        else:
            write_netcdf(temporary, columns)


def open_source(path: Path) -> Source:
    """The file as columns in its own units, by the ending of its name and its content."""
    kind = format_of(path)
    compressed = check_content(path, kind)
    if kind == "csv":
        return open_csv(path, compressed)
    return open_parquet(path) if kind == "parquet" else open_netcdf(path)


def flight_name(path: Path) -> str:
    """The file's name without its ending; the folder's where the file is just called ``flight``."""
    stem = path.name
    for suffix in sorted(FORMATS, key=len, reverse=True):
        if stem.lower().endswith(suffix):
            stem = stem[: -len(suffix)]
            break
    folder = path.resolve().parent.name
    return f"{folder}/{stem}" if stem == "flight" and folder else stem


def file_digest(path: Path) -> str:
    """SHA-256 of the file, hexadecimal."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def _parts(source: Source, rows: int) -> Iterator[Batch]:
    names = [c.name for c in source.columns]
    waiting: list[Batch] = []
    count = 0
    for batch in source.batches():
        waiting.append(batch)
        count += len(batch["time"])
        # The last part must not be too short to stand alone: one more than a full part stays in hand.
        while count >= 2 * rows:
            joined = {n: np.concatenate([b[n] for b in waiting]) for n in names}
            yield {n: v[:rows] for n, v in joined.items()}
            waiting = [{n: v[rows:] for n, v in joined.items()}]
            count -= rows
    yield {n: np.concatenate([np.empty(0), *(b[n] for b in waiting)]) for n in names}


def _columns(flight: Flight, units_of: Mapping[str, str], g0: float | None) -> list[tuple[Column, Array]]:
    known = Units(1.0) if g0 is None else units(g0)
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
