"""Tables in files as other programs write them: Excel, HDF5 and MATLAB; CSV, Parquet and NetCDF as ours."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import openpyxl
from scipy.io import savemat

from ragg_runtime.io.files import write_tables
from ragg_runtime.io.tables import DataColumn, DataTable

ENDINGS = (".csv", ".csv.gz", ".parquet", ".nc", ".h5", ".mat", ".xlsx")


G0, N, RATE = 9.8, 60, 16
UNITS = {"time": "s", "a_x": "g", "a_y": "g", "a_z": "g", "omega_x": "deg/h", "omega_y": "deg/h"}
UNITS |= {"omega_z": "deg/h", "G_out": "V"}
HEADER = [f"{n} [{u}]" for n, u in UNITS.items()]


def make_lines(*lines: str) -> list[DataTable]:
    """Records of N rows: numbers of any size, one missing in each column but the time."""
    rng, tables = np.random.default_rng(0), []
    for line in lines or (None,):
        columns = [DataColumn("time", "s", np.arange(N) / RATE)]
        for name, unit in {**UNITS, "fuel": "kg"}.items():
            values = np.round(rng.normal(size=N), 9) * 10.0 ** rng.integers(-12, 12)
            values[rng.integers(0, N)] = np.nan
            columns += [DataColumn(name, unit, values)] if name != "time" else []
        tables.append(DataTable(tuple(columns), line))
    return tables


def write(path: Path, tables: Sequence[DataTable]) -> Path:
    """Write tables in the format of the name's ending."""
    if path.suffix == ".h5":
        _hdf5(path, tables)
    elif path.suffix == ".mat":
        _matlab(path, tables)
    elif path.suffix == ".xlsx":
        _excel(path, tables)
    else:
        write_tables(path, tables)
    return path


def _hdf5(path: Path, tables: Sequence[DataTable]) -> None:
    with h5py.File(path, "w", track_order=True) as file:
        for t in tables:
            group = file if t.line is None else file.create_group(t.line, track_order=True)
            for c in t.columns:
                group[c.name] = c.values
                group[c.name].attrs["units"] = c.unit


def _matlab(path: Path, tables: Sequence[DataTable]) -> None:
    whole: dict[str, Any] = {}
    for t in tables:
        inside: dict[str, Any] = {c.name: c.values for c in t.columns}
        inside["units"] = {c.name: c.unit for c in t.columns}
        whole |= inside if t.line is None else {f"line_{t.line}": inside | {"line": t.line}}
    savemat(path, whole, do_compression=True)  # as MATLAB does since version 7


def _excel(path: Path, tables: Sequence[DataTable]) -> None:
    columns = {t.line or "flight": [c.values.tolist() for c in t.columns] for t in tables}
    heads = [[f"{c.name} [{c.unit}]" for c in t.columns] for t in tables]
    sheets = zip(heads, columns.items(), strict=True)
    write_sheets(path, {name: [head, *zip(*cells, strict=True)] for head, (name, cells) in sheets})


def write_sheets(path: Path, sheets: dict[str, Iterable[Iterable[Any]]]) -> Path:
    """A workbook of sheets of rows; NaN is an empty cell."""
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, rows in sheets.items():
        sheet = book.create_sheet(name)
        for row in rows:
            cells = [float(c) if isinstance(c, np.floating) else c for c in row]
            sheet.append([None if c != c else c for c in cells])
    book.save(path)
    return path
