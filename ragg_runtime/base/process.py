"""A process that works on long flights: its memory, and what its libraries do beside its work."""

from __future__ import annotations

import atexit
import ctypes
import gc
import os
import sys

_TRIM_THRESHOLD, _MMAP_THRESHOLD, _ARENA_MAX = -1, -3, -8
"""Options of glibc's malloc."""

_ALLOCATIONS = 20_000
"""Objects that are made between two looks for cycles, which may hold arrays."""

ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
"""Variables by which a library of linear algebra learns, while it is loaded, to work on one thread."""


def reuse_memory() -> None:
    """Let this process keep memory for reuse that it has freed (glibc): segments need the same again and again.

    Fresh pages would cost a fifth of the time. For programs, not for libraries; before any thread begins.
    """
    for option, value in ((_MMAP_THRESHOLD, 1 << 30), (_TRIM_THRESHOLD, 1 << 30), (_ARENA_MAX, 1)):
        _glibc("mallopt", option, value)


def collect_seldom() -> None:
    """Let Python look for cycles of this process seldom, and not at its end: for programs, not for libraries.

    Their modules are some 80,000 objects that live until the end, looked through again and again while they are made.
    """
    gc.set_threshold(_ALLOCATIONS)
    atexit.register(gc.freeze)


def no_idle_threads() -> None:
    """Let libraries of linear algebra start no threads, which would turn idly for 0.1 s each: nothing here uses them (threads.py).

    For programs, not for libraries; before NumPy is imported, or it is too late.
    """
    for name in ONE_THREAD:
        os.environ.setdefault(name, "1")


def give_back() -> None:
    """Give freed memory back to the system."""
    _glibc("malloc_trim", 0)


def _glibc(name: str, *arguments: int) -> None:
    """Call a function of the C library, where there is one of this name."""
    function = getattr(ctypes.CDLL(None), name, None) if sys.platform == "linux" else None
    if function is not None:
        function(*arguments)
