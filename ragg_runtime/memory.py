"""Memory of a process that works on long flights."""

from __future__ import annotations

import ctypes
import sys

_TRIM_THRESHOLD, _MMAP_THRESHOLD, _ARENA_MAX = -1, -3, -8
"""Options of glibc's malloc."""


def reuse_memory() -> None:
    """Let this process keep memory for reuse that it has freed (glibc): segments need the same again and again.

    Fresh pages would cost a fifth of the time. For programs, not for libraries; before any thread begins.
    """
    set_option = getattr(ctypes.CDLL(None), "mallopt", None) if sys.platform == "linux" else None
    if set_option is not None:
        for option, value in ((_MMAP_THRESHOLD, 1 << 30), (_TRIM_THRESHOLD, 1 << 30), (_ARENA_MAX, 1)):
            set_option(option, value)
