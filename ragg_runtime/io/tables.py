"""Tables as they stand in files or in memory: columns with the file's own names and units, and the lines among them.

A reader of a format makes one or more :class:`Table`; what a pandas DataFrame, an xarray Dataset, a group of an HDF5
file, a structure of MATLAB or a dict of arrays holds becomes one by :func:`make_table`.
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, one_line
from ragg_runtime.instrument.units import units
from ragg_runtime.io.record import SI_UNITS

MOST_COLUMNS = 2000
"""Columns of a file beyond which it is no record of an instrument, and would take minutes."""

MOST_LINES = 20_000
"""Lines of a file, beyond which the column does not name lines: the largest surveys have some thousands."""

WIDEST = 16
"""Columns of one array that are taken apart: accelerations along three axes, voltages of a few discs."""

INDEX = "index"
"""Name of a column that labels the rows and has none."""

SHARE = 0.5
"""Of the free memory that a table may take: reading and fitting it take as much again."""

_HEADER = re.compile(r"(?P<name>[^\[\]]*?)\s*\[(?P<unit>[^\[\]]*)\]")
_OTHERWISE = re.compile(
    r"(?P<name>.*?\S)(?:\s*\((?P<inside>[^()]+)\)|\s*[,:]\s*(?P<behind>\S+)| / (?P<over>\S+))"
)
"""``name (unit)``, ``name, unit``, ``name: unit`` and ``name / unit`` (ISO 80000-1)."""
_UNIT_KEYS = ("units", "Units", "UNITS", "unit", "Unit")
_DEFAULT_FILL = {"f4": 2.0**123 * 0.9375, "f8": 2.0**123 * 0.9375, "i4": -2147483647, "i2": -32767}
"""What NetCDF writes where nothing was written, by type (netcdf.h: NC_FILL_FLOAT ...)."""


@dataclass(frozen=True, eq=False)
class Column:
    """Values (n,) of a column under the file's own name, and their unit (``""``: none given).

    ``values``: float64 with NaN for nothing, object (text, ``""`` for nothing), datetime64[ns] or timedelta64[ns].
    """

    name: str
    unit: str
    values: NDArray[Any]

    @property
    def is_text(self) -> bool:
        return self.values.dtype.kind == "O"

    @property
    def is_number(self) -> bool:
        return self.values.dtype.kind == "f"


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of one length.

    ``line`` is the flight line, where there are several; ``part`` the group, structure or sheet; ``index`` the name of
    the column that labels the rows (the index of a DataFrame); ``notes`` what was made of the file. ``counts`` says how
    the file itself counts its rows: its word for them, and the number of the first.
    """

    columns: tuple[Column, ...]
    line: str | None = None
    part: str = ""
    notes: tuple[str, ...] = ()
    index: str | None = None
    counts: tuple[str, int] = field(default=("row", 1))

    def __len__(self) -> int:
        return len(self.columns[0].values) if self.columns else 0

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(c.name for c in self.columns)

    def column(self, name: str) -> Column:
        """The only column of this name; KeyError if there is none."""
        return next(c for c in self.columns if c.name == name)

    def row(self, position: int) -> str:
        """A row as the file counts it: ``line 9``."""
        return f"{self.counts[0]} {self.counts[1] + position}"

    def rows(self, chosen: NDArray[Any]) -> Table:
        """Some of the rows, by their positions."""
        return replace(self, columns=tuple(replace(c, values=c.values[chosen]) for c in self.columns))


def read_heading(text: str) -> tuple[str, str]:
    """Name and unit of ``name [unit]``, or of another way in which what should be the unit is one (see above)."""
    text = " ".join(text.split())
    if match := _HEADER.fullmatch(text):
        return one_line(match["name"]), match["unit"].strip()
    if match := _OTHERWISE.fullmatch(text):
        unit = next(filter(None, match.groups()[1:])).strip()
        if is_unit(unit) or match["name"] in SI_UNITS:
            return one_line(match["name"]), unit
    return one_line(text), ""


def read_units(cells: Sequence[str]) -> list[str] | None:
    """The units in a row below the names: each cell is a unit, perhaps in brackets, or empty; not all numbers."""
    found = [re.sub(r"\s*(?:\[(.*)\]|\((.*)\))\s*", r"\1\2", c).strip() for c in cells]
    if not all(not c or is_unit(c) for c in found) or not any(c not in ("", "1") for c in found):
        return None
    return found


def is_unit(text: str) -> bool:
    """Whether the text reads as a unit."""
    try:
        units(9.8).parse(text)  # whether a text is a unit does not depend on the model's g
    except UserError:
        return False
    return bool(text.strip())


def is_line(name: str) -> bool:
    """Whether a column of this name tells flight lines apart."""
    return name.casefold() == "line"


def make_table(
    arrays: Iterable[tuple[str, Any]],
    given: Mapping[str, str] | None = None,
    **about: Any,
) -> Table:
    """A table of those arrays that have the length of ``time`` (or the commonest one); notes say which have not.

    Parameters
    ----------
    arrays
        Name and array: (n,), or (n, m), (m, n) with m up to ``WIDEST``, which give ``name_1`` ... ``name_m``. Anything
        with ``shape`` that NumPy converts, perhaps with ``attrs``.
    given
        Units by name, beside those in ``attrs`` and in the names themselves.
    about
        Further fields of the table.
    """
    given, arrays = given or {}, list(arrays)
    if len(arrays) > MOST_COLUMNS:
        raise too_wide(None, len(arrays))
    length = _common_length(arrays)
    columns, other = [], []
    for name, x in arrays:
        if length not in x.shape or len(x.shape) > 2 or (len(x.shape) == 2 and min(x.shape) > WIDEST):
            other.append(f"{name!r} ({' x '.join(map(str, x.shape)) or 'a single value'})")
            continue
        attributes = read_attributes(x)
        values = decode_values(np.asarray(x), attributes)
        if values is None:
            other.append(f"{name!r} (neither numbers nor text)")
            continue
        title, unit = read_heading(name)
        said = next(filter(None, (_text(attributes.get(k)) for k in _UNIT_KEYS)), "").strip()
        for own, part in _spread(title, values, length):
            unit_of = given.get(own) or given.get(name) or given.get(title) or said or unit
            columns.append(Column(own, unit_of.strip(), part))
    notes = list(about.pop("notes", ()))
    if other:
        shown = ", ".join(other[:6]) + (" ..." if len(other) > 6 else "")
        notes.append(f"passed over, not of the {length} rows of the table: {one_line(shown)}")
    return Table(tuple(columns), notes=tuple(notes), **about)


def too_wide(where: Path | None, count: int) -> UserError:
    """The refusal of a table of more than ``MOST_COLUMNS``."""
    what, remedy = "the file has too many columns for a flight", "keep the columns that the instrument needs"
    return UserError(what, where=where, found=count, expected=f"at most {MOST_COLUMNS}", remedy=remedy)


def _common_length(arrays: Sequence[tuple[str, Any]]) -> int:
    """Rows of the table that arrays make up: those of ``time``, else the commonest length."""
    shapes = [(n, x.shape) for n, x in arrays]
    sizes = [(n, max(s)) for n, s in shapes if len(s) == 1 or (len(s) == 2 and min(s) <= WIDEST)]
    time = next((size for n, size in sizes if read_heading(n)[0] == "time"), 0)
    if time > 1:
        return time
    common = Counter(size for _, size in sizes if size > 1).most_common(1)
    return common[0][0] if common else max((size for _, size in sizes), default=0)


def _spread(name: str, values: NDArray[Any], length: int) -> list[tuple[str, NDArray[Any]]]:
    """The columns of an array: itself, or ``name_1`` ... of one of two dimensions."""
    if values.ndim == 1:
        return [(name, values)]
    values = values if values.shape[0] == length else values.T
    width = values.shape[1]
    return [(name if width == 1 else f"{name}_{k + 1}", values[:, k]) for k in range(width)]


def read_attributes(thing: Any) -> dict[str, Any]:
    """The attributes of an array or group, as far as its library can read them."""
    attributes = getattr(thing, "attrs", None) or {}
    found = {}
    for name in list(attributes):
        try:
            found[str(name)] = attributes[name]
        except (OSError, RuntimeError, TypeError, ValueError, KeyError):
            continue  # of a type that h5py does not know
    return found


def decode_values(values: NDArray[Any], attributes: Mapping[str, Any]) -> NDArray[Any] | None:
    """Numbers as float64, text as objects, instants as they are; ``None`` for anything else.

    What the CF conventions call missing (2.5.1: ``_FillValue``, ``missing_value``, ``valid_range``, and NetCDF's
    default fill values) becomes NaN; ``scale_factor`` and ``add_offset`` are applied, ``flag_meanings`` give texts.
    """
    kind = values.dtype.kind
    if kind in "mM":
        return values.astype(f"{'datetime' if kind == 'M' else 'timedelta'}64[ns]")
    if kind in "OSUT":
        return _decode_objects(values)
    if kind not in "biuf":
        return None
    meanings = _text(attributes.get("flag_meanings")).split()
    if meanings and kind in "iu" and values.ndim == 1:
        flags = np.atleast_1d(attributes.get("flag_values", np.arange(len(meanings)))).tolist()
        known = dict(zip(flags, meanings, strict=False))
        return np.array([known.get(int(v), str(v)) for v in values], dtype=object)
    missing = np.zeros(values.shape, dtype=np.bool_)
    for name in ("_FillValue", "missing_value"):
        for nothing in _numbers(attributes.get(name)):
            missing |= values == np.asarray(nothing).astype(values.dtype)
    low, high = [*_numbers(attributes.get("valid_range")), -np.inf, np.inf][:2]
    low = [*_numbers(attributes.get("valid_min")), low][0]
    missing |= (values < low) | (values > [*_numbers(attributes.get("valid_max")), high][0])
    if (fill := _DEFAULT_FILL.get(values.dtype.str[1:])) is not None and "DIMENSION_LIST" in attributes:
        missing |= values == np.asarray(fill).astype(values.dtype)
    result: NDArray[Any] = values.astype(np.float64)
    if "scale_factor" in attributes or "add_offset" in attributes:
        factor = [*_numbers(attributes.get("scale_factor")), 1.0][0]
        result = result * factor + [*_numbers(attributes.get("add_offset")), 0.0][0]
    result[missing] = np.nan
    return result


def _decode_objects(values: NDArray[Any]) -> NDArray[Any] | None:
    """Texts; numbers and dates that stand in an array of objects as what they are."""
    cells = values.tolist()
    there = [c for c in cells if c is not None and c != "" and c == c]
    number = (int, float, np.number)
    if there and all(isinstance(c, number) for c in there):
        return np.array([float(c) if isinstance(c, number) else np.nan for c in cells])
    if not all(isinstance(c, (str, bytes, *number)) or hasattr(c, "isoformat") for c in there):
        return None
    return np.array([write_cell(c) for c in cells], dtype=object)


def write_cell(cell: Any) -> str:
    """A cell as text: dates in ISO 8601, 1010 for 1010.0, nothing for ``None`` and NaN."""
    if cell is None or cell != cell:
        return ""
    if isinstance(cell, bytes):
        return cell.decode("utf-8", "replace").strip("\0 \t\r\n")
    if hasattr(cell, "isoformat"):
        return str(cell.isoformat())
    if isinstance(cell, float):
        return str(int(cell)) if cell.is_integer() and abs(cell) < 1e15 else repr(float(cell))
    return str(cell).strip("\0 \t\r\n")


def _text(value: object) -> str:
    """The text of an attribute; ``""`` where it is none."""
    if isinstance(value, np.ndarray) and value.size == 1:
        value = value.ravel()[0]
    return write_cell(value) if isinstance(value, str | bytes) else ""


def _numbers(value: object) -> list[Any]:
    """The numbers of an attribute; none where it is no number."""
    found = np.asarray(value)
    return [v for v in found.ravel() if np.isfinite(v)] if found.dtype.kind in "fiu" else []


# --- in memory -----------------------------------------------------------------------------------------


def tabulate(data: Any) -> list[Table]:
    """A DataFrame, a Dataset or a dict of arrays as a table; UserError for anything else."""
    if hasattr(data, "iloc") and hasattr(data, "columns"):
        return [_of_frame(data)]
    if hasattr(data, "data_vars") and hasattr(data, "coords"):
        return [make_table([(str(n), _of_variable(v)) for n, v in data.variables.items()])]
    if isinstance(data, Mapping):
        about = [data[n] for n in ("units", "attrs") if isinstance(data.get(n), Mapping)]
        arrays = [(str(n), _of_series(v)) for n, v in data.items() if not isinstance(v, Mapping)]
        return [make_table(arrays, read_frame_units(about[0] if about else {}))]
    raise UserError(
        "this is no flight",
        found=type(data).__name__,
        expected="a path, a pandas DataFrame, an xarray Dataset, a dict of arrays, or a list of these",
    )


def _of_variable(v: Any) -> Any:
    """A variable of xarray, which unpacks values but not the range in which they are valid."""
    scale, offset = v.encoding.get("scale_factor", 1.0), v.encoding.get("add_offset", 0.0)
    packed = {n: np.asarray(x) * scale + offset for n, x in v.attrs.items() if n.startswith("valid_")}
    return label(v.values, {**v.attrs, **packed})


def _of_frame(frame: Any) -> Table:
    """The table of a DataFrame; an index that is more than row numbers is its first column."""
    labels = [
        (f"{' '.join(map(str, c[:-1]))} [{c[-1]}]" if is_unit(str(c[-1])) else " ".join(map(str, c)))
        if isinstance(c, tuple)
        else str(c)
        for c in frame.columns  # names and units in two rows of a header
    ]
    arrays = [(n, _of_series(frame.iloc[:, k])) for k, n in enumerate(labels)]
    index = None
    if type(frame.index).__name__ != "RangeIndex":
        name = INDEX if frame.index.name is None else str(frame.index.name)
        arrays.insert(0, (name, _of_series(frame.index.to_series())))
        index = read_heading(name)[0]
    return make_table(arrays, read_frame_units(frame.attrs), index=index)


class Labelled(np.ndarray[Any, Any]):
    """An array with attributes, as those of xarray and h5py have them."""

    attrs: Mapping[str, Any]


def label(values: NDArray[Any], attributes: Mapping[str, Any]) -> NDArray[Any]:
    """The array with these attributes."""
    view = np.asarray(values).view(Labelled)
    view.attrs = attributes
    return view


def _of_series(series: Any) -> Any:
    """A column of pandas as an array of NumPy; any other array as it is."""
    if not hasattr(series, "to_numpy") or not hasattr(series, "index"):
        return series if hasattr(series, "shape") else np.asarray(series)
    dtype = series.dtype
    if getattr(dtype, "tz", None) is not None:
        series = series.dt.tz_convert("UTC").dt.tz_localize(None)
    if str(dtype) == "category":
        series = series.astype(object)
    numeric = getattr(dtype, "kind", "O") in "iufb"
    values = series.to_numpy(dtype=np.float64, na_value=np.nan) if numeric else series.to_numpy()
    return label(values if values.dtype.kind != "T" else values.astype(object), series.attrs)


def read_frame_units(attributes: Mapping[Any, Any]) -> dict[str, str]:
    """Units that a DataFrame carries in ``attrs``: under ``units``, or name -> unit or name -> {units: unit}."""
    inside = attributes.get("units")
    found = {}
    for name, unit in (inside if isinstance(inside, Mapping) else attributes).items():
        value = unit.get("units", unit.get("unit")) if isinstance(unit, Mapping) else unit
        if isinstance(value, str):
            found[str(name)] = value.strip()
    return found


def of_arrow(column: pa.ChunkedArray) -> NDArray[Any] | None:
    """Numbers, texts or instants of a column of Arrow; ``None`` for anything else. Its own ``to_numpy`` may load pandas."""
    kind = column.type.value_type if pa.types.is_dictionary(column.type) else column.type
    if pa.types.is_string(kind) or pa.types.is_large_string(kind) or pa.types.is_time(kind):
        return np.array([write_cell(t) for t in column.to_pylist()], dtype=object)
    if pa.types.is_timestamp(kind) or pa.types.is_date(kind):
        return np.asarray(column.cast(pa.timestamp("ns")).to_numpy(), dtype="datetime64[ns]")
    if pa.types.is_duration(kind):
        return np.asarray(column.cast(pa.duration("ns")).to_numpy(), dtype="timedelta64[ns]")
    if not (pa.types.is_primitive(kind) or pa.types.is_decimal(kind) or pa.types.is_null(kind)):
        return None
    column = column.cast(pa.int8()) if pa.types.is_boolean(kind) else column
    whole = column.cast(pa.float64()).combine_chunks()
    return np.asarray(np.from_dlpack(whole.fill_null(float("nan")) if whole.null_count else whole))


def digest_tables(tables: Sequence[Table]) -> str:
    """SHA-256 of what tables hold, for flights that have no file."""
    total = hashlib.sha256()
    for c in (c for t in tables for c in t.columns):
        total.update(f"{c.name} [{c.unit}] {c.values.dtype.kind}\n".encode("utf-8", "replace"))
        total.update("\n".join(c.values).encode("utf-8", "replace") if c.is_text else c.values.tobytes())
    return total.hexdigest()


# --- several tables, several lines ---------------------------------------------------------------------


def choose_tables(
    tables: Sequence[Table],
    where: Path | str | None,
    wanted: frozenset[str] = frozenset(),
    part: str | None = None,
) -> list[Table]:
    """The tables that are meant: those of ``part``, with all columns that are wanted or with time; several alike are lines."""
    found = [t for t in tables if t.columns]
    if part is not None:
        name = part.strip("/")
        found = [t for t in found if t.part.strip("/") == name or t.part.strip("/").startswith(name + "/")]
    if len({tuple(sorted(t.names)) for t in found}) > 1:
        whole = [t for t in found if wanted <= {*t.names}]
        found = whole or [t for t in found if "time" in t.names] or found
    if len(found) == 1:
        return [replace(found[0], line=None)]
    if len({tuple(sorted(t.names)) for t in found}) == 1:
        return found
    parts = [t.part or "/" for t in found]
    raise UserError(
        "the file holds several tables that differ" if found else "the file holds no table",
        where=where,
        found=", ".join(parts[:12]) + (" ..." if len(parts) > 12 else "") or None,
        expected="vectors of one length in one place, or in groups that are alike" if part is None else part,
        remedy="say in a mapping which is meant: [file] part = ...",
    )


def split_lines(tables: Sequence[Table], column: str | None, where: Path | str | None) -> list[Table]:
    """A table for each line, in the order in which they begin; the rows of one need not stand together."""
    if len(tables) != 1:
        return list(tables)
    (table,) = tables
    name = column or next((n for n in table.names if is_line(n)), None)
    if name is None:
        return [table]
    values = table.column(name).values
    different, first, inverse = np.unique(
        values.astype(str) if values.dtype.kind == "O" else values, return_index=True, return_inverse=True
    )
    texts = [line_name(v) for v in different]
    named = list(dict.fromkeys(texts[k] for k in np.argsort(first) if texts[k]))
    number = {text: k for k, text in enumerate(named)}
    which = np.array([number.get(text, -1) for text in texts], dtype=np.int64)[inverse]
    rest = replace(table, columns=tuple(c for c in table.columns if c.name != name))
    if len(named) > MOST_LINES:
        raise UserError(
            "the column does not name lines: its values differ from row to row",
            where=at(where, f"column {name!r}"),
            found=f"{len(named)} values in {len(which)} rows",
            expected=f"at most {MOST_LINES}, or another column in a mapping: [file] line = ...",
        )
    lost = int(np.sum(which < 0))
    if lost:
        note = f"{lost} row{'s' * (lost > 1)} without the name of a line left out"
        rest = replace(rest, notes=(*rest.notes, note))
    elif len(named) == 1:
        return [rest]
    order = np.argsort(which, kind="stable")
    edges = np.searchsorted(which[order], np.arange(len(named) + 1))
    return [
        replace(rest.rows(order[a:b]), line=text) for text, a, b in zip(named, edges, edges[1:], strict=False)
    ]


def line_name(value: object) -> str:
    """The name of a line: 1010 of 1010.0, in numbers or in text; ``""`` where nothing stands."""
    try:
        number = float(str(value))
    except ValueError:
        return write_cell(value)
    return write_cell(number) if np.isfinite(number) else ""


# --- memory --------------------------------------------------------------------------------------------


def require_memory(path: Path, size: float) -> None:
    """UserError if a table of so many bytes is more than ``SHARE`` of the memory that is free."""
    free = find_free_memory()
    if free is not None and size > SHARE * free:
        raise UserError(
            "the table is too large for the memory of this computer",
            where=path,
            found=f"about {size / 1e9:.3g} GB once it is read",
            expected=f"at most {SHARE * free / 1e9:.3g} GB, half of what is free",
            remedy="divide the file, or leave out columns and lines that are not needed",
        )


def find_free_memory() -> float | None:
    """Bytes that can be had without swapping; ``None`` where the system does not say."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            return next(float(x.split()[1]) * 1024 for x in lines if x.startswith("MemAvailable:"))
    except (OSError, StopIteration, ValueError):
        return None  # of other systems NumPy's own MemoryError is said
