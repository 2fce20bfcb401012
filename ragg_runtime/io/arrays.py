"""Arrays with names and attributes as tables: those of Parquet, NetCDF, HDF5 and MATLAB files, and those in memory.

What a file or a dict holds is a tree of arrays; a branch of it is a table, which may be the record of a line. NetCDF-4 and MATLAB 7.3
are HDF5. Of HDF5 the datasets at the root and in groups are read, tables of PyTables as well; nothing that is in another file. What a
library raises for a damaged file becomes one message.
"""

from __future__ import annotations

import contextlib
import itertools
import json
import math
import pickletools
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from numbers import Number
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsFloat

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, missing_package, one_line
from ragg_runtime.io.instants import count_seconds
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.io.tables import (
    INDEX,
    DataColumn,
    DataTable,
    is_unit,
    read_heading,
    require_memory,
    write_cell,
)

if TYPE_CHECKING:
    import h5py

# columns of one array that are taken apart: accelerations along three axes, voltages of a few discs, a whole flight
WIDEST = 64
# what a file says about an array: units, _FillValue, valid_range, names of columns
Attributes = Mapping[str, Any]
# arrays (or pairs of an array and its attributes), texts, and trees, by name: units is a tree of texts, line names the line
Tree = Mapping[str, Any]

# how lists of names of columns, and of their units, are called
_TITLES = re.compile(
    r"(?:column|channel)?_?(?:columns|names|fields|colheaders|labels?|channels)$", re.IGNORECASE
)
_UNITS = re.compile(r"(?:column|channel)?_?units?(?:_string)?$", re.IGNORECASE)

# how numbers were packed: in the words of CF and, of whole numbers, in those of others
_FACTORS, _OFFSETS = ("scale_factor", "scale", "slope", "conversion"), ("add_offset", "offset", "intercept")

# what NetCDF writes where nothing was written, by type (netcdf.h: NC_FILL_FLOAT ...)
_DEFAULT_FILL = {"f4": 2.0**123 * 0.9375, "f8": 2.0**123 * 0.9375, "i4": -2147483647, "i2": -32767}


def make_tables(tree: Tree, place: str = "") -> list[DataTable]:
    """The tables of a tree of arrays and of its branches, from the outermost on.

    A branch with as many rows, and no name in common, is a part of the record around it, unless both have a clock, or the record has all
    of the motion: columns besides it may have no units.
    """
    arrays, branches = list[tuple[Any, ...]](), dict[str, Any]()
    for name, item in tree.items():
        x = read_array(item) if isinstance(item, list | np.ndarray) else None
        parts = x.ravel().tolist() if x is not None and x.dtype == object else []
        if isinstance(item, Mapping):
            branches[name] = item
        elif parts and all(isinstance(p, Mapping) for p in parts):  # an array of structures
            single = len(parts) > 1 and not any(np.ndim(v) for p in parts for v in p.values())
            rows = {n: [p.get(n) for p in parts] for n in parts[0]}
            if all(rows.get("label") or [""]) and "values" in rows:  # of Simulink
                arrays += zip(rows["label"], rows["values"], strict=True)
            else:
                branches |= {name: rows} if single else {f"{name}_{k}": p for k, p in enumerate(parts, 1)}
        elif x is not None and parts and x.ndim == 2 and all(isinstance(t, str) for t in x[0]):
            # cells below their titles
            branches[name] = dict(zip(x[0], x[1:].T, strict=True))
        elif not isinstance(item, str):
            arrays.append((name, *item) if isinstance(item, tuple) else (name, item))
    units, line, index = branches.pop("units", {}), tree.get("line"), tree.get("index_name", INDEX)
    title = write_cell(line) if isinstance(line, str | int | float) else place.rpartition("/")[2]
    outer = make_table(arrays, read_frame_units(units), line=title, part=place, index=read_heading(index)[0])
    apart = []
    for t in (t for n, x in branches.items() for t in make_tables({"units": units, **x}, f"{place}/{n}")):
        whole = {*SPECIFIC_FORCE, *ANGULAR_RATE} <= {*outer.names} and "[" not in t.part
        clocks = [{"time", "t"} & {n.casefold() for n in x.names} for x in (outer, t)]
        if len(t) != len(outer) or {*outer.names} & {*t.names} or whole or all(clocks):
            apart.append(t)
            continue
        stem = t.part.removeprefix(place).strip("/")
        more = [_name_inside(stem, c, outer.names) for c in t.columns]
        outer = replace(outer, columns=(*outer.columns, *more), notes=(*outer.notes, *t.notes))
    tables = [outer, *apart] if outer.columns else apart
    return tables if place else _join_channels(tables)


def _name_inside(stem: str, c: DataColumn, names: Sequence[str]) -> DataColumn:
    """A column of a branch that belongs to a record: its name follows the branch's, unless it is one of the contract and free. HDF5
    makes a group of a name such as ``omega_x [deg/h]``.
    """
    if c.name in SI_UNITS and c.name not in names:
        return c
    if "[" not in stem:
        return replace(c, name=f"{stem}_{c.name}".replace("/", "_"))
    name, unit = read_heading(f"{stem}/{c.name}")
    return replace(c, name=name, unit=unit)


def _join_channels(tables: list[DataTable]) -> list[DataTable]:
    """Tables of the same instants, without other names in common, as one: a single channel is called as its branch."""
    times = [next((c for c in t.columns if c.name.casefold() in ("time", "t")), None) for t in tables]
    first = times[0] if len(times) > 1 else None
    if first is None or not all(c is not None and np.array_equal(c.values, first.values) for c in times):
        return tables
    columns = [
        replace(c, name=t.part.rpartition("/")[2]) if len(t.columns) == 2 and c.name not in SI_UNITS else c
        for t, time in zip(tables, times, strict=True)
        for c in t.columns
        if c is not time
    ]
    if len({c.name for c in columns}) < len(columns):
        return tables
    return [replace(tables[0], columns=(replace(first, name="time"), *columns), line=None, part="")]


def make_table(
    arrays: Iterable[tuple[Any, ...]], units: Mapping[str, str] | None = None, **about: Any
) -> DataTable:
    """A table of those arrays that have the length of ``time`` (or the commonest one); notes say which have not.

    Each comes with its name and perhaps attributes: (n,), or (n, m), (m, n) with m up to ``WIDEST``, which give ``name_1`` ... ``name_m``
    (or ``a_x`` ... of a vector ``a``, or what m texts in an attribute or another array, such as ``colheaders``, say). ``units`` are those
    by name, besides those in attributes and names; ``about`` further fields of the table.
    """
    units, arrays = units or {}, [(n, read_array(x), dict(*a)) for n, x, *a in arrays]
    numbers = [a for a in arrays if a[1].dtype.kind not in "OSUT"] or arrays  # texts may be names of columns
    sizes = [(read_heading(n)[0], max(x.shape)) for n, x, _ in numbers if _is_narrow(x.shape)]
    common = Counter(size for _, size in sizes if size > 1).most_common(1)
    length = next((size for n, size in sizes if n == "time" and size > 1), common[0][0] if common else 1)
    words = [(n, x) for n, x, _ in arrays if x.dtype.kind in "OSUT"]
    lists = {n: x for n, x in words if _TITLES.search(n) or _UNITS.search(n)}
    columns, other, packed = [], [], dict[str, list[str]]()
    for name, x, attributes in arrays:
        fits = _is_narrow(x.shape) and length in x.shape
        instants = ""
        if x.dtype.kind in "mM":
            x, instants = count_seconds(x)
        values = decode_values(x, attributes) if fits else None
        if values is None:
            why = "neither numbers nor text" if fits else " x ".join(map(str, x.shape)) or "a single value"
            other += [f"{name!r} ({why})"] if name not in lists else []
            continue
        title, unit = read_heading(name)
        told = sorted(n for n in attributes if n.casefold() in (*_FACTORS[1:], *_OFFSETS[1:]))
        if any(_read_attribute(attributes[n]).tolist() not in ([0], [1]) for n in told):
            done = "applied" if x.dtype.kind in "iu" else "not applied, these are no whole numbers"
            packed.setdefault(f"attributes {', '.join(told)}: {done}", []).append(title)
        logical = x.dtype == np.bool_ or attributes.get("MATLAB_class") == b"logical"
        units_here = (_read_text(v) for k, v in attributes.items() if _UNITS.fullmatch(k))
        own_unit = next(filter(None, units_here), unit or "1" * logical)
        for label, unit, part in _spread(title, values, length, {**lists, **attributes}):
            unit_of = instants or units.get(label) or units.get(name) or units.get(title) or unit or own_unit
            columns.append(DataColumn(label, unit_of.strip(), part))
    notes = [*about.pop("notes", ()), *(f"{', '.join(n)}: {words}" for words, n in packed.items())]
    if other:
        shown = ", ".join(other[:6]) + (" ..." if len(other) > 6 else "")
        notes.append(f"skipped, not of the {length} rows of the table: {one_line(shown)}")
    return DataTable(tuple(columns), notes=tuple(notes), **about)


def read_array(x: Any) -> NDArray[Any]:
    """Anything as an array; what is masked holds nothing."""
    if isinstance(x, np.ma.MaskedArray) and x.dtype.kind in "biuf":
        return np.where(np.ma.getmaskarray(x), np.nan, x.data)
    try:
        array = np.asarray(x)
    except ValueError:  # parts of several lengths
        array = np.asarray(x, dtype=object)
    letters = array.dtype == "S1" and array.ndim == 2  # texts of NetCDF 3
    return np.array([b"".join(t) for t in array.tolist()]) if letters else array


def _is_narrow(shape: tuple[int, ...]) -> bool:
    return len(shape) == 1 or (len(shape) == 2 and min(shape) <= WIDEST)


def _spread(
    name: str, values: NDArray[Any], length: int, attributes: Attributes
) -> list[tuple[str, str, NDArray[Any]]]:
    """The columns of an array with their units, if each has its own: itself, or of two dimensions ``name_1`` ...

    A vector ``a`` gives ``a_x``, ``a_y``, ``a_z``; lists of names and units in its attributes are taken.
    """
    if values.ndim == 1:
        return [(name, "", values)]
    values = values if values.shape[0] == length else values.T
    width = values.shape[1]
    axes = "xyz" if width == 3 and f"{name}_x" in SI_UNITS else range(1, width + 1)
    lists = {
        k.removeprefix(name): [write_cell(t) for t in np.ravel(v)]  # IMU_label is that of IMU
        for k, v in attributes.items()
        if np.ndim(v) and np.size(v) == width
    }
    plain = [name if width == 1 else f"{name}_{k}" for k in axes]
    titles = [read_heading(t) for t in next((v for k, v in lists.items() if _TITLES.fullmatch(k)), plain)]
    units = next((v for k, v in lists.items() if _UNITS.fullmatch(k)), [""] * width)
    return [(n, u or own_unit, x) for (n, own_unit), u, x in zip(titles, units, values.T, strict=True)]


# --- values --------------------------------------------------------------------------------------------


def decode_values(values: NDArray[Any], attributes: Attributes) -> NDArray[Any] | None:
    """Numbers as float64, text as objects; ``None`` for anything else.

    What the CF conventions call missing (2.5.1: ``_FillValue``, ``missing_value``, ``valid_range``, and NetCDF's
    default fill values) becomes NaN; ``scale_factor`` and ``add_offset`` are applied, ``flag_meanings`` give texts.
    """
    kind = values.dtype.kind
    if kind == "i" and _read_text(attributes.get("_Unsigned")) == "true":  # NetCDF 3 has no unsigned numbers
        values, kind = values.view(values.dtype.str.replace("i", "u")), "u"
    if kind in "OSUT":
        return _decode_objects(values.tolist())
    if kind not in "biuf":
        return None
    meanings = _read_text(attributes.get("flag_meanings")).split()
    if meanings and kind in "iu" and values.ndim == 1:
        flags = np.atleast_1d(attributes.get("flag_values", np.arange(len(meanings)))).tolist()
        texts = dict(zip(flags, meanings, strict=False))
        return np.array([texts.get(int(v), str(v)) for v in values], dtype=object)
    numbers = {n.casefold(): x for n, v in attributes.items() if (x := _read_attribute(v)).size}
    nothing = [v for n in ("_fillvalue", "missing_value") for v in numbers.get(n, ()) if np.isfinite(v)]
    if (fill := _DEFAULT_FILL.get(values.dtype.str[1:])) is not None and "DIMENSION_LIST" in attributes:
        nothing.append(fill)
    missing = np.isin(values, np.array(nothing).astype(values.dtype))
    factor, offset = (
        next((numbers[n][0] for n in names if n in numbers and (kind in "iu" or n == names[0])), default)
        for names, default in ((_FACTORS, 1.0), (_OFFSETS, 0.0))
    )
    packed = (factor, offset) != (1.0, 0.0)
    result: NDArray[Any] = values.astype(np.float64, copy=False)
    result = result * factor + offset if packed else result
    for name in (n for n in ("valid_range", "valid_min", "valid_max") if n in numbers):
        # of packed whole numbers the range is one of whole numbers, or of what they encode (NUG, appendix A)
        encoded = packed and kind in "iu" and numbers[name].dtype.kind == "f"
        x, limits = result if encoded else values, numbers[name]
        missing |= (x < limits[0]) & (name != "valid_max") | (x > limits[-1]) & (name != "valid_min")
    return np.where(missing, np.nan, result) if missing.any() else result


def _read_attribute(value: Any) -> NDArray[Any]:
    """The numbers of an attribute, even where they are written as text; none where it holds anything else."""
    x = np.ravel(value)
    with contextlib.suppress(ValueError, TypeError):
        x = x.astype(np.float64) if x.dtype.kind in "SUO" else x
    return x if x.dtype.kind in "fiu" else np.empty(0)


def _decode_objects(cells: list[Any]) -> NDArray[Any] | None:
    """Numbers, if all of what is there are numbers; else texts; ``None`` where there is anything else."""
    filled = [c for c in cells if write_cell(c)]
    if filled and all(isinstance(c, Number) for c in filled):
        return np.array([float(c) if isinstance(c, SupportsFloat) else np.nan for c in cells])
    if not all(isinstance(c, str | bytes | Number) or hasattr(c, "isoformat") for c in filled):
        return None
    return np.array([write_cell(c) for c in cells], dtype=object)


def _read_text(value: Any) -> str:
    """The text of an attribute; ``""`` where it is none."""
    first = np.ravel(value)[0] if np.size(value) == 1 else ""
    return write_cell(first) if isinstance(first, str | bytes) else ""


def read_frame_units(attributes: Mapping[Any, Any]) -> dict[str, str]:
    """Units by name: as a DataFrame carries them in ``attrs``, under ``units``, or name -> unit or name -> {units: unit}."""
    inside = attributes.get("units")
    units = {}
    for name, unit in (inside if isinstance(inside, Mapping) else attributes).items():
        value = unit.get("units", unit.get("unit")) if isinstance(unit, Mapping) else unit
        if isinstance(value, str):
            units[str(name)] = value.strip()
    return units


# --- in memory -----------------------------------------------------------------------------------------


def tabulate(data: Any) -> list[DataTable]:
    """The tables of a DataFrame, a Dataset or a dict of arrays; UserError for anything else."""
    if hasattr(data, "iloc") and hasattr(data, "columns"):
        return [_tabulate_frame(data)]
    if hasattr(data, "data_vars") and hasattr(data, "coords"):
        return [make_table((str(n), v.values, _unpack_range(v)) for n, v in data.variables.items())]
    if isinstance(data, Mapping):
        tree = {str(n): v if isinstance(v, Mapping) else _read_series(v) for n, v in data.items()}
        return make_tables({"units": tree.pop("attrs", {}), **tree})
    raise UserError(
        "this is not a flight",
        found=type(data).__name__,
        expected="a path, a pandas DataFrame, an xarray Dataset, a dict of arrays, or a list of these",
    )


def _unpack_range(v: Any) -> Attributes:
    """The attributes of a variable of xarray, which unpacks values but not the range in which they are valid."""
    scale, offset = v.encoding.get("scale_factor", 1.0), v.encoding.get("add_offset", 0.0)
    packed = {n: np.asarray(x) * scale + offset for n, x in v.attrs.items() if n.startswith("valid_")}
    return {**v.attrs, **packed}


def _tabulate_frame(frame: Any) -> DataTable:
    """The table of a DataFrame; an index that is more than row numbers is its first column."""
    frame = frame.reset_index() if frame.index.nlevels > 1 else frame  # by line and time
    arrays = []
    for k, c in enumerate(frame.columns):
        parts = [str(x) for x in c] if isinstance(c, tuple) else [str(c)]
        if len(parts) > 1 and is_unit(parts[-1]):  # names and units in two rows of a header
            parts[-1] = f"[{parts[-1]}]"
        arrays.append((" ".join(parts), *_read_series(frame.iloc[:, k])))
    index = None
    if type(frame.index).__name__ != "RangeIndex":
        name = INDEX if frame.index.name is None else str(frame.index.name)
        arrays.insert(0, (name, *_read_series(frame.index.to_series())))
        index = read_heading(name)[0]
    return make_table(arrays, read_frame_units(frame.attrs), index=index)


def _read_series(series: Any) -> tuple[Any, Attributes]:
    """A column of pandas as an array of NumPy, any other array as it is; and its attributes."""
    attributes = getattr(series, "attrs", {})
    if not hasattr(series, "to_numpy") or not hasattr(series, "index"):
        return series, attributes
    try:
        return convert_arrow(pa.chunked_array([pa.Array.from_pandas(series)])), attributes
    except pa.ArrowException:  # cells of several kinds
        return series.to_numpy(object), attributes


# --- Parquet -------------------------------------------------------------------------------------------


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


def read_parquet(path: Path) -> list[DataTable]:
    """The Parquet file as one table: the unit in a field's metadata ``units`` or in what pandas keeps in ``attrs``."""
    with report_damage(path, "Parquet"), path.open("rb") as stream, pq.ParquetFile(stream) as file:
        schema = file.schema_arrow
        require_memory(path, 8.0 * file.metadata.num_rows * len(schema))
        table = file.read()
        about = schema.metadata or {}
        units = read_frame_units(json.loads(about.get(b"PANDAS_ATTRS", b"{}")))
        labels = json.loads(about.get(b"pandas", b"{}")).get("index_columns", [])
    while any(map(pa.types.is_struct, table.schema.types)):  # the component x of a vector a is a column a.x
        table = table.flatten()
    arrays, index = [], None
    for field, values in zip(table.schema, table.columns, strict=True):
        unnamed, joined = field.name.startswith("__index_level_"), field.name.replace(".", "_")
        name = INDEX if unnamed else joined if joined in SI_UNITS else field.name
        index = read_heading(name)[0] if unnamed or field.name in labels else index
        own_unit = read_unit(field) or "1" * pa.types.is_boolean(field.type)
        arrays.append((name, convert_arrow(values), {"units": own_unit}))
    return [make_table(arrays, units, index=index)]


def convert_arrow(column: pa.ChunkedArray) -> NDArray[Any]:
    """A column of Arrow as an array. Its own ``to_numpy`` would load pandas for numbers."""
    kind = column.type.value_type if pa.types.is_dictionary(column.type) else column.type
    if pa.types.is_string(kind) or pa.types.is_large_string(kind) or pa.types.is_binary(kind):
        return np.array(column.to_pylist(), dtype=object)
    if pa.types.is_nested(kind) or pa.types.is_time(kind) or pa.types.is_date(kind):
        return read_array(column.to_pylist())
    if pa.types.is_temporal(kind):
        return np.asarray(column.to_numpy())
    column = column.cast(pa.int8()) if pa.types.is_boolean(kind) else column
    column = column.cast(pa.float64(), safe=False)  # whole numbers beyond 2^53: ns since 1970
    column = column.fill_null(float("nan")) if column.null_count else column
    return np.concatenate([np.empty(0), *map(np.from_dlpack, column.chunks)])


def read_unit(field: pa.Field) -> str:
    """The unit in the metadata of a field; ``""``: there is none."""
    return str((field.metadata or {}).get(b"units", b"").decode("utf-8", "replace"))


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


def _read_group(group: h5py.Group, visited: set[h5py.HLObject]) -> dict[str, Any]:
    """What a group holds, everything once: not MATLAB's and PyTables' own, nor links to elsewhere in this file or to another."""
    import h5py

    line = write_cell(read_attributes(group).get("line"))
    tree: dict[str, Any] = {"line": line} if line else {}
    links = [n for n in group if isinstance(group.get(n, getlink=True), h5py.HardLink)]
    items = {n: x for n in links if not n.startswith(("#", "_i_")) and (x := group[n]) not in visited}
    visited.update(items.values())
    columns = {n: x for n, x in items.items() if isinstance(x, h5py.Dataset) and _is_column(x)}
    if {"axis1", "block0_items"} <= columns.keys():
        return tree | _read_blocks(columns)
    for name, item in items.items():
        if isinstance(item, h5py.Group):
            tree[name] = _read_group(item, visited)
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
    tree: dict[str, Any] = {"index_name": index}
    for name in ("axis1", *(n for n in arrays if n.endswith("_values"))):
        attributes, titles = read_attributes(arrays[name]), arrays[name.replace("_values", "_items")][()]
        values = _read_instants(arrays[name][()], attributes.get("kind", attributes.get("value_type")))
        tree[index if name == "axis1" else name] = (values, {"columns": titles})
    return tree


def _is_column(data: h5py.Dataset) -> bool:
    """Whether a dataset holds numbers, texts or records of them, not those of another file."""
    import h5py

    kind = data.dtype.kind
    if data.shape is None or data.is_virtual or data.external or kind not in "fiubSOV":
        return False
    if kind == "O" and h5py.check_string_dtype(data.dtype) is None:
        return False  # references and sequences
    if (
        "a netCDF dimension but not a" in write_cell(data.attrs.get("NAME"))
        or "MATLAB_object_decode" in data.attrs
    ):
        return False  # nor tables and other objects of MATLAB
    return not data.shape or _is_narrow(data.shape) or data.dtype.names is not None


def _read_matlab_text(data: h5py.Dataset) -> str:
    """A text of MATLAB, which keeps them as numbers; ``""``: it is none."""
    if write_cell(data.attrs.get("MATLAB_class")) != "char" or not data.shape:
        return ""
    return "".join(map(chr, data[()].ravel(order="F").tolist())).strip("\0 ")


def read_attributes(thing: h5py.Group | h5py.Dataset) -> dict[str, Any]:
    """The attributes of a dataset or group, as far as h5py can read them."""
    attributes = {}
    for name in list(thing.attrs):
        with contextlib.suppress(OSError, RuntimeError, TypeError, ValueError, KeyError):
            attributes[str(name)] = thing.attrs[name]
    return attributes


def _read_records(data: h5py.Dataset, index: str) -> dict[str, tuple[Any, Attributes]]:
    """The fields of records as arrays with their units; those of pandas have a list of their names."""
    attributes, whole = read_attributes(data), data[()].ravel()
    fields = whole.dtype.names
    listed = np.ravel(attributes.get("units", attributes.get("unit", "")))
    folded = {n.casefold(): v for n, v in attributes.items()}
    arrays: dict[str, tuple[Any, Attributes]] = {}
    for k, name in enumerate(fields):
        keys = [f"{n}_{e}".casefold() for n in (name, f"FIELD_{k}") for e in ("units", "unit")]
        unit = listed[k] if len(listed) == len(fields) else next((folded[n] for n in keys if n in folded), "")
        kind = attributes.get(f"{name}_kind")
        titles = [] if name == INDEX else _read_pickled_names(kind)
        values = _read_instants(whole[name], kind if name == INDEX else attributes.get(f"{name}_dtype"))
        title = titles[0] if len(titles) == 1 and values.ndim == 1 else name
        arrays[index if name == INDEX else title] = (values, {"units": write_cell(unit), "columns": titles})
    return arrays


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
        if stream.read(10).startswith((b"MATLAB 7.3", b"\x89HDF")):
            return read_hdf5(path)
    from scipy.io import loadmat, whosmat  # slow to import, and only this format needs it

    with report_damage(path, "MATLAB"):
        require_memory(path, 8.0 * sum(math.prod(shape) for _, shape, _ in whosmat(path)))
        variables = loadmat(path, mat_dtype=False, simplify_cells=True)
        return make_tables({n: v for n, v in variables.items() if not n.startswith("__")})
