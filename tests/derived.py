"""What ``ragg derive`` yields, computed once in a run of the tests."""

from __future__ import annotations

from functools import cache

from derive import everything

_folders = everything.folders


def derived(*, docs: bool = True) -> dict[str, dict[str, str]]:
    """Folder of the project -> path in it -> text."""
    found = _everything()
    return found if docs else {everything.GENERATED: found[everything.GENERATED]}


@cache
def _everything() -> dict[str, dict[str, str]]:
    return {folder: dict(files) for folder, files in _folders().items()}
