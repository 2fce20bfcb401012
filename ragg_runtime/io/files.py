"""Flight files: the formats by their endings, reading, writing, converting; flights in memory go the same way.

A further format is one function ``path -> list of DataTable`` and a line of :data:`FORMATS`.
"""

from __future__ import annotations

import contextlib
import csv
import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.files import file_digest, open_regular, replacing
from ragg_runtime.instrument.units import units
from ragg_runtime.io.arrays import (
    convert_arrow,
    read_hdf5,
    read_matlab,
    read_netcdf,
    read_parquet,
    read_unit,
    tabulate,
)
from ragg_runtime.io.assemble import make_flight
from ragg_runtime.io.mapping import Mapped, join_parts, make_recordings, read_quantities
from ragg_runtime.io.record import SI_UNITS, Flight, digest_content, is_disc_angle
from ragg_runtime.io.sampling import make_grid
from ragg_runtime.io.tables import DataColumn, DataTable
from ragg_runtime.io.text_tables import read_csv, read_excel

PAPER_G = 9.8  # m/s^2: the g of units such as mg where no model says its own
MOST_GAPS = 20  # gaps that are listed, the longest ones

# --- formats -------------------------------------------------------------------------------------------


def write_csv(path: Path, table: pa.Table) -> None:
    """Write columns exactly: every number is the shortest that reads back as itself, NaN is left empty."""
    header = io.StringIO()
    titles = [f"{f.name} [{unit}]" if (unit := read_unit(f)) else f.name for f in table.schema]
    csv.writer(header, lineterminator="\n").writerow(titles)
    compressed = path.name.lower().endswith(".gz")
    with path.open("wb") as raw, pa.CompressedOutputStream(raw, "gzip") if compressed else raw as stream:
        stream.write(header.getvalue().encode())
        pyarrow.csv.write_csv(table, stream, pyarrow.csv.WriteOptions(include_header=False))


def write_netcdf(path: Path, table: pa.Table) -> None:
    """Write columns as variables along ``time``, float64 or texts."""
    import xarray  # slow to import, and only this format needs it

    units_of = [{"units": unit} if (unit := read_unit(f)) else {} for f in table.schema]
    columns = zip(table.column_names, map(convert_arrow, table.columns), units_of, strict=True)
    data = xarray.Dataset({name: ("time", values, unit) for name, values, unit in columns})
    # in memory first: where a disc is full HDF5 crashes as the process ends
    path.write_bytes(data.to_netcdf(engine="h5netcdf"))


def write_parquet(path: Path, table: pa.Table) -> None:
    """Write columns as float64 with their units; NaN is null."""
    with path.open("wb") as stream:
        pq.write_table(table, stream)


@dataclass(frozen=True)
class Format:
    """A format of files: its ``name`` for messages, endings of names, reader and writer."""

    name: str
    endings: tuple[str, ...]
    read: Callable[[Path], list[DataTable]]
    write: Callable[[Path, pa.Table], None] | None = None


FORMATS = (
    Format("csv", (".csv", ".csv.gz"), read_csv, write_csv),
    Format("text", (".txt", ".dat", ".asc", ".tsv", ".log", ".lvm", ".xyz"), read_csv),
    Format("parquet", (".parquet", ".pq"), read_parquet, write_parquet),
    Format("netcdf", (".nc", ".nc4"), read_netcdf, write_netcdf),
    Format("hdf5", (".h5", ".hdf5", ".hdf", ".he5"), read_hdf5),
    Format("MATLAB", (".mat",), read_matlab),
    Format("Excel", (".xlsx", ".xlsm"), read_excel),
)

# file name endings and the format that they stand for
ENDINGS: Mapping[str, Format] = {e: f for f in FORMATS for e in f.endings}
ENDINGS = {**ENDINGS, **{f"{e}.gz": f for e, f in ENDINGS.items() if f.name == "text"}}


def find_ending(name: str) -> str | None:
    """The longest known ending of a file name."""
    return max((e for e in ENDINGS if name.lower().endswith(e)), key=len, default=None)


def find_format(path: Path, *, write: bool = False) -> Format:
    """The format by the ending of the name; UserError for any other, or for one that cannot be written."""
    kind = ENDINGS.get(find_ending(path.name) or "")
    if kind is not None and (kind.write is not None or not write):
        return kind
    raise UserError(
        "unknown file ending" if kind is None else f"{kind.name} files are read, not written",
        where=path,
        found=path.suffix or "no ending",
        expected=", ".join(e for f in FORMATS if f.write is not None or not write for e in f.endings),
        remedy="choose one of these formats; a table that is plain text may be called .txt",
    )


def read_tables(source: Any) -> list[DataTable]:
    """All tables of a file, by the ending of its name, or of a flight in memory."""
    try:
        tables = _read_file(Path(source)) if isinstance(source, str | Path) else tabulate(source)
        pa.default_memory_pool().release_unused()  # Arrow would keep what a long file took
        return [join_parts(read_quantities(t)) for t in tables]
    except MemoryError:
        what = "the file is damaged, or too large for the memory of this computer"
        raise UserError(what, where=source, remedy="copy it again, or split it") from None


def _read_file(path: Path) -> list[DataTable]:
    kind = find_format(path)
    try:
        with open_regular(path) as stream:
            is_empty = not stream.read(1)
    except OSError as error:
        reason = "it does not exist" if isinstance(error, FileNotFoundError) else error.strerror
        remedy = "check its name, its folder and its permissions"
        raise UserError("the flight file cannot be read", where=path, found=reason, remedy=remedy) from None
    if is_empty:
        remedy = "the recording or the copy may have failed: get the file again"
        raise UserError("the flight file is empty", where=path, found="0 bytes", remedy=remedy)
    return kind.read(path)


# --- reading -------------------------------------------------------------------------------------------


def read_recordings(source: Any, mapping: Mapped | None = None, name: str = "flight") -> list[DataTable]:
    """The records in a file or in memory, one for each line; see :func:`.mapping.make_recordings`."""
    place = Path(source) if isinstance(source, str | Path) else name
    return make_recordings(read_tables(source), place, mapping)


def read_flights(
    source: Any, g0: float, *, mapping: Mapped | None = None, name: str = "flight", **options: Any
) -> list[Flight]:
    """The flights in a file or in memory, in SI, one for each line; UserError if they are no uniformly sampled ones.

    Missing samples are filled in and marked in ``valid``; ``omegadot`` and ``G_out`` are derived where they are absent.

    Parameters
    ----------
    source
        A path (see :data:`FORMATS`), a pandas DataFrame, an xarray Dataset, or a dict of arrays (n,).
    g0
        The g of the file's units, m/s^2.
    mapping
        What the columns are, where the file has names of its own.
    name
        Of a flight in memory.
    options
        Those of :func:`.assemble.make_flight`.
    """
    path = Path(source) if isinstance(source, str | Path) else None
    records = read_recordings(source, mapping, name)
    digest = None if path is None else file_digest(path)
    title = name if path is None else name_flight(path)
    flights = []
    for r in records:
        x, label = make_flight(r, g0, **options), f"{title}:{r.line}" if len(records) > 1 else title
        flights.append(replace(x, name=label, path=path, digest=digest or digest_content(x)))
    return flights


def read_flight(source: Any, g0: float, *, line: str | None = None, **options: Any) -> Flight:
    """The only flight in a file or in memory, or that of a ``line``; see :func:`read_flights`."""
    flights = read_flights(source, g0, **options)
    if line is not None:
        flights = [x for x in flights if x.name.endswith(f":{line}")] or flights
    if len(flights) == 1:
        return flights[0]
    names = [x.name.rpartition(":")[2] for x in flights]
    raise UserError(
        "the file holds several lines",
        where=flights[0].path or flights[0].name,
        found=", ".join(names[:12]) + (" ..." if len(names) > 12 else ""),
        remedy="choose a line in a mapping: [file] lines = [...]; or convert it first",
    )


def name_flight(path: Path) -> str:
    """The file's name without its ending; the folder's where the file is just called ``flight``."""
    stem = path.name[: len(path.name) - len(find_ending(path.name) or "")]
    folder = path.resolve().parent.name
    # it is shown on terminals and in reports: control characters and line ends are escaped
    return one_line(f"{folder}/{stem}" if stem == "flight" and folder else stem)


# --- writing -------------------------------------------------------------------------------------------


def write_flight(flight: Flight, path: Path | str) -> None:
    """Write a flight in SI as CSV, Parquet or NetCDF, by the ending of the name; whole or not at all. The same bits are read back."""
    ordered = [n for n in SI_UNITS if n in flight.channels]
    ordered += [n for n in flight.channels if n not in SI_UNITS]
    series = {n: flight.channels[n] for n in ordered} | dict(flight.outputs)
    columns = [DataColumn("time", flight.units["time"], flight.time)]
    for name, values in series.items():
        column = values if flight.valid.all() else np.where(flight.valid, values, np.nan)
        columns.append(DataColumn(name, flight.units[name], column))
    write_tables(Path(path), [DataTable(tuple(columns))])


def write_tables(path: Path, tables: Sequence[DataTable]) -> None:
    """Write tables in the format of the name's ending, whole or not at all; lines are distinguished by a column ``line``."""
    write = find_format(path, write=True).write
    assert write is not None
    parts = list(map(_to_arrow, tables))
    with replacing(path) as temporary:
        write(temporary, pa.concat_tables(parts, promote_options="default") if len(parts) > 1 else parts[0])


def _to_arrow(table: DataTable) -> pa.Table:
    """The columns with their units, the line's name in front; NaN is null."""
    line = [] if table.line is None else [DataColumn("line", "", np.full(len(table), table.line, object))]
    columns = [*line, *table.columns]
    arrays = [pa.array(c.values, from_pandas=True) for c in columns]
    units_of = [{"units": c.unit} if c.unit else None for c in columns]
    fields = [pa.field(c.name, x.type, metadata=u) for c, x, u in zip(columns, arrays, units_of, strict=True)]
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))


def convert(source: Path, target: Path, mapping: Mapped | None = None) -> dict[str, Any]:
    """Write the flights of one file to another, in the format of its ending; values as they are. What was done, and ``notes`` of what
    was left out: the keys are in docs/reference/json.toml.

    Instants become seconds since the first of them, of every line its own: the angle of a disc without an encoder counts
    from there, in the new file and in what is cut out of it.
    """
    if source.resolve() == target.resolve():
        raise UserError("a file cannot be converted into itself", where=source, remedy="name another file")
    find_format(target, write=True)  # before a long file is read for nothing
    lines = read_recordings(source, mapping)
    if len(lines) == 1:
        lines = [replace(lines[0], line=None)]
    names, bare = lines[0].names, [c.name for c in lines[0].columns if not c.unit]
    notes = [n for r in lines for n in r.notes]
    notes += [f"without a unit, as in the file: {', '.join(bare)}"] if bare else []
    lines = [_count_from_first(r, notes) for r in lines]
    write_tables(target, lines)
    counts = {"output": str(target), "lines": len(lines), "rows": sum(map(len, lines)), "columns": [*names]}
    return {**counts, "notes": list(dict.fromkeys(notes))}


def _count_from_first(r: DataTable, notes: list[str]) -> DataTable:
    """A line whose instants count from the first of them, which is noted."""
    if r.origin is None and not r.instants:
        return r
    first = float(r.column("time").values[0]) if r.instants and len(r) else 0.0
    elapsed = timedelta(seconds=first)
    origin = f"{first:.10g} s after midnight" if r.origin is None else write_instant(r.origin + elapsed)
    notes.append(("" if r.line is None else f"line {r.line}: ") + f"time counts from {origin}")
    moved = (replace(c, values=c.values - first) if c.name == "time" else c for c in r.columns)
    return replace(r, columns=tuple(moved))


def write_instant(instant: datetime) -> str:
    """An instant in ISO 8601, UTC as ``Z``."""
    return instant.isoformat().replace("+00:00", "Z")


# --- what a file holds ----------------------------------------------------------------------------------


def describe_flight(path: Path | str, mapping: Mapped | None = None) -> dict[str, Any]:
    """What a flight file holds, as ``ragg info --json`` writes it (its keys: docs/reference/json.toml); UserError if it has no table.

    Of a record that cannot be used as it is ``refused`` says why.
    """
    path = Path(path)
    records = read_recordings(path, mapping)
    return {
        "path": str(path),
        "sha256": file_digest(path),
        "format": find_format(path).name,
        "bytes": path.stat().st_size,
        "records": [_describe_record(r, name_flight(path), len(records) > 1) for r in records],
    }


def _describe_record(r: DataTable, name: str, several: bool) -> dict[str, Any]:
    notes, refused, grid = [*r.notes], None, None
    try:
        x = make_flight(r, PAPER_G)
        notes = [*x.notes]
        if not any(map(is_disc_angle, x.channels)):
            zero = "the first sample, since time is given as instants" if x.instants else "t = 0 of time"
            notes.append(
                f"no spin_angle: the disc angle counts from {zero} (angle_origin in model.toml overrides this)"
            )
    except UserError as error:
        refused = error.message
    with contextlib.suppress(KeyError, UserError):  # reported in ``refused``
        time = r.column("time")
        grid = make_grid(units(PAPER_G).to_si(time.values, time.unit or "s", "s", "column 'time'"), r.place)
    gaps = [] if grid is None else grid.gaps
    longest = sorted(gaps, key=lambda g: -g["samples"])[:MOST_GAPS]
    return {
        "name": f"{name}:{r.line}" if several else name,
        "line": r.line if several else None,
        "rows": len(r),
        "start_s": None if grid is None else float(grid.time[0]),
        "duration_s": None if grid is None else len(grid.time) * grid.step,
        "rate_Hz": None if grid is None else 1 / grid.step,
        "origin": None if r.origin is None else write_instant(r.origin),
        "gap_count": len(gaps),
        "missing": sum(g["samples"] for g in gaps),
        "gaps": sorted(longest, key=lambda g: g["from_s"]),
        "columns": list(map(_describe_column, r.columns)),
        "notes": notes,
        "refused": refused,
    }


def _describe_column(c: DataColumn) -> dict[str, Any]:
    finite = c.values[np.isfinite(c.values)]
    ranges = ("minimum", finite.min), ("maximum", finite.max), ("mean", finite.mean)
    entry = {"name": c.name, "unit": c.unit, "samples": len(finite), "missing": len(c.values) - len(finite)}
    return entry | {n: float(f()) if len(finite) else None for n, f in ranges}
