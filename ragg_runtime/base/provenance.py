"""What makes a result again: versions, digests of what was read, the command. No times: same input, same bytes."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import metadata
from pathlib import Path

LIBRARIES = ("numpy", "scipy", "sympy", "pint", "pandas", "pyarrow", "xarray", "h5netcdf", "h5py")
"""What the numbers of a result depend on, beside this package."""


MISSING = "not installed"


@cache
def versions() -> dict[str, str]:
    """Name -> version of this package, Python and the libraries that results depend on."""
    found = {"ragg": _installed("ragg"), "python": platform.python_version()}
    return found | {name: _installed(name) for name in LIBRARIES}


def _installed(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return MISSING


def provenance(
    made_by: str, model: Mapping[str, object] | None = None, files: Sequence[tuple[str, str | None]] = ()
) -> dict[str, object]:
    """The object ``provenance`` of a JSON result: command line, identity of the model, (path, SHA-256) of the flights."""
    flights = [{"path": path, "digest": digest} for path, digest in files]
    return {**versions(), **(model or {}), "flights": flights, "command": made_by}


@cache
def digest_sources(*packages: str, suffixes: tuple[str, ...] = (".py",), first: str = "") -> str:
    """SHA-256 of the text of the program's own packages, wherever they are, and of what comes ``first``."""
    total, root = hashlib.sha256(first.encode()), Path(__file__).parents[2]
    files = {p.relative_to(root).as_posix(): p for name in packages for p in (root / name).rglob("*")}
    for name in sorted(n for n in files if n.endswith(suffixes)):
        text = files[name].read_bytes()
        total.update(f"{name} {len(text)}\n".encode() + text)
    return total.hexdigest()
