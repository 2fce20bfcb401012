"""The records of a survey as one Parquet table, a row a flight: what a table program or a query wants of ten thousand."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from ragg_runtime.base.errors import UserError
from ragg_runtime.survey.task import Record

TOGETHER = 512
"""Flights of a row group: so many are in memory as a table at once."""

ERRORS = ("nominal", "calibrated", "holdout", "after", "after_holdout")
"""Of these a row has the rms, ``nominal_Eo`` and so on; None where a record does not tell."""

_NAMES = pa.list_(pa.string())
_SCHEMA = pa.schema(
    [
        *((n, pa.string()) for n in ("flight", "file", "sha256", "verdict", "error")),
        ("samples", pa.int64()),
        *((n, pa.float64()) for n in ("duration_s", "rate_Hz")),
        ("found", _NAMES),
        *((f"{n}_Eo", pa.float64()) for n in (*ERRORS, "noise_floor")),
        (
            "ranking",
            pa.list_(pa.struct({"effect": pa.string(), "log10_p": pa.float64(), "delta_bic": pa.float64()})),
        ),
        (
            "parameters",
            pa.list_(
                pa.struct(
                    {
                        "name": pa.string(),
                        "accelerometer": pa.int64(),
                        "unit": pa.string(),
                        "value": pa.float64(),
                        "std": pa.float64(),
                    }
                )
            ),
        ),
        ("terms", pa.list_(pa.struct({"harmonic": pa.string(), "term": pa.string()}))),
        ("notes", _NAMES),
    ]
)


def parquet(records: Sequence[Record]) -> bytes:
    """The table as the bytes of a Parquet file; the same records give the same bytes."""
    stream = io.BytesIO()
    with pq.ParquetWriter(stream, _SCHEMA, compression="zstd") as writer:
        for start in range(0, max(len(records), 1), TOGETHER):
            rows = [_row(r) for r in records[start : start + TOGETHER]]
            writer.write_table(pa.Table.from_pylist(rows, schema=_SCHEMA))
    return stream.getvalue()


def check_place(path: Path) -> None:
    """UserError if a file stands there that is neither empty nor such a table: a record may be a Parquet file too."""
    if not path.is_file() or not path.stat().st_size:
        return
    try:
        known = pq.read_schema(path).names == _SCHEMA.names
    except (OSError, pa.ArrowException):
        known = False
    if not known:
        raise UserError(
            "a table would be written over something else",
            where=path,
            found="a file that is no table of a survey",
            remedy="name another file, or delete this one first",
        )


def _row(r: Record) -> dict[str, Any]:
    row = {name: r.get(name) for name in _SCHEMA.names}
    if "verdict" not in r:
        return row | {"error": r["error"]["message"]}
    scored = {f"{n}_Eo": r["error"][n]["rms_Eo"] if r["error"][n] else None for n in ERRORS}
    return row | scored | {"error": None, "noise_floor_Eo": r["noise_floor"]["rms_Eo"]}
