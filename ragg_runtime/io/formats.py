"""The file formats: one module each, one line here.

A module has a ``NAME`` for messages, ``ENDINGS`` of file names, ``MAGIC`` (what files begin with; none for text) and
``open_tables(path, look)``; one that is written has ``write_tables(path, tables)``, which keeps every bit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType, ModuleType

from ragg_runtime.base.errors import UserError
from ragg_runtime.io import (
    csv_file,
    excel_file,
    hdf5_file,
    mat_file,
    netcdf_file,
    parquet_file,
)
from ragg_runtime.io.source import Look, Table

ALL: Sequence[ModuleType] = (
    csv_file,
    parquet_file,
    netcdf_file,
    hdf5_file,
    mat_file,
    excel_file,
)

ENDINGS: Mapping[str, ModuleType] = MappingProxyType({e: f for f in ALL for e in f.ENDINGS})
"""File name endings and the format that they stand for."""

_FOREIGN = ((b"CDF", "classic NetCDF"), (b"\xd0\xcf\x11\xe0", "old Excel (.xls)"))
_SNIFFED = 8


def format_of(path: Path) -> ModuleType:
    """The format by the ending of the name; UserError for any other."""
    ending = ending_of(path.name)
    if ending is not None:
        return ENDINGS[ending]
    raise UserError(
        "no flight format has this file name ending",
        where=path,
        found=path.suffix or "no ending",
        expected=", ".join(ENDINGS),
        remedy="save the record in one of these formats",
    )


def writable(path: Path) -> ModuleType:
    """The same for a file to be written; UserError for formats that are read alone."""
    kind = format_of(path)
    if hasattr(kind, "write_tables"):
        return kind
    raise UserError(
        f"{kind.NAME} files are read, not written",
        where=path,
        expected=", ".join(e for f in ALL if hasattr(f, "write_tables") for e in f.ENDINGS),
        remedy="choose one of these formats",
    )


def ending_of(name: str) -> str | None:
    """The longest known ending of a file name."""
    return next((e for e in sorted(ENDINGS, key=len, reverse=True) if name.lower().endswith(e)), None)


def open_file(path: Path, look: Look) -> Sequence[Table]:
    """The tables of a file, by the ending of its name and its content."""
    kind = format_of(path)
    check_content(path, kind)
    tables: Sequence[Table] = kind.open_tables(path, look)
    return tables


def check_content(path: Path, expected: ModuleType) -> None:
    """Compare the first bytes of an existing file with its format."""
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise UserError(
            "a flight file is needed here, not a device or a pipe",
            where=path,
            expected="a regular file",
            remedy="write the record to a file first",
        )
    try:
        with path.open("rb") as stream:
            head = stream.read(_SNIFFED)
    except FileNotFoundError:
        raise UserError(
            "the flight file does not exist",
            where=path,
            expected="a CSV, Parquet or NetCDF file, or another that `ragg convert` reads",
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
    names = [f.NAME for f in ALL if any(head.startswith(m) for m in f.MAGIC)]
    names += [name for magic, name in _FOREIGN if head.startswith(magic)]
    if (expected.NAME in names) if expected.MAGIC else not names:
        return
    raise UserError(
        "the content does not fit the ending of the file name",
        where=path,
        found=f"{' or '.join(names)}, by its first bytes" if names else "text, or a format that is not known",
        expected=expected.NAME,
        remedy="rename the file, or save it as CSV, Parquet or NetCDF-4",
    )
