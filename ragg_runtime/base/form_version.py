"""The forms in which this program keeps things carry a version; what a newer program wrote is refused, and says which.

A file says ``version`` (absent: 1, as in files of 0.1.0) and ``written_by``, the release that wrote it. A version goes up
only where an older program would misread the file: keys that it does not know, it leaves alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from ragg_runtime.base.errors import UserError, one_line

VERSION, WRITER = "version", "written_by"


class NewerFormError(UserError):
    """A file that is whole, and of a newer program: nothing is wrong with it."""


@dataclass(frozen=True)
class Form:
    """A form of file: what it is in words, and the newest version of it that this program reads and writes."""

    name: str
    version: int = 1

    def stamp(self) -> dict[str, object]:
        """What a file of this form begins with."""
        return {VERSION: self.version, WRITER: f"ragg {installed('ragg')}"}

    def check(self, content: Mapping[str, Any], where: str | Path | None) -> None:
        """Raise UserError if a file says a version that this program does not know, or none that can be."""
        found, writer = content.get(VERSION, 1), content.get(WRITER)
        if isinstance(found, bool) or not isinstance(found, int) or found < 1:
            raise UserError(
                f"{VERSION} of {self.name} is no whole number from 1 on",
                where=where,
                found=one_line(repr(found)[:60]),
                expected=f"{VERSION} {self.version}, or none",
            )
        if found > self.version:
            known = isinstance(writer, str) and 0 < len(writer) < 60
            release = one_line(writer) if known and isinstance(writer, str) else "the release that wrote it"
            raise NewerFormError(
                f"{self.name} is of a newer version of this program",
                where=where,
                found=f"{VERSION} {str(found)[:20]}{f', written by {release}' if known else ''}",
                expected=f"{VERSION} {self.version} or older; this is ragg {installed('ragg')}",
                remedy=f"{release} or a newer one is needed: pip install --upgrade ragg",
            )


@cache
def installed(name: str) -> str:
    """The version of an installed package."""
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return "not installed"
