"""The one place that says whether a table fits into memory, before it is read."""

from __future__ import annotations

import os
from pathlib import Path

from ragg_runtime.base.errors import UserError

SHARE = 0.5
"""Of the free memory that a table may take: reading and fitting it take as much again."""


def require_memory(path: Path, size: float) -> None:
    """UserError if a table of so many bytes is more than ``SHARE`` of the memory that is free."""
    free = find_free_memory()
    if free is not None and size > SHARE * free:
        raise UserError(
            "the table is too large for the memory of this computer",
            where=path,
            found=f"about {size / 1e9:.3g} GB once it is read",
            expected=f"at most {SHARE * free / 1e9:.3g} GB, half of what is free",
            remedy="divide the file, or leave out columns and lines that are not needed",
        )


def find_free_memory() -> float | None:
    """Bytes that can be had without swapping; ``None`` where the system does not say."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            free = next(float(x.split()[1]) * 1024 for x in lines if x.startswith("MemAvailable:"))
    except (OSError, StopIteration, ValueError):
        try:
            return float(os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
        except (AttributeError, ValueError, OSError):
            return None
    return free
