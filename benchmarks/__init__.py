"""Measurements of speed: every module with a function ``run() -> list[Row]`` is one.

``python -m benchmarks`` runs all of them, prints a table and writes JSON to ``benchmarks/results/``;
``python -m benchmarks derivation`` runs one. Ratios are taken within one run, on one machine.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One measured number. ``target``: what it is held against, in words; ``None`` if nothing."""

    name: str
    value: float
    unit: str
    note: str = ""
    target: str | None = None
