"""Measurements: of speed, of compensation (``compensation``) and of the diagnosis (``diagnosis``).

A benchmark of speed is a module of this package with a function ``run() -> list[Row]``; nothing is registered.

``python -m benchmarks [NAME ...]`` runs all or those named, each in a process of its own (so import heavy things inside
``run``; ``ENVIRONMENT`` adds to the environment of that process), prints tables and keeps ``build/bench.json``; a run of all
writes ``docs/contributors/benchmarks.md`` too. A row should be a time or a rate, and beside it the *ratio to something fixed,
measured interleaved in the same run* (``timing.interleaved``), since machines and their load differ.
"""

from __future__ import annotations

from dataclasses import dataclass

RATIO = "x"
"""The unit of a ratio."""


@dataclass(frozen=True)
class Row:
    """One measured number: the median over repetitions, with ``low`` and ``high`` quartiles.

    ``target``: what it is held against, in words; ``met``: whether it is.
    """

    name: str
    value: float
    unit: str
    note: str = ""
    target: str | None = None
    low: float | None = None
    high: float | None = None
    met: bool | None = None


def at_most(name: str, value: float, unit: str, limit: float | None, note: str = "", **spread: float) -> Row:
    """A row that is held against an upper limit, if there is one."""
    target = (
        None if limit is None else f"at most {limit:g} {'' if unit == RATIO else unit.split()[0]}".rstrip()
    )
    return Row(name, value, unit, note, target, met=None if limit is None else value <= limit, **spread)
