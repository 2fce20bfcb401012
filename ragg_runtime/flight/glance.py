"""A first look at a flight: its output alone, as the file has it, before anything is examined or filled in."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight import netcdf_file, parquet_file
from ragg_runtime.flight.files import flight_name
from ragg_runtime.flight.formats import check_content, format_of
from ragg_runtime.flight.record import Array
from ragg_runtime.instrument.units import units


@dataclass(frozen=True)
class Glance:
    """The output ``G_out`` (N,), V, in single precision, NaN where nothing stands, from ``start`` s on every ``step`` s.

    Time is taken as uniform between the first stamp and the last: good enough to draw, and for nothing else.
    """

    name: str
    start: float
    step: float
    values: NDArray[np.float32]


def glance(path: Path, g0: float) -> Glance | None:
    """The output of a file whose columns can be read one by one (Parquet, NetCDF); ``None`` of any other file.

    Whatever is wrong with a file is told by :func:`~ragg_runtime.flight.files.read_flight`, not here.
    """
    try:
        kind = format_of(path)
        check_content(path, kind)
        if kind not in (parquet_file, netcdf_file):
            return None
        found = _parquet(path) if kind is parquet_file else _netcdf(path)
        (time, time_unit), (output, unit) = found
        known = units(g0)
        ends = known.to_si(time, time_unit, "s", str(path))
        values = output if unit == "V" else known.to_si(output, unit, "V", str(path))
    except (UserError, OSError, ValueError, KeyError, TypeError, IndexError, MemoryError):
        return None
    step = float(ends[1] - ends[0]) / max(len(values) - 1, 1)
    if not (np.isfinite(step) and step > 0.0):
        return None
    # as in a flight that has been read, time begins with the first sample
    return Glance(name=flight_name(path), start=0.0, step=step, values=np.asarray(values, dtype=np.float32))


def _parquet(path: Path) -> tuple[Any, Any]:
    import pyarrow.parquet as pq

    from ragg_runtime.flight.arrow import floats

    def column(table: Any, name: str) -> Array:
        return floats(table.column(name).combine_chunks())

    with pq.ParquetFile(path) as file:
        schema = file.schema_arrow
        time, volts = ((schema.field(n).metadata or {})[b"units"].decode() for n in ("time", "G_out"))
        chunks = file.read(columns=["G_out"]).column("G_out").chunks
        output = np.concatenate([np.empty(0), *(floats(c) for c in chunks)], dtype=np.float32)
        last = file.metadata.num_row_groups - 1
        ends = [column(file.read_row_group(k, columns=["time"]), "time") for k in (0, last)]
    return (np.array([ends[0][0], ends[1][-1]]), time), (output, volts)


def _netcdf(path: Path) -> tuple[Any, Any]:
    import h5py

    from ragg_runtime.flight.hdf5_self_contained import refuse_elsewhere

    refuse_elsewhere(path)
    with h5py.File(path, "r") as file:
        found = []
        for name in ("time", "G_out"):
            unit = file[name].attrs["units"]
            text = unit.decode() if isinstance(unit, bytes) else str(unit)
            rows = slice(None) if name == "G_out" else slice(None, None, max(1, len(file[name]) - 1))
            found.append((np.asarray(file[name][rows], dtype=np.float64), text.split(" since ")[0]))
    return found[0], found[1]
