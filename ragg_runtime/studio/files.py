"""Which files the studio may touch: folders below those named at the start, and flights that the page sends."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from starlette.requests import ClientDisconnect, Request

from ragg_runtime.base.errors import UserError
from ragg_runtime.io.files import ENDINGS, find_ending
from ragg_runtime.workspace import Loaded

FOLDER = "flights"  # where uploaded flights are kept, in the model directory


@dataclass(frozen=True)
class Places:
    """Folders, resolved, below which files may be touched."""

    roots: tuple[Path, ...]

    @staticmethod
    def of(model: Path | None, flights: Sequence[Path]) -> Places:
        """Those of the model directory and of the flights; the working directory where nothing is named."""
        named = [*([model.parent if model.name else model] if model else []), *(f.parent for f in flights)]
        return Places(tuple(dict.fromkeys(p.resolve() for p in named or [Path.cwd()])))

    def inside(self, text: str) -> Path:
        """The file or folder of this name if it lies, links followed, below one of the folders."""
        try:
            path = Path(text).resolve() if text and "\0" not in text else None
        except (OSError, RuntimeError, ValueError):
            path = None
        if path is None or not any(path == r or r in path.parents for r in self.roots):
            raise UserError(
                "the studio may not use this folder",
                where=text[:200] or "(no name)",
                expected="a place below " + ", ".join(map(str, self.roots)),
                remedy="name its folder when you start `ragg studio`",
            )
        return path

    def listing(self, text: str) -> dict[str, object]:
        """What can be opened in a folder: folders, model directories, test sheets, flights."""
        folder = self.inside(text) if text else self.roots[0]
        if not folder.is_dir():
            raise UserError("there is no such folder", where=folder)
        with os.scandir(folder) as entries:
            kinds = [(e, _find_kind(e)) for e in sorted(entries, key=lambda e: e.name)]
        return {
            "folder": str(folder),
            "above": str(folder.parent) if any(r in folder.parents for r in self.roots) else None,
            "roots": list(map(str, self.roots)),
            "entries": [{"name": e.name, "path": e.path, "kind": kind} for e, kind in kinds if kind],
        }


def _find_kind(e: os.DirEntry[str]) -> str | None:
    if e.name.startswith("."):
        return None
    if e.is_dir():
        return "model" if Path(e.path, "model.toml").is_file() else "folder"
    if e.name.lower().endswith(".toml"):
        return "sheet"
    return "flight" if find_ending(e.name) else None


# --- flights that the page sends -----------------------------------------------------------------------


async def receive_flight(m: Loaded, name: str, request: Request) -> Path:
    """The body of a request as a file; nothing is overwritten. UserError if it does not arrive whole."""
    folder, safe_name = m.directory.path.resolve() / FOLDER, make_safe(name)
    folder.mkdir(exist_ok=True)
    path = _claim(folder, safe_name)
    try:
        with path.open("wb") as target:
            async for chunk in request.stream():  # as long as was announced
                target.write(chunk)
        if not path.stat().st_size:
            raise UserError("the file is empty", where=safe_name)
    except BaseException as error:
        path.unlink(missing_ok=True)
        if isinstance(error, ClientDisconnect):
            raise UserError("the upload was interrupted; nothing was kept", where=safe_name) from None
        raise
    return path


def make_safe(name: str) -> str:
    """A name for an uploaded flight: one part, no control characters, of a known ending; or UserError."""
    plain = unicodedata.normalize("NFC", name).replace("\\", "/").split("/")[-1]
    plain = re.sub(r"[^\w.+ ()-]", "_", plain).strip(" .")
    ending = find_ending(plain)
    if ending is None or len(plain) == len(ending):
        expected = "a name that ends in " + ", ".join(ENDINGS)
        raise UserError("this is not a flight file", where=name[:200], expected=expected)
    return plain


def _claim(folder: Path, name: str) -> Path:
    """An empty file of a name that was not taken: ``flight.csv``, ``flight-2.csv`` ..."""
    stem, dot, ending = name.partition(".")
    for n in range(1, 1000):
        path = folder / (name if n == 1 else f"{stem}-{n}{dot}{ending}")
        try:
            path.touch(exist_ok=False)
        except FileExistsError:
            continue
        return path
    raise UserError("there are too many files of this name", where=name)


def check_flight(path: Path) -> None:
    """Read an uploaded file in a process of its own; UserError, and the file is gone, if that fails or takes too long.

    A damaged file can bring down the library that reads it: then that process ends, and not the studio. A file with columns of
    other names is kept: the page asks what they are.
    """
    limit, fault = 120.0 + path.stat().st_size / 2e6, "it ends with a fault"
    command = [sys.executable, "-m", "ragg_runtime", "info", str(path)]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace", timeout=limit, check=False
        )
        if done.returncode in (0, 1):
            return  # a fault of the program is reported where the flight is opened
        if done.returncode == 2:
            fault = done.stderr.strip().removeprefix("ragg: ")
    except subprocess.TimeoutExpired:
        fault = f"no end after {limit:.0f} s"
    path.unlink(missing_ok=True)
    raise UserError("the file cannot be read", where=path.name, found=fault, remedy="see: ragg info FLIGHT")
