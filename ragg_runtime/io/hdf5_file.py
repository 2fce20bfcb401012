"""HDF5 flights: datasets of one length at the root or in a group; groups with the same names are lines.

That is also how geoWhizz files, NetCDF-4 and MATLAB 7.3 look. The unit is the dataset's attribute ``units`` (or ``Units``).
"""

from __future__ import annotations

import contextlib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.io.source import Heading, Look, Rows, Table, chosen, distinct, heading

if TYPE_CHECKING:
    import h5py


WIDEST = 16
"""Columns of one array that are taken apart: accelerations along three axes, voltages of a few discs."""

Shape = tuple[int, ...]


@dataclass(frozen=True)
class Place:
    """Where a column lies in an array: along ``axis``, at ``index`` of the other one (``None``: it has none)."""

    array: str
    column: str
    axis: int
    index: int | None

    def of(self, data: Any) -> NDArray[Any]:
        """(N,): the column of the array."""
        x = np.asarray(data)
        return x if self.index is None else np.take(x, self.index, axis=1 - self.axis)


def places(shapes: Mapping[str, Shape], where: str | Path) -> list[Place]:
    """The columns of the table that arrays of these shapes make up; arrays of few columns or rows give ``name_1`` ..."""
    tables = {n: s for n, s in shapes.items() if len(s) == 1 or (len(s) == 2 and min(s) <= WIDEST)}
    longest = {n: max(s) for n, s in tables.items() if max(s) > 1}
    if not longest:
        return []
    length = longest.get("time") or Counter(longest.values()).most_common(1)[0][0]
    found = []
    for name, size in longest.items():
        if size != length:
            raise UserError(
                "the columns differ in length",
                where=where,
                found=f"{name!r} has {size} rows, others {length}",
                expected="one length for all that is needed of the file",
                remedy="name the columns that are needed in a mapping: ragg map FLIGHT -o mapping.toml",
            )
        found += _spread(name, shapes[name], length)
    return found


def _spread(name: str, shape: Shape, length: int) -> list[Place]:
    if len(shape) == 1:
        return [Place(array=name, column=name, axis=0, index=None)]
    axis = 0 if shape[0] == length else 1
    width = shape[1 - axis]
    names = [name] if width == 1 else [f"{name}_{k}" for k in range(1, width + 1)]
    return [Place(array=name, column=n, axis=axis, index=k) for k, n in enumerate(names)]


NAME = "hdf5"
ENDINGS = (".h5", ".hdf5", ".hdf", ".he5")
MAGIC = (b"\x89HDF\r\n\x1a\n",)

_UNITS = ("units", "Units", "UNITS", "unit", "Unit")
_DIMENSION = "This is a netCDF dimension but not a netCDF variable"

UnitOf = Callable[["h5py.Dataset"], str]


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The tables of an HDF5 file: one, or one for each line."""
    return tables_of(path, look, unit_of)


def tables_of(path: Path, look: Look, unit: UnitOf) -> list[Table]:
    """The tables of any file built on HDF5, with a function that finds a dataset's unit."""
    with opened(path) as file:
        found = list(_groups(file, look, unit, path))
    return chosen(path, found, look)


def unit_of(data: h5py.Dataset) -> str:
    """The unit in a dataset's attributes; ``""`` if there is none."""
    return next((t for t in (text_of(data, n) for n in _UNITS) if t), "")


@contextlib.contextmanager
def opened(path: Path) -> Iterator[h5py.File]:
    """The file for reading; UserError if it is damaged, here or later."""
    import h5py  # slow to import, and only files built on HDF5 need it

    try:
        with h5py.File(path, "r") as file:
            yield file
    except (OSError, RuntimeError, ValueError, KeyError, TypeError, AttributeError, MemoryError) as error:
        # What h5py raises for damaged files is not documented.
        raise UserError(
            "the HDF5 file is damaged",
            where=path,
            found=str(error).split("\n", 1)[0][:200],
            expected="a whole HDF5 file",
            remedy="copy it again",
        ) from None


def _groups(file: h5py.File, look: Look, unit: UnitOf, path: Path) -> Iterator[Table]:
    import h5py

    waiting: list[tuple[str, h5py.Group]] = [("", file)]
    seen = set()  # groups may stand in each other, round in a circle
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
        yield _group(place, group, arrays, look, unit, path)


def _group(
    place: str, group: h5py.Group, arrays: Mapping[str, h5py.Dataset], look: Look, unit: UnitOf, path: Path
) -> Table:
    """The group as a table, perhaps without columns; it may be a line."""
    if look.only is not None:
        wanted = look.only | {n.rsplit("_", 1)[0] for n in look.only}
        arrays = {n: d for n, d in arrays.items() if n in wanted or text_of(d, "name") in wanted}
    columns = []
    for number, p in enumerate(places({n: d.shape for n, d in arrays.items()}, f"{path}: {place or '/'}"), 1):
        data = arrays[p.array]
        own = (text_of(data, "name") if p.column == p.array else "") or p.column
        h = heading(own, path, number)
        text = data.dtype.kind in "SOU" or bool(h.name == "line" and text_of(data, "flag_meanings"))
        if look.wants(h.name) and (not text or look.allows_text(h.name)):
            columns.append((Heading(h.name, unit(data).split(" since ")[0] or h.unit, text), p))
    headings = distinct(path, [h for h, _ in columns])
    name = text_of(group, "line") or matlab_text(group.get("line")) or place.rsplit("/", 1)[-1]
    return Table(path, headings, partial(_rows, path, place, columns), name, place)


def _is_column(data: h5py.Dataset) -> bool:
    """Whether a dataset holds numbers or texts of its own, not those of another file."""
    import h5py

    kind = data.dtype.kind
    if kind == "O" and h5py.check_string_dtype(data.dtype) is None:
        return False  # references and sequences
    if _DIMENSION in text_of(data, "NAME") or text_of(data, "MATLAB_class") == "char":
        return False  # MATLAB keeps texts as numbers
    if data.is_virtual or data.external:
        return False
    return data.shape is not None and (kind in "fiu" or (kind in "SO" and len(data.shape) == 1))


def _rows(path: Path, place: str, columns: Sequence[tuple[Heading, Place]]) -> Rows:
    with opened(path) as file:
        group = file[place or "/"]
        return {h.name: _values(group[p.array], p, h) for h, p in columns}


def _values(data: h5py.Dataset, place: Place, column: Heading) -> NDArray[Any]:
    names = text_of(data, "flag_meanings").split()  # of numbered lines (CF conventions, 3.5)
    if column.text and not names:
        return np.array([_plain(t) for t in data[()]], dtype=object)
    raw = place.of(data[()])
    if column.text:
        return np.array([names[int(k)] if 0 <= k < len(names) else str(k) for k in raw], dtype=object)
    values = raw.astype(np.float64)
    for name in ("_FillValue", "missing_value"):
        nothing = _number_of(data, name)
        if nothing is not None:
            values[raw == np.asarray(nothing).astype(raw.dtype)] = np.nan
    for name, apply in (("scale_factor", np.multiply), ("add_offset", np.add)):
        factor = _number_of(data, name)
        if factor is not None and np.isfinite(factor):
            values = apply(values, factor)
    return values


def text_of(thing: h5py.Dataset | h5py.Group, name: str) -> str:
    """The text of an attribute; ``""`` if there is none of that name that is one text."""
    return _plain(_attribute(thing, name))


def _number_of(thing: h5py.Dataset, name: str) -> float | None:
    """The number of an attribute; ``None`` if there is none of that name that is one number."""
    value = np.asarray(_attribute(thing, name))
    return float(value.ravel()[0]) if value.size == 1 and value.dtype.kind in "fiu" else None


def _attribute(thing: h5py.Dataset | h5py.Group, name: str) -> object:
    try:
        return thing.attrs.get(name)
    except (OSError, RuntimeError, TypeError, ValueError, KeyError):
        return None  # of a type that h5py does not know


def _plain(value: object) -> str:
    """Text of an attribute or a cell; ``""`` where it is none."""
    if isinstance(value, np.ndarray) and value.size == 1:
        value = value.ravel()[0]
    if isinstance(value, bytes):
        value = value.decode("utf-8", "replace")
    return value.strip("\0 \t\r\n") if isinstance(value, str) else ""


LONGEST_TEXT = 200
"""Characters of a unit or the name of a line in a MATLAB file: what is longer is neither."""


def matlab_text(item: object) -> str:
    """The text that MATLAB keeps in a dataset, as numbers; ``""`` where there is none, or no short one."""
    import h5py

    if not isinstance(item, h5py.Dataset) or item.dtype.kind not in "ui" or not 0 < item.size <= LONGEST_TEXT:
        return ""
    return "".join(
        chr(int(c)) for c in np.asarray(item[()]).ravel(order="F") if 0 < int(c) < 0x110000
    ).strip()
