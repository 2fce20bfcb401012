"""Tables: columns with names and units as in files or in memory, and the lines among them.

A reader of a format makes one or more :class:`DataTable`; what a pandas DataFrame, an xarray Dataset, a group of an HDF5
file, a structure of MATLAB or a dict of arrays holds becomes one by :func:`make_table`.
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from numbers import Number
from pathlib import Path
from typing import Any, SupportsFloat

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, count, one_line
from ragg_runtime.instrument.demodulation import Demodulation
from ragg_runtime.instrument.units import units
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE

MOST_LINES = 20_000
"""Lines of a file, beyond which the column does not name lines: the largest surveys have some thousands."""

WIDEST = 64
"""Columns of one array that are taken apart: accelerations along three axes, voltages of a few discs, a whole flight."""

INDEX = "index"
"""Name of a column that labels the rows and has none."""

SHARE = 0.5
"""Of the free memory that a table may take: reading and fitting it take as much again."""

_WORDS = "nan NaN NAN NaT NA N/A n/a n.a. <NA> null NULL None -nan nan(ind) -nan(ind)"
_OF_C = tuple(f"{sign}1.#{word}" for sign in ("", "-") for word in ("IND", "QNAN", "INF"))
_OF_EXCEL = ("#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!")
MISSING = frozenset(
    ("", "?", *(c * k for c in "-*" for k in range(1, 25)), *_WORDS.split(), *_OF_C, *_OF_EXCEL)
)
"""Cells that hold nothing; Fortran writes asterisks for what has no room."""

_HEADING = re.compile(
    r"(?P<name>[^\[\]]*?)\s*\[(?P<inside>[^\[\]]*)\]"
    r"|(?P<other>.*?\S)(?:\s*[({<](?P<round>[^(){}<>]+)[)}>]|\s*[,:]\s*(?P<behind>\S+)| / (?P<over>\S+))"
)
"""``name [unit]``, or ``name (unit)``, ``name {unit}``, ``name <unit>``, ``name, unit``, ``name: unit``, ``name / unit`` (ISO 80000-1)."""

_ALONE = re.compile(r"[({<]([^(){}<>]+)[)}>]")
"""A unit in brackets below a name, or below one for several columns."""

_DEFAULT_FILL = {"f4": 2.0**123 * 0.9375, "f8": 2.0**123 * 0.9375, "i4": -2147483647, "i2": -32767}
"""What NetCDF writes where nothing was written, by type (netcdf.h: NC_FILL_FLOAT ...)."""


@dataclass(frozen=True, eq=False)
class DataColumn:
    """Values (n,) of a column under its name, and their unit (``""``: none given).

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
class DataTable:
    """Columns of one length: as a file has them or, once read, those of a flight under the names of the contract.

    ``line`` is the flight line, where there are several; ``part`` the group, structure or sheet; ``index`` the name of
    the column that labels the rows (the index of a DataFrame); ``notes`` what was made of the file. ``counts`` is how
    the file itself counts its rows: its word for them, and the number of the first.

    Of a flight further: ``place`` for messages; ``origin``, the instant at which ``time`` is 0, if it is known (UTC, or
    GPS time where the file counts in that); ``instants``, whether its stamps are instants, not seconds; ``demodulation``,
    how its channels were made, if that is known.
    """

    columns: tuple[DataColumn, ...]
    line: str | None = None
    part: str = ""
    notes: tuple[str, ...] = ()
    index: str | None = None
    counts: tuple[str, int] = ("row", 1)
    place: str = ""
    origin: datetime | None = None
    instants: bool = False
    demodulation: Demodulation | None = None

    def __len__(self) -> int:
        return len(self.columns[0].values) if self.columns else 0

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(c.name for c in self.columns)

    def column(self, name: str) -> DataColumn:
        """The first column of this name; KeyError if there is none."""
        return {c.name: c for c in reversed(self.columns)}[name]

    def row(self, position: int) -> str:
        """A row as the file counts it: ``line 9``."""
        return f"{self.counts[0]} {self.counts[1] + position}"

    def rows(self, chosen: NDArray[Any]) -> DataTable:
        """Some of the rows, by their positions."""
        return replace(self, columns=tuple(replace(c, values=c.values[chosen]) for c in self.columns))


# --- headings and cells --------------------------------------------------------------------------------


def read_heading(text: str) -> tuple[str, str]:
    """Name and unit of ``name [unit]``, or of another way in which what should be the unit is one (see above)."""
    text = " ".join(text.split())
    if text.startswith("/'"):  # LabVIEW: /'group'/'name (unit)'
        text = re.sub(r"([\[(][^\[\]()]+[\])])'$", r"'\1", text)
    if (alone := _ALONE.fullmatch(text)) and is_unit(alone[1]):
        return "", alone[1]
    match = _HEADING.fullmatch(text)
    if match and match["inside"] is not None:
        return one_line(match["name"]), match["inside"].strip()
    if match:
        unit = (match["round"] or match["behind"] or match["over"]).strip()
        if is_unit(unit) or match["other"] in SI_UNITS:
            return one_line(match["other"]), unit
    return one_line(text), ""


def read_headings(texts: Sequence[str]) -> list[tuple[str, str]]:
    """Names and units of a header; of ``gyro[0]``, ``gyro[1]``, ``gyro[2]`` the numbers belong to the names."""
    found = [read_heading(t) for t in texts]
    numbered = Counter(name for name, unit in found if unit.isdigit())
    return [
        (one_line(text.strip()), "") if unit.isdigit() and numbered[name] > 1 else (name, unit)
        for text, (name, unit) in zip(texts, found, strict=True)
    ]


def read_units(cells: Sequence[str]) -> list[str] | None:
    """The units in a row below the names: each cell is a unit, perhaps in brackets, or empty; not all numbers.

    The first cell may name the row: ``Units``.
    """
    found = [re.sub(r"\s*(?:\[(.*)\]|\((.*)\)|'(.*)')\s*", r"\1\2\3", c).strip() for c in cells]
    found[:1] = ["" if re.fullmatch(r"units?:?", c, re.IGNORECASE) else c for c in found[:1]]
    return (
        found if all(not c or is_unit(c) for c in found) and any(c not in ("", "1") for c in found) else None
    )


def is_unit(text: str) -> bool:
    """Whether the text reads as a unit."""
    try:
        units(9.8).parse(text)  # whether a text is a unit does not depend on the model's g
    except UserError:
        return False
    return bool(text.strip())


def write_cell(cell: Any) -> str:
    """A cell as text: dates in ISO 8601, 1010 for 1010.0, nothing for ``None`` and NaN."""
    if str(cell) in ("None", "nan", "NaT", "<NA>"):
        return ""
    if isinstance(cell, bytes):
        cell = cell.decode("utf-8", "replace")
    if hasattr(cell, "isoformat"):
        return str(cell.isoformat())
    if isinstance(cell, float):
        return str(int(cell)) if cell.is_integer() and abs(cell) < 1e15 else repr(float(cell))
    return str(cell).strip("\0 \t\r\n")


# --- from arrays ---------------------------------------------------------------------------------------


Attributes = Mapping[str, Any]
"""What a file says about an array: ``units``, ``_FillValue``, ``valid_range``, names of columns."""

_TITLES = ("columns", "names", "fields", "colheaders", "labels", "channels")


def make_table(
    arrays: Iterable[tuple[Any, ...]],
    given: Mapping[str, str] | None = None,
    **about: Any,
) -> DataTable:
    """A table of those arrays that have the length of ``time`` (or the commonest one); notes say which have not.

    Parameters
    ----------
    arrays
        Name, array and perhaps attributes: (n,), or (n, m), (m, n) with m up to ``WIDEST``, which give ``name_1`` ... ``name_m`` (or
        ``a_x`` ... of a vector ``a``, or what m texts in an attribute or another array, such as ``colheaders``, say).
    given
        Units by name, besides those in the attributes and in the names.
    about
        Further fields of the table.
    """
    given, arrays = given or {}, [(n, _read_array(x), dict(*a)) for n, x, *a in arrays]
    numbers = [a for a in arrays if a[1].dtype.kind not in "OSUT"] or arrays  # texts may be names of columns
    sizes = [(read_heading(n)[0], max(x.shape)) for n, x, _ in numbers if _is_narrow(x.shape)]
    common = Counter(size for _, size in sizes if size > 1).most_common(1)
    length = next((size for n, size in sizes if n == "time" and size > 1), common[0][0] if common else 1)
    lists = {n: x for n, x, _ in arrays if n.casefold() in (*_TITLES, "units") and x.dtype.kind in "OSUT"}
    columns, other = [], []
    for name, x, attributes in arrays:
        fits = _is_narrow(x.shape) and length in x.shape
        values = decode_values(x, attributes) if fits else None
        if values is None:
            why = "neither numbers nor text" if fits else " x ".join(map(str, x.shape)) or "a single value"
            other += [f"{name!r} ({why})"] if name not in lists else []
            continue
        title, unit = read_heading(name)
        said = [
            t for k, v in attributes.items() if k.casefold() in ("units", "unit") and (t := _read_text(v))
        ]
        logical = x.dtype == np.bool_ or attributes.get("MATLAB_class") == b"logical"
        said = said or [unit or "1" * logical]
        for own, unit, part in _spread(title, values, length, {**lists, **attributes}):
            unit_of = given.get(own) or given.get(name) or given.get(title) or unit or said[0]
            columns.append(DataColumn(own, unit_of.strip(), part))
    notes = list(about.pop("notes", ()))
    if other:
        shown = ", ".join(other[:6]) + (" ..." if len(other) > 6 else "")
        notes.append(f"skipped, not of the {length} rows of the table: {one_line(shown)}")
    return DataTable(tuple(columns), notes=tuple(notes), **about)


def _read_array(x: Any) -> NDArray[Any]:
    """Anything as an array; what is masked holds nothing."""
    if isinstance(x, np.ma.MaskedArray) and x.dtype.kind in "biuf":
        return np.where(np.ma.getmaskarray(x), np.nan, x.data)
    try:
        return np.asarray(x)
    except ValueError:  # parts of several lengths
        return np.asarray(x, dtype=object)


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
        k.casefold(): [write_cell(t) for t in np.ravel(v)]
        for k, v in attributes.items()
        if np.ndim(v) and np.size(v) == width
    }
    plain = [name if width == 1 else f"{name}_{k}" for k in axes]
    titles = [read_heading(t) for t in next((lists[k] for k in _TITLES if k in lists), plain)]
    units = next((lists[k] for k in ("units", "unit") if k in lists), [""] * width)
    return [(n, u or own, x) for (n, own), u, x in zip(titles, units, values.T, strict=True)]


def read_attributes(thing: Any) -> dict[str, Any]:
    """The attributes of a dataset or group, as far as h5py can read them."""
    found = {}
    for name in list(thing.attrs):
        try:
            found[str(name)] = thing.attrs[name]
        except (OSError, RuntimeError, TypeError, ValueError, KeyError):
            continue  # of a type that h5py does not support
    return found


def decode_values(values: NDArray[Any], attributes: Mapping[str, Any]) -> NDArray[Any] | None:
    """Numbers as float64, text as objects, instants as they are; ``None`` for anything else.

    What the CF conventions call missing (2.5.1: ``_FillValue``, ``missing_value``, ``valid_range``, and NetCDF's
    default fill values) becomes NaN; ``scale_factor`` and ``add_offset`` are applied, ``flag_meanings`` give texts.
    """
    kind = values.dtype.kind
    if kind in "mM":
        return values.astype(f"{'datetime' if kind == 'M' else 'timedelta'}64[ns]")
    if kind == "i" and _read_text(attributes.get("_Unsigned")) == "true":  # NetCDF 3 has no unsigned numbers
        values, kind = values.view(values.dtype.str.replace("i", "u")), "u"
    if kind in "OSUT":
        return _decode_objects(values)
    if kind not in "biuf":
        return None
    meanings = _read_text(attributes.get("flag_meanings")).split()
    if meanings and kind in "iu" and values.ndim == 1:
        flags = np.atleast_1d(attributes.get("flag_values", np.arange(len(meanings)))).tolist()
        known = dict(zip(flags, meanings, strict=False))
        return np.array([known.get(int(v), str(v)) for v in values], dtype=object)
    numbers = {n: _read_numbers(attributes.get(n)) for n in attributes}
    nothing = [*numbers.get("_FillValue", ()), *numbers.get("missing_value", ())]
    if (fill := _DEFAULT_FILL.get(values.dtype.str[1:])) is not None and "DIMENSION_LIST" in attributes:
        nothing.append(fill)
    missing = (
        np.isin(values, np.array(nothing).astype(values.dtype)) if nothing else np.zeros(values.shape, bool)
    )
    packed = "scale_factor" in attributes or "add_offset" in attributes
    result: NDArray[Any] = values.astype(np.float64)
    if packed:
        factor, offset = (numbers.get(n, ()) for n in ("scale_factor", "add_offset"))
        result = result * next(iter(factor), 1.0) + next(iter(offset), 0.0)
    both = numbers.get("valid_range", [])
    low, high = (*both[:1], *numbers.get("valid_min", ())), (*both[-1:], *numbers.get("valid_max", ()))
    for limit, is_beyond in (*((x, np.less) for x in low), *((x, np.greater) for x in high)):
        # of packed whole numbers the range is one of whole numbers, or of what they encode (NUG, appendix A)
        encoded = packed and kind in "iu" and np.asarray(limit).dtype.kind == "f"
        missing |= is_beyond(result if encoded else values, limit)
    result[missing] = np.nan
    return result


def _decode_objects(values: NDArray[Any]) -> NDArray[Any] | None:
    """Texts; numbers and dates in an array of objects as such."""
    cells = values.tolist()
    there = [c for c in cells if write_cell(c)]
    if there and all(isinstance(c, Number) for c in there):
        return np.array([float(c) if isinstance(c, SupportsFloat) else np.nan for c in cells])
    if not all(isinstance(c, str | bytes | Number) or hasattr(c, "isoformat") for c in there):
        return None
    return np.array([write_cell(c) for c in cells], dtype=object)


def _read_text(value: object) -> str:
    """The text of an attribute; ``""`` where it is none."""
    if isinstance(value, np.ndarray) and value.size == 1:
        value = value.ravel()[0]
    return write_cell(value) if isinstance(value, str | bytes) else ""


def _read_numbers(value: object) -> list[Any]:
    """The numbers of an attribute; none where it is no number."""
    found = np.asarray(value)
    return [v for v in found.ravel() if np.isfinite(v)] if found.dtype.kind in "fiu" else []


# --- in memory -----------------------------------------------------------------------------------------


def tabulate(data: Any) -> list[DataTable]:
    """A DataFrame, a Dataset or a dict of arrays as a table; UserError for anything else."""
    if hasattr(data, "iloc") and hasattr(data, "columns"):
        return [_tabulate_frame(data)]
    if hasattr(data, "data_vars") and hasattr(data, "coords"):
        return [make_table((str(n), v.values, _unpack_range(v)) for n, v in data.variables.items())]
    if isinstance(data, Mapping):
        about = [data[n] for n in ("units", "attrs") if isinstance(data.get(n), Mapping)]
        arrays = ((str(n), *_read_series(v)) for n, v in data.items() if not isinstance(v, Mapping))
        return [make_table(arrays, read_frame_units(about[0] if about else {}))]
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
    if not hasattr(series, "to_numpy") or not hasattr(series, "index"):
        return series, getattr(series, "attrs", {})
    dtype = series.dtype
    if getattr(dtype, "tz", None) is not None:
        series = series.dt.tz_convert("UTC").dt.tz_localize(None)
    if str(dtype) == "category":
        series = series.astype(object)
    series = series.infer_objects()
    numeric = getattr(series.dtype, "kind", "O") in "iufb"
    values = series.to_numpy(dtype=np.float64, na_value=np.nan) if numeric else series.to_numpy()
    return values if values.dtype.kind != "T" else values.astype(object), series.attrs


def read_frame_units(attributes: Mapping[Any, Any]) -> dict[str, str]:
    """Units that a DataFrame carries in ``attrs``: under ``units``, or name -> unit or name -> {units: unit}."""
    inside = attributes.get("units")
    found = {}
    for name, unit in (inside if isinstance(inside, Mapping) else attributes).items():
        value = unit.get("units", unit.get("unit")) if isinstance(unit, Mapping) else unit
        if isinstance(value, str):
            found[str(name)] = value.strip()
    return found


def digest_tables(tables: Sequence[DataTable]) -> str:
    """SHA-256 of what tables hold, for flights that have no file."""
    total = hashlib.sha256()
    for c in (c for t in tables for c in t.columns):
        total.update(f"{c.name} [{c.unit}] {c.values.dtype.kind}\n".encode("utf-8", "replace"))
        total.update("\n".join(c.values).encode("utf-8", "replace") if c.is_text else c.values.tobytes())
    return total.hexdigest()


# --- several tables, several lines ---------------------------------------------------------------------


def choose_tables(
    tables: Sequence[DataTable], where: Path | str, wanted: frozenset[str], part: str | None = None
) -> list[DataTable]:
    """The tables that are meant: those of ``part``, with all columns that are wanted or with time; several alike are lines."""
    found = [t for t in tables if t.columns]
    if part is not None:
        name = part.strip("/")
        found = [t for t in found if f"{t.part.strip('/')}/".startswith(f"{name}/")]
    if _count_kinds(found) > 1:
        found = [t for t in found if wanted <= {*t.names}] or [t for t in found if "time" in t.names] or found
    if len(found) == 1:
        return [replace(found[0], line=None)]
    if _count_kinds(found) == 1:
        return found
    parts = [t.part or "/" for t in found]
    raise UserError(
        "the file holds several tables that differ" if found else "the file holds no table",
        where=where,
        found=", ".join(parts[:12]) + (" ..." if len(parts) > 12 else "") or None,
        expected="vectors of one length in one place, or in groups of equal structure"
        if part is None
        else part,
        remedy="choose one in a mapping: [file] part = ...",
    )


def _count_kinds(tables: Sequence[DataTable]) -> int:
    """How many sets of columns there are."""
    return len({tuple(sorted(t.names)) for t in tables})


def split_lines(tables: Sequence[DataTable], column: str | None, where: Path | str | None) -> list[DataTable]:
    """A table for each line, in the order in which they begin; the rows of one need not be contiguous."""
    if len(tables) != 1:
        return list(tables)
    (table,) = tables
    name = column or next((n for n in table.names if n.casefold() == "line"), None)
    if name is None:
        return [table]
    values = table.column(name).values
    different, first, inverse = np.unique(
        values.astype(str) if values.dtype.kind == "O" else values, return_index=True, return_inverse=True
    )
    texts = [name_line(v) for v in different]
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
        note = f"{count(lost, 'row')} without the name of a line left out"
        rest = replace(rest, notes=(*rest.notes, note))
    elif len(named) == 1:
        return [rest]
    order = np.argsort(which, kind="stable")
    edges = np.searchsorted(which[order], np.arange(len(named) + 1))
    return [
        replace(rest.rows(order[a:b]), line=text) for text, a, b in zip(named, edges, edges[1:], strict=False)
    ]


def name_line(value: object) -> str:
    """The name of a line: 1010 of 1010.0, in numbers or in text; ``""`` where there is none."""
    try:
        number = float(str(value))
    except ValueError:
        return write_cell(value)
    return write_cell(number) if np.isfinite(number) else ""


def join_groups(tables: Sequence[DataTable]) -> list[DataTable]:
    """Groups in groups as one table: what has as many rows, and no name in common, is a part of the record around it.

    A record that has all of the motion needs nothing further, and columns besides it may have no units. Groups of one
    channel each that share their time are one record, too.
    """
    found: dict[str, DataTable] = {}
    for t in tables:
        place = t.part.strip("/")
        around = place
        while around and (around not in found):
            around = around.rpartition("/")[0]
        outer = found.get(around)
        if (
            outer is None
            or around == place
            or len(outer) != len(t)
            or {*outer.names} & {*t.names}
            or ({*SPECIFIC_FORCE, *ANGULAR_RATE} <= {*outer.names} and "[" not in place)
        ):
            found[place] = t
            continue
        stem = place.removeprefix(around).strip("/")
        own = (_name_inside(stem, c, outer.names) for c in t.columns)
        found[around] = replace(outer, columns=(*outer.columns, *own), notes=(*outer.notes, *t.notes))
    return _join_channels(list(found.values()))


def _name_inside(stem: str, c: DataColumn, taken: Sequence[str]) -> DataColumn:
    """A column of a group that belongs to a record: behind the group's name, unless its own is the contract's and free. Of a name such as
    ``omega_x [deg/h]`` HDF5 makes a group.
    """
    if c.name in SI_UNITS and c.name not in taken:
        return c
    if "[" not in stem:
        return replace(c, name=f"{stem}_{c.name}".replace("/", "_"))
    name, unit = read_heading(f"{stem}/{c.name}")
    return replace(c, name=name, unit=unit)


def _join_channels(tables: list[DataTable]) -> list[DataTable]:
    """Tables of the same instants, without other names in common, as one: a single channel is called as its group."""
    times = [next((c for c in t.columns if c.name.casefold() in ("time", "t")), None) for t in tables]
    first = times[0] if len(times) > 1 else None
    if first is None or not all(c is not None and np.array_equal(c.values, first.values) for c in times):
        return tables
    own = [
        replace(c, name=t.part.rpartition("/")[2]) if len(t.columns) == 2 and c.name not in SI_UNITS else c
        for t, time in zip(tables, times, strict=True)
        for c in t.columns
        if c is not time
    ]
    if len({c.name for c in own}) < len(own):
        return tables
    return [replace(tables[0], columns=(replace(first, name="time"), *own), line=None, part="")]


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
    """Bytes that can be had without swapping; ``None`` where the system does not report it."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            return next(float(x.split()[1]) * 1024 for x in lines if x.startswith("MemAvailable:"))
    except (OSError, StopIteration, ValueError):
        return None  # on other systems NumPy raises its own MemoryError
