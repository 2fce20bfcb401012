"""Numbers as texts: written so that they read back as themselves, and read from columns of bytes."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.record import Array


def shortest(values: NDArray[Any], missing: str) -> list[str]:
    """The shortest text of each number that reads back as the same; ``missing`` for NaN."""
    import pyarrow.compute as pc  # slow to import, and only what is written as text needs it

    column = pa.array(np.ascontiguousarray(values), from_pandas=True)
    found: list[str] = pc.fill_null(column.cast(pa.string()), missing).to_pylist()
    return found


def parsed(cells: NDArray[np.bytes_]) -> Array:
    """(n,) float64 of cells of text; blank ones and stars (what did not fit) are NaN. ValueError for the rest."""
    bare = np.char.strip(cells)
    nothing = (bare == b"") | np.char.startswith(bare, b"*")
    # Fortran writes D for the exponent of double precision; Python would read 1_0 as ten.
    bare = np.where(nothing, b"nan", np.char.replace(np.char.replace(bare, b"D", b"E"), b"_", b"?"))
    return bare.astype(np.float64)


def numbers(cells: NDArray[np.bytes_], where: Callable[[int], str], expected: str) -> Array:
    """As :func:`parsed`; UserError for a cell that is no number, with ``where`` it is, counted from 0."""
    try:
        return parsed(cells)
    except ValueError:
        n = _first_wrong(cells)
        raise UserError(
            "not a number",
            where=where(n),
            found=repr(cells[n].decode("utf-8", "replace"))[:60],
            expected=expected,
        ) from None


def _first_wrong(cells: NDArray[np.bytes_]) -> int:
    """The first cell at which :func:`parsed` stumbles."""
    for n in itertools.count():
        try:
            parsed(cells[n : n + 1])
        except ValueError:
            return n
    raise AssertionError
