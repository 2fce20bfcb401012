"""What ``ragg derive`` writes below the root of the project: all of it, or nothing."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from derive import everything
from ragg_runtime.base import transaction
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.lock import locked

_PATIENCE = 60.0  # s

HOME = Path(str(everything.__file__)).parents[1]
"""Where the project stands: the root to write to unless another is named."""

Folders = Mapping[str, Mapping[str, str]]
"""Folder below the root -> path in it -> text."""


def rederived(root: Path) -> list[str]:
    """Derive everything and write it below ``root``; returns the paths that changed."""
    return publish(root, everything.folders(), whole=(everything.GENERATED,))


@dataclass(frozen=True)
class Checked:
    """What is committed below a root against what the derivation yields.

    Attributes
    ----------
    difference
        Of the files, as text; empty if there is none.
    versions
        What is to be said of other versions of what derives, if they are others.
    committed_with
        The SymPy that derived what is committed.
    """

    difference: str
    versions: str | None
    committed_with: str


def checked(root: Path) -> Checked:
    """Compare, and write nothing; UserError if a killed ``ragg derive`` left something half done."""
    check_settled(root)
    return Checked(
        difference=everything.difference(root),
        versions=everything.about_versions(root),
        committed_with=everything.committed_with(root),
    )


def publish(root: Path, folders: Folders, whole: tuple[str, ...]) -> list[str]:
    """Make the folders hold these files; returns the paths that changed.

    Of the folders in ``whole``, files that are not given are removed, byte code with them if anything
    changed; in the others the rest is left alone. Raises UserError if that cannot be written.
    """
    with _held(root, tuple(folders)):
        changed = [
            f"{folder}/{name}" for folder in folders for name in _changed(root, folder, folders, whole)
        ]
        if not changed:
            return []
        replaced = [f for f in whole if any(name.startswith(f"{f}/") for name in changed)]
        staged = transaction.stage(root)
        for folder, files in folders.items():
            for name, text in files.items():
                if folder in replaced or f"{folder}/{name}" in changed:
                    place = staged / folder / name
                    place.parent.mkdir(parents=True, exist_ok=True)
                    place.write_bytes(text.encode())
        transaction.switch(root, replaced)
    return changed


def check_settled(root: Path) -> None:
    """UserError if a killed ``ragg derive`` left something half done: who only looks does not finish it."""
    if transaction.is_committing(root):
        raise UserError(
            "an earlier `ragg derive` was cut off before all that it made was in place",
            where=root,
            remedy=f"finish it with: ragg derive --out {root}",
        )


@contextlib.contextmanager
def _held(root: Path, among: tuple[str, ...]) -> Iterator[None]:
    try:
        root.mkdir(parents=True, exist_ok=True)
        with locked(root, _PATIENCE):
            transaction.finish(root, among)
            try:
                yield
            finally:
                transaction.abandon(root)
    except TimeoutError:
        raise UserError(
            "another command is deriving there", where=root, remedy="wait for it to end and try again"
        ) from None
    except OSError as error:
        raise UserError(
            "what was derived cannot be written", where=error.filename or root, found=error.strerror or error
        ) from None


def _changed(root: Path, folder: str, folders: Folders, whole: tuple[str, ...]) -> list[str]:
    """The files of a folder that are not as given, and those that are not given at all."""
    place, files = root / folder, folders[folder]
    changed = [n for n, text in files.items() if not _holds(place / n, text.encode())]
    if folder in whole:
        present = (p for p in place.rglob("*") if p.is_file() and "__pycache__" not in p.parts)
        changed += sorted({p.relative_to(place).as_posix() for p in present} - set(files))
    return changed


def _holds(path: Path, content: bytes) -> bool:
    return path.is_file() and not path.is_symlink() and path.read_bytes() == content
