"""Measurements of speed. A benchmark is a module of this package with a function ``run() -> list[Row]``.

To add one, write ``benchmarks/<name>.py``::

    from benchmarks import Row, timing

    def run() -> list[Row]:
        flight = ...                                       # set up, not timed
        found = timing.interleaved({"diagnose, 30 min": lambda: diagnose(flight)}, repeats=3)
        return [Row("diagnose, 30 min", found["diagnose, 30 min"].median, "s")]

Nothing has to be registered. ``python -m benchmarks [NAME ...]`` runs all benchmarks or those named, each in a
process of its own (so import heavy things inside ``run``; ``ENVIRONMENT``, a mapping, adds to the
environment of that process), prints tables, and keeps ``build/bench.json``; a run of all of them writes
``docs/benchmarks.md`` too. All together take 10 to 20 minutes (``make bench``).

What a row should be: a time or a rate, with its spread, and beside it the *ratio to something fixed, measured
interleaved in the same run* (``timing.interleaved``), since machines and their load differ.
"""

from __future__ import annotations

from dataclasses import dataclass

RATIO = "x"
"""The unit of a ratio."""


@dataclass(frozen=True)
class Row:
    """One measured number.

    Attributes
    ----------
    name, value, unit
        ``value`` is the median over repetitions, if there are any; ``unit`` is "x" for a ratio.
    note
        How it was measured, if the name does not say it.
    target
        What it is held against, in words; ``None`` if nothing.
    low, high
        Spread over the repetitions (lower and upper quartile).
    met
        Whether the target is met, where that can be said.
    """

    name: str
    value: float
    unit: str
    note: str = ""
    target: str | None = None
    low: float | None = None
    high: float | None = None
    met: bool | None = None
