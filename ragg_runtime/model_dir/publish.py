"""What ``ragg derive`` writes below the root of the project. Cut off, it leaves whole files; the next one writes the others."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from derive import everything, tree

HOME = Path(str(everything.__file__)).parents[1]
"""Where the project stands: the root to write to unless another is named."""


def rederived(root: Path) -> list[str]:
    """Derive everything and write it below ``root``; returns the paths that changed."""
    found = everything.folders()
    return [
        f"{folder}/{name}"
        for folder, files in found.items()
        for name in tree.write(files, root / folder, exclusive=folder == everything.GENERATED)
    ]


@dataclass(frozen=True)
class Checked:
    """What is committed below a root against what the derivation yields: ``difference`` is text, empty if there is none."""

    difference: str
    versions: str | None
    committed_with: str


def checked(root: Path) -> Checked:
    """Compare, and write nothing."""
    return Checked(
        difference=everything.difference(root),
        versions=everything.about_versions(root),
        committed_with=everything.committed_with(root),
    )
