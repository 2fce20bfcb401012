"""Outputs that were recorded more seldom than the motion and filled in: each value repeated, or joined by straight lines, up to
the next. Between the instants at which they were recorded they are no measurement.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.io import Flight

Array = NDArray[np.float64]
Index = NDArray[np.intp]

LOOKED_AT = 1 << 16
"""Samples from whose beginning it is told: hours at usual rates."""

FEWEST = 8
"""Recorded values that are needed to see that they come at regular intervals."""

REGULAR = 0.99
"""Share of the values that must follow each other at the same number of samples: of a coarsely quantised output, which
repeats values as well, no more than half do."""

STRAIGHT = 1e-3
"""Second difference, over the root mean square of all, below which three samples lie on one line: digits that were written make
less, and of recorded values one in a thousand bends so little."""


def without_filling(flight: Flight) -> tuple[Flight, list[str]]:
    """The flight with what was filled in of its outputs taken out (NaN), and that in sentences."""
    outputs: dict[str, Array] = dict(flight.outputs)
    told: dict[tuple[str, int], list[str]] = {}
    for name, x in flight.outputs.items():
        there = np.isfinite(x[:LOOKED_AT]) & flight.valid[:LOOKED_AT]
        for how, recorded in _fillings(np.array(x[:LOOKED_AT]), there).items():
            every, first = _interval(recorded)
            if every < 2:
                continue
            kept = np.arange(len(x)) % every == first % every
            outputs[name] = np.where(kept, x, np.nan)
            told.setdefault((how, every), []).append(name)
            break
    notes = [
        f"{', '.join(names)}: recorded every {every / flight.rate:.4g} s and {how} in between; only what was recorded is used"
        for (how, every), names in told.items()
    ]
    return (dataclasses.replace(flight, outputs=outputs) if told else flight), notes


def _fillings(x: Array, there: NDArray[np.bool_]) -> Mapping[str, Index]:
    """Way of filling in -> samples (k,) at which a series (N,) would have been recorded."""
    pairs = there[1:] & there[:-1]
    threes = pairs[1:] & pairs[:-1]
    changed = pairs & (np.diff(np.where(there, x, 0.0)) != 0.0)
    bend = np.where(threes, np.abs(np.diff(np.where(there, x, 0.0), 2)), 0.0)
    sharp = bend > STRAIGHT * float(np.sqrt(np.mean(bend**2))) if len(bend) else np.zeros(0, dtype=np.bool_)
    found = {}
    if 0 < 3 * np.sum(changed) <= 2 * np.sum(pairs):
        found["repeated"] = np.flatnonzero(changed) + 1
    elif 0 < 3 * np.sum(sharp) <= 2 * np.sum(threes):
        found["joined by straight lines"] = np.flatnonzero(sharp) + 1
    return found


def _interval(recorded: Index) -> tuple[int, int]:
    """Samples from one recorded value to the next, and where one stands; (1, 0) if they are not regular."""
    if len(recorded) < FEWEST:
        return 1, 0
    every = int(np.median(np.diff(recorded)))
    first = int(recorded[len(recorded) // 2])
    regular = np.mean(recorded % max(every, 1) == first % max(every, 1))
    return (every, first) if regular >= REGULAR else (1, 0)
