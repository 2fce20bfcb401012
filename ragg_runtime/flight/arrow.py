"""Columns of Arrow tables as NumPy arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from ragg_runtime.flight.record import Array


def floats(column: pa.ChunkedArray) -> Array:
    """(N,): a column of numbers, as float64; null becomes NaN. Arrow's own ``to_numpy`` would load pandas."""
    whole = column.cast(pa.float64()).combine_chunks()
    return np.asarray(np.from_dlpack(whole.fill_null(float("nan")) if whole.null_count else whole))


def texts(column: pa.ChunkedArray) -> NDArray[Any]:
    """(N,) str: a column of text; null becomes the empty text. Instants are datetime64."""
    kind = column.type
    if pa.types.is_timestamp(kind) or pa.types.is_date(kind):
        return np.asarray(column.cast(pa.timestamp("ns")).to_numpy(), dtype="datetime64[ns]")
    return np.array(["" if t is None else t for t in column.cast(pa.string()).to_pylist()], dtype=object)
