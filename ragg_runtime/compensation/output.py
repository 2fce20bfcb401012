"""Compensated series in a file, written as they come: CSV, Parquet or NetCDF-4 by the ending of its name."""

from __future__ import annotations

import contextlib
import gzip
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import IO, Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
from numpy.typing import NDArray

from ragg_runtime.base.files import replacing
from ragg_runtime.flight.formats import format_of

UNITS: Mapping[str, str] = MappingProxyType(
    {
        "time": "s",
        "inline": "Eo",
        "cross": "Eo",
        "inline_std": "Eo",
        "cross_std": "Eo",
        "quality": "1",
        "flight": "1",
    }
)
"""The columns and their units; ``flight`` (1, 2, ...) only where there are several."""

Rows = Mapping[str, NDArray[Any]]
Write = Callable[[Rows], None]


@contextlib.contextmanager
def writing(path: Path, samples: int, *, several: bool) -> Iterator[Write]:
    """A function that takes columns of successive rows; the file appears whole or not at all.

    ``samples`` is the number of all rows.
    """
    kind = format_of(path).NAME
    names = [n for n in UNITS if several or n != "flight"]
    schema = pa.schema([pa.field(n, _type(n), metadata={"units": UNITS[n]}) for n in names])
    with replacing(path) as temporary:
        if kind == "parquet":
            with pq.ParquetWriter(
                temporary, schema, compression="snappy", use_dictionary=["quality"]
            ) as writer:
                yield lambda rows: writer.write_table(_table(rows, schema))
        elif kind == "csv":
            with _text(temporary, path.name.lower().endswith(".gz")) as stream:
                stream.write((",".join(f"{n} [{UNITS[n]}]" for n in names) + "\n").encode())
                options = pyarrow.csv.WriteOptions(include_header=False)
                yield lambda rows: pyarrow.csv.write_csv(_table(rows, schema), stream, options)
        else:
            with _netcdf(temporary, names, samples) as write:
                yield write


def _type(name: str) -> pa.DataType:
    return pa.int64() if name in ("quality", "flight") else pa.float64()


def _table(rows: Rows, schema: pa.Schema) -> pa.Table:
    arrays = [pa.array(np.ascontiguousarray(rows[f.name]), type=f.type, from_pandas=True) for f in schema]
    return pa.Table.from_arrays(arrays, schema=schema)


@contextlib.contextmanager
def _text(path: Path, compressed: bool) -> Iterator[IO[bytes]]:
    with path.open("wb") as raw:
        if not compressed:
            yield raw
            return
        with gzip.GzipFile("", "wb", 6, raw, mtime=0) as stream:  # equal series give equal files
            yield stream  # type: ignore[misc]


@contextlib.contextmanager
def _netcdf(path: Path, names: list[str], samples: int) -> Iterator[Write]:
    import h5netcdf  # slow to import, and only this format needs it

    with h5netcdf.File(path, "w") as file:
        file.dimensions = {"time": samples}
        for n in names:
            whole = n in ("quality", "flight")
            variable = file.create_variable(n, ("time",), np.int64 if whole else np.float64)
            variable.attrs["units"] = UNITS[n]
        done = 0

        def write(rows: Rows) -> None:
            nonlocal done
            count = len(rows["time"])
            for n in names:
                file.variables[n][done : done + count] = rows[n]
            done += count

        yield write
