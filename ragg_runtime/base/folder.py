"""A folder that is held open: what is in it is reached by one plain name at a time, and through no link.

Everything in a folder that somebody sent may have been made to lead elsewhere. Paths are looked up anew at
every call, and through links; names in an open folder are not (openat(2) with O_NOFOLLOW). Where a system
cannot do that (Windows), each name is looked at before it is used.
"""

from __future__ import annotations

import contextlib
import ctypes
import errno
import os
import shutil
import stat
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

_HELD = os.open in os.supports_dir_fd
_FOLDER = os.O_RDONLY | getattr(os, "O_DIRECTORY", 0) | getattr(os, "O_CLOEXEC", 0)
_NOT_THROUGH_LINKS = getattr(os, "O_NOFOLLOW", 0)
# A pipe would be waited for, were it not opened in this way.
_FILE = os.O_RDONLY | _NOT_THROUGH_LINKS | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0)
_LONGEST_NAME = 255


class NotPlainError(OSError):
    """A name that leads elsewhere, or something that is neither a file nor a folder."""

    def __init__(self, place: Path | str, what: str) -> None:
        super().__init__(errno.ELOOP, what, str(place))


@dataclass(frozen=True)
class Folder:
    """A folder that is held open by :meth:`at` or :meth:`below`.

    Attributes
    ----------
    path
        Where it was found: for messages, and for systems that know no names relative to an open folder.
    handle
        Its descriptor; ``None`` on such systems.
    """

    path: Path
    handle: int | None

    @staticmethod
    @contextlib.contextmanager
    def at(path: Path) -> Iterator[Folder]:
        """The folder that the user names (a link if the user names one)."""
        if not _HELD:
            yield Folder(path=path, handle=None)
            return
        handle = os.open(path, _FOLDER)
        try:
            yield Folder(path=path, handle=handle)
        finally:
            os.close(handle)

    @contextlib.contextmanager
    def below(self, name: str, *, make: bool = False) -> Iterator[Folder]:
        """A folder in this one, made where it is missing if ``make``."""
        found = self.status(name)
        if make and found is None:
            os.mkdir(self._name(name), **self._here)
            found = self.status(name)
        if found is not None and not stat.S_ISDIR(found.st_mode):
            raise NotPlainError(self.path / name, f"{kind(found)} where a folder is expected")
        if not _HELD:
            yield Folder(path=self.path / name, handle=None)
            return
        handle = os.open(name, _FOLDER | _NOT_THROUGH_LINKS, dir_fd=self.handle)
        try:
            yield Folder(path=self.path / name, handle=handle)
        finally:
            os.close(handle)

    def status(self, name: str) -> os.stat_result | None:
        """What a name is, links as links; ``None`` if there is no such thing."""
        try:
            return os.stat(self._name(name), follow_symlinks=False, **self._here)
        except FileNotFoundError:
            return None

    def read(self, name: str, longest: int) -> bytes:
        """A file of at most ``longest`` bytes, which is no link, pipe or device."""
        found = os.stat(self._name(name), follow_symlinks=False, **self._here)
        if not stat.S_ISREG(found.st_mode):
            raise NotPlainError(self.path / name, f"{kind(found)} where a file is expected")
        with os.fdopen(os.open(self._name(name), _FILE, **self._here), "rb") as stream:
            status = os.fstat(stream.fileno())
            if not stat.S_ISREG(status.st_mode):
                raise NotPlainError(self.path / name, f"{kind(status)} where a file is expected")
            data = stream.read(longest + 1)
        if len(data) > longest:
            raise OSError(errno.EFBIG, f"more than {longest} bytes", str(self.path / name))
        return data

    def move(self, name: str, to: Folder, new: str) -> None:
        """Rename; a file takes the place of another one, links are moved as they are."""
        if _HELD:
            _plain(name)
            os.replace(name, _plain(new), src_dir_fd=self.handle, dst_dir_fd=to.handle)
        else:
            os.replace(self._name(name), to._name(new))

    def exchange(self, name: str, other: Folder, its: str) -> bool:
        """Exchange two things at a stroke; False where the system cannot."""
        call, exchanged = renameat2(), 2  # <linux/fs.h>
        if call is None or self.handle is None or other.handle is None:
            return False
        names = os.fsencode(_plain(name)), os.fsencode(_plain(its))
        return bool(call(self.handle, names[0], other.handle, names[1], exchanged) == 0)

    def remove(self, name: str) -> None:
        """Remove a file, a link or a whole folder, as far as that can be done."""
        found = self.status(name)
        if found is None:
            return
        if not stat.S_ISDIR(found.st_mode):
            os.unlink(self._name(name), **self._here)
        elif _HELD:
            shutil.rmtree(_plain(name), ignore_errors=True, dir_fd=self.handle)
        else:
            shutil.rmtree(self._name(name), ignore_errors=True)

    def chmod(self, name: str, mode: int) -> None:
        """Give a file these rights."""
        handle = os.open(self._name(name), _FILE, **self._here)
        try:
            if hasattr(os, "fchmod"):
                os.fchmod(handle, mode & 0o777)
        finally:
            os.close(handle)

    @property
    def _here(self) -> dict[str, Any]:
        return {"dir_fd": self.handle} if _HELD else {}

    def _name(self, name: str) -> str:
        return _plain(name) if _HELD else str(self.path / _plain(name))


def is_plain(name: object) -> bool:
    """Whether this is the name of one thing in a folder: no path, nothing that leads upwards."""
    return (
        isinstance(name, str)
        and 0 < len(name) <= _LONGEST_NAME
        and name not in (".", "..")
        and not any(c in name for c in "/\\:\0")
    )


def kind(status: os.stat_result) -> str:
    """What this is, in words."""
    for test, word in (
        (stat.S_ISREG, "a file"),
        (stat.S_ISDIR, "a folder"),
        (stat.S_ISLNK, "a link"),
        (stat.S_ISFIFO, "a pipe"),
        (stat.S_ISSOCK, "a socket"),
    ):
        if test(status.st_mode):
            return word
    return "a device"


def _plain(name: str) -> str:
    if not is_plain(name):
        raise NotPlainError(repr(name), "not the name of a thing in a folder")
    return name


@cache
def renameat2() -> Any:
    """The call of Linux that exchanges two names at a stroke; ``None`` where there is none."""
    if not sys.platform.startswith("linux"):
        return None
    with contextlib.suppress(OSError, AttributeError):
        call = ctypes.CDLL(None).renameat2
        call.argtypes = (ctypes.c_int, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_uint)
        return call
    return None
