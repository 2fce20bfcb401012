"""A lock on a directory that leaves nothing behind."""

from __future__ import annotations

import contextlib
import errno
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import filelock

_POLL = 0.005  # s


@contextlib.contextmanager
def locked(path: Path, patience: float) -> Iterator[None]:
    """Hold the lock of a directory; it is free again when the process ends, however it ends.

    The directory itself is locked, so that no lock file is left over; where the system cannot do that
    (Windows, some network file systems) a hidden file in it is, and stays.

    Raises TimeoutError if another process holds it for longer than ``patience``, s; OSError if the
    directory cannot be locked.
    """
    if sys.platform == "win32":
        with _by_file(path, patience):
            yield
        return
    import fcntl  # does not exist on Windows

    handle = os.open(path, os.O_RDONLY)
    try:
        deadline = time.monotonic() + patience
        while True:
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if time.monotonic() >= deadline:
                    raise TimeoutError(errno.ETIMEDOUT, "the directory is locked") from None
                time.sleep(_POLL)
            except OSError as error:
                if error.errno not in (errno.EBADF, errno.ENOLCK, errno.ENOTSUP, errno.ENOSYS, errno.EINVAL):
                    raise
                with _by_file(path, max(deadline - time.monotonic(), 0.0)):
                    yield
                return
        yield
    finally:
        os.close(handle)


@contextlib.contextmanager
def _by_file(path: Path, patience: float) -> Iterator[None]:
    try:
        with filelock.FileLock(path / ".ragg.lock", timeout=patience):
            yield
    except filelock.Timeout:
        raise TimeoutError(errno.ETIMEDOUT, "the directory is locked") from None
