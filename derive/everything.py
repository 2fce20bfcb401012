"""All that ``ragg derive`` writes: the generated package, and the pages that the derivation itself makes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from derive import audit, pages, tree
from derive.pipeline import derive_base
from derive.simplify.page import page as simplified_page

GENERATED = "generated"


def folders() -> Mapping[str, Mapping[str, str]]:
    """Folder of the project -> path in it -> text."""
    return {
        GENERATED: derive_base(),
        "docs": {"errata.md": audit.page(), "simplified.md": simplified_page(), **pages.effects()},
    }


def below(root: Path) -> Mapping[str, Mapping[str, str]]:
    """As :func:`folders`, but only what concerns this root: pages, if it has a docs folder."""
    return {folder: files for folder, files in folders().items() if _concerns(root, folder)}


def difference(root: Path) -> str:
    """Empty if everything below ``root`` is as derived; else the diff."""
    parts = []
    for folder, files in below(root).items():
        found = tree.difference(files, root / folder, exclusive=folder == GENERATED)
        if found:
            parts.append(f"{folder}/ differs from the derivation:\n{found}")
    return "\n".join(parts)


def _concerns(root: Path, folder: str) -> bool:
    """An installed package carries no docs."""
    return folder == GENERATED or (root / folder).is_dir()
