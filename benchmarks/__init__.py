"""Measurements: of speed (``commands``, ``evaluation``), of compensation and of the diagnosis.

A row of a table of speed should be a time or a rate, and beside it the *ratio to something fixed, measured interleaved in the same
run*, since machines and their load differ.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
RATIO = "x"  # the unit of a ratio


def commit() -> str:
    """The commit that is measured, in short."""
    words = ["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"]
    return subprocess.run(words, capture_output=True, text=True, check=False).stdout.strip()


def table(heads: Iterable[object], rows: Iterable[Iterable[object]], right: Sequence[int] = ()) -> str:
    """A table in Markdown; the columns ``right`` are set to the right."""
    lines = [[*map(str, cells)] for cells in (heads, *rows)]
    lines.insert(1, ["---:" if k in right else "---" for k in range(len(lines[0]))])
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


@dataclass(frozen=True)
class Row:
    """One measured number: repetitions, of which the median counts; and what it is held against."""

    name: str
    values: float | Sequence[float]
    unit: str
    limit: float | None = None
    at_least: bool = False

    def cells(self) -> tuple[str, str, str]:
        """Name, value and target."""
        value, target = float(np.median(self.values)), ""
        if self.limit is not None:
            met = value >= self.limit if self.at_least else value <= self.limit
            bound = f"at {'least' if self.at_least else 'most'} {self.limit:g} {self.unit.split()[0]}"
            target = f"{bound}: {'met' if met else 'not met'}"
        return self.name, f"{value:.3g} {self.unit}", target
