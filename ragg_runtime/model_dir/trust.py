"""Whose Python may be executed: the effects of a user's own folder, and nobody else's.

A model.toml may name a folder of Python files (``effects_folder``). They are executed if

- folder, files and model.toml belong to the user who runs the command (or to the system's administrator),
  nobody else may write to them, and the files do what effect files do (:mod:`ragg_runtime.model_dir.effect_source`), or
- the user has said ``ragg trust MODEL_DIR`` about exactly these files, byte for byte, or
- the environment variable ``RAGG_TRUST_EFFECTS`` is ``all``.

Where ``RAGG_TRUST_EFFECTS`` is ``listed``, belonging to the user is not enough.
"""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import platformdirs

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.base.files import write_text
from ragg_runtime.base.ownership import _doubts, belongs_to_user
from ragg_runtime.model_dir.effect_source import unusual

VARIABLE = "RAGG_TRUST_EFFECTS"
"""``all``: execute whatever a model directory names; ``listed``: only what `ragg trust` was told."""

_LARGEST = 1 << 20  # bytes of one file
_MOST = 200  # files


@dataclass(frozen=True)
class OwnEffects:
    """The Python files of a folder of own effects, as they were read.

    Attributes
    ----------
    folder
        The folder.
    sources
        Path -> text of every ``*.py`` file in it.
    digest
        SHA-256 over names and texts, hexadecimal.
    doubts
        Why they should not be executed unasked; none if they may be.
    """

    folder: Path
    sources: Mapping[Path, bytes]
    digest: str
    doubts: tuple[str, ...]


def trusted_sources(folder: Path, model: Path | None) -> Mapping[Path, bytes]:
    """The sources of a folder of own effects, if they may be executed; ``model`` is the model.toml.

    Raises UserError, with the remedy, where they may not, or cannot be read.
    """
    found = read_effects(folder, model)
    choice = os.environ.get(VARIABLE, "")
    if choice not in ("", "all", "listed"):
        raise UserError(f"{VARIABLE} has no such value", found=repr(choice), expected="all, listed, or unset")
    if choice == "all" or found.digest in _listed():
        return found.sources
    doubts = found.doubts or (("not listed as trusted",) if choice == "listed" else ())
    if doubts and found.sources:
        place = model.parent if model is not None else "MODEL_DIR"
        raise UserError(
            "the model names Python files that are not executed unasked",
            where=at(model, "effects_folder"),
            found="; ".join(doubts[:5]),
            expected="files of your own that nobody else can write to and that only describe effects",
            remedy=f"read the files in {folder}; if you trust them: ragg trust {place}",
        )
    return found.sources


def read_effects(folder: Path, model: Path | None) -> OwnEffects:
    """Read every ``*.py`` of a folder, and look whose they are. Raises UserError if that fails."""
    doubts: list[str] = []
    sources: dict[Path, bytes] = {}
    try:
        for place in (folder, *(() if model is None else (model,))):
            if place.exists():
                doubts += _whose(place, place.stat())
        names = sorted(p for p in folder.iterdir() if p.suffix == ".py" and not p.name.startswith("."))
        if len(names) > _MOST:
            raise UserError(
                "the folder of own effects holds too many files",
                where=folder,
                found=len(names),
                expected=_MOST,
            )
        for path in names:
            sources[path], status = _read(path)
            doubts += _whose(path, status)
            strange = unusual(sources[path])
            doubts += [] if strange is None else [f"{path}, {strange}"]
    except OSError as error:
        raise UserError(
            "the folder of own effects cannot be read", where=error.filename or folder, found=error.strerror
        ) from None
    total = hashlib.sha256()
    for path, text in sources.items():
        total.update(f"{path.name} {len(text)}\n".encode("utf-8", "surrogateescape") + text)
    return OwnEffects(folder, sources, total.hexdigest(), tuple(doubts))


def trust(found: OwnEffects) -> Path:
    """Remember that exactly these files may be executed; returns the file in which that stands."""
    place = _list_file()
    place.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    lines = [line for line in _lines() if not line.startswith(found.digest)]
    shown = str(found.folder.resolve()).encode(errors="replace").decode().replace("\n", " ")
    write_text(place, "".join(f"{line}\n" for line in (*lines, f"{found.digest}  {shown}")))
    return place


def forget(found: OwnEffects) -> bool:
    """Take these files off the list again; False if they were not on it."""
    lines = list(_lines())
    left = [line for line in lines if not line.startswith(found.digest)]
    if len(left) < len(lines):
        write_text(_list_file(), "".join(f"{line}\n" for line in left))
    return len(left) < len(lines)


def _read(path: Path) -> tuple[bytes, os.stat_result]:
    """Text and status of the same file, whatever is put in its place meanwhile."""
    # A pipe would never end, were it waited for.
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0))
    with os.fdopen(handle, "rb") as stream:
        status = os.fstat(stream.fileno())
        if not stat.S_ISREG(status.st_mode) or status.st_size > _LARGEST:
            raise UserError(
                "not a Python file of an effect",
                where=path,
                found=f"{status.st_size} bytes" if stat.S_ISREG(status.st_mode) else "not a regular file",
                expected=f"a text of at most {_LARGEST} bytes",
            )
        return stream.read(_LARGEST + 1), status


def _whose(path: Path, status: os.stat_result) -> list[str]:
    return [f"{path} {doubt}" for doubt in _doubts(status)]


def _list_file() -> Path:
    return platformdirs.user_config_path("ragg") / "trusted-effects"


def _listed() -> frozenset[str]:
    return frozenset(line.split()[0] for line in _lines() if line.strip())


def _lines() -> tuple[str, ...]:
    try:
        text, status = _read(_list_file())
    except (OSError, UserError):
        return ()
    return tuple(text.decode(errors="replace").splitlines()) if belongs_to_user(status) else ()
