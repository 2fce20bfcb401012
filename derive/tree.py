"""Derived files on disk: write them, or report differences."""

from __future__ import annotations

import difflib
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path


def write(files: Mapping[str, str], folder: Path) -> list[str]:
    """Make ``folder`` hold these files; returns the paths that changed.

    Each file is replaced by a rename, so that none is ever half-written. Files that are not derived are removed; caches
    (``__pycache__``) are left alone.
    """
    changed = []
    for name, text in files.items():
        path = folder / name
        data = text.encode()
        if path.is_file() and path.read_bytes() == data:
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=path.parent)
        with os.fdopen(handle, "wb") as f:
            f.write(data)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
        changed.append(name)
    for name in _present(folder):
        if name not in files:
            (folder / name).unlink()
            changed.append(name)
    return changed


def difference(files: Mapping[str, str], folder: Path, lines: int = 40) -> str:
    """Empty if ``folder`` holds these files and only them, byte for byte; else a diff."""
    report: list[str] = []
    present = _present(folder)
    report += [f"missing: {n}" for n in files if n not in present]
    report += [f"not derived: {n}" for n in present if n not in files]
    for name in files:
        if name not in present:
            continue
        old = (folder / name).read_bytes()
        if old != files[name].encode():
            diff = difflib.unified_diff(
                old.decode(errors="replace").splitlines(),
                files[name].splitlines(),
                f"committed/{name}",
                f"derived/{name}",
                lineterm="",
                n=1,
            )
            report += list(diff) or [f"{name}: line endings or final newline differ"]
    if len(report) > lines:
        report = [*report[:lines], f"... and {len(report) - lines} more lines"]
    return "\n".join(report)


def _present(folder: Path) -> list[str]:
    """The files below a folder; links are none, for what they lead to is elsewhere."""
    if folder.is_symlink():
        return []
    found = (
        p for p in folder.rglob("*") if p.is_file() and not p.is_symlink() and "__pycache__" not in p.parts
    )
    return sorted(p.relative_to(folder).as_posix() for p in found)
