"""Parquet, NetCDF, HDF5 and MATLAB: arrays with names and units, perhaps in groups or structures that are lines.

NetCDF-4 and MATLAB 7.3 are HDF5. Of HDF5 the datasets at the root and in groups are read, tables of PyTables as well;
nothing that is in another file. What a library raises for a damaged file becomes one message.
"""

from __future__ import annotations

import contextlib
import itertools
import json
import math
import pickletools
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, missing_package
from ragg_runtime.io.arrays import WIDEST, Attributes, make_table, make_tables, read_array, read_frame_units
from ragg_runtime.io.cells import read_heading, write_cell
from ragg_runtime.io.record import SI_UNITS
from ragg_runtime.io.tables import INDEX, DataColumn, DataTable, require_memory

if TYPE_CHECKING:
    import h5py

HDF5_MAGIC = b"\x89HDF\r\n\x1a\n"

_DIMENSION = "This is a netCDF dimension but not a netCDF variable"


@contextlib.contextmanager
def report_damage(path: Path, kind: str) -> Iterator[None]:
    """Report whatever a library raises as a damaged file."""
    try:
        yield
    except (UserError, MemoryError):
        raise
    except Exception as error:  # what they raise for damaged files is not documented
        if (lacking := missing_package(error)) is not None:
            raise lacking from None
        raise UserError(
            f"the {kind} file is damaged",
            where=path,
            found=(str(error) or type(error).__name__).splitlines()[0][:200],
            expected=f"a whole {kind} file",
            remedy="copy it again, or save it once more, compressed by nothing but gzip",
        ) from None


# --- Parquet -------------------------------------------------------------------------------------------


def read_parquet(path: Path) -> list[DataTable]:
    """The Parquet file as one table: the unit in a field's metadata ``units`` or in what pandas keeps in ``attrs``."""
    with report_damage(path, "Parquet"), path.open("rb") as stream, pq.ParquetFile(stream) as file:
        schema = file.schema_arrow
        require_memory(path, 8.0 * file.metadata.num_rows * len(schema))
        table = file.read()
    while any(map(pa.types.is_struct, table.schema.types)):  # the component x of a vector a is a column a.x
        table = table.flatten()
    about = schema.metadata or {}
    given = read_frame_units(_read_json(about.get(b"PANDAS_ATTRS", b"{}")))
    labels = _read_json(about.get(b"pandas", b"{}")).get("index_columns", [])
    arrays, index = [], None
    for field, values in zip(table.schema, table.columns, strict=True):
        unnamed, joined = field.name.startswith("__index_level_"), field.name.replace(".", "_")
        name = INDEX if unnamed else joined if joined in SI_UNITS else field.name
        index = read_heading(name)[0] if unnamed or field.name in labels else index
        said = (field.metadata or {}).get(b"units", b"").decode("utf-8", "replace")
        said = "1" if not said and pa.types.is_boolean(field.type) else said
        arrays.append((name, convert_arrow(values), {"units": said}))
    return [make_table(arrays, given, index=index)]


def _read_json(text: bytes) -> dict[str, Any]:
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def convert_arrow(column: pa.ChunkedArray) -> NDArray[Any]:
    """A column of Arrow as an array. Its own ``to_numpy`` would load pandas for numbers."""
    kind = column.type.value_type if pa.types.is_dictionary(column.type) else column.type
    if pa.types.is_string(kind) or pa.types.is_large_string(kind) or pa.types.is_binary(kind):
        return np.array(column.to_pylist(), dtype=object)
    if pa.types.is_nested(kind) or pa.types.is_time(kind):
        return read_array(column.to_pylist())
    if pa.types.is_temporal(kind):
        return np.asarray(column.to_numpy())
    column = column.cast(pa.int8()) if pa.types.is_boolean(kind) else column
    whole = column.cast(pa.float64()).combine_chunks()
    return np.asarray(np.from_dlpack(whole.fill_null(float("nan")) if whole.null_count else whole))


def write_parquet(path: Path, columns: Sequence[DataColumn]) -> None:
    """Write columns as float64 with their units; NaN becomes null."""
    arrays = [pa.array(c.values, from_pandas=True) for c in columns]
    units = [{"units": c.unit} if c.unit else None for c in columns]
    fields = [pa.field(c.name, x.type, metadata=u) for c, x, u in zip(columns, arrays, units, strict=True)]
    with path.open("wb") as stream:
        pq.write_table(pa.Table.from_arrays(arrays, schema=pa.schema(fields)), stream)


# --- HDF5 and NetCDF -----------------------------------------------------------------------------------


def read_netcdf(path: Path) -> list[DataTable]:
    """The tables of a NetCDF file, version 3 or 4."""
    with path.open("rb") as stream:
        classic = stream.read(3) == b"CDF"
    if not classic:
        return read_hdf5(path)
    from scipy.io import netcdf_file  # slow to import, and only this format needs it

    with report_damage(path, "NetCDF"), netcdf_file(path, mmap=False) as file:
        return make_tables({n: (np.array(v.data), vars(v)["_attributes"]) for n, v in file.variables.items()})


def read_hdf5(path: Path) -> list[DataTable]:
    """The groups of an HDF5, NetCDF-4 or MATLAB 7.3 file that hold tables."""
    import h5py  # slow to import, and only files built on HDF5 need it

    sizes = [0]

    def measure(_: str, item: h5py.HLObject) -> None:
        if isinstance(item, h5py.Dataset) and _is_column(item):
            sizes.append(8 * math.prod(item.shape) * max(1, len(item.dtype.names or ())))

    with report_damage(path, "HDF5"), h5py.File(path, "r") as file:
        file.visititems(measure)
        require_memory(path, sum(sizes))
        return make_tables(_read_group(file, {file}))


def _read_group(group: h5py.Group, known: set[h5py.HLObject]) -> dict[str, Any]:
    """What a group holds, everything once: not MATLAB's and PyTables' own, nor links to elsewhere in this file or to another."""
    import h5py

    line = write_cell(read_attributes(group).get("line"))
    tree: dict[str, Any] = {"line": line} if line else {}
    own = [n for n in group if isinstance(group.get(n, getlink=True), h5py.HardLink)]
    items = {n: x for n in own if not n.startswith(("#", "_i_")) and (x := group[n]) not in known}
    known.update(items.values())
    columns = {n: x for n, x in items.items() if isinstance(x, h5py.Dataset) and _is_column(x)}
    if {"axis1", "block0_items"} <= columns.keys():
        return tree | _read_blocks(columns)
    for name, item in items.items():
        if isinstance(item, h5py.Group):
            tree[name] = _read_group(item, known)
        elif isinstance(item, h5py.Dataset) and (text := _read_matlab_text(item)):
            tree[name] = text
        elif name in columns and item.dtype.names is None:
            tree[name] = (item[()], read_attributes(item))
        elif name in columns:
            title = group.name.rpartition("/")[2] if name == "table" else name  # pandas calls all of them so
            about = _read_pickled_names(group.attrs.get("info"))
            index = next((b for a, b in itertools.pairwise(about) if a == "index_name"), INDEX)
            tree[name] = {"line": title, "index_name": index, **_read_records(item, index)}
    return tree


def _read_blocks(arrays: Mapping[str, h5py.Dataset]) -> dict[str, Any]:
    """A DataFrame in the fixed format of pandas: its index, and blocks of columns beside their titles."""
    index = write_cell(arrays["axis1"].attrs.get("name"))
    index = INDEX if index in ("", "N.") else index  # a pickled None
    found: dict[str, Any] = {"index_name": index}
    for name in ("axis1", *(n for n in arrays if n.endswith("_values"))):
        own, titles = read_attributes(arrays[name]), arrays[name.replace("_values", "_items")][()]
        values = _read_instants(arrays[name][()], own.get("kind", own.get("value_type")))
        found[index if name == "axis1" else name] = (values, {"columns": titles})
    return found


def _is_column(data: h5py.Dataset) -> bool:
    """Whether a dataset holds numbers, texts or records of them, not those of another file."""
    import h5py

    kind = data.dtype.kind
    if data.shape is None or data.is_virtual or data.external or kind not in "fiubSOV":
        return False
    if kind == "O" and h5py.check_string_dtype(data.dtype) is None:
        return False  # references and sequences
    if _DIMENSION in write_cell(data.attrs.get("NAME")):
        return False
    narrow = len(data.shape) < 2 or (len(data.shape) == 2 and min(data.shape) <= WIDEST)
    return narrow or data.dtype.names is not None


def _read_matlab_text(data: h5py.Dataset) -> str:
    """A text of MATLAB, which keeps them as numbers; ``""``: it is none."""
    if write_cell(data.attrs.get("MATLAB_class")) != "char" or not data.shape:
        return ""
    return "".join(map(chr, data[()].ravel(order="F").tolist())).strip("\0 ")


def read_attributes(thing: h5py.Group | h5py.Dataset) -> dict[str, Any]:
    """The attributes of a dataset or group, as far as h5py can read them."""
    found = {}
    for name in list(thing.attrs):
        with contextlib.suppress(OSError, RuntimeError, TypeError, ValueError, KeyError):
            found[str(name)] = thing.attrs[name]
    return found


def _read_records(data: h5py.Dataset, index: str) -> dict[str, tuple[Any, Attributes]]:
    """The fields of records as arrays with their units; those of pandas have a list of their names."""
    attributes, whole = read_attributes(data), data[()].ravel()
    fields = whole.dtype.names
    listed = np.ravel(attributes.get("units", attributes.get("unit", "")))
    folded = {n.casefold(): v for n, v in attributes.items()}
    found: dict[str, tuple[Any, Attributes]] = {}
    for k, name in enumerate(fields):
        keys = [f"{n}_{e}".casefold() for n in (name, f"FIELD_{k}") for e in ("units", "unit")]
        unit = listed[k] if len(listed) == len(fields) else next((folded[n] for n in keys if n in folded), "")
        kind = attributes.get(f"{name}_kind")
        titles = [] if name == INDEX else _read_pickled_names(kind)
        values = _read_instants(whole[name], kind if name == INDEX else attributes.get(f"{name}_dtype"))
        title = titles[0] if len(titles) == 1 and values.ndim == 1 else name
        found[index if name == INDEX else title] = (values, {"units": write_cell(unit), "columns": titles})
    return found


def _read_instants(values: NDArray[Any], kind: object) -> NDArray[Any]:
    """Whole numbers of which pandas says that they are instants or durations, of ns by default."""
    if (m := re.match(r"(datetime|timedelta)64(\[\w+\])?", write_cell(kind))) is None:
        return values
    return values.astype(np.int64).view(f"{'M' if m[1] == 'datetime' else 'm'}8{m[2] or '[ns]'}")


def _read_pickled_names(value: object) -> list[str]:
    """The texts in a list that PyTables has pickled; nothing is executed."""
    data = value.tobytes() if isinstance(value, np.void) else value if isinstance(value, bytes) else b""
    try:
        return [a for o, a, _ in pickletools.genops(data) if "UNICODE" in o.name and isinstance(a, str)]
    except (ValueError, IndexError, UnicodeDecodeError):
        return []


# --- MATLAB --------------------------------------------------------------------------------------------


def read_matlab(path: Path) -> list[DataTable]:
    """The vectors of a MATLAB file, and its structures of vectors; units in a structure ``units``."""
    with path.open("rb") as stream:
        if stream.read(10).startswith((b"MATLAB 7.3", HDF5_MAGIC)):
            return read_hdf5(path)
    from scipy.io import loadmat, whosmat  # slow to import, and only this format needs it

    with report_damage(path, "MATLAB"):
        require_memory(path, 8.0 * sum(math.prod(shape) for _, shape, _ in whosmat(path)))
        found = loadmat(path, mat_dtype=False, simplify_cells=True)
        return make_tables({n: v for n, v in found.items() if not n.startswith("__")})
