"""Which Python of a model directory may be executed: exactly the files that the user has listed, and no other.

A model.toml may name a folder of Python files (``effects_folder``). Whose they are says nothing: an archive that is
unpacked belongs to who unpacks it. What they do cannot be told from their text. So none is executed before the user
has said ``ragg trust MODEL_DIR`` about these very files, byte for byte; the list of such digests is kept in the user's
own configuration, out of reach of any model directory. ``RAGG_TRUST_EFFECTS=all`` switches the question off.
"""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import platformdirs

from ragg_runtime.base.errors import UserError, at, one_line
from ragg_runtime.base.files import write_text
from ragg_runtime.base.ownership import belongs_to_user

VARIABLE = "RAGG_TRUST_EFFECTS"
"""``all``: execute whatever a model directory names; ``listed`` or unset: only what `ragg trust` was told."""

_LARGEST = 1 << 20  # bytes of one file
_MOST = 200  # files
_NAMED = 5  # files that the refusal names; `ragg trust` lists them all


@dataclass(frozen=True)
class OwnEffects:
    """The Python files of a folder of own effects, as they were read.

    Attributes
    ----------
    folder
        The folder.
    sources
        Path -> text of every ``*.py`` file in it: what would be executed.
    digest
        SHA-256 over names and texts, hexadecimal.
    """

    folder: Path
    sources: Mapping[Path, bytes]
    digest: str

    def lines(self) -> list[str]:
        """What would be executed, one line per file: its place, size and SHA-256."""
        return [
            f"{one_line(str(path))}  ({len(text)} bytes, SHA-256 {hashlib.sha256(text).hexdigest()})"
            for path, text in self.sources.items()
        ]


def trusted_sources(folder: Path, model: Path | None) -> Mapping[Path, bytes]:
    """The sources of a folder of own effects, if they may be executed; ``model`` is the model.toml.

    Raises UserError, with the remedy, where they may not, or cannot be read.
    """
    found = read_effects(folder)
    choice = os.environ.get(VARIABLE, "")
    if choice not in ("", "all", "listed"):
        raise UserError(f"{VARIABLE} has no such value", found=repr(choice), expected="all, listed, or unset")
    if not found.sources or choice == "all" or is_trusted(found):
        return found.sources
    lines = found.lines()
    more = [f"and {len(lines) - _NAMED} more"] if len(lines) > _NAMED else []
    place: Path | str = "MODEL_DIR"
    if model is not None:
        place = model.parent if model.name == "model.toml" else model
    raise UserError(
        "the model names Python files, and they have not been listed as trusted as they are now: none was executed",
        where=at(model, "effects_folder"),
        found="\n".join(["these would run:", *lines[:_NAMED], *more]),
        expected="files that you have read; whose they are is no matter: what you unpack is yours",
        remedy=f"read them; if you want them to run: ragg trust {place}",
    )


def read_effects(folder: Path) -> OwnEffects:
    """Read every ``*.py`` of a folder; nothing is executed. Raises UserError if that fails."""
    sources: dict[Path, bytes] = {}
    try:
        names = sorted(p for p in folder.iterdir() if p.suffix == ".py" and not p.name.startswith("."))
        if len(names) > _MOST:
            raise UserError(
                "the folder of own effects holds too many files",
                where=folder,
                found=len(names),
                expected=_MOST,
            )
        for path in names:
            sources[path], _ = _read(path)
    except OSError as error:
        raise UserError(
            "the folder of own effects cannot be read", where=error.filename or folder, found=error.strerror
        ) from None
    total = hashlib.sha256()
    for path, text in sources.items():
        total.update(f"{path.name} {len(text)}\n".encode("utf-8", "surrogateescape") + text)
    return OwnEffects(folder=folder, sources=sources, digest=total.hexdigest())


def is_trusted(found: OwnEffects) -> bool:
    """Whether exactly these files are on the user's list."""
    return found.digest in _listed()


def trust(found: OwnEffects) -> Path:
    """Remember that exactly these files may be executed; returns the file in which that stands."""
    place = _list_file()
    place.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    lines = [line for line in _lines() if not line.startswith(found.digest)]
    shown = one_line(str(found.folder.resolve()))
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
