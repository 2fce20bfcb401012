"""All that ``ragg derive`` writes, the generated package: on disk, or its differences from what is there."""

from __future__ import annotations

import difflib
import json
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path

import sympy

from derive import pipeline

GENERATED, MANIFEST = "generated", "manifest.json"


def difference(root: Path) -> str:
    """Empty if ``generated/`` below ``root`` is as derived; else the diff.

    The version of SymPy in the manifest does not count: another one may well yield the same code.
    """
    version = committed_with(root)
    files = {
        n: _with_version(t, version) if n.endswith(MANIFEST) else t for n, t in pipeline.derive_base().items()
    }
    found = diff_files(files, root / GENERATED)
    return f"{GENERATED}/ differs from the derivation:\n{found}" if found else ""


def committed_with(root: Path) -> str:
    """The version of SymPy that the code below ``root`` was derived with; that of this machine if none is recorded."""
    place = root / GENERATED / MANIFEST
    try:
        # a pipe would be waited for
        found = json.loads(place.read_text("utf-8"))["sympy"] if place.is_file() else None
    except (OSError, ValueError, KeyError, TypeError):
        return str(sympy.__version__)
    return found if isinstance(found, str) else str(sympy.__version__)


def about_versions(root: Path) -> str | None:
    """A warning where SymPy is not the version that the code below ``root`` was derived with."""
    here, there = str(sympy.__version__), committed_with(root)
    if here == there:
        return None
    return (
        f"SymPy is {here} here, and the code was derived with {there}: another SymPy may write the same terms in "
        "another order. The 50-digit test shows whether it is only that: ragg derive, then python -m pytest tests/generated. For "
        "the same bytes install the versions of requirements.lock"
    )


def _with_version(manifest: str, version: str) -> str:
    return pipeline.manifest_text(json.loads(manifest) | {"sympy": version})


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


def diff_files(files: Mapping[str, str], folder: Path, lines: int = 40) -> str:
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
