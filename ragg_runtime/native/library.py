"""Functions of a compiled model through ctypes, which leaves Python's lock to others while they run."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.native.compiler import BuildError

Array = NDArray[np.float64]


class Library:
    """A shared library of generated models: functions ragg_<model>_<function>."""

    def __init__(self, file: Path) -> None:
        try:
            self._library = ctypes.CDLL(str(file))
        except OSError as error:
            raise BuildError(f"the compiled model cannot be loaded: {error}") from None

    def series(
        self,
        model: str,
        function: str,
        t: Array,
        inputs: Sequence[Array],
        p: Array,
        angle: Array | None,
        found: Array,
        leading: Sequence[int] = (),
    ) -> None:
        """Evaluate a function over N samples into ``found``, (N,) or (rows, N).

        All arrays are contiguous float64 of the lengths that the function wants: this is not looked at again.
        """
        pointers = (ctypes.c_void_p * len(inputs))(*(x.ctypes.data for x in inputs))
        call = getattr(self._library, f"ragg_{model}_{function}")
        call.restype = None
        call(
            *(ctypes.c_size_t(v) for v in (*leading, len(t))),
            ctypes.c_void_p(t.ctypes.data),
            pointers,
            ctypes.c_void_p(p.ctypes.data),
            ctypes.c_void_p(None if angle is None else angle.ctypes.data),
            ctypes.c_void_p(found.ctypes.data),
        )
