"""HDF5 flights: datasets of one length at the root or in a group; groups with the same names are lines.

That is also how geoWhizz files, NetCDF-4 with groups and MATLAB 7.3 look. The unit is the dataset's attribute
``units`` (or ``Units``).
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import require_room
from ragg_runtime.flight.shapes import Place, places
from ragg_runtime.flight.source import Heading, Look, RawBatch, Table, Written, chosen, distinct, heading

if TYPE_CHECKING:
    import h5py

NAME = "hdf5"
ENDINGS = (".h5", ".hdf5", ".hdf", ".he5")
MAGIC = (b"\x89HDF\r\n\x1a\n",)

MOST_NUMBERS = 1 << 33
"""Numbers of one dataset that are read at most: 64 GB in float64. A few bytes of a file may claim any number."""

_BATCH = 1 << 18
_UNITS = ("units", "Units", "UNITS", "unit", "Unit")
_DIMENSION = "This is a netCDF dimension but not a netCDF variable"

UnitOf = Callable[["h5py.Dataset"], str]


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The tables of an HDF5 file: one, or one for each line."""
    return tables_of(path, look, unit_of)


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write columns as float64 datasets with their units: at the root, or in a group for each line."""
    import h5py  # slow to import, and only files built on HDF5 need it

    from ragg_runtime.flight.hdf5_attributes import write_text

    require_room(path, room_for(tables))
    with h5py.File(path, "w", track_order=True) as file:
        for number, table in enumerate(tables):
            group = file
            if table.line is not None:
                group = file.create_group(f"lines/{_plain(table.line, number)}", track_order=True)
                write_text(group, "line", table.line)
            for column, values in table.columns:
                data = group.create_dataset(_plain(column.name, 0), data=np.asarray(values))
                write_text(data, "name", column.name)
                if column.unit:
                    write_text(data, "units", column.unit)


COLUMN, TABLE = 8192, 1 << 16
"""Bytes that a column takes beside its numbers, and a table beside its columns, with room to spare."""


def room_for(tables: Sequence[Written]) -> int:
    """Bytes that a file of these tables takes at most."""
    return room([np.asarray(v).size for t in tables for _, v in t.columns], len(tables) + 1)


def room(sizes: Sequence[int], tables: int = 1) -> int:
    """Bytes that columns of so many numbers take at most."""
    return TABLE * tables + sum(8 * n + COLUMN for n in sizes)


def tables_of(path: Path, look: Look, unit: UnitOf) -> list[Table]:
    """The tables of any file built on HDF5, with a function that finds a dataset's unit."""
    with opened(path) as file:
        found = [t for t in _groups(file, look, unit, path) if t.columns]
    found = chosen(path, found, look)
    return [
        Table(path, t.headings(), lambda t=t: _batches(path, t), t.line if len(found) > 1 else None)  # type: ignore[misc]
        for t in found
    ]


@dataclass(frozen=True)
class Group:
    """A group that is a table: its place in the file, its length and columns, the name of the line it may be."""

    place: str
    line: str
    length: int
    columns: tuple[tuple[Heading, Place], ...]

    def headings(self) -> tuple[Heading, ...]:
        return tuple(h for h, _ in self.columns)


def unit_of(data: h5py.Dataset) -> str:
    """The unit in a dataset's attributes; ``""`` if there is none."""
    from ragg_runtime.flight.hdf5_attributes import text_of

    return next((t for t in (text_of(data, n) for n in _UNITS) if t), "")


@contextlib.contextmanager
def opened(path: Path, *, checked: bool = False) -> Iterator[h5py.File]:
    """The file for reading, with nothing in it that reaches out; UserError if it is damaged, here or later."""
    import h5py  # slow to import, and only files built on HDF5 need it

    from ragg_runtime.flight.hdf5_self_contained import refuse_elsewhere

    try:
        if not checked:
            refuse_elsewhere(path)
        with h5py.File(path, "r") as file:
            yield file
    except (OSError, RuntimeError, ValueError, KeyError, TypeError, AttributeError) as error:
        # What h5py raises for files that were damaged on purpose is not documented.
        raise damaged(path, error) from None


def damaged(path: Path, error: Exception) -> UserError:
    return UserError(
        "the HDF5 file is damaged",
        where=path,
        found=str(error).split("\n", 1)[0][:200],
        expected="a whole HDF5 file",
        remedy="copy it again",
    )


def _groups(file: h5py.File, look: Look, unit: UnitOf, path: Path) -> Iterator[Group]:
    import h5py  # slow to import, and only files built on HDF5 need it

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
            if name.startswith("#") or isinstance(group.get(name, getlink=True), h5py.SoftLink):
                continue  # what MATLAB keeps for itself; and what stands elsewhere too
            item = group[name]
            if isinstance(item, h5py.Group):
                waiting.append((f"{place}/{name}", item))
            elif isinstance(item, h5py.Dataset) and _is_column(item, look):
                arrays[name] = item
        yield _group(place, group, arrays, look, unit, path)


def _group(
    place: str, group: h5py.Group, arrays: Mapping[str, h5py.Dataset], look: Look, unit: UnitOf, path: Path
) -> Group:
    from ragg_runtime.flight.hdf5_attributes import matlab_text, text_of

    if look.only is not None:
        wanted = look.only | {n.rsplit("_", 1)[0] for n in look.only}
        arrays = {n: d for n, d in arrays.items() if n in wanted or text_of(d, "name") in wanted}
    for name, data in arrays.items():
        if math.prod(data.shape) > MOST_NUMBERS:
            raise UserError(
                "the dataset is out of all proportion",
                where=f"{path}: {place}/{name}",
                found=f"{math.prod(data.shape)} numbers",
                expected=f"at most {MOST_NUMBERS}",
            )
    length, found = places({n: d.shape for n, d in arrays.items()}, f"{path}: {place or '/'}")
    columns = []
    for number, p in enumerate(found, 1):
        data = arrays[p.array]
        own = (text_of(data, "name") if p.column == p.array else "") or p.column
        h = heading(own, path, number)
        text = data.dtype.kind in "SOU"
        if look.wants(h.name) and (not text or look.allows_text(h.name)):
            columns.append((Heading(h.name, unit(data).split(" since ")[0] or h.unit, text), p))
    distinct(path, [h for h, _ in columns])
    name = text_of(group, "line") or matlab_text(group.get("line")) or place.rsplit("/", 1)[-1]
    return Group(place=place, line=name, length=length, columns=tuple(columns))


def _is_column(data: h5py.Dataset, look: Look) -> bool:
    import h5py  # slow to import, and only files built on HDF5 need it

    from ragg_runtime.flight.hdf5_attributes import text_of

    kind = data.dtype.kind
    if kind == "O" and h5py.check_string_dtype(data.dtype) is None:
        return False  # references and sequences
    if _DIMENSION in text_of(data, "NAME") or text_of(data, "MATLAB_class") == "char":
        return False  # MATLAB keeps texts as numbers
    return data.shape is not None and (kind in "fiu" or (kind in "SO" and len(data.shape) == 1))


def _batches(path: Path, table: Group) -> Iterator[RawBatch]:
    with opened(path, checked=True) as file:
        group = file[table.place or "/"]
        for start in range(0, table.length, _BATCH):
            stop = min(start + _BATCH, table.length)
            yield {h.name: _values(group[p.array], p, h, start, stop) for h, p in table.columns}


def _values(data: h5py.Dataset, place: Place, column: Heading, start: int, stop: int) -> NDArray[Any]:
    from ragg_runtime.flight.hdf5_attributes import number_of, plain

    if column.text:
        return np.array([plain(t) for t in data[start:stop]], dtype=object)
    raw = place.rows(data, start, stop)
    values = raw.astype(np.float64)
    for name in ("_FillValue", "missing_value"):
        nothing = number_of(data, name)
        if nothing is not None:
            values[raw == np.asarray(nothing).astype(raw.dtype)] = np.nan
    for name, apply in (("scale_factor", np.multiply), ("add_offset", np.add)):
        factor = number_of(data, name)
        if factor is not None and np.isfinite(factor):
            values = apply(values, factor)
    return values


def _plain(name: str, number: int) -> str:
    """A name that HDF5 allows: no slash, not a point alone."""
    plain = name.replace("/", "_").replace("\0", "_").strip()
    return plain if plain.strip(".") else f"_{number}"
