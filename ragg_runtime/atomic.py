"""Files that appear whole or not at all."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from ragg_runtime.errors import UserError


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A temporary file beside ``path`` that takes its place on success and vanishes on failure.

    Raises UserError where the folder is missing or cannot be written.
    """
    try:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=path.suffix)
    except FileNotFoundError:
        raise UserError("the folder does not exist", where=path.parent, remedy="make it first") from None
    except OSError as error:
        raise UserError("the file cannot be written", where=path, found=error.strerror) from None
    os.close(handle)
    temporary = Path(name)
    try:
        # mkstemp makes it private; the file that is asked for has the rights of any new file, or its own.
        os.chmod(temporary, path.stat().st_mode & 0o7777 if path.exists() else 0o666 & ~_umask())
        yield temporary
        sync(temporary)
        os.replace(temporary, path)
    except OSError as error:
        raise UserError("the file cannot be written", where=path, found=error.strerror or error) from None
    finally:
        temporary.unlink(missing_ok=True)
    sync(path.parent)


def write_text(path: Path, text: str) -> None:
    """Write UTF-8 text whole or not at all."""
    with replacing(path) as temporary:
        temporary.write_bytes(text.encode())


def sync(path: Path) -> None:
    """Force a file or folder to the disc; folders cannot be synced on every system."""
    flags = os.O_RDONLY | getattr(os, "O_DIRECTORY", 0) if path.is_dir() else os.O_RDONLY
    with contextlib.suppress(OSError):
        handle = os.open(path, flags)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
