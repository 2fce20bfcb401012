"""Columns of a table among arrays of any shape, as HDF5 and MATLAB files hold them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError

WIDEST = 16
"""Columns of one array that are taken apart: accelerations along three axes, voltages of a few discs."""

Shape = tuple[int, ...]


@dataclass(frozen=True)
class Place:
    """Where a column lies in an array: along ``axis``, at ``index`` of the other one (``None``: it has none)."""

    array: str
    column: str
    axis: int
    index: int | None

    def of(self, data: Any) -> NDArray[Any]:
        """(N,): the column of the array."""
        x = np.asarray(data)
        return x if self.index is None else np.take(x, self.index, axis=1 - self.axis)


def places(shapes: Mapping[str, Shape], where: str | Path) -> list[Place]:
    """The columns of the table that arrays of these shapes make up.

    Vectors count in either direction; an array of few columns (or rows) gives ``name_1``, ``name_2`` ...
    Single numbers are no columns. UserError where vectors differ in length.
    """
    longest = {n: max(s) for n, s in shapes.items() if s and max(s) > 1 and _is_table(s)}
    if not longest:
        return []
    length = longest.get("time") or Counter(longest.values()).most_common(1)[0][0]
    found = []
    for name, size in longest.items():
        if size != length:
            raise UserError(
                "the columns differ in length",
                where=where,
                found=f"{name!r} has {size} rows, others {length}",
                expected="one length for all that is needed of the file",
                remedy="name the columns that are needed in a mapping: ragg map FLIGHT -o mapping.toml",
            )
        found += _spread(name, shapes[name], length)
    return found


def _is_table(shape: Shape) -> bool:
    return len(shape) == 1 or (len(shape) == 2 and min(shape) <= WIDEST)


def _spread(name: str, shape: Shape, length: int) -> list[Place]:
    if len(shape) == 1:
        return [Place(array=name, column=name, axis=0, index=None)]
    axis = 0 if shape[0] == length else 1
    width = shape[1 - axis]
    names = [name] if width == 1 else [f"{name}_{k}" for k in range(1, width + 1)]
    return [Place(array=name, column=n, axis=axis, index=k) for k, n in enumerate(names)]
