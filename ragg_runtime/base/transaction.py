"""Several files and folders of one directory, changed all together or not at all.

A change is staged in ``<root>/.ragg/next``. The rename of that folder to ``.ragg/commit`` is the instant at
which it is made: before it the old state stands, and what was staged is waste; after it the new one does, and
whoever comes next finishes moving things into place. So a process may be killed at any instant. A folder
that is replaced is exchanged with the new one at a stroke, where the system can do that.

Changes are made under the lock of the directory (:mod:`ragg_runtime.base.lock`).
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import shutil
import signal
import sys
import time
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from ragg_runtime.base.files import sync

WORK = ".ragg"
_NEXT, _COMMIT, _JOURNAL, _OLD = "next", "commit", "journal.json", "old"


def stage(root: Path) -> Path:
    """An empty folder to put new files into. Needs the lock; finish(root) must have been called."""
    place = root / WORK / _NEXT
    place.mkdir(parents=True)
    return place


def switch(root: Path, folders: Sequence[str], *, removed: Sequence[str] = ()) -> None:
    """Commit what is staged and move it into place.

    Of what is staged, ``folders`` take the place of whole folders; all other files that of files.
    ``removed`` files and folders go. Raises OSError; whether the change was made, says ``is_committing``.
    """
    work = root / WORK
    staged = work / _NEXT
    inodes = {name: staged.joinpath(name).stat().st_ino for name in folders}
    files = [
        p.relative_to(staged).as_posix()
        for p in sorted(staged.rglob("*"))
        if p.is_file() and p.relative_to(staged).parts[0] not in folders
    ]
    for place in sorted(staged.rglob("*"), reverse=True):
        sync(place)
    journal = {"folders": inodes, "files": files, "removed": list(removed)}
    (staged / _JOURNAL).write_text(json.dumps(journal), "utf-8")
    sync(staged / _JOURNAL)
    sync(staged)
    with uninterrupted():
        staged.rename(work / _COMMIT)
        sync(work)
        finish(root)


def finish(root: Path) -> None:
    """Complete a committed change, if there is one, and clear away what an aborted one left. Needs the lock.

    Each move is done once however often this is cut off and run again.
    """
    work, commit = root / WORK, root / WORK / _COMMIT
    if is_committing(root):
        journal: dict[str, Any] = json.loads((commit / _JOURNAL).read_text("utf-8"))
        for name in journal["removed"]:
            _put_away(root / name, commit)
        for name, inode in journal["folders"].items():
            _bring(commit / name, root / name, inode, commit)
        for name in journal["files"]:
            if (commit / name).exists():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                if (root / name).exists():
                    shutil.copymode(root / name, commit / name)
                os.replace(commit / name, root / name)
        sync(root)
        # From here on nothing is left to be moved.
        commit.rename(work / f"done-{os.getpid()}-{time.monotonic_ns()}")
    shutil.rmtree(work, ignore_errors=True)


def abandon(root: Path) -> None:
    """Clear away what was staged, unless it has been committed. Needs the lock."""
    if not is_committing(root):
        shutil.rmtree(root / WORK, ignore_errors=True)


def is_committing(root: Path) -> bool:
    """Whether a change has been made whose files are not all in place."""
    return (root / WORK / _COMMIT).exists()


def _bring(new: Path, place: Path, inode: int, commit: Path) -> None:
    """Put a folder in place of another; it is known by its inode, for an exchange could be undone by a second."""
    if _inode(place) == inode or not new.exists():
        return
    if _inode(place) is not None and not _exchange(new, place):
        _put_away(place, commit)
    if _inode(place) is None:
        new.rename(place)


def _put_away(place: Path, commit: Path) -> None:
    if _inode(place) is not None:
        (commit / _OLD).mkdir(exist_ok=True)
        place.rename(commit / _OLD / place.name)


def _inode(place: Path) -> int | None:
    try:
        return place.lstat().st_ino
    except FileNotFoundError:
        return None


def _exchange(one: Path, other: Path) -> bool:
    """Exchange two folders at a stroke; False where the system cannot."""
    call = _renameat2()
    at_cwd, exchange = -100, 2  # <fcntl.h>, <linux/fs.h>
    return bool(call) and call(at_cwd, os.fsencode(one), at_cwd, os.fsencode(other), exchange) == 0


@cache
def _renameat2() -> Any:
    if not sys.platform.startswith("linux"):
        return None
    with contextlib.suppress(OSError, AttributeError):
        call = ctypes.CDLL(None).renameat2
        call.argtypes = (ctypes.c_int, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_uint)
        return call
    return None


@contextlib.contextmanager
def uninterrupted() -> Iterator[None]:
    """Hold back the signals by which users and systems end a command, for the moment of a change."""
    if sys.platform == "win32":
        yield
        return
    old = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM, signal.SIGHUP})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, old)
