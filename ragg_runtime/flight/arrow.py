"""Columns of Arrow tables as NumPy arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from ragg_runtime.flight.record import Array


def floats(column: pa.Array) -> Array:
    """(N,): a column of numbers, as float64; null becomes NaN.

    Arrow's own ``to_numpy`` loads pandas for it, which takes as long as a small flight; ``cast`` loads all that Arrow computes.
    """
    if column.type != pa.float64():
        column = column.cast(pa.float64())
    if column.null_count:
        column = column.fill_null(float("nan"))
    return np.asarray(np.from_dlpack(column))


def texts(column: pa.Array) -> NDArray[Any]:
    """(N,) str: a column of text; null becomes the empty text."""
    return np.array(["" if t is None else t for t in column.to_pylist()], dtype=object)
