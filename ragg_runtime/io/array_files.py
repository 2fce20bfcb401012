"""Parquet, NetCDF, HDF5 and MATLAB: arrays with names and units, perhaps in groups or structures that are lines.

NetCDF-4 and MATLAB 7.3 are HDF5. Of HDF5 the datasets at the root and in groups are read, tables of PyTables and pandas
as well; nothing that stands in another file. What a library raises for a damaged file becomes one message.
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
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.io.tables import (
    WIDEST,
    Column,
    Table,
    decode_values,
    label,
    make_table,
    read_attributes,
    read_frame_units,
    read_heading,
    require_memory,
    write_cell,
)

if TYPE_CHECKING:
    import h5py

HDF5_MAGIC = b"\x89HDF\r\n\x1a\n"
LONGEST_TEXT = 200
"""Characters of a unit or the name of a line in a MATLAB file: what is longer is neither."""

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
    pandas = _read_json(schema.metadata, b"pandas")
    given = read_frame_units(_read_json(schema.metadata, b"PANDAS_ATTRS"))
    labels = [n for n in pandas.get("index_columns", []) if isinstance(n, str)]
    columns, other, index = [], [], None
    for field, values in zip(schema, table.columns, strict=True):
        array = _of_arrow(values)
        unnamed = field.name.startswith("__index_level_")
        if array is None:
            other.append(f"{field.name!r} ({field.type})")
            continue
        name, unit = ("index", "") if unnamed else read_heading(field.name)
        said = (field.metadata or {}).get(b"units", b"").decode("utf-8", "replace").strip()
        columns.append(Column(name, said or given.get(field.name, "") or unit, array))
        index = name if field.name in labels or unnamed else index
    notes = (f"passed over, neither numbers nor text: {', '.join(other[:6])}",) if other else ()
    return [Table(tuple(columns), index=index, notes=notes)]


def _read_json(metadata: Mapping[bytes, bytes] | None, key: bytes) -> dict[str, Any]:
    try:
        found = json.loads((metadata or {}).get(key, b"{}"))
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def _of_arrow(column: pa.ChunkedArray) -> NDArray[Any] | None:
    """Numbers, texts or instants of a column; ``None`` for anything else. Arrow's own ``to_numpy`` may load pandas."""
    kind = column.type.value_type if pa.types.is_dictionary(column.type) else column.type
    if (
        pa.types.is_floating(kind)
        or pa.types.is_integer(kind)
        or pa.types.is_boolean(kind)
        or pa.types.is_null(kind)
    ):
        whole = (
            column.cast(pa.float64() if not pa.types.is_boolean(kind) else pa.int8())
            .cast(pa.float64())
            .combine_chunks()
        )
        return np.asarray(np.from_dlpack(whole.fill_null(float("nan")) if whole.null_count else whole))
    if pa.types.is_decimal(kind):
        return _of_arrow(column.cast(pa.float64()))
    if pa.types.is_timestamp(kind) or pa.types.is_date(kind):
        return np.asarray(column.cast(pa.timestamp("ns")).to_numpy(), dtype="datetime64[ns]")
    if pa.types.is_duration(kind):
        return np.asarray(column.cast(pa.duration("ns")).to_numpy(), dtype="timedelta64[ns]")
    if pa.types.is_string(kind) or pa.types.is_large_string(kind) or pa.types.is_time(kind):
        return np.array([write_cell(t) for t in column.to_pylist()], dtype=object)
    return None


# --- HDF5 and NetCDF -----------------------------------------------------------------------------------


def read_hdf5(path: Path) -> list[Table]:
    """The groups of an HDF5 or NetCDF-4 file that hold tables."""
    with _opened(path) as file:
        return [t for group in _groups(file) for t in _tables_of_group(path, *group, {}, {})]


def read_classic_netcdf(path: Path) -> list[Table]:
    """The variables of a file of NetCDF 3."""
    from scipy.io import netcdf_file  # slow to import, and only this format needs it

    with _whole(path, "NetCDF"), netcdf_file(path, mmap=False) as file:
        arrays = []
        for name, v in file.variables.items():
            attributes = {
                n: write_cell(x) if isinstance(x, bytes) else x for n, x in vars(v)["_attributes"].items()
            }
            arrays.append((name, label(np.array(v.data), attributes)))
        return [make_table(arrays)]


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
    attributes = read_attributes(data)
    if (
        _DIMENSION in write_cell(attributes.get("NAME"))
        or write_cell(attributes.get("MATLAB_class")) == "char"
    ):
        return False  # MATLAB keeps texts as numbers
    if data.dtype.names is None and (
        len(data.shape) > 2 or (len(data.shape) == 2 and min(data.shape) > WIDEST)
    ):
        return False
    return data.dtype.kind in "fiubSOV"


def _tables_of_group(
    path: Path,
    place: str,
    group: h5py.Group,
    arrays: Mapping[str, h5py.Dataset],
    given: Mapping[str, str],
    names: Mapping[str, str],
) -> Iterator[Table]:
    """The datasets of a group as a table, and every table of records (PyTables) in it; the group may be a line."""
    records = {n: d for n, d in arrays.items() if d.dtype.names is not None}
    plain = {n: d for n, d in arrays.items() if n not in records}
    require_memory(
        path, 8.0 * sum(math.prod(d.shape) * max(1, len(d.dtype.names or ())) for d in arrays.values())
    )
    line = (
        write_cell(read_attributes(group).get("line"))
        or matlab_text(group.get("line"))
        or place.rsplit("/", 1)[-1]
    )
    if "block0_values" in plain and "block0_items" in plain:  # DataFrame.to_hdf(format="fixed")
        yield make_table(_blocks(plain), given, index="index", line=line, part=place)
    elif plain:
        read = [(n, label(d[()], read_attributes(d))) for n, d in plain.items()]
        yield make_table(read, given, names=names, line=line, part=place)
    for name, data in records.items():
        yield make_table(_fields(data), given, index="index", line=line, part=f"{place}/{name}")


def _fields(data: h5py.Dataset) -> list[tuple[str, Any]]:
    """The fields of records as arrays with their units; those of pandas are taken apart by its own list of names."""
    attributes = read_attributes(data)
    whole = data[()]
    listed = np.atleast_1d(np.asarray(attributes.get("units", attributes.get("unit", "")))).ravel()
    found: list[tuple[str, Any]] = []
    for k, name in enumerate(whole.dtype.names):
        unit = write_cell(listed[k]) if len(listed) == len(whole.dtype.names) else ""
        keys = [f"{n}{e}" for n in (name, f"FIELD_{k}") for e in _UNIT_ENDINGS]
        unit = unit or next((write_cell(attributes[n]) for n in keys if n in attributes), "")
        values = whole[name]
        columns = _pickled_names(attributes.get(f"{name}_kind"))
        if name == "index":
            values = _of_index(values, write_cell(attributes.get("index_kind")))
        if values.ndim == 2 and values.shape[1] == len(columns):
            found += [(n, values[:, i]) for i, n in enumerate(columns)]
        else:
            found.append(
                (
                    columns[0] if len(columns) == 1 and values.ndim == 1 else name,
                    label(values, {"units": unit}),
                )
            )
    return found


def _pickled_names(value: object) -> list[str]:
    """The texts in a list that PyTables has pickled; nothing is executed."""
    data = (
        value.tobytes()
        if isinstance(value, np.void)
        else bytes(value)
        if isinstance(value, np.bytes_ | bytes)
        else b""
    )
    try:
        return [a for o, a, _ in pickletools.genops(data) if "UNICODE" in o.name and isinstance(a, str)]
    except (ValueError, IndexError, UnicodeDecodeError):
        return []


def _of_index(values: NDArray[Any], kind: str) -> NDArray[Any]:
    """The index of a DataFrame in a file of PyTables, which keeps instants as whole numbers."""
    for start, code in (("datetime64", "M8"), ("timedelta64", "m8")):
        if kind.startswith(start) and values.dtype.kind in "iu":
            step = kind[len(start) + 1 : -1] if kind.endswith("]") else "ns"
            return values.astype(np.int64).view(f"{code}[{step}]")
    return values


def _blocks(arrays: Mapping[str, h5py.Dataset]) -> list[tuple[str, Any]]:
    """The columns of a DataFrame that pandas has written by blocks of one type."""
    index = arrays["axis1"]
    attributes = read_attributes(index)
    found: list[tuple[str, Any]] = [("index", _of_index(index[()], write_cell(attributes.get("kind"))))]
    for k in range(len(arrays)):
        if f"block{k}_values" in arrays and f"block{k}_items" in arrays:
            values, items = arrays[f"block{k}_values"][()], arrays[f"block{k}_items"][()]
            found += [(write_cell(n), values[:, i]) for i, n in enumerate(items)]
    return found


# --- MATLAB --------------------------------------------------------------------------------------------


def read_matlab(path: Path) -> list[Table]:
    """The vectors of a MATLAB file, and its structures of vectors; units in a structure ``units``, names in ``names``."""
    with path.open("rb") as stream:
        head = stream.read(10)
    if not head.startswith((b"MATLAB 7.3", HDF5_MAGIC)):
        return list(_structures(_load(path)))
    import h5py

    tables: list[Table] = []
    with _opened(path) as file:
        for place, group, arrays in _groups(file):
            if place.rsplit("/", 1)[-1] in ("units", "names"):
                continue
            given, names = (
                {n: matlab_text(x) for n, x in inside.items()} if isinstance(inside, h5py.Group) else {}
                for inside in (group.get("units"), group.get("names"))
            )
            tables += _tables_of_group(path, place, group, arrays, given, names)
    return tables


def matlab_text(item: object) -> str:
    """The text that MATLAB keeps in a dataset, as numbers; ``""`` where there is none, or no short one."""
    import h5py

    if not isinstance(item, h5py.Dataset) or item.dtype.kind != "u" or not 0 < item.size <= LONGEST_TEXT:
        return ""
    return "".join(
        chr(int(c)) for c in np.asarray(item[()]).ravel(order="F") if 0 < int(c) < 0x110000
    ).strip()


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
        arrays = []
        for name, value in inside.items():
            if name in ("units", "names"):
                continue
            boxed = isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype == object)
            parts = [value] if isinstance(value, Mapping) else list(value) if boxed else []
            if parts and all(isinstance(p, Mapping) for p in parts):
                for k, part in enumerate(parts, 1):
                    own = str(part.get("line", "")) if isinstance(part.get("line"), str | int | float) else ""
                    title = own or (name if len(parts) == 1 else f"{name}_{k}")
                    waiting.append((f"{place}/{title}" if place else title, part))
            elif isinstance(value, np.ndarray | list):
                arrays.append((name, np.asarray(value, dtype=object if isinstance(value, list) else None)))
        given, names = (
            {n: t.strip() for n, t in inside.get(key, {}).items() if isinstance(t, str)}
            if isinstance(inside.get(key), Mapping)
            else {}
            for key in ("units", "names")
        )
        arrays = [(n, x) for n, x in arrays if x.ndim and decode_values(x.ravel()[:4], {}) is not None]
        if arrays:
            yield make_table(arrays, given, names=names, line=place, part=place)


def write_parquet(path: Path, columns: Sequence[Column]) -> None:
    """Write columns as float64 with their units; NaN becomes null."""
    arrays = [pa.array(c.values, from_pandas=True) for c in columns]
    units = [{"units": c.unit} if c.unit else None for c in columns]
    fields = [pa.field(c.name, x.type, metadata=u) for c, x, u in zip(columns, arrays, units, strict=True)]
    with path.open("wb") as stream:
        pq.write_table(pa.Table.from_arrays(arrays, schema=pa.schema(fields)), stream)
