"""A folder for an export: a new one, an empty one, or that of an earlier export."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text

MARK = ".ragg-export"
"""The file by which a folder is known as that of an export; what an earlier one wrote is replaced file by file."""


def write_folder(folder: Path, files: Mapping[str, str]) -> list[Path]:
    """Write text files into the folder; UserError if it holds anything else."""
    if folder.exists() and not folder.is_dir():
        raise UserError("the export needs a folder", where=folder, found="a file", remedy="name another one")
    if folder.is_dir() and any(folder.iterdir()) and not (folder / MARK).is_file():
        raise UserError(
            "the folder is not empty, and not that of an export",
            where=folder,
            remedy="name another folder, or empty this one",
        )
    written = []
    for name, text in {MARK: "\n".join(sorted(files)) + "\n", **files}.items():
        place = folder / name
        if place.is_symlink() or (place.parent != folder and place.parent.is_symlink()):
            raise UserError(
                "a link stands where the export is to be written",
                where=place,
                remedy="name another folder, or remove the link",
            )
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UserError("the folder cannot be made", where=place.parent, found=error.strerror) from None
        write_text(place, text)
        written.append(place)
    return written
