"""A model directory: model.toml, generated/, history.json, calibration.json, mapping.toml, changed all together or not at all.

A change is a transaction (:mod:`ragg_runtime.base.transaction`): a process may be killed at any instant. Writers
hold a lock; readers need none: they look again if a change came between. What a killed writer left unfinished
is read in its new state and completed by the next writer, or by ``ragg doctor``: who reads moves nothing.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import stat
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from ragg_runtime.base import transaction
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import clear_stale, read_text, sync, temporary_name
from ragg_runtime.base.lock import locked
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model_dir.history import Step, history_text, read_history

__all__ = ["ModelDir", "Step", "create_model_dir", "load_model_dir", "replace_model_dir"]

MODEL, GENERATED, HISTORY, CALIBRATION = "model.toml", "generated", "history.json", "calibration.json"
MAPPING = "mapping.toml"
"""How the columns of the instrument's flight files are read (see ``flight.mapping``); only what the user gives replaces it."""
Code = Mapping[str, str] | Path | None
"""Derived files: path -> text, or a folder to copy; empty or ``None``: the packaged base model."""

NAMES = (MODEL, GENERATED, HISTORY, CALIBRATION, MAPPING)
"""All that a change of a model directory concerns."""

LONGEST = 1 << 26  # bytes of calibration.json
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
    unfinished
        Whether this is the new state of a change that was cut off before all of it was in its place.
    calibration
        The text of calibration.json; ``None``: nothing was ever saved.
    mapping
        The file that says what the columns of the instrument's flight files are; ``None``: there is none.
    """

    path: Path
    text: str
    instrument: Instrument
    generated: Path | None
    history: tuple[Step, ...]
    digest: str
    unfinished: bool = False
    calibration: str | None = None
    mapping: Path | None = None

    @property
    def notes(self) -> tuple[str, ...]:
        """What is odd about the directory, in sentences."""
        if not self.unfinished:
            return ()
        return (
            "a change of this model was cut off after it had been made; its new state is read here, and put in "
            f"place by the next command that changes the model, or by: ragg doctor {self.path}",
        )


def load_model_dir(path: Path | str) -> ModelDir:
    """The model in a directory; of a change that another process left unfinished, the new state.

    Raises UserError if it is not a model directory or one of its files is damaged. Nothing is written.
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
        if transaction.is_committing(path):
            unfinished = _unfinished(path)
            if unfinished is not None:
                return unfinished
            continue
        before = _stamp(path)
        try:
            state = _read(path, {name: path / name for name in NAMES})
        except (UserError, FileNotFoundError):
            # Read amidst a change, a file may be missing.
            if _stamp(path) == before and not transaction.is_committing(path):
                raise
        else:
            if _stamp(path) == before and not transaction.is_committing(path):
                return state
    raise UserError("the model directory keeps changing", where=path, remedy="wait for the other commands")


def create_model_dir(
    path: Path | str,
    text: str,
    *,
    generated: Code = None,
    history: tuple[Step, ...] = (),
    mapping: str | None = None,
) -> ModelDir:
    """Make a model directory with this model.toml (and mapping.toml). It appears whole or not at all.

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
        clear_stale(path.absolute())
        staging = temporary_name(path.absolute())
        staging.mkdir()
    except OSError as error:
        raise UserError("the model directory cannot be made", where=path, found=error.strerror) from None
    try:
        _stage(staging, text, generated, history, mapping=mapping)
        for place in sorted(staging.rglob("*"), reverse=True):
            sync(place)
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
    current: ModelDir,
    text: str,
    *,
    generated: Code,
    step: Step | None = None,
    calibration: Callable[[str | None], str] | None = None,
    mapping: str | None = None,
) -> ModelDir:
    """Put a new state in place of ``current``: all of it, or nothing if this fails or is killed.

    ``step`` is added to the history, and ``calibration`` is given the text of calibration.json and makes the new one: of both
    what is there now counts, so that a calibration saved meanwhile hinders nobody. What is not given stays.

    Raises UserError if model.toml was changed since ``current`` was read, or if the directory cannot be written.
    """
    path = current.path
    parse_instrument(text, path / MODEL)
    with contextlib.ExitStack() as held:
        try:
            held.enter_context(locked(path, _PATIENCE))
            transaction.finish(path, NAMES)
        except TimeoutError:
            raise UserError(
                "another command is changing the model", where=path, remedy="wait for it to end and try again"
            ) from None
        except OSError as error:
            raise UserError("the model cannot be written", where=path, found=error.strerror) from None
        found = load_model_dir(path)
        if found.text != current.text:
            raise UserError(
                "the model was changed by someone else meanwhile",
                where=path,
                remedy="look at it with: ragg history, load it again and repeat the change",
            )
        history = found.history if step is None else (*found.history, step)
        kept = None if calibration is None else calibration(found.calibration)
        try:
            _stage(transaction.stage(path), text, generated, history, kept, mapping)
            folders, removed = ((GENERATED,), ()) if generated else ((), (GENERATED,))
            transaction.switch(path, folders, removed=removed)
        except OSError as error:
            raise UserError(
                "the model cannot be written", where=path, found=error.strerror or error
            ) from None
        finally:
            transaction.abandon(path)
    return load_model_dir(path)


def _stage(
    folder: Path,
    text: str,
    generated: Code,
    history: tuple[Step, ...],
    calibration: str | None = None,
    mapping: str | None = None,
) -> None:
    """Write a complete state into an empty folder."""
    if mapping is not None:
        (folder / MAPPING).write_bytes(mapping.encode())
    if calibration is not None:
        (folder / CALIBRATION).write_bytes(calibration.encode())
    (folder / MODEL).write_bytes(text.encode())
    (folder / HISTORY).write_text(history_text(history), "utf-8")
    if isinstance(generated, Path):
        shutil.copytree(generated, folder / GENERATED, ignore=shutil.ignore_patterns("__pycache__"))
        return
    for name, content in (generated or {}).items():
        place = folder / GENERATED / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content.encode())


def _unfinished(path: Path) -> ModelDir | None:
    """The new state of a dead process's change; one that is alive gets a moment to finish its own (``None``)."""
    try:
        with locked(path, 0.0):
            if not transaction.is_committing(path):
                return None
            return replace(_read(path, transaction.places(path, NAMES)), unfinished=True)
    except TimeoutError:
        time.sleep(0.002)
        return None
    except OSError as error:
        raise UserError(
            "a change of the model was interrupted, and what it made cannot be read",
            where=error.filename or path,
            found=error.strerror,
            remedy=f"make the directory writable, then: ragg doctor {path}",
        ) from None


def _stamp(path: Path) -> tuple[tuple[int, int, int] | None, ...]:
    """What changes whenever one of these things is replaced or edited."""
    found: list[tuple[int, int, int] | None] = []
    for name in NAMES:
        try:
            status = (path / name).lstat()
        except FileNotFoundError:
            found.append(None)
        else:
            found.append((status.st_ino, status.st_mtime_ns, status.st_size))
    return tuple(found)


def _read(path: Path, places: Mapping[str, Path | None]) -> ModelDir:
    """The state whose parts stand at these ``places`` (:func:`ragg_runtime.base.transaction.places`)."""
    model, generated, history, calibration, mapping = (places[name] for name in NAMES)
    if model is None or not os.path.lexists(model):
        raise UserError(
            "not a model directory: model.toml is missing",
            where=path,
            found=", ".join(sorted(p.name for p in path.iterdir())[:8]) or "an empty directory",
            remedy="make a model with: ragg new",
        )
    for place in (model, history, calibration, mapping):
        if place is not None and place.is_symlink():
            raise UserError(
                "links in a model directory are not followed",
                where=place,
                found=f"a link to {os.readlink(place)}",
                expected="the file itself",
                remedy="put the file there in place of the link",
            )
    text = read_text(model)
    return ModelDir(
        path=path,
        text=text,
        instrument=parse_instrument(text, path / MODEL),
        generated=generated if generated is not None and generated.is_dir() else None,
        history=() if history is None else read_history(history),
        digest=_digest(places),
        calibration=(
            read_text(calibration, LONGEST)
            if calibration is not None and os.path.lexists(calibration)
            else None
        ),
        mapping=mapping if mapping is not None and mapping.exists() else None,
    )


def _digest(places: Mapping[str, Path | None]) -> str:
    """SHA-256 over all of it. Links and pipes in generated/ count by what they are, and are not followed."""
    total = hashlib.sha256()
    for name in (MODEL, HISTORY, CALIBRATION, GENERATED):
        top = places[name]
        for file in [] if top is None else _below(top) if name == GENERATED else [top]:
            try:
                status = file.lstat()
                if stat.S_ISLNK(status.st_mode):
                    content = b"link " + os.fsencode(os.readlink(file))
                elif stat.S_ISREG(status.st_mode):
                    content = file.read_bytes()
                else:
                    content = b"neither file nor folder"
            except FileNotFoundError:
                continue
            shown = Path(name, file.relative_to(top)) if top is not None else file
            total.update(f"{shown.as_posix()} {len(content)}\n".encode(errors="surrogateescape"))
            total.update(content)
    return total.hexdigest()


def _below(folder: Path) -> list[Path]:
    """Everything in a folder but byte code; links are not followed, the folder's own neither."""
    if folder.is_symlink():
        return [folder]
    found = []
    for place, folders, files in os.walk(folder):
        folders[:] = [f for f in folders if f != "__pycache__"]
        links = [f for f in folders if Path(place, f).is_symlink()]
        found += [Path(place, name) for name in (*files, *links)]
    return sorted(found)
