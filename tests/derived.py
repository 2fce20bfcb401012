"""What ``ragg derive`` yields: the committed files, which ``test_gates.py`` holds to it in processes of their own."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

from derive.everything import GENERATED

ROOT = Path(__file__).parents[1]


@cache
def derived() -> dict[str, dict[str, str]]:
    """Folder of the project -> path in it -> text."""
    place = ROOT / GENERATED
    names = json.loads((place / "manifest.json").read_text("utf-8"))["files"]
    return {GENERATED: {n: (place / n).read_text("utf-8") for n in names}}
