"""Rows that enter a triangular factor, by LAPACK's dtpqrt, while other threads go on.

SciPy's own wrapper of the routine keeps Python's lock, and threads that eliminate at a time take turns: of two halves of a
triangle the second waited for the first. The same routine is called here by the address that SciPy hands to compiled code
(``scipy.linalg.cython_lapack``), without the lock; where there is none such, by the wrapper, with the same bits.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy import linalg
from scipy.linalg import cython_lapack

Array = NDArray[np.float64]

PANEL = 32
"""Columns that LAPACK eliminates at a time."""


def entered(R: Array, part: Array, trapezoid: int = 0) -> None:
    """Put in place of R (n, n), upper triangular, the factor of its rows and those of ``part`` (m, n), which are used up.

    Both in Fortran's order. The last ``trapezoid`` rows of ``part`` are an upper trapezoid, whose zeros stay.
    """
    m, n = part.shape
    if not (R.flags.f_contiguous and part.flags.f_contiguous and R.dtype == part.dtype == np.float64):
        raise ValueError("LAPACK takes columns one after the other")
    if m and n:
        _routine()(R, part, trapezoid, min(PANEL, n))


@cache
def _routine() -> Callable[[Array, Array, int, int], None]:
    address = _address("dtpqrt")
    if address is None:
        return _wrapped
    i, x = ctypes.POINTER(ctypes.c_int), ctypes.c_void_p
    called = ctypes.CFUNCTYPE(None, i, i, i, i, x, i, x, i, x, i, x, i)(address)

    def bare(R: Array, part: Array, trapezoid: int, panel: int) -> None:
        m, n, low, nb = (ctypes.c_int(k) for k in (*part.shape, trapezoid, panel))
        factor, work = np.empty((n.value, panel)), np.empty((n.value, panel))
        wrong = ctypes.c_int(0)
        a, b, t, w = (array.ctypes.data for array in (R, part, factor, work))
        called(m, n, low, nb, a, n, b, m, t, nb, w, wrong)
        if wrong.value:
            raise ValueError(f"dtpqrt: argument {-wrong.value}")

    return bare


def _wrapped(R: Array, part: Array, trapezoid: int, panel: int) -> None:
    linalg.lapack.dtpqrt(trapezoid, panel, R, part, overwrite_a=True, overwrite_b=True)


def _address(routine: str) -> int | None:
    """Where it is, if its integers are of C's ``int``."""
    capsule = getattr(cython_lapack, "__pyx_capi__", {}).get(routine)
    if capsule is None:
        return None
    name_of, pointer_of = ctypes.pythonapi.PyCapsule_GetName, ctypes.pythonapi.PyCapsule_GetPointer
    name_of.restype, name_of.argtypes = ctypes.c_char_p, [ctypes.py_object]
    pointer_of.restype, pointer_of.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    name = name_of(capsule)
    return pointer_of(capsule, name) if name.startswith(b"void (int *, int *, int *, int *,") else None
