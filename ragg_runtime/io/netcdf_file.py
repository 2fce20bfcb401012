"""NetCDF-4 flights: read as HDF5, which it is; variables along ``time`` are written, with the attribute ``units``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.files import require_room
from ragg_runtime.io import hdf5_file
from ragg_runtime.io.one_table import joined
from ragg_runtime.io.source import Written

NAME = "netcdf"
ENDINGS = (".nc", ".nc4")
MAGIC = hdf5_file.MAGIC

COLUMN, TABLE = 8192, 1 << 16
"""Bytes that a column takes beside its numbers, and a table beside its columns, with room to spare."""

open_tables = hdf5_file.open_tables


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write columns as float64 variables along ``time``; names of lines that are no numbers in ``flag_meanings`` (CF, 3.5)."""
    import xarray  # slow to import, and only this format needs it

    columns, rows = joined(tables)
    variables = {}
    for c in columns:
        values = rows[c.name]
        attributes: dict[str, Any] = {"units": c.unit} if c.unit else {}
        if values.dtype == object:
            names = list(dict.fromkeys(values))
            values = np.array([names.index(v) for v in values], dtype=np.int32)
            attributes = {
                "flag_values": np.arange(len(names), dtype=np.int32),
                "flag_meanings": " ".join("_".join(n.split()) for n in names),
            }
        variables[c.name] = ("time", values, attributes)
    require_room(path, room([v.size for _, v, _ in variables.values()]))
    xarray.Dataset(variables).to_netcdf(path, engine="h5netcdf")


def room(sizes: Sequence[int]) -> int:
    """Bytes that columns of so many numbers take at most."""
    return TABLE + sum(8 * n + COLUMN for n in sizes)
