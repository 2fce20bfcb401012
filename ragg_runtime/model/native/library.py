"""Functions of a compiled model through ctypes, which leaves Python's lock to others while they run."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.model.native.arguments import Case, address
from ragg_runtime.model.native.compiler import BuildError

Array = NDArray[np.float64]


class Library:
    """A shared library of generated models: functions ragg_<model>_<function>."""

    def __init__(self, file: Path) -> None:
        try:
            self._library = ctypes.CDLL(str(file))
        except OSError as error:
            file.unlink(missing_ok=True)  # damaged: it is made anew the next time
            raise BuildError(f"the compiled model cannot be loaded: {error}") from None
        self._functions: dict[tuple[str, str], ctypes._NamedFuncPointer] = {}

    def series(
        self, model: str, function: str, case: Case, found: Array, leading: Sequence[int] = ()
    ) -> None:
        """Evaluate a function over N samples into ``found``, contiguous float64, (N,) or (rows, N)."""
        addresses = case.addresses
        self._function(model, function, len(leading))(
            *leading,
            len(case.t),
            address(case.t),
            (ctypes.c_void_p * len(addresses))(*addresses),
            address(case.p),
            None if case.angle is None else address(case.angle),
            address(found),
        )

    def changes(self, model: str, case: Case, vectors: Array, few: int, weights: Array, found: Array) -> None:
        """What ``vectors`` (count, size) make of the output against the case's own, as :func:`..changes.changes` says."""
        call = getattr(self._library, f"ragg_{model}_changes")
        call.restype = None
        number, pointer = ctypes.c_size_t, ctypes.c_void_p
        call.argtypes = [number, pointer, pointer, number, pointer, pointer, number, pointer, pointer]
        addresses = case.addresses
        p = np.concatenate([case.p[None], vectors])
        call(
            len(case.t),
            address(case.t),
            (ctypes.c_void_p * len(addresses))(*addresses),
            len(vectors),
            address(p),
            None if case.angle is None else address(case.angle),
            few,
            address(weights),
            address(found),
        )

    def _function(self, model: str, function: str, leading: int) -> ctypes._NamedFuncPointer:
        call = self._functions.get((model, function))
        if call is None:
            call = getattr(self._library, f"ragg_{model}_{function}")
            call.restype = None
            call.argtypes = [ctypes.c_size_t] * (leading + 1) + [ctypes.c_void_p] * 5
            self._functions[model, function] = call
        return call
