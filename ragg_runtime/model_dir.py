"""A model directory: model.toml, generated/ and history.json, changed all together or not at all.

A change is staged in ``<model>/.ragg/next``. The rename of that folder to ``.ragg/commit`` is the instant at
which it is made: before it the old state stands, and what was staged is waste; after it the new one does, and
whoever comes next finishes moving the three things into place. So a process may be killed at any instant.
Writers hold a lock; readers need none: they look again if a change came between.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ragg_runtime.atomic import sync
from ragg_runtime.errors import UserError
from ragg_runtime.history import Step, history_text, read_history
from ragg_runtime.instrument import Instrument, parse_instrument, read_text
from ragg_runtime.lock import locked

__all__ = ["ModelDir", "Step", "create_model_dir", "load_model_dir", "replace_model_dir"]

MODEL, GENERATED, HISTORY = "model.toml", "generated", "history.json"
_WORK = ".ragg"
_JOURNAL = "journal.json"
_PATIENCE = 30.0  # s; a change holds the lock for a fraction of a second


@dataclass(frozen=True, eq=False)
class ModelDir:
    """The state of a model directory as it was read.

    Attributes
    ----------
    path
        The directory.
    text
        The text of model.toml, comments and all.
    instrument
        What it says.
    generated
        The folder of code derived for its effects; ``None``: the packaged base model.
    history
        The steps so far, oldest first.
    digest
        SHA-256 over all of it, hexadecimal: equal states have equal digests.
    """

    path: Path
    text: str
    instrument: Instrument
    generated: Path | None
    history: tuple[Step, ...]
    digest: str


def load_model_dir(path: Path | str) -> ModelDir:
    """The model in a directory; a change that another process left unfinished is finished first.

    Raises UserError if it is not a model directory or one of its files is damaged.
    """
    path = Path(path)
    if not path.is_dir():
        raise UserError(
            "there is no model directory",
            where=path,
            found="a file" if path.exists() else "nothing",
            remedy=f"make one with: ragg new {path}",
        )
    deadline = time.monotonic() + _PATIENCE
    while time.monotonic() < deadline:
        if _is_committing(path):
            _recover(path)
            continue
        before = _stamp(path)
        try:
            state = _read(path)
        except (UserError, FileNotFoundError):
            # Read amidst a change, a file may be missing.
            if _stamp(path) == before and not _is_committing(path):
                raise
        else:
            if _stamp(path) == before and not _is_committing(path):
                return state
    raise UserError("the model directory keeps changing", where=path, remedy="wait for the other commands")


def create_model_dir(
    path: Path | str, text: str, *, generated: Path | None = None, history: tuple[Step, ...] = ()
) -> ModelDir:
    """Make a model directory with this model.toml; ``generated`` is copied. It appears whole or not at all.

    Raises UserError if ``path`` exists and is not an empty directory, or if ``text`` is no good model.toml.
    """
    path = Path(path)
    parse_instrument(text, path / MODEL)
    if path.exists() and not (path.is_dir() and not any(path.iterdir())):
        raise UserError(
            "the model directory exists already", where=path, remedy="choose another name or remove it first"
        )
    parent = path.absolute().parent
    try:
        parent.mkdir(parents=True, exist_ok=True)
        staging = Path(tempfile.mkdtemp(prefix=f".{path.name}.", dir=parent))
    except OSError as error:
        raise UserError("the model directory cannot be made", where=path, found=error.strerror) from None
    try:
        _stage(staging, text, generated, history)
        staging.chmod(parent.stat().st_mode & 0o777)
        if path.exists():
            path.rmdir()
        staging.rename(path)
        sync(parent)
    except OSError as error:
        raise UserError("the model directory cannot be made", where=path, found=error.strerror) from None
    finally:
        shutil.rmtree(staging, ignore_errors=True)
    return load_model_dir(path)


def replace_model_dir(
    current: ModelDir, text: str, *, generated: Path | None, history: tuple[Step, ...]
) -> ModelDir:
    """Put a new state in place of ``current``: all three things, or nothing if this fails or is killed.

    ``generated`` is a folder anywhere, which is copied; ``None`` falls back to the packaged base model.
    Raises UserError if the directory was changed since ``current`` was read, or cannot be written.
    """
    path = current.path
    parse_instrument(text, path / MODEL)
    with contextlib.ExitStack() as held:
        try:
            held.enter_context(locked(path, _PATIENCE))
            _finish(path)
        except TimeoutError:
            raise UserError(
                "another command is changing the model", where=path, remedy="wait for it to end and try again"
            ) from None
        except OSError as error:
            raise UserError("the model cannot be written", where=path, found=error.strerror) from None
        if load_model_dir(path).digest != current.digest:
            raise UserError(
                "the model was changed by someone else meanwhile",
                where=path,
                remedy="look at it with: ragg history, and run the command again",
            )
        work = path / _WORK
        try:
            staging = work / "next"
            staging.mkdir(parents=True)
            _stage(staging, text, generated, history)
            _switch(path)
        except OSError as error:
            raise UserError(
                "the model cannot be written", where=path, found=error.strerror or error
            ) from None
        finally:
            if not _is_committing(path):
                shutil.rmtree(work, ignore_errors=True)
    return load_model_dir(path)


def _stage(folder: Path, text: str, generated: Path | None, history: tuple[Step, ...]) -> None:
    """Write a complete state into an empty folder, on the disc."""
    (folder / MODEL).write_bytes(text.encode())
    (folder / HISTORY).write_text(history_text(history), "utf-8")
    if generated is not None:
        shutil.copytree(generated, folder / GENERATED, ignore=shutil.ignore_patterns("__pycache__"))
    for place in sorted(folder.rglob("*"), reverse=True):
        sync(place)
    sync(folder)


def _switch(path: Path) -> None:
    """Commit what is staged and move it into place."""
    work = path / _WORK
    journal = work / "next" / _JOURNAL
    journal.write_text(json.dumps({"generated": (work / "next" / GENERATED).exists()}), "utf-8")
    sync(journal)
    sync(work / "next")
    with _uninterrupted():
        (work / "next").rename(work / "commit")
        sync(work)
        _finish(path)


def _finish(path: Path) -> None:
    """Complete a committed change, if there is one, and clear away what an aborted one left. Needs the lock.

    Each move is done once whenever this is cut off and run again: what has been moved is no longer there.
    """
    work, commit = path / _WORK, path / _WORK / "commit"
    if _is_committing(path):
        _move_generated(path, commit)
        for name in (MODEL, HISTORY):
            if (commit / name).exists():
                if (path / name).exists():
                    shutil.copymode(path / name, commit / name)
                os.replace(commit / name, path / name)
        sync(path)
        # From here on nothing is left to be moved.
        commit.rename(work / f"done-{os.getpid()}-{time.monotonic_ns()}")
    shutil.rmtree(work, ignore_errors=True)


def _move_generated(path: Path, commit: Path) -> None:
    """Move the old generated/ out of the way and the new one in, each once."""
    old, new, place = commit / "old", commit / GENERATED, path / GENERATED
    if json.loads((commit / _JOURNAL).read_text("utf-8"))["generated"]:
        if new.exists():
            if place.exists():
                place.rename(old)
            new.rename(place)
    elif place.exists():
        place.rename(old)


def _is_committing(path: Path) -> bool:
    return (path / _WORK / "commit").exists()


def _recover(path: Path) -> None:
    """Finish a dead process's change; one that is alive gets a moment to finish its own."""
    try:
        with locked(path, 0.0):
            _finish(path)
    except TimeoutError:
        time.sleep(0.002)
    except OSError as error:
        raise _cannot_complete(path, error) from None


def _cannot_complete(path: Path, error: OSError) -> UserError:
    return UserError(
        "a change of the model was interrupted and cannot be completed",
        where=path,
        found=error.strerror,
        remedy="make the directory writable and run any command on it",
    )


@contextlib.contextmanager
def _uninterrupted() -> Iterator[None]:
    """Hold back the signals by which users and systems end a command, for the moment of a change."""
    if sys.platform == "win32":
        yield
        return
    old = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM, signal.SIGHUP})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, old)


def _stamp(path: Path) -> tuple[tuple[int, int, int] | None, ...]:
    """What changes whenever one of the three things is replaced or edited."""
    found: list[tuple[int, int, int] | None] = []
    for name in (MODEL, GENERATED, HISTORY):
        try:
            status = (path / name).stat()
        except FileNotFoundError:
            found.append(None)
        else:
            found.append((status.st_ino, status.st_mtime_ns, status.st_size))
    return tuple(found)


def _read(path: Path) -> ModelDir:
    if not (path / MODEL).exists():
        raise UserError(
            "not a model directory: model.toml is missing",
            where=path,
            found=", ".join(sorted(p.name for p in path.iterdir())[:8]) or "an empty directory",
            remedy="make a model with: ragg new",
        )
    text = read_text(path / MODEL)
    history = read_history(path / HISTORY)
    generated = path / GENERATED if (path / GENERATED).is_dir() else None
    return ModelDir(
        path=path,
        text=text,
        instrument=parse_instrument(text, path / MODEL),
        generated=generated,
        history=history,
        digest=_digest(path),
    )


def _digest(path: Path) -> str:
    total = hashlib.sha256()
    files = [path / MODEL, path / HISTORY]
    files += sorted(p for p in (path / GENERATED).rglob("*") if "__pycache__" not in p.parts)
    for file in files:
        try:
            content = file.read_bytes()
        except (FileNotFoundError, IsADirectoryError):
            continue
        total.update(f"{file.relative_to(path).as_posix()} {len(content)}\n".encode())
        total.update(content)
    return total.hexdigest()
