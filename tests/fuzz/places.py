"""Where targets put their files, and how they judge a message."""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
from pathlib import Path

from ragg_runtime.base.errors import UserError

Outcome = str
"""``read`` or ``refused``."""

_folder: Path | None = None


def place(name: str, data: bytes | None) -> Path:
    """A file in memory, if the system has such a place; ``None``: its name alone."""
    global _folder
    if _folder is None:
        shm = Path("/dev/shm")
        _folder = Path(tempfile.mkdtemp(dir=shm if os.access(shm, os.W_OK) else None))
        atexit.register(shutil.rmtree, _folder, ignore_errors=True)
    path = _folder / name
    if data is not None:
        path.write_bytes(data)
    return path


def shown(error: UserError) -> Outcome:
    """A message can be written to any terminal and is not a book."""
    message = error.message
    message.encode("utf-8", "backslashreplace")
    assert len(message) < 20_000
    return "refused"
