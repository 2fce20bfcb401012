"""Measurements: of speed (``commands``, ``evaluation``), of compensation and of the diagnosis.

A row of a table of speed should be a time or a rate, and beside it the *ratio to something fixed, measured interleaved in the same
run*, since machines and their load differ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

RATIO = "x"  # the unit of a ratio


@dataclass(frozen=True)
class Row:
    """One measured number: repetitions, of which the median counts; and what it is held against."""

    name: str
    values: float | Sequence[float]
    unit: str
    limit: float | None = None
    at_least: bool = False

    def __str__(self) -> str:
        """In Markdown."""
        value, target = float(np.median(self.values)), ""
        if self.limit is not None:
            met = value >= self.limit if self.at_least else value <= self.limit
            bound = f"at {'least' if self.at_least else 'most'} {self.limit:g} {self.unit.split()[0]}"
            target = f"{bound}: {'met' if met else 'not met'}"
        return f"| {self.name} | {value:.3g} {self.unit} | {target} |"
