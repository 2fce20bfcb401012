"""Parquet, NetCDF, HDF5 and MATLAB: arrays with names and units, perhaps in groups or structures that are lines.

NetCDF-4 and MATLAB 7.3 are HDF5. Of HDF5 the datasets at the root and in groups are read, tables of PyTables as well;
nothing that stands in another file. What a library raises for a damaged file becomes one message.
"""

from __future__ import annotations

import contextlib
import json
import math
import pickletools
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from ragg_runtime.base.errors import UserError
from ragg_runtime.io.tables import (
    INDEX,
    WIDEST,
    Column,
    Table,
    decode_values,
    label,
    make_table,
    of_arrow,
    read_attributes,
    read_frame_units,
    read_heading,
    require_memory,
    write_cell,
)

if TYPE_CHECKING:
    import h5py

HDF5_MAGIC = b"\x89HDF\r\n\x1a\n"

_DIMENSION = "This is a netCDF dimension but not a netCDF variable"
_UNIT_ENDINGS = ("_units", "_unit", "_UNITS", "_UNIT")


@contextlib.contextmanager
def _whole(path: Path, kind: str) -> Iterator[None]:
    """Say of whatever a library raises that the file is damaged."""
    try:
        yield
    except UserError:
        raise
    except Exception as error:  # what they raise for damaged files is not documented
        raise UserError(
            f"the {kind} file is damaged",
            where=path,
            found=(str(error) or type(error).__name__).splitlines()[0][:200],
            expected=f"a whole {kind} file",
            remedy="copy it again",
        ) from None


# --- Parquet -------------------------------------------------------------------------------------------


def read_parquet(path: Path) -> list[Table]:
    """The Parquet file as one table: the unit in a field's metadata ``units`` or in what pandas keeps in ``attrs``."""
    with _whole(path, "Parquet"), path.open("rb") as stream, pq.ParquetFile(stream) as file:
        schema = file.schema_arrow
        require_memory(path, 8.0 * file.metadata.num_rows * len(schema))
        table = file.read()
    about = schema.metadata or {}
    given = read_frame_units(_read_json(about.get(b"PANDAS_ATTRS", b"{}")))
    labels = _read_json(about.get(b"pandas", b"{}")).get("index_columns", [])
    arrays, index = [], None
    for field, values in zip(schema, table.columns, strict=True):
        unnamed = field.name.startswith("__index_level_")
        name = INDEX if unnamed else field.name
        index = read_heading(name)[0] if unnamed or field.name in labels else index
        found = of_arrow(values)
        said = (field.metadata or {}).get(b"units", b"").decode("utf-8", "replace")
        arrays.append((name, label(np.zeros(len(values), "V1") if found is None else found, {"units": said})))
    return [make_table(arrays, given, index=index)]


def _read_json(text: bytes) -> dict[str, Any]:
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


# --- HDF5 and NetCDF -----------------------------------------------------------------------------------


def read_hdf5(path: Path) -> list[Table]:
    """The groups of an HDF5 or NetCDF-4 file that hold tables."""
    with _opened(path) as file:
        return [t for group in _groups(file) for t in _tables_of_group(path, *group, {})]


def read_classic_netcdf(path: Path) -> list[Table]:
    """The variables of a file of NetCDF 3."""
    from scipy.io import netcdf_file  # slow to import, and only this format needs it

    with _whole(path, "NetCDF"), netcdf_file(path, mmap=False) as file:
        found = {n: (np.array(v.data), vars(v)["_attributes"]) for n, v in file.variables.items()}
        return [make_table([(n, label(x, a)) for n, (x, a) in found.items()])]


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[h5py.File]:
    """The file for reading; UserError if it is damaged, here or later."""
    import h5py  # slow to import, and only files built on HDF5 need it

    with _whole(path, "HDF5"), h5py.File(path, "r") as file:
        yield file


def _groups(file: h5py.File) -> Iterator[tuple[str, h5py.Group, dict[str, h5py.Dataset]]]:
    """Every group once, with its datasets; groups may stand in each other, round in a circle."""
    import h5py

    waiting: list[tuple[str, h5py.Group]] = [("", file)]
    seen = set()
    while waiting:
        place, group = waiting.pop(0)
        address = h5py.h5o.get_info(group.id).addr
        if address in seen:
            continue
        seen.add(address)
        arrays: dict[str, h5py.Dataset] = {}
        for name in group:
            # not what MATLAB keeps for itself, nor what stands elsewhere in this file or in another
            if name.startswith("#") or not isinstance(group.get(name, getlink=True), h5py.HardLink):
                continue
            item = group[name]
            if isinstance(item, h5py.Group):
                waiting.append((f"{place}/{name}", item))
            elif isinstance(item, h5py.Dataset) and _is_column(item):
                arrays[name] = item
        yield place, group, arrays


def _is_column(data: h5py.Dataset) -> bool:
    """Whether a dataset holds numbers, texts or records of them, not those of another file."""
    import h5py

    if data.shape is None or data.is_virtual or data.external:
        return False
    if data.dtype.kind == "O" and h5py.check_string_dtype(data.dtype) is None:
        return False  # references and sequences
    if (
        _DIMENSION in write_cell(data.attrs.get("NAME"))
        or write_cell(data.attrs.get("MATLAB_class")) == "char"
    ):
        return False  # MATLAB keeps texts as numbers
    wide = len(data.shape) > 2 or (len(data.shape) == 2 and min(data.shape) > WIDEST)
    return data.dtype.kind in "fiubSOV" and not (wide and data.dtype.names is None)


def _tables_of_group(
    path: Path, place: str, group: h5py.Group, arrays: Mapping[str, h5py.Dataset], given: Mapping[str, str]
) -> Iterator[Table]:
    """The datasets of a group as a table, and every table of records (PyTables) in it; the group may be a line."""
    records = {n: d for n, d in arrays.items() if d.dtype.names is not None}
    plain = {n: d for n, d in arrays.items() if n not in records}
    size = sum(math.prod(d.shape) * max(1, len(d.dtype.names or ())) for d in arrays.values())
    require_memory(path, 8.0 * size)
    own = write_cell(read_attributes(group).get("line")) or matlab_text(group.get("line"))
    line = own or place.rsplit("/", 1)[-1]
    if plain:
        read = [(n, label(d[()], read_attributes(d))) for n, d in plain.items()]
        yield make_table(read, given, line=line, part=place)
    for name, data in records.items():
        yield make_table(_fields(data), index=INDEX, line=line, part=f"{place}/{name}")


def _fields(data: h5py.Dataset) -> list[tuple[str, Any]]:
    """The fields of records as arrays with their units; those of pandas are taken apart by its own list of names."""
    attributes = read_attributes(data)
    whole = data[()]
    listed = np.atleast_1d(np.asarray(attributes.get("units", attributes.get("unit", "")))).ravel()
    found: list[tuple[str, Any]] = []
    for k, name in enumerate(whole.dtype.names):
        keys = [f"{n}{e}" for n in (name, f"FIELD_{k}") for e in _UNIT_ENDINGS]
        unit = next((write_cell(attributes[n]) for n in keys if n in attributes), "")
        unit = write_cell(listed[k]) if len(listed) == len(whole.dtype.names) else unit
        values = whole[name]
        kind = write_cell(attributes.get(f"{name}_kind"))
        if name == INDEX and kind.startswith(
            ("datetime64", "timedelta64")
        ):  # whole numbers, of nanoseconds if not said
            step = kind[kind.index("[") + 1 : -1] if kind.endswith("]") else "ns"
            values = values.astype(np.int64).view(f"{'M8' if kind[0] == 'd' else 'm8'}[{step}]")
        columns = _pickled_names(attributes.get(f"{name}_kind")) if name != INDEX else []
        parts = values.T if values.ndim == 2 and values.shape[1] == len(columns) else [values]
        titles = columns if len(columns) == len(parts) else [name]
        found += [(n, label(x, {"units": unit})) for n, x in zip(titles, parts, strict=False)]
    return found


def _pickled_names(value: object) -> list[str]:
    """The texts in a list that PyTables has pickled; nothing is executed."""
    data = (
        value.tobytes() if isinstance(value, np.void) else bytes(value) if isinstance(value, bytes) else b""
    )
    try:
        return [a for o, a, _ in pickletools.genops(data) if "UNICODE" in o.name and isinstance(a, str)]
    except (ValueError, IndexError, UnicodeDecodeError):
        return []


# --- MATLAB --------------------------------------------------------------------------------------------


def read_matlab(path: Path) -> list[Table]:
    """The vectors of a MATLAB file, and its structures of vectors; units in a structure ``units``."""
    with path.open("rb") as stream:
        head = stream.read(10)
    if not head.startswith((b"MATLAB 7.3", HDF5_MAGIC)):
        return list(_structures(_load(path)))
    tables: list[Table] = []
    with _opened(path) as file:
        for place, group, arrays in _groups(file):
            units = group.get("units")
            given = {n: matlab_text(x) for n, x in units.items()} if hasattr(units, "items") else {}
            if place.rsplit("/", 1)[-1] != "units":
                tables += _tables_of_group(path, place, group, arrays, given)
    return tables


def matlab_text(item: object) -> str:
    """The text that MATLAB keeps in a dataset, as numbers; ``""`` where there is none, or no short one."""
    if getattr(getattr(item, "dtype", None), "kind", "") != "u" or not 0 < item.size <= 200:  # type: ignore[attr-defined]
        return ""
    codes = np.asarray(item[()]).ravel(order="F")  # type: ignore[index]
    return "".join(chr(int(c)) for c in codes if 0 < int(c) < 0x110000).strip()


def _load(path: Path) -> dict[str, Any]:
    """The variables of a file of version 4 to 7."""
    from scipy.io import loadmat, whosmat  # slow to import, and only this format needs it

    with _whole(path, "MATLAB"):
        require_memory(path, 8.0 * sum(math.prod(shape) for _, shape, _ in whosmat(path)))
        found = loadmat(path, mat_dtype=False, simplify_cells=True)
    return {n: v for n, v in found.items() if not n.startswith("__")}


def _structures(variables: Mapping[str, Any]) -> Iterator[Table]:
    """Every structure of vectors as a table; where it stands is the name of its line."""
    waiting: list[tuple[str, Mapping[str, Any]]] = [("", variables)]
    while waiting:
        place, inside = waiting.pop(0)
        units = inside.get("units")
        known = units.items() if isinstance(units, Mapping) else ()
        given = {n: t.strip() for n, t in known if isinstance(t, str)}
        arrays = []
        for name, value in ((n, v) for n, v in inside.items() if n != "units"):
            boxed = isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype == object)
            parts = [value] if isinstance(value, Mapping) else list(value) if boxed else []
            if parts and all(isinstance(p, Mapping) for p in parts):
                for k, part in enumerate(parts, 1):
                    own = str(part["line"]) if isinstance(part.get("line"), str | int | float) else ""
                    title = own or (name if len(parts) == 1 else f"{name}_{k}")
                    waiting.append((f"{place}/{title}" if place else title, part))
            elif isinstance(value, np.ndarray | list):
                x = np.asarray(value, dtype=object if isinstance(value, list) else None)
                if x.ndim and decode_values(x.ravel()[:4], {}) is not None:
                    arrays.append((name, x))
        if arrays:
            yield make_table(arrays, given, line=place, part=place)


def write_parquet(path: Path, columns: Sequence[Column]) -> None:
    """Write columns as float64 with their units; NaN becomes null."""
    arrays = [pa.array(c.values, from_pandas=True) for c in columns]
    units = [{"units": c.unit} if c.unit else None for c in columns]
    fields = [pa.field(c.name, x.type, metadata=u) for c, x, u in zip(columns, arrays, units, strict=True)]
    with path.open("wb") as stream:
        pq.write_table(pa.Table.from_arrays(arrays, schema=pa.schema(fields)), stream)
