"""NetCDF-4 (HDF5) flights: one-dimensional variables along time, the unit in the attribute ``units``."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.record import Array
from ragg_runtime.flight.source import Batch, Column, Source, columns_of

_BATCH = 1 << 18


def open_netcdf(path: Path) -> Source:
    """The NetCDF file as a source; UserError if its variables do not share one dimension or have no units."""
    headers = []
    with _dataset(path) as data:
        if "time" not in data.variables:
            raise UserError(
                "the column 'time' is missing",
                where=path,
                found=", ".join(map(str, data.variables)) or "nothing",
            )
        dimensions = data.variables["time"].dims
        for name, variable in data.variables.items():
            place = f"{path}: variable {name!r}"
            if variable.dims != dimensions or len(dimensions) != 1:
                raise UserError(
                    "the variable does not run along time alone",
                    where=place,
                    found=variable.dims,
                    expected=dimensions if len(dimensions) == 1 else "one dimension",
                )
            if variable.dtype.kind not in "fiu":
                raise UserError("the variable does not hold numbers", where=place, found=variable.dtype)
            unit = variable.attrs.get("units")
            if name == "time" and isinstance(unit, str):
                unit = unit.split(" since ")[0]  # CF writes the origin there; any origin will do
            headers.append((str(name), None if unit is None else str(unit)))
        length, names = data.sizes[dimensions[0]], list(data.variables)
    columns = columns_of(path, headers)
    return Source(path, columns, lambda: _batches(path, names, columns, str(dimensions[0]), length))


def write_netcdf(path: Path, columns: list[tuple[Column, Array]]) -> None:
    """Write columns as float64 variables along ``time`` with their units."""
    import xarray  # slow to import, and only this format needs it

    variables = {c.name: ("time", v, {"units": c.unit}) for c, v in columns}
    xarray.Dataset(variables).to_netcdf(path, engine="h5netcdf")


def _dataset(path: Path) -> Any:
    import xarray  # slow to import, and only this format needs it

    from ragg_runtime.flight.hdf5_self_contained import leads_elsewhere

    # What h5netcdf leaves of a file that it failed to open complains on stderr when it is finalised.
    hook, sys.unraisablehook = sys.unraisablehook, lambda _: None
    try:
        try:
            elsewhere = leads_elsewhere(path)
            if elsewhere is not None:
                raise _not_whole(path, elsewhere)
            # CF decoding would turn a time "in seconds" into durations.
            return xarray.open_dataset(path, engine="h5netcdf", decode_times=False)
        except UserError:
            raise
        except Exception as error:  # h5py, h5netcdf and xarray each raise their own
            fault = str(error).split("\n", 1)[0][:200]
        gc.collect()
    finally:
        sys.unraisablehook = hook
    raise _damaged(path, fault)


def _not_whole(path: Path, found: str) -> UserError:
    return UserError(
        "the file does not hold its numbers itself",
        where=path,
        found=found,
        expected="a file whose numbers all stand in it",
        remedy="copy the data into one file, with nccopy or h5repack for example",
    )


def _damaged(path: Path, fault: str) -> UserError:
    return UserError(
        "the NetCDF file is damaged or not NetCDF-4",
        where=path,
        found=fault,
        expected="a whole NetCDF-4 (HDF5) file",
        remedy="copy it again, or save it as NetCDF-4",
    )


def _batches(
    path: Path, names: list[Any], columns: tuple[Column, ...], dimension: str, length: int
) -> Iterator[Batch]:
    with _dataset(path) as data:
        for start in range(0, length, _BATCH):
            part = data.isel({dimension: slice(start, start + _BATCH)})
            try:
                batch = {
                    c.name: np.asarray(part.variables[n].values, dtype=np.float64)
                    for n, c in zip(names, columns, strict=True)
                }
            except (OSError, RuntimeError, ValueError) as error:
                raise _damaged(path, str(error)[:200]) from None
            yield batch
