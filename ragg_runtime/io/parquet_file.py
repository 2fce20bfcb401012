"""Parquet flights: float columns, the unit in each field's metadata ``units`` or in what pandas keeps in ``attrs``."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from ragg_runtime.base.errors import UserError
from ragg_runtime.io.one_table import floats, joined, texts
from ragg_runtime.io.source import Heading, Look, Rows, Table, Written, distinct, heading, not_numbers

NAME = "parquet"
ENDINGS = (".parquet", ".pq")
MAGIC = (b"PAR1",)

# What pyarrow raises for files that were damaged on purpose is not documented: names that are no text are
# a ValueError, sizes that no memory holds a MemoryError.
_DAMAGED = (pa.ArrowException, OSError, ValueError, TypeError, KeyError, OverflowError, MemoryError)


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
    return (Table(path, tuple(headings), lambda: _rows(path, names, headings)),)


def write_tables(path: Path, tables: Sequence[Written]) -> None:
    """Write columns as float64 with their units; NaN becomes null."""
    columns, rows = joined(tables)
    metadata = [{"units": c.unit} if c.unit else None for c in columns]
    arrays = [pa.array(rows[c.name], from_pandas=True) for c in columns]
    fields = [pa.field(c.name, x.type, metadata=m) for c, x, m in zip(columns, arrays, metadata, strict=True)]
    pq.write_table(pa.Table.from_arrays(arrays, schema=pa.schema(fields)), path)


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


def _rows(path: Path, names: Sequence[str], headings: Sequence[Heading]) -> Rows:
    try:
        with pq.ParquetFile(path) as file:
            table = file.read(columns=list(names))
        return {
            h.name: (texts if h.text else floats)(table.column(n))
            for n, h in zip(names, headings, strict=True)
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
