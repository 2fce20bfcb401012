"""A lock on a directory that leaves nothing behind."""

from __future__ import annotations

import contextlib
import errno
import os
import sys
import time
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import filelock

from ragg_runtime.base import progress

_POLL = 0.005  # s
_NO_LOCKS = (errno.EBADF, errno.ENOLCK, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS, errno.EINVAL)


@contextlib.contextmanager
def locked(path: Path, patience: float) -> Iterator[None]:
    """Hold the lock of a directory; it is free again when the process ends, however it ends.

    Where the file system knows no locks the work is done without one, and that is said once. Raises TimeoutError
    if another process holds it for longer than ``patience``, s; OSError if the directory cannot be opened.
    """
    if sys.platform == "win32":  # a directory cannot be locked there
        with filelock.FileLock(path / ".ragg.lock", timeout=patience):
            yield
        return
    handle = os.open(path, os.O_RDONLY)
    try:
        deadline = time.monotonic() + patience
        while not _taken(handle):
            if time.monotonic() >= deadline:
                raise TimeoutError(errno.ETIMEDOUT, "the directory is locked")
            time.sleep(_POLL)
        yield
    finally:
        os.close(handle)


def _taken(handle: int) -> bool:
    import fcntl  # does not exist on Windows

    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError as error:
        if error.errno not in _NO_LOCKS:
            raise
        _say_once()
    return True


@cache
def _say_once() -> None:
    progress.remark("this file system knows no locks: let one command at a time change things here")
