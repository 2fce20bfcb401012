"""NetCDF-4 (HDF5) flights: one-dimensional variables along time, the unit in the attribute ``units``."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import require_room
from ragg_runtime.flight import hdf5_file
from ragg_runtime.flight.one_table import joined
from ragg_runtime.flight.source import Heading, Look, RawBatch, Table, Written, distinct, heading

NAME = "netcdf"
ENDINGS = (".nc", ".nc4")
MAGIC = hdf5_file.MAGIC

_BATCH = 1 << 18


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The NetCDF file; UserError if its variables do not share one dimension. Groups are lines, as in HDF5."""
    headings, names = [], []
    with _dataset(path) as data:
        if not data.variables or look.part is not None:
            return hdf5_file.open_tables(path, look)
        if "time" not in data.variables and look.only is None and not look.text:
            raise UserError(
                "the column 'time' is missing", where=path, found=", ".join(map(str, data.variables))
            )
        dimensions = data.variables["time" if "time" in data.variables else next(iter(data.variables))].dims
        for number, name in enumerate(_in_the_files_order(path, data), 1):
            if not look.wants(str(name)):
                continue
            variable = data.variables[name]
            _check(path, str(name), variable, dimensions)
            unit = variable.attrs.get("units")
            if name == "time" and isinstance(unit, str):
                unit = unit.split(" since ")[0]  # CF writes the origin there; any origin will do
            found = heading(str(name), path, number)
            headings.append(Heading(found.name, str(unit).strip() if unit is not None else found.unit))
            names.append(name)
        length = data.sizes[dimensions[0]]
        lines = _lines(data)
    distinct(path, headings)
    headings = [Heading("line", text=True) if h.name == "line" and lines else h for h in headings]
    return (
        Table(
            path, tuple(headings), lambda: _batches(path, names, headings, str(dimensions[0]), length, lines)
        ),
    )


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write columns as float64 variables along ``time`` with their units.

    Lines whose names are no numbers are numbered, with the names in ``flag_meanings`` (CF conventions, 3.5).
    """
    import xarray  # slow to import, and only this format needs it

    columns, rows = joined(tables)
    whole = list(rows(max((len(t.columns[0][1]) for t in tables if t.columns), default=1)))
    variables = {}
    for c in columns:
        values = np.concatenate([np.empty(0, whole[0][c.name].dtype), *(r[c.name] for r in whole)])
        attributes: dict[str, Any] = {"units": c.unit} if c.unit else {}
        if values.dtype == object:
            names = list(dict.fromkeys(values))
            values = np.array([names.index(v) for v in values], dtype=np.int32)
            attributes = {
                "flag_values": np.arange(len(names), dtype=np.int32),
                "flag_meanings": " ".join("_".join(n.split()) for n in names),
            }
        variables[c.name] = ("time", values, attributes)
    require_room(path, hdf5_file.room_for(tables))
    xarray.Dataset(variables).to_netcdf(path, engine="h5netcdf")


def _check(path: Path, name: str, variable: Any, dimensions: Any) -> None:
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


def _in_the_files_order(path: Path, data: Any) -> list[Any]:
    """Names of the variables as they stand in the file; xarray puts the one of the dimension last."""
    import h5netcdf  # slow to import, and only this format needs it

    with h5netcdf.File(path, "r") as file:
        places = {str(name): k for k, name in enumerate(file.variables)}
    return sorted(data.variables, key=lambda name: places.get(str(name), len(places)))


def _lines(data: Any) -> list[str]:
    """Names of the lines that a variable ``line`` counts; none if it holds numbers of their own."""
    if "line" not in data.variables:
        return []
    return str(data.variables["line"].attrs.get("flag_meanings", "")).split()


def _dataset(path: Path) -> Any:
    import xarray  # slow to import, and only this format needs it

    from ragg_runtime.flight.hdf5_self_contained import refuse_elsewhere

    # What h5netcdf leaves of a file that it failed to open complains on stderr when it is finalised.
    hook, sys.unraisablehook = sys.unraisablehook, lambda _: None
    try:
        try:
            refuse_elsewhere(path)
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


def _damaged(path: Path, fault: str) -> UserError:
    return UserError(
        "the NetCDF file is damaged or not NetCDF-4",
        where=path,
        found=fault,
        expected="a whole NetCDF-4 (HDF5) file",
        remedy="copy it again, or save it as NetCDF-4",
    )


def _batches(
    path: Path, names: list[Any], headings: Sequence[Heading], dimension: str, length: int, lines: list[str]
) -> Iterator[RawBatch]:
    with _dataset(path) as data:
        for start in range(0, length, _BATCH):
            part = data.isel({dimension: slice(start, start + _BATCH)})
            try:
                batch: dict[str, Any] = {
                    h.name: np.asarray(part.variables[n].values, dtype=np.float64)
                    for n, h in zip(names, headings, strict=True)
                }
            except (OSError, RuntimeError, ValueError) as error:
                raise _damaged(path, str(error)[:200]) from None
            if lines and "line" in batch:
                batch["line"] = np.array([_named(lines, k) for k in batch["line"]], dtype=object)
            yield batch


def _named(lines: list[str], k: float) -> str:
    return lines[int(k)] if np.isfinite(k) and 0 <= k < len(lines) else repr(float(k))
