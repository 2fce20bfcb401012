"""Tables in files as other programs write them: Excel, HDF5 and MATLAB; CSV, Parquet and NetCDF as ours."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import h5py
import openpyxl
from scipy.io import savemat

from ragg_runtime.io.files import write_tables
from ragg_runtime.io.tables import DataTable

ENDINGS = (".csv", ".csv.gz", ".parquet", ".nc", ".h5", ".mat", ".xlsx")


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
    book = openpyxl.Workbook()
    book.remove(book.active)
    for t in tables:
        sheet = book.create_sheet(t.line or "flight")
        sheet.append([f"{c.name} [{c.unit}]" for c in t.columns])
        for row in zip(*(c.values.tolist() for c in t.columns), strict=True):
            sheet.append([None if x != x else x for x in row])
    book.save(path)
