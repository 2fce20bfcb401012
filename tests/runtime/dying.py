"""What worker processes of a survey are given to die of: each of them imports this, so it imports nothing that takes long."""

from __future__ import annotations

import os
import signal


def begin() -> None:
    """Stands in for what a worker does first."""


def deadly(given: object, file: str) -> dict[str, str]:
    """Stands in for a flight that takes its worker down each time."""
    if "flight-1" in file:
        os.kill(os.getpid(), signal.SIGKILL)
    if "flight-2.parquet" in file:
        raise MemoryError("no room")
    return {"flight": os.path.basename(file), "file": file, "verdict": "adequate"}
