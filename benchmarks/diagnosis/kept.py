"""What a campaign has flown: a line of JSON a flight, so that one that was cut short goes on where it was."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any


class Kept:
    """The lines of a campaign's seed: those that its file holds, and those that are added to both."""

    def __init__(self, cache: Path, seed: int) -> None:
        self._path = cache.with_name(f"{cache.stem}-{seed}.jsonl")
        self._path.parent.mkdir(parents=True, exist_ok=True)
        there = self._path.read_text("utf-8").splitlines() if self._path.exists() else []
        self.lines: list[dict[str, Any]] = [json.loads(x) for x in there]
        self._done = {x["id"] for x in self.lines}

    def __contains__(self, flight: str) -> bool:
        return flight in self._done

    def add(self, line: Mapping[str, Any]) -> None:
        """Keep the line of one more flight."""
        self.lines.append(dict(line))
        self._done.add(line["id"])
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
