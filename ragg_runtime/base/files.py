"""Files that appear whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import stat
import sys
import tempfile
import time
from collections.abc import Iterator
from functools import cache
from io import BufferedReader
from pathlib import Path

import filelock

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A temporary file that takes the place of ``path`` on success and vanishes on failure; a device or a pipe is written to."""
    with _report_refusal(path):
        mode = _find_mode(path)
        is_stream = mode is not None and not stat.S_ISREG(mode)
        place = Path(os.path.realpath(path))
        beside = Path(tempfile.gettempdir()) / "ragg-output" if is_stream else place
        handle, name = tempfile.mkstemp(path.suffix, f".{beside.name[:60]}.", beside.parent)
        os.close(handle)
        temporary = Path(name)
        try:
            yield temporary
            if is_stream:
                path.write_bytes(temporary.read_bytes())
            else:
                # It is private so far; the file that is asked for has the rights of any new file, or its own.
                os.chmod(temporary, 0o666 & ~_umask() if mode is None else mode & 0o7777)
                sync(temporary)
                os.replace(temporary, place)
                sync(place.parent)
        finally:
            temporary.unlink(missing_ok=True)


def check_writable(path: Path) -> None:
    """UserError where :func:`replacing` would not begin."""
    with _report_refusal(path):
        mode = _find_mode(path)
        if mode is None or stat.S_ISREG(mode):
            tempfile.TemporaryFile(dir=os.path.dirname(os.path.realpath(path))).close()


@contextlib.contextmanager
def _report_refusal(path: Path) -> Iterator[None]:
    """UserError where the system refuses to write."""
    try:
        yield
    except OSError as error:
        raise refuse_to_write("the file", path, error) from None


def refuse_to_write(what: str, where: Path, error: OSError) -> UserError:
    """What is said where the system refuses to write."""
    full = error.errno in (errno.ENOSPC, errno.EDQUOT)
    remedy = (
        "make room on its disc, or write elsewhere"
        if full
        else "check who may write there, or write elsewhere"
    )
    return UserError(f"{what} cannot be written", where=where, found=error.strerror or error, remedy=remedy)


def _find_mode(path: Path) -> int | None:
    """The mode of what exists at a path; ``None``: nothing. OSError where it is a folder, or a device that may not be written."""
    if not path.parent.exists():
        raise UserError("the folder does not exist", where=path.parent, remedy="make it first")
    if not path.exists():
        return None
    mode = path.stat().st_mode
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode) and not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    return mode


def write_text(path: Path, text: str) -> None:
    """Write UTF-8 text whole or not at all."""
    write_bytes(path, text.encode())


def write_bytes(path: Path, content: bytes) -> None:
    """Write bytes whole or not at all."""
    with replacing(path) as temporary:
        temporary.write_bytes(content)


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


def opened(path: Path) -> BufferedReader:
    """A user's file, to read. A pipe or a device would be waited for, or never end: UserError."""
    if path.exists() and not path.is_file():
        what = "directory" if path.is_dir() else "pipe or a device"
        raise UserError(f"a regular file is needed here, not a {what}", where=path)
    return path.open("rb")


def file_digest(path: Path) -> str:
    """SHA-256 of a user's file, hexadecimal."""
    with opened(path) as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def read_text(path: Path, longest: int = 1 << 20) -> str:
    """The text of a user's file, UTF-8 with or without a byte-order mark, of at most ``longest`` bytes."""
    try:
        with opened(path) as stream:
            data = stream.read(longest + 1)
        if len(data) > longest:
            raise UserError("the file is too long", where=path, expected=f"at most {longest} bytes")
        return data.decode("utf-8-sig")
    except FileNotFoundError:
        raise UserError(
            "the file does not exist", where=path, remedy="check the name and the folder"
        ) from None
    except UnicodeDecodeError as error:
        raise UserError(
            "the file is not UTF-8 text",
            where=path,
            found=f"byte {error.object[error.start]:#04x} at {error.start}",
        ) from None
    except OSError as error:
        raise UserError("the file cannot be read", where=path, found=error.strerror) from None


_POLL = 0.005  # s
_NO_LOCKS = (errno.EBADF, errno.ENOLCK, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS, errno.EINVAL)


@contextlib.contextmanager
def locked(path: Path, patience: float) -> Iterator[None]:
    """Hold the lock of a directory, or of a file, while this process lives; without one where the file system has none.

    Raises TimeoutError if another process holds it for longer than ``patience``, s.
    """
    if sys.platform == "win32":  # a directory cannot be locked there
        place = path / ".ragg.lock" if path.is_dir() else path.with_name(f"{path.name}.lock")
        with filelock.FileLock(place, timeout=patience):
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
    progress.remark("this file system has no locks: run one command at a time on this model")
