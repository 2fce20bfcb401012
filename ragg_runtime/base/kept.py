"""A cache of the user that stays below a size: what was used least recently goes first."""

from __future__ import annotations

import contextlib
import time
from pathlib import Path

from ragg_runtime.base.files import clear_all_stale

SPARED = 60.0
"""Since when an entry was not used before it goes, s: another process may be about to open it, which takes milliseconds."""


def keep_below(folder: Path, largest: int) -> None:
    """Remove entries until those that are left take at most ``largest`` bytes, and what killed processes left.

    An entry is all files of one stem; its time is that of the one used last. What vanishes meanwhile was
    removed by another process; on Unix what is open or mapped stays there for who has it.
    """
    clear_all_stale(folder)
    entries: dict[str, list[tuple[Path, float, int]]] = {}
    for file in folder.iterdir():
        with contextlib.suppress(OSError):
            status = file.lstat()
            if not file.name.startswith("."):
                entries.setdefault(file.stem, []).append((file, status.st_mtime, status.st_size))
    last = {stem: max(at for _, at, _ in files) for stem, files in entries.items()}
    size = sum(n for files in entries.values() for _, _, n in files)
    before = time.time() - SPARED
    for stem in sorted(entries, key=lambda s: last[s]):
        if size <= largest or last[stem] > before:
            return
        for file, _, n in entries[stem]:
            with contextlib.suppress(OSError):
                file.unlink()
                size -= n
