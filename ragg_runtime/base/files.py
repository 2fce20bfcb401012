"""Files that appear whole or not at all."""

from __future__ import annotations

import contextlib
import hashlib
import os
import platform
import secrets
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

from ragg_runtime.base.errors import UserError


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A temporary file beside ``path`` that takes its place on success and vanishes on failure.

    Raises UserError where the folder is missing or cannot be written.
    """
    temporary = temporary_name(path)
    try:
        clear_stale(path)
        os.close(os.open(temporary, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600))
    except FileNotFoundError:
        raise UserError("the folder does not exist", where=path.parent, remedy="make it first") from None
    except OSError as error:
        raise UserError("the file cannot be written", where=path, found=error.strerror) from None
    try:
        # It is private so far; the file that is asked for has the rights of any new file, or its own.
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


def temporary_name(path: Path) -> Path:
    """A free name beside ``path`` that tells who uses it, and on which machine."""
    return path.with_name(f"{_prefix(path)}{os.getpid()}-{secrets.token_hex(4)}{path.suffix}")


def clear_stale(path: Path) -> None:
    """Remove what processes that were killed on this machine left of :func:`temporary_name` for this path."""
    if sys.platform == "win32":  # whether a process lives cannot be asked there without ending it
        return
    prefix = _prefix(path)
    with contextlib.suppress(OSError):
        for name in os.listdir(path.parent):
            process = name.removeprefix(prefix).split("-")[0]
            if name.startswith(prefix) and process.isdecimal() and not _lives(int(process)):
                place = path.with_name(name)
                if place.is_dir() and not place.is_symlink():
                    shutil.rmtree(place, ignore_errors=True)
                else:
                    place.unlink(missing_ok=True)


def _prefix(path: Path) -> str:
    machine = hashlib.sha256(platform.node().encode()).hexdigest()[:6]
    return f".{path.name[:60]}.{machine}-"


def _lives(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True


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


def read_text(path: Path, longest: int = 1 << 20) -> str:
    """The text of a user's file, UTF-8 with or without a byte-order mark, of at most ``longest`` bytes."""
    try:
        # A pipe or a device would be waited for, or never end.
        if path.exists() and not path.is_file() and not path.is_dir():
            raise UserError("a file is needed here, not a pipe or a device", where=path)
        with path.open("rb") as stream:
            data = stream.read(longest + 1)
        if len(data) > longest:
            raise UserError("the file is too long", where=path, expected=f"at most {longest} bytes")
        return data.decode("utf-8-sig")
    except FileNotFoundError:
        raise UserError(
            "the file does not exist", where=path, remedy="check the name and the folder"
        ) from None
    except IsADirectoryError:
        raise UserError("a file is needed here, not a directory", where=path) from None
    except UnicodeDecodeError as error:
        raise UserError(
            "the file is not UTF-8 text",
            where=path,
            found=f"byte {error.object[error.start]:#04x} at {error.start}",
        ) from None
    except OSError as error:
        raise UserError("the file cannot be read", where=path, found=error.strerror) from None
