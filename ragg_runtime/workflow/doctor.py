"""A damaged model directory: what is wrong, in one message each, and the way back.

Nothing that somebody may have written by hand is thrown away: what has to make room is kept beside its place.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ragg_runtime.base import transaction
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text
from ragg_runtime.base.folder import Folder, kind
from ragg_runtime.base.form_version import NewerFormError
from ragg_runtime.base.lock import locked
from ragg_runtime.compensation import saved
from ragg_runtime.flight.mapping import read_mapping
from ragg_runtime.model_dir import derive, derived_cache
from ragg_runtime.model_dir.directory import (
    CALIBRATION,
    GENERATED,
    HISTORY,
    LONGEST,
    MODEL,
    NAMES,
    ModelDir,
    load_model_dir,
    replace_model_dir,
)
from ragg_runtime.model_dir.history import read_history

_PATIENCE = 30.0  # s; as long as any command waits for another one's change


@dataclass(frozen=True)
class Finding:
    """Something that is not in order.

    Attributes
    ----------
    what
        In a sentence, or the message of the error that it causes.
    way_back
        What was done about it, or what to do; empty where ``what`` says so.
    open
        Whether it is still so.
    """

    what: str
    way_back: str
    open: bool


def examined(path: Path, *, mend: bool) -> tuple[Finding, ...]:
    """What is wrong with a model directory; what can be mended without loss is, if ``mend``.

    Raises UserError where there is no such directory, it cannot be written, or a newer program has written there.
    """
    if not path.is_dir():
        raise UserError("there is no model directory", where=path, remedy=f"make one with: ragg new {path}")
    try:
        with contextlib.ExitStack() as held:
            if mend:
                held.enter_context(locked(path, _PATIENCE))
            found = [*_change(path, mend), *_kept(path, mend)]
    except TimeoutError:
        raise UserError(
            "another command is changing the model", where=path, remedy="wait for it to end and try again"
        ) from None
    except OSError as error:
        raise UserError(
            "the model directory cannot be mended", where=error.filename or path, found=error.strerror
        ) from None
    if not mend and any(f.open for f in found):
        return tuple(found)  # what else is wrong shows when that is mended
    try:
        current = load_model_dir(path)
        found += _mapping(current)
        found += _code(current, mend)
    except UserError as error:
        found.append(Finding(what=error.message, way_back="", open=True))
    return tuple(found)


def _change(path: Path, mend: bool) -> Iterator[Finding]:
    """A change that was cut off: before it was made, after that, or one that nobody here has made."""
    with Folder.at(path) as top:
        work = top.status(transaction.WORK)
    if work is None:
        return
    if not transaction.is_committing(path):
        if mend:
            transaction.finish(path, NAMES)
        yield Finding(
            what=f"{transaction.WORK}: a command was cut off before its change was made; the model is as before it",
            way_back="what it left was cleared away" if mend else "the next change clears away what it left",
            open=not mend,
        )
        return
    try:
        if mend:
            transaction.finish(path, NAMES)
        else:
            transaction.places(path, NAMES)
    except NewerFormError:
        raise
    except UserError as error:
        kept = _aside(path, transaction.WORK, "ragg-unfinished") if mend else ""
        done = f"put aside as {kept}; the model is as {MODEL} says"
        yield Finding(what=error.message, way_back=done if mend else "", open=not mend)
        return
    yield Finding(
        what=f"{transaction.WORK}: a change was cut off after it had been made",
        way_back="it is complete now" if mend else "ragg doctor, or the next change, completes it",
        open=not mend,
    )


def _kept(path: Path, mend: bool) -> Iterator[Finding]:
    """A history or a calibration that cannot be read, or is no file; a mapping is left to whoever wrote it."""
    for name, what, read, then in (
        (HISTORY, "history", read_history, "a new history begins with the next step"),
        (CALIBRATION, "saved calibration", _calibration, "without it: ragg calibrate ... --save"),
    ):
        with Folder.at(path) as top:
            status = top.status(name)
        if status is None:
            continue
        try:
            if kind(status) != "a file":
                raise UserError(f"the {what} is no file", where=path / name, found=kind(status))
            read(path / name)
        except NewerFormError:
            raise
        except UserError as error:
            kept = _aside(path, name, f"{name}.damaged") if mend else ""
            done = f"kept as {kept}; {then}"
            yield Finding(what=error.message, way_back=done if mend else "", open=not mend)


def _calibration(path: Path) -> object:
    return saved.read(read_text(path, LONGEST), str(path))


def _mapping(current: ModelDir) -> Iterator[Finding]:
    """A mapping that is none."""
    if current.mapping is None:
        return
    try:
        read_mapping(current.mapping)
    except NewerFormError:
        raise
    except UserError as error:
        way_back = "mend it by hand, or remove it: ragg map FLIGHT writes a new one"
        yield Finding(what=error.message, way_back=way_back, open=True)


def _code(current: ModelDir, mend: bool) -> Iterator[Finding]:
    """Code that is not what model.toml derives. Raises UserError where model.toml itself is wrong."""
    expected = derive.files_of(current.instrument)
    held = {} if current.generated is None else derived_cache.read(current.generated)
    if held == expected or current.unfinished:
        return
    missing = bool(expected) and current.generated is None
    if mend:
        replace_model_dir(current, current.text, generated=expected)
    yield Finding(
        what=f"{GENERATED}/ is missing" if missing else f"{GENERATED}/ is not what {MODEL} derives",
        way_back="derived again" if mend else "it is not used; ragg doctor derives it again",
        open=not mend,
    )


def _aside(path: Path, name: str, kept: str) -> str:
    """Keep something beside its place under a name that is free; returns that."""
    with Folder.at(path) as top:
        number = 1
        while top.status(f"{kept}-{number}") is not None:
            number += 1
        top.move(name, top, f"{kept}-{number}")
    return f"{kept}-{number}"
