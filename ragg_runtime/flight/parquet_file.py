"""Parquet flights: float columns, the unit in each field's metadata ``units`` or in what pandas keeps in ``attrs``."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.arrow import floats, texts
from ragg_runtime.flight.one_table import joined
from ragg_runtime.flight.source import Heading, Look, RawBatch, Table, Written, distinct, heading, not_numbers

NAME = "parquet"
ENDINGS = (".parquet", ".pq")
MAGIC = (b"PAR1",)

# What pyarrow raises for files that were damaged on purpose is not documented: names that are no text are
# a ValueError, sizes that no memory holds a MemoryError.
_DAMAGED = (pa.ArrowException, OSError, ValueError, TypeError, KeyError, OverflowError, MemoryError)
_BUFFER = (
    1 << 16
)  # bytes of a column: with a million rows of all columns at once it takes twice the time and 150 MB more
_AT_ONCE = 1 << 20  # rows of a row group: what pyarrow makes of a table by itself


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The Parquet file as one table; UserError if it is damaged, or a column holds neither numbers nor text."""
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
    kept = _of_pandas(schema.metadata or {})
    headings, names = [], []
    for number, field in enumerate(fields, 1):
        unit = (field.metadata or {}).get(b"units")
        given = kept.get(field.name, "") if unit is None else unit.decode("utf-8", "replace").strip()
        found = heading(field.name, path, number)
        text = _is_text(field.type)
        found = Heading(found.name, given or found.unit, bool(text))
        if not look.wants(found.name):
            continue
        if text is None or (text and not look.allows_text(found.name)):
            raise not_numbers(path, found.name, field.type)
        headings.append(found)
        names.append(field.name)
    distinct(path, headings)
    return (Table(path, tuple(headings), lambda: _batches(path, names, headings)),)


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write columns as float64 with their units; NaN becomes null."""
    columns, lines = joined(tables)
    metadata = [{"units": c.unit} if c.unit else None for c in columns]
    kinds = [pa.float64() if c.unit or c.name != "line" else pa.string() for c in columns]
    schema = pa.schema(
        [pa.field(c.name, k, metadata=m) for c, k, m in zip(columns, kinds, metadata, strict=True)]
    )
    with pq.ParquetWriter(path, schema) as writer:
        for rows in lines(_AT_ONCE):
            arrays = [pa.array(np.ascontiguousarray(rows[c.name]), from_pandas=True) for c in columns]
            writer.write_table(pa.Table.from_arrays(arrays, schema=schema), row_group_size=_AT_ONCE)


def _of_pandas(metadata: Mapping[bytes, bytes]) -> dict[str, str]:
    """Units that a DataFrame carried in ``attrs``: under ``units``, or name -> unit or name -> {units: unit}."""
    try:
        attributes = json.loads(metadata.get(b"PANDAS_ATTRS", b"{}"))
    except (ValueError, RecursionError):
        return {}
    if not isinstance(attributes, dict):
        return {}
    if isinstance(attributes.get("units"), dict):
        attributes = attributes["units"]
    found = {}
    for name, unit in attributes.items():
        value = unit.get("units", unit.get("unit")) if isinstance(unit, dict) else unit
        if isinstance(value, str):
            found[name] = value.strip()
    return found


def _is_text(kind: Any) -> bool | None:
    """Whether a type is text or an instant (True) or a number (False); ``None`` for any other."""
    if pa.types.is_floating(kind) or pa.types.is_integer(kind) or pa.types.is_null(kind):
        return False
    if pa.types.is_dictionary(kind):
        kind = kind.value_type
    is_text = pa.types.is_string(kind) or pa.types.is_large_string(kind)
    return True if is_text or pa.types.is_timestamp(kind) or pa.types.is_date(kind) else None


def _batches(path: Path, names: Sequence[str], headings: Sequence[Heading]) -> Iterator[RawBatch]:
    try:
        # else all of a row group is read ahead
        with pq.ParquetFile(path, pre_buffer=False, buffer_size=_BUFFER) as file:
            for batch in file.iter_batches(batch_size=32768, columns=list(names)):
                yield {
                    h.name: _texts(batch.column(n)) if h.text else floats(batch.column(n))
                    for n, h in zip(names, headings, strict=True)
                }
    except _DAMAGED as error:
        raise _damaged(path, error) from None


def _texts(column: pa.Array) -> NDArray[Any]:
    kind = column.type
    if pa.types.is_timestamp(kind) or pa.types.is_date(kind):
        whole = column.cast(pa.timestamp("ns", tz=getattr(kind, "tz", None))).cast(pa.int64())
        nanoseconds = whole.fill_null(np.iinfo(np.int64).min).to_numpy(zero_copy_only=False)
        return np.asarray(nanoseconds, dtype=np.int64).view("datetime64[ns]")
    return texts(column.cast(pa.string()))


def _damaged(path: Path, error: Exception) -> UserError:
    return UserError(
        "the Parquet file is damaged",
        where=path,
        found=(str(error) or type(error).__name__).splitlines()[0][:200],
        expected="a whole Parquet file",
        remedy="copy it again",
    )
