"""A flight file as it stands: columns with the file's own units, in batches of rows."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.record import Array

Batch = Mapping[str, Array]

FORMATS: Mapping[str, str] = {
    ".csv": "csv",
    ".csv.gz": "csv",
    ".parquet": "parquet",
    ".pq": "parquet",
    ".nc": "netcdf",
    ".nc4": "netcdf",
    ".h5": "netcdf",
    ".hdf5": "netcdf",
}
"""File name endings and the format that they stand for."""

_MAGIC = (
    (b"PAR1", "parquet"),
    (b"\x89HDF\r\n\x1a\n", "netcdf"),
    (b"CDF", "classic NetCDF"),
    (b"PK\x03\x04", "zip or Excel"),
)
_GZIP = b"\x1f\x8b"
_HEADER = re.compile(r"\s*(?P<name>[^\[\]]+?)\s*(?:\[(?P<unit>[^\[\]]*)\]\s*)?")


@dataclass(frozen=True)
class Column:
    """A column's name and the unit that the file gives it."""

    name: str
    unit: str


@dataclass(frozen=True)
class Source:
    """A flight file: its columns, and a function that yields its rows (float64, NaN where nothing stands)."""

    path: Path
    columns: tuple[Column, ...]
    batches: Callable[[], Iterator[Batch]]


def format_of(path: Path) -> str:
    """``csv``, ``parquet`` or ``netcdf`` by the ending of the name; UserError for any other."""
    name = path.name.lower()
    for suffix in sorted(FORMATS, key=len, reverse=True):
        if name.endswith(suffix):
            return FORMATS[suffix]
    raise UserError(
        "the ending of the file name stands for no flight format",
        where=path,
        found=path.suffix or "no ending",
        expected=", ".join(FORMATS),
        remedy="save the record in one of these formats",
    )


def check_content(path: Path, expected: str) -> bool:
    """Compare the first bytes of an existing file with its format; True if it is compressed (gzip)."""
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise UserError(
            "a flight file is needed here, not a device or a pipe",
            where=path,
            expected="a regular file",
            remedy="write the record to a file first",
        )
    try:
        with path.open("rb") as stream:
            head = stream.read(8)
    except FileNotFoundError:
        raise UserError(
            "the flight file does not exist",
            where=path,
            expected="a CSV, Parquet or NetCDF file",
            remedy="check the name and the folder",
        ) from None
    except IsADirectoryError:
        raise UserError(
            "a flight file is needed here, not a directory", where=path, remedy="name the files in it"
        ) from None
    except OSError as error:
        raise UserError("the flight file cannot be read", where=path, found=error.strerror) from None
    if not head:
        raise UserError(
            "the flight file is empty",
            where=path,
            found="0 bytes",
            expected="a header of names and units, then rows",
            remedy="the recording or the copy may have failed: get the file again",
        )
    found = next((kind for magic, kind in _MAGIC if head.startswith(magic)), "csv")
    if found != expected:
        raise UserError(
            "the content does not fit the ending of the file name",
            where=path,
            found="neither Parquet nor NetCDF" if found == "csv" else f"a {found} file",
            expected=expected,
            remedy="rename the file, or save it as CSV, Parquet or NetCDF-4",
        )
    return head.startswith(_GZIP)


def columns_of(path: Path, headers: Sequence[tuple[str, str | None]]) -> tuple[Column, ...]:
    """Columns from pairs of header and unit; where the unit is None it is in the header, ``name [unit]``."""
    found: list[Column] = []
    for number, (header, unit) in enumerate(headers, 1):
        match = _HEADER.fullmatch(header)
        if match is None:
            raise UserError(
                f"column {number} has no readable name",
                where=path,
                found=repr(header),
                expected="name [unit], such as a_x [g]",
            )
        name, given = match["name"], (match["unit"] if unit is None else unit)
        if given is None or not given.strip():
            raise UserError(
                "the column has no unit",
                where=f"{path}: column {name!r}",
                found=repr(header),
                expected=f"{name} [unit], such as {name} [{_EXAMPLES.get(name.split('_')[0], 'K')}]",
                remedy="write the unit; a pure number has the unit 1; none is guessed",
            )
        if any(c.name == name for c in found):
            raise UserError(
                f"the column {name!r} stands there twice", where=path, remedy="remove or rename one"
            )
        found.append(Column(name, given.strip()))
    return tuple(found)


_EXAMPLES = {
    "time": "s",
    "a": "g",
    "omega": "deg/h",
    "omegadot": "rad/s^2",
    "Gamma": "Eo",
    "G": "V",
    "V": "V",
    "inline": "Eo",
    "cross": "Eo",
}
