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
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, missing_package
from ragg_runtime.io.record import SI_UNITS
from ragg_runtime.io.tables import (
    INDEX,
    WIDEST,
    Attributes,
    DataColumn,
    DataTable,
    decode_values,
    join_groups,
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
        found = convert_arrow(values)
        said = (field.metadata or {}).get(b"units", b"").decode("utf-8", "replace")
        said = "1" if not said and pa.types.is_boolean(field.type) else said
        arrays.append((name, np.zeros(len(values), "V1") if found is None else found, {"units": said}))
    return [make_table(arrays, given, index=index)]


def _read_json(text: bytes) -> dict[str, Any]:
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def convert_arrow(column: pa.ChunkedArray) -> NDArray[Any] | None:
    """Numbers, texts or instants of a column of Arrow; ``None`` for anything else. Its own ``to_numpy`` may load pandas."""
    kind = column.type.value_type if pa.types.is_dictionary(column.type) else column.type
    if (
        pa.types.is_string(kind)
        or pa.types.is_large_string(kind)
        or pa.types.is_binary(kind)
        or pa.types.is_time(kind)
    ):
        return np.array([write_cell(t) for t in column.to_pylist()], dtype=object)
    if pa.types.is_timestamp(kind) or pa.types.is_date(kind):
        return np.asarray(column.cast(pa.timestamp("ns")).to_numpy(), dtype="datetime64[ns]")
    if pa.types.is_duration(kind):
        return np.asarray(column.cast(pa.duration("ns")).to_numpy(), dtype="timedelta64[ns]")
    if pa.types.is_fixed_size_list(kind) or pa.types.is_list(kind) or pa.types.is_large_list(kind):
        lengths = {None if x is None else len(x) for x in column}
        inner = convert_arrow(pa.chunked_array([c.flatten() for c in column.chunks], kind.value_type))
        if inner is None or len(lengths) != 1 or None in lengths:
            return None
        return inner.reshape(len(column), -1)
    if not (pa.types.is_primitive(kind) or pa.types.is_decimal(kind) or pa.types.is_null(kind)):
        return None
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
        found = {n: (np.array(v.data), vars(v)["_attributes"]) for n, v in file.variables.items()}
        return [make_table((n, x, a) for n, (x, a) in found.items())]


def read_hdf5(path: Path) -> list[DataTable]:
    """The groups of an HDF5, NetCDF-4 or MATLAB 7.3 file that hold tables; units of MATLAB in a structure ``units``."""
    import h5py  # slow to import, and only files built on HDF5 need it

    tables: list[DataTable] = []
    with report_damage(path, "HDF5"), h5py.File(path, "r") as file:
        for place, group, arrays in _find_groups(file):
            if place.rsplit("/", 1)[-1] != "units":
                tables += _read_group(path, place, group, arrays)
    return join_groups(tables)


def _find_groups(file: h5py.File) -> Iterator[tuple[str, h5py.Group, dict[str, h5py.Dataset]]]:
    """Every group once, with its datasets: not MATLAB's and PyTables' own, nor links to elsewhere in this file or to another."""
    import h5py

    found: list[tuple[str, h5py.Group]] = [("", file)]
    file.visititems(lambda n, x: found.append((f"/{n}", x)) if isinstance(x, h5py.Group) else None)
    for place, group in found:
        if "/#" not in place and "/_i_" not in place:
            own = {n: group[n] for n in group if isinstance(group.get(n, getlink=True), h5py.HardLink)}
            yield (
                place,
                group,
                {n: x for n, x in own.items() if isinstance(x, h5py.Dataset) and _is_column(x)},
            )


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
    if write_cell(data.attrs.get("MATLAB_class")) == "char":
        return False  # MATLAB keeps texts as numbers
    narrow = len(data.shape) < 2 or (len(data.shape) == 2 and min(data.shape) <= WIDEST)
    return narrow or data.dtype.names is not None


def _read_group(
    path: Path, place: str, group: h5py.Group, arrays: Mapping[str, h5py.Dataset]
) -> Iterator[DataTable]:
    """The datasets of a group as a table, and every table of records (PyTables) in it; the group may be a line."""
    size = sum(math.prod(d.shape) * max(1, len(d.dtype.names or ())) for d in arrays.values())
    require_memory(path, 8.0 * size)
    own = write_cell(read_attributes(group).get("line")) or read_matlab_text(group.get("line"))
    line = own or place.rsplit("/", 1)[-1]
    units = group.get("units")
    given = {n: read_matlab_text(x) for n, x in units.items()} if hasattr(units, "items") else {}
    plain = {n: d for n, d in arrays.items() if d.dtype.names is None}
    if "axis1" in plain and "block0_items" in plain:
        yield _read_blocks(plain, line=line, part=place)
    elif plain:
        found = [(n, d[()], read_attributes(d)) for n, d in plain.items()]
        yield make_table(found, given, line=line, part=place)
    for name, data in arrays.items():
        if data.dtype.names is not None:
            about = _read_pickled_names(group.attrs.get("info"))
            index = next((b for a, b in itertools.pairwise(about) if a == "index_name"), INDEX)
            records = [(index if n == INDEX else n, *x) for n, *x in _read_records(data)]
            yield make_table(records, index=read_heading(index)[0], line=line, part=f"{place}/{name}")


def _read_blocks(arrays: Mapping[str, h5py.Dataset], **about: Any) -> DataTable:
    """A DataFrame in the fixed format of pandas: its index, and blocks of columns beside their titles."""
    index = write_cell(arrays["axis1"].attrs.get("name"))
    index = INDEX if index in ("", "N.") else index  # a pickled None
    found = []
    for name in ("axis1", *(n for n in arrays if n.endswith("_values"))):
        own, titles = read_attributes(arrays[name]), arrays[name.replace("_values", "_items")][()]
        values = _read_instants(arrays[name][()], own.get("kind", own.get("value_type")))
        found.append((index if name == "axis1" else name, values, {"columns": titles}))
    return make_table(found, index=read_heading(index)[0], **about)


def _read_records(data: h5py.Dataset) -> list[tuple[str, Any, Attributes]]:
    """The fields of records as arrays with their units; those of pandas are taken apart by its own list of names."""
    attributes, whole = read_attributes(data), data[()].ravel()
    listed = np.atleast_1d(np.asarray(attributes.get("units", attributes.get("unit", "")))).ravel()
    folded = {n.casefold(): v for n, v in attributes.items()}
    found: list[tuple[str, Any, Attributes]] = []
    for k, name in enumerate(whole.dtype.names):
        keys = [f"{n}_{e}".casefold() for n in (name, f"FIELD_{k}") for e in ("units", "unit")]
        unit = next((write_cell(folded[n]) for n in keys if n in folded), "")
        unit = write_cell(listed[k]) if len(listed) == len(whole.dtype.names) else unit
        values, kind = whole[name], attributes.get(f"{name}_kind")
        titles = [] if name == INDEX else _read_pickled_names(kind)
        values = _read_instants(values, kind if name == INDEX else attributes.get(f"{name}_dtype"))
        title = titles[0] if len(titles) == 1 and values.ndim == 1 else name
        found.append((title, values, {"units": unit, "columns": titles}))
    return found


def _read_instants(values: NDArray[Any], kind: object) -> NDArray[Any]:
    """Whole numbers of which pandas says that they are instants or durations, of ns by default."""
    written = write_cell(kind)
    if not written.startswith(("datetime64", "timedelta64")):
        return values
    step = written[written.index("[") + 1 : -1] if written.endswith("]") else "ns"
    return values.astype(np.int64).view(f"{'M8' if written[0] == 'd' else 'm8'}[{step}]")


def _read_pickled_names(value: object) -> list[str]:
    """The texts in a list that PyTables has pickled; nothing is executed."""
    data = (
        value.tobytes() if isinstance(value, np.void) else bytes(value) if isinstance(value, bytes) else b""
    )
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
    return join_groups([*_read_structures({n: v for n, v in found.items() if not n.startswith("__")})])


def read_matlab_text(item: object) -> str:
    """The text that MATLAB keeps in a dataset, as numbers; ``""`` where there is none, or no short one."""
    if getattr(getattr(item, "dtype", None), "kind", "") != "u" or not 0 < item.size <= 200:  # type: ignore[attr-defined]
        return ""
    codes = np.asarray(item[()]).ravel(order="F")  # type: ignore[index]
    return "".join(chr(int(c)) for c in codes if 0 < int(c) < 0x110000).strip()


def _read_structures(variables: Mapping[str, Any]) -> Iterator[DataTable]:
    """Every structure of vectors as a table; its path is the name of its line."""
    waiting: list[tuple[str, Mapping[str, Any]]] = [("", variables)]
    while waiting:
        place, inside = waiting.pop(0)
        units = inside.get("units")
        known = units.items() if isinstance(units, Mapping) else ()
        given = {n: t.strip() for n, t in known if isinstance(t, str)}
        arrays = []
        for name, value in (
            (n, v) for n, v in inside.items() if v is not units or not isinstance(v, Mapping)
        ):
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
