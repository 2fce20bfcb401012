"""Stand-ins for the workers of a survey. Processes import this each time, so it imports nothing that takes long."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator, Sequence
from typing import Any


def begin() -> None:
    """What a worker does first."""


def die(given: object, file: str) -> dict[str, str]:
    """A flight that takes its worker down each time."""
    if "flight-1" in file:
        os.kill(os.getpid(), signal.SIGKILL)
    if "flight-2.parquet" in file:
        raise MemoryError("no room")
    return {"flight": os.path.basename(file), "file": file, "verdict": "adequate"}


def in_process(job: Any, files: Sequence[str], *_: object) -> Iterator[tuple[str, dict[str, Any]]]:
    """A pool, whose processes would import everything anew: for what is not about the pool."""
    from ragg_runtime.survey.examine import examine

    return ((f, examine(job, f)) for f in files)
