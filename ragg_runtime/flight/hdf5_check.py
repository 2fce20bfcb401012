"""What an HDF5 file of a stranger may hold, whatever format is built on it (NetCDF-4, MATLAB 7.3, plain groups).

A dataset may name other files on this machine as the place of its numbers, a link may lead into another file,
and a virtual dataset may be put together from others: whoever opens the file would read them with the rights of
its user. None of that belongs into a flight.
"""

from __future__ import annotations

import math
from pathlib import Path

import h5py

from ragg_runtime.base.errors import UserError

MOST_OBJECTS = 200_000
"""Groups and datasets of a file, beyond which it is no record: a survey of 2,000 lines has 30 in each."""

DEEPEST = 8
"""Nested groups, beyond which a file is no record."""

MOST_NUMBERS = 1 << 33
"""Numbers of one dataset that are read at most: 64 GB in float64."""


def refuse_foreign(file: h5py.File, path: Path) -> None:
    """UserError if anything in the file reaches out of it, or if it is out of all proportion."""
    count = 0
    waiting: list[tuple[str, h5py.Group, int]] = [("", file, 0)]
    while waiting:
        place, group, depth = waiting.pop()
        for name in group:
            inside = f"{place}/{name}"
            count += 1
            if count > MOST_OBJECTS or depth > DEEPEST:
                raise UserError(
                    "the HDF5 file is no record",
                    where=path,
                    found=f"more than {MOST_OBJECTS} objects"
                    if count > MOST_OBJECTS
                    else f"{inside[:80]} ...",
                    expected=f"at most {MOST_OBJECTS} groups and datasets, {DEEPEST} groups deep",
                )
            link = group.get(name, getlink=True)
            if isinstance(link, h5py.ExternalLink):
                raise _foreign(path, inside, f"a link into the file {link.filename!r}")
            if not isinstance(link, h5py.HardLink):
                continue  # a soft link leads to what is looked at where it stands, or to nothing
            item = group.get(name)
            if isinstance(item, h5py.Group):
                waiting.append((inside, item, depth + 1))
            elif isinstance(item, h5py.Dataset):
                _check_dataset(item, path, inside)


def _check_dataset(data: h5py.Dataset, path: Path, place: str) -> None:
    if data.external:
        raise _foreign(path, place, f"its numbers lie in the file {data.external[0][0]!r}")
    if data.is_virtual:
        raise _foreign(path, place, "it is put together from other datasets (virtual)")
    if data.shape is not None and math.prod(data.shape) > MOST_NUMBERS:
        raise UserError(
            "the dataset is out of all proportion",
            where=f"{path}: {place}",
            found=f"{math.prod(data.shape)} numbers",
            expected=f"at most {MOST_NUMBERS}",
        )


def _foreign(path: Path, place: str, what: str) -> UserError:
    return UserError(
        "the HDF5 file reaches out of itself",
        where=f"{path}: {place}",
        found=what,
        expected="all numbers of a flight in its own file",
        remedy="have it written as one file (h5repack does that), if you trust where it comes from",
    )
