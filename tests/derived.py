"""What ``ragg derive`` yields, computed once in a run of the tests."""

from __future__ import annotations

from functools import cache

from derive import everything

_folders = everything.folders


@cache
def derived() -> dict[str, dict[str, str]]:
    """Folder of the project -> path in it -> text."""
    return {folder: dict(files) for folder, files in _folders().items()}
