"""Measurements: of speed, of compensation (``compensation``) and of the diagnosis (``diagnosis``).

A benchmark of speed is a module of this package with a function ``run() -> list[Row]``; nothing is registered.

``python -m benchmarks [NAME ...]`` runs all or those named, each in a process of its own, and prints tables; a run of all writes those
of ``docs/contributors/benchmarks.md``. A row should be a time or a rate, and beside it the *ratio to something fixed, measured
interleaved in the same run*, since machines and their load differ.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

RATIO = "x"
"""The unit of a ratio."""


@dataclass(frozen=True)
class Row:
    """One measured number: the median over repetitions, with ``low`` and ``high`` quartiles; ``limit``: what it is held against."""

    name: str
    value: float
    unit: str
    note: str = ""
    limit: float | None = None
    at_least: bool = False
    low: float = math.nan
    high: float = math.nan

    @staticmethod
    def of(name: str, values: Sequence[float], unit: str, **more: Any) -> Row:
        """The median of repetitions."""
        low, value, high = map(float, np.quantile(values, (0.25, 0.5, 0.75)))
        return Row(name, value, unit, low=low, high=high, **more)

    @property
    def target(self) -> str:
        """What it is held against, and whether that is met."""
        if self.limit is None:
            return ""
        met = self.value >= self.limit if self.at_least else self.value <= self.limit
        unit = "" if self.unit == RATIO else self.unit.split()[0]
        text = f"at {'least' if self.at_least else 'most'} {self.limit:g} {unit}".rstrip()
        return f"{text}: {'met' if met else 'not met'}"
