"""Parquet flights: float columns, the unit in each field's metadata ``units``."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.arrow import floats
from ragg_runtime.flight.record import Array
from ragg_runtime.flight.source import Batch, Column, Source, columns_of

# What pyarrow raises for files that were damaged on purpose is not documented: names that are no text are
# a ValueError, sizes that no memory holds a MemoryError.
_DAMAGED = (pa.ArrowException, OSError, ValueError, TypeError, KeyError, OverflowError, MemoryError)


def open_parquet(path: Path) -> Source:
    """The Parquet file as a source; UserError if a column is not numeric or has no unit."""
    try:
        schema = pq.read_schema(path)
        # pandas keeps an unnamed index as a column of its own.
        fields = [f for f in schema if not f.name.startswith("__index_level_")]
    except UnicodeDecodeError as error:
        raise UserError(
            "the name of a column is not UTF-8 text",
            where=path,
            found=ascii(error.object[:60]),
            expected="names in UTF-8, as in every Parquet file",
            remedy="rename the column where the file is made",
        ) from None
    except _DAMAGED as error:
        raise _damaged(path, error) from None
    headers = []
    names = [f.name for f in fields]
    for field in fields:
        name, kind = field.name, field.type
        if not (pa.types.is_floating(kind) or pa.types.is_integer(kind) or pa.types.is_null(kind)):
            raise UserError(
                "the column does not hold numbers",
                where=f"{path}: column {name!r}",
                found=kind,
                expected="float64",
            )
        unit = (field.metadata or {}).get(b"units")
        headers.append((name, None if unit is None else unit.decode("utf-8", "replace")))
    columns = columns_of(path, headers)
    return Source(path, columns, lambda: _batches(path, names, columns))


def write_parquet(path: Path, columns: list[tuple[Column, Array]]) -> None:
    """Write columns as float64 with their units; NaN becomes null."""
    fields = [pa.field(c.name, pa.float64(), metadata={"units": c.unit}) for c, _ in columns]
    arrays = [pa.array(np.ascontiguousarray(v), from_pandas=True) for _, v in columns]
    pq.write_table(pa.Table.from_arrays(arrays, schema=pa.schema(fields)), path)


def _batches(path: Path, names: list[str], columns: tuple[Column, ...]) -> Iterator[Batch]:
    try:
        with pq.ParquetFile(path, pre_buffer=False) as file:  # else all of it is read ahead
            for batch in file.iter_batches(batch_size=32768, columns=names):
                yield {
                    c.name: floats(batch.column(n).cast(pa.float64()))
                    for n, c in zip(names, columns, strict=True)
                }
    except _DAMAGED as error:
        raise _damaged(path, error) from None


def _damaged(path: Path, error: Exception) -> UserError:
    return UserError(
        "the Parquet file is damaged",
        where=path,
        found=(str(error) or type(error).__name__).splitlines()[0][:200],
        expected="a whole Parquet file",
        remedy="copy it again",
    )
