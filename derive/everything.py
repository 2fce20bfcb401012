"""All that ``ragg derive`` writes: the generated package."""

from __future__ import annotations

import json
from pathlib import Path

import sympy

from derive import pipeline, tree

GENERATED, MANIFEST = "generated", "manifest.json"


def difference(root: Path) -> str:
    """Empty if ``generated/`` below ``root`` is as derived; else the diff.

    The version of SymPy in the manifest does not count: another one may well yield the same code.
    """
    version = committed_with(root)
    files = {
        n: _with_version(t, version) if n.endswith(MANIFEST) else t for n, t in pipeline.derive_base().items()
    }
    found = tree.difference(files, root / GENERATED)
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
