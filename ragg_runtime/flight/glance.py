"""A first look at a flight: its output alone, as the file has it, before anything is examined or filled in."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.files import flight_name
from ragg_runtime.flight.record import Array
from ragg_runtime.flight.source import check_content, format_of
from ragg_runtime.instrument.units import units


@dataclass(frozen=True)
class Glance:
    """The output ``G_out`` (N,), V, NaN where nothing stands, from ``start`` s on every ``step`` s.

    Time is taken as uniform between the first stamp and the last: good enough to draw, and for nothing else.
    """

    name: str
    start: float
    step: float
    values: Array


def glance(path: Path, g0: float) -> Glance | None:
    """The output of a file whose columns can be read one by one (Parquet, NetCDF); ``None`` of any other file.

    Whatever is wrong with a file is told by :func:`~ragg_runtime.flight.files.read_flight`, not here.
    """
    try:
        check_content(path, format_of(path))
        found = _parquet(path) if format_of(path) == "parquet" else None
        if format_of(path) == "netcdf":
            found = _netcdf(path)
        if found is None:
            return None
        (time, time_unit), (output, unit) = found
        known = units(g0)
        ends = known.to_si(time[[0, -1]], time_unit, "s", str(path))
        values = output if unit == "V" else known.to_si(output, unit, "V", str(path))
    except (UserError, OSError, ValueError, KeyError, TypeError, IndexError, MemoryError):
        return None
    step = float(ends[1] - ends[0]) / max(len(time) - 1, 1)
    if not (np.isfinite(step) and step > 0.0):
        return None
    # as in a flight that has been read, time begins with the first sample
    return Glance(name=flight_name(path), start=0.0, step=step, values=np.asarray(values, dtype=np.float64))


def _parquet(path: Path) -> tuple[Any, Any]:
    import pyarrow.parquet as pq

    from ragg_runtime.flight.arrow import floats

    names = ["time", "G_out"]
    table = pq.read_table(path, columns=names, use_threads=True)
    units_of = [(table.schema.field(n).metadata or {})[b"units"].decode() for n in names]
    time, output = (floats(table.column(n).combine_chunks().cast("float64")) for n in names)
    return (time, units_of[0]), (output, units_of[1])


def _netcdf(path: Path) -> tuple[Any, Any]:
    import h5py

    with h5py.File(path, "r") as file:
        found = []
        for name in ("time", "G_out"):
            unit = file[name].attrs["units"]
            text = unit.decode() if isinstance(unit, bytes) else str(unit)
            found.append((np.asarray(file[name][:], dtype=np.float64), text.split(" since ")[0]))
    return found[0], found[1]
