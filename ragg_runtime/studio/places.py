"""The folders that the studio may read from and write to: those named at the start, and nothing beside them."""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.formats import ENDINGS, ending_of

LISTED = 500
"""Most entries of a folder that are shown."""

LONGEST_NAME = 120
"""Longest name of an uploaded file, characters."""


@dataclass(frozen=True)
class Places:
    """Folders, resolved, below which files may be touched."""

    roots: tuple[Path, ...]

    @staticmethod
    def of(model: Path | None, flights: Sequence[Path]) -> Places:
        """Those of the model directory and of the flights; the working directory where nothing is named."""
        named = [*([model.parent if model.name else model] if model else []), *(f.parent for f in flights)]
        found = [p.resolve() for p in named] or [Path.cwd()]
        return Places(tuple(dict.fromkeys(found)))

    def inside(self, text: str) -> Path:
        """The file or folder of this name if it lies, links followed, below one of the folders."""
        try:
            path = Path(text).resolve() if text and "\0" not in text else None
        except (OSError, RuntimeError, ValueError):
            path = None
        if path is None or not self.holds(path):
            raise UserError(
                "this place is not open to the studio",
                where=text[:200] or "(no name)",
                expected="a place below " + ", ".join(map(str, self.roots)),
                remedy="name its folder when you start `ragg studio`",
            )
        return path

    def holds(self, path: Path) -> bool:
        """Whether it lies, links followed, below one of the folders."""
        real = path.resolve()
        return any(real == r or r in real.parents for r in self.roots)

    def listing(self, text: str) -> dict[str, object]:
        """What of a folder can be opened: folders, model directories, flights."""
        folder = self.inside(text) if text else self.roots[0]
        if not folder.is_dir():
            raise UserError("there is no such folder", where=folder)
        entries: list[dict[str, object]] = []
        with os.scandir(folder) as found:
            for e in sorted(found, key=lambda e: e.name):
                kind = _kind(e)
                if kind is not None and len(entries) < LISTED:
                    entries.append({"name": e.name, "path": e.path, "kind": kind, "bytes": _size(e)})
        above = str(folder.parent) if any(r in folder.parents for r in self.roots) else None
        return {
            "folder": str(folder),
            "above": above,
            "roots": list(map(str, self.roots)),
            "entries": entries,
        }


def safe_name(name: str) -> str:
    """A name for an uploaded flight: one part, no control characters, of a known ending; or UserError."""
    plain = unicodedata.normalize("NFC", name).replace("\\", "/").split("/")[-1]
    plain = re.sub(r"[^\w.+ ()-]", "_", plain).strip(" .")
    ending = ending_of(plain)
    if ending is None or len(plain) == len(ending):
        raise UserError(
            "this is not a flight file",
            where=name[:200],
            expected="a name that ends in " + ", ".join(ENDINGS),
        )
    if len(plain) > LONGEST_NAME:
        raise UserError("the name is too long", where=plain[:60] + "…", expected=f"{LONGEST_NAME} characters")
    return plain


def _kind(e: os.DirEntry[str]) -> str | None:
    if e.name.startswith("."):
        return None
    if e.is_dir():
        return "model" if Path(e.path, "model.toml").is_file() else "folder"
    if e.name.lower().endswith(".toml"):
        return "sheet"
    return "flight" if ending_of(e.name) else None


def _size(e: os.DirEntry[str]) -> int:
    try:
        return e.stat().st_size if e.is_file() else 0
    except OSError:
        return 0
