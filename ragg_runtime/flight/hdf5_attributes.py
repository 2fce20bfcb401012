"""Attributes of HDF5 objects, read only where they are what is expected: the library may crash on types that are not."""

from __future__ import annotations

import h5py
import numpy as np

LONGEST = 4096
"""Bytes of an attribute that are read at most: units and names are short."""


def text_of(thing: h5py.Dataset | h5py.Group, name: str) -> str:
    """The text of an attribute; ``""`` if there is none of that name that is one text."""
    return plain(thing.attrs[name]) if _is(thing, name, (h5py.h5t.STRING,)) else ""


def write_text(thing: h5py.Dataset | h5py.Group, name: str, text: str) -> None:
    """Write an attribute of fixed length: what is damaged in texts of any length can make the library hang."""
    data = text.encode()
    thing.attrs.create(name, np.array(data), dtype=h5py.string_dtype("utf-8", max(len(data), 1)))


def number_of(thing: h5py.Dataset | h5py.Group, name: str) -> float | None:
    """The number of an attribute; ``None`` if there is none of that name that is one number."""
    if not _is(thing, name, (h5py.h5t.INTEGER, h5py.h5t.FLOAT)):
        return None
    return float(np.asarray(thing.attrs[name]).ravel()[0])


def plain(value: object) -> str:
    """Text of an attribute or a cell; ``""`` where it is none."""
    if isinstance(value, np.ndarray) and value.size == 1:
        value = value.ravel()[0]
    if isinstance(value, bytes):
        value = value.decode("utf-8", "replace")
    return value.strip("\0 \t\r\n") if isinstance(value, str) else ""


def _is(thing: h5py.Dataset | h5py.Group, name: str, classes: tuple[int, ...]) -> bool:
    key = name.encode()
    if not h5py.h5a.exists(thing.id, key):
        return False
    attribute = h5py.h5a.open(thing.id, key)
    space = attribute.get_space()
    return bool(
        attribute.get_type().get_class() in classes
        and space.get_simple_extent_type() != h5py.h5s.NULL
        and space.get_simple_extent_npoints() == 1
        and attribute.get_storage_size() <= LONGEST
    )


def matlab_text(item: object) -> str:
    """The text that MATLAB keeps in a dataset, as numbers; ``""`` where there is none, or no short one."""
    if not isinstance(item, h5py.Dataset) or item.dtype.kind not in "ui" or not 0 < item.size <= LONGEST_TEXT:
        return ""
    return "".join(
        chr(int(c)) for c in np.asarray(item[()]).ravel(order="F") if 0 < int(c) < 0x110000
    ).strip()


LONGEST_TEXT = 200
"""Characters of a unit or the name of a line in a MATLAB file: what is longer is neither."""
