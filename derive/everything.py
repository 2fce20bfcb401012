"""All that ``ragg derive`` writes, the generated package: on disk, or its differences from what is there."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from pathlib import Path

from derive import pipeline

GENERATED = "generated"


def difference(root: Path) -> str:
    """Empty if ``generated/`` below ``root`` is as derived; else the diff."""
    found = diff_files(pipeline.derive_base(), root / GENERATED)
    return f"{GENERATED}/ differs from the derivation:\n{found}" if found else ""


def write(files: Mapping[str, str], folder: Path) -> list[str]:
    """Make ``folder`` hold these files; returns the paths that changed.

    Each file is replaced by a rename, so that none is ever half-written. Files that are not derived are removed; caches
    (``__pycache__``) are left alone.
    """
    changed = []
    for name, text in files.items():
        path = folder / name
        if path.is_file() and path.read_bytes() == text.encode():
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_name(f"{path.name}.new")
        temporary.write_bytes(text.encode())
        temporary.replace(path)
        changed.append(name)
    for name in _present(folder):
        if name not in files:
            (folder / name).unlink()
            changed.append(name)
    return changed


def diff_files(files: Mapping[str, str], folder: Path, lines: int = 40) -> str:
    """Empty if ``folder`` holds these files and only them, byte for byte; else a diff."""
    present = _present(folder)
    report = [f"missing: {n}" for n in files if n not in present]
    report += [f"not derived: {n}" for n in present if n not in files]
    for name in (n for n in files if n in present):
        old = (folder / name).read_bytes()
        if old != files[name].encode():
            texts = old.decode(errors="replace").splitlines(), files[name].splitlines()
            diff = difflib.unified_diff(*texts, f"committed/{name}", f"derived/{name}", lineterm="", n=1)
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
