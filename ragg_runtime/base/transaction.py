"""Several files and folders of one directory, changed all together or not at all.

A change is staged in ``<root>/.ragg/next``. The rename of that folder to ``.ragg/commit`` is the instant at
which it is made: before it the old state stands, and what was staged is waste; after it the new one does, and
the next command that writes there finishes moving things into place. So a process may be killed at any instant.
A folder that is replaced is exchanged with the new one at a stroke, where the system can do that.

Changes are made under the lock of the directory (:mod:`ragg_runtime.base.lock`). A directory may come from a
stranger, unfinished change and all: what a journal says is followed only where it names things that the caller
changes anyway (``among``), plain names in the directory itself, reached through no link
(:mod:`ragg_runtime.base.folder`). A command that only reads moves nothing: :func:`places` tells it where the
new state stands.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import stat
import sys
import time
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import sync
from ragg_runtime.base.folder import Folder, NotPlainError, is_plain
from ragg_runtime.base.form_version import Form, NewerFormError

WORK = ".ragg"
_NEXT, _COMMIT, _JOURNAL, _OLD = "next", "commit", "journal.json", "old"
_LONGEST = 1 << 20  # bytes of a journal
FORM = Form("the record of an unfinished change")
_DEEPEST = 8  # folders in folders


@dataclass(frozen=True)
class _Journal:
    """What a change puts where: folders (name -> inode of the new one), files (their paths), and what goes."""

    folders: Mapping[str, int]
    files: tuple[str, ...]
    removed: tuple[str, ...]


def stage(root: Path) -> Path:
    """An empty folder to put new files into. Needs the lock; finish(root) must have been called."""
    with Folder.at(root) as top:
        top.remove(WORK)
        with top.below(WORK, make=True) as work, work.below(_NEXT, make=True):
            return root / WORK / _NEXT


def switch(root: Path, folders: Sequence[str], *, removed: Sequence[str] = ()) -> None:
    """Commit what is staged and move it into place.

    Of what is staged, ``folders`` take the place of whole folders; all other files that of files.
    ``removed`` files and folders go. Raises OSError; whether the change was made, says ``is_committing``.
    """
    staged = root / WORK / _NEXT
    files = [
        p.relative_to(staged).as_posix()
        for p in sorted(staged.rglob("*"))
        if p.is_file() and p.relative_to(staged).parts[0] not in folders
    ]
    for place in sorted(staged.rglob("*"), reverse=True):
        sync(place)
    with Folder.at(root) as top:
        for path in files:  # what cannot be done is said before the change is made
            _way(top, path)
    inodes = {name: staged.joinpath(name).stat().st_ino for name in folders}
    journal = {**FORM.stamp(), "folders": inodes, "files": files, "removed": list(removed)}
    (staged / _JOURNAL).write_text(json.dumps(journal), "utf-8")
    sync(staged / _JOURNAL)
    sync(staged)
    with uninterrupted():
        with Folder.at(root) as top, top.below(WORK) as work:
            work.move(_NEXT, work, _COMMIT)
        sync(root / WORK)
        finish(root, {*folders, *removed, *(f.split("/")[0] for f in files)})


def finish(root: Path, among: Collection[str]) -> None:
    """Complete a committed change, if there is one, and clear away what an aborted one left. Needs the lock.

    Each move is done once however often this is cut off and run again. Raises UserError, and moves nothing,
    if the change concerns anything but files and folders ``among`` these in ``root``.
    """
    with Folder.at(root) as top:
        if is_committing(root):
            with top.below(WORK) as work:
                with work.below(_COMMIT) as commit:
                    journal = _journal(commit, among)
                    for path in journal.files:  # nothing is moved if anything cannot be
                        _way(top, path)
                    _complete(top, commit, journal)
                sync(root)
                # From here on nothing is left to be moved.
                work.move(_COMMIT, work, f"done-{os.getpid()}-{time.monotonic_ns()}")
        top.remove(WORK)


def places(root: Path, among: Collection[str]) -> Mapping[str, Path | None]:
    """Where each of these stands once the change is complete, now; ``None``: it is removed. Needs the lock.

    Raises UserError as :func:`finish` does. Nothing is moved.
    """
    found: dict[str, Path | None] = {name: root / name for name in among}
    with Folder.at(root) as top, top.below(WORK) as work, work.below(_COMMIT) as commit:
        journal = _journal(commit, among)
        found |= dict.fromkeys(journal.removed)
        for name, inode in journal.folders.items():
            if not _is(top, name, inode):
                found[name] = commit.path / name
        for name in journal.files:
            if name in found:
                found[name] = commit.path / name if commit.status(name) is not None else root / name
    return found


def abandon(root: Path) -> None:
    """Clear away what was staged, unless it has been committed. Needs the lock."""
    if not is_committing(root):
        with contextlib.suppress(OSError), Folder.at(root) as top:
            top.remove(WORK)


def is_committing(root: Path) -> bool:
    """Whether a change has been made whose files are not all in place."""
    try:
        with Folder.at(root) as top, top.below(WORK) as work:
            return work.status(_COMMIT) is not None
    except (FileNotFoundError, NotADirectoryError, NotPlainError):
        return False


def _complete(top: Folder, commit: Folder, journal: _Journal) -> None:
    for name in journal.removed:
        _put_away(top, name, commit)
    for name, inode in journal.folders.items():
        _bring(top, name, inode, commit)
    for path in journal.files:
        *folders, name = path.split("/")
        with contextlib.ExitStack() as held:
            source, target = commit, top
            try:
                for folder in folders:
                    source = held.enter_context(source.below(folder))
            except FileNotFoundError:
                continue
            if source.status(name) is None:  # moved before
                continue
            for folder in folders:
                target = held.enter_context(target.below(folder, make=True))
            old = target.status(name)
            if old is not None and stat.S_ISREG(old.st_mode):
                source.chmod(name, old.st_mode)
            source.move(name, target, name)


def _way(top: Folder, path: str) -> None:
    """Raise OSError if a link, or something that is no folder, lies on the way to this path."""
    with contextlib.ExitStack() as held:
        for folder in path.split("/")[:-1]:
            if top.status(folder) is None:
                return
            top = held.enter_context(top.below(folder))


def _bring(top: Folder, name: str, inode: int, commit: Folder) -> None:
    """Put a folder in place of another; it is known by its inode, for an exchange could be undone by a second."""
    if _is(top, name, inode) or commit.status(name) is None:
        return
    if top.status(name) is not None and not commit.exchange(name, top, name):
        _put_away(top, name, commit)
    if top.status(name) is None:
        commit.move(name, top, name)


def _put_away(top: Folder, name: str, commit: Folder) -> None:
    if top.status(name) is not None:
        with commit.below(_OLD, make=True) as old:
            top.move(name, old, name)


def _is(top: Folder, name: str, inode: int) -> bool:
    found = top.status(name)
    return found is not None and found.st_ino == inode


def _journal(commit: Folder, among: Collection[str]) -> _Journal:
    """The journal of a change; UserError if it is damaged, or asks for more than this program ever does."""
    try:
        content = json.loads(commit.read(_JOURNAL, _LONGEST))
        FORM.check(content, commit.path / _JOURNAL)
        found = _Journal(
            folders={str(n): int(i) for n, i in content["folders"].items()},
            files=tuple(content["files"]),
            removed=tuple(content["removed"]),
        )
        odd = [n for n in (*found.folders, *found.removed) if not is_plain(n) or n not in among]
        odd += [f for f in found.files if not _is_below(f, among)]
        for path in found.files if not odd else ():
            _way(commit, path)
    except NewerFormError:
        raise
    except (
        UserError,
        OSError,
        ArithmeticError,
        ValueError,
        LookupError,
        TypeError,
        AttributeError,
        RecursionError,
    ) as error:
        raise _refused(commit, str(error)) from None
    if odd:
        raise _refused(commit, f"it is about {', '.join(repr(n)[:60] for n in odd[:3])}")
    return found


def _is_below(path: object, among: Collection[str]) -> bool:
    parts = path.split("/") if isinstance(path, str) else []
    return 0 < len(parts) <= _DEEPEST and all(map(is_plain, parts)) and parts[0] in among


def _refused(commit: Folder, found: str) -> UserError:
    root = commit.path.parents[1]
    return UserError(
        "the record of an unfinished change is none that this program writes; nothing of it was done",
        where=commit.path / _JOURNAL,
        found=found,
        expected="names of things that the change replaces in this directory",
        remedy=f"ragg doctor {root} puts it aside; then the state stands that the directory shows",
    )


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
