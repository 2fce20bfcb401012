"""What a generated chain is: the one thing that is asked of it, in NumPy or as machine code."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Chain(Protocol):
    """A generated module: one accelerometer's V_j and its derivatives (see ``generated/chain.py``)."""

    INPUTS: tuple[str, ...]
    PARAMETERS: tuple[tuple[str, int], ...]
    ROWS: tuple[tuple[str, bool], ...]
    SIZE: int

    def accelerometer(
        self, j: int, time: Array, cos_phi: Array, sin_phi: Array, inputs: Array, q: Array
    ) -> Array: ...

    def derivatives(
        self, j: int, time: Array, cos_phi: Array, sin_phi: Array, inputs: Array, q: Array
    ) -> Array: ...

    def values_of(self, j: int, p: Array) -> Array: ...
