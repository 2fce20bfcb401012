"""The slow noise of a long flight, from what columns leave of its means over neighbouring samples: segments do not show it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.left_over import left_over, placed
from ragg_runtime.estimation.linearise import Point
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.estimation.passes import Piece, flight_segments, longer, passed
from ragg_runtime.estimation.spectrum import Averages

if TYPE_CHECKING:
    from ragg_runtime.estimation.noise import NoiseModel

Array = NDArray[np.float64]

MEANS = 8192
"""Most means of a flight."""

PERIODS = 16.0
"""In a segment, up to which means tell the noise."""

RESOLVED = 8.0
"""Means a period, at least, of the noise that they tell: what is faster they show weaker, and something else in its place."""

FULL = 0.9
"""Share of its samples that must be valid for a mean to count: of fewer it has more white noise."""

ENOUGH = 2
"""Means for every column, at least."""


def averages(at: Point, o: Observation, unwhitened: NoiseModel) -> list[Averages] | None:
    """What all columns leave of each output's means; ``None`` of a flight seen in one piece, or in too few means.

    ``unwhitened``: the noise that makes the columns as they are, or in combinations.
    """
    if not longer(o):
        return None
    n, m = len(o.record.time), len(o.series)
    every = -(-n // MEANS)
    count = np.bincount(np.flatnonzero(o.record.valid) // every, minlength=-(-n // every))
    sums: Array | None = None

    def summed(piece: Piece) -> tuple[int, Array]:
        boxes = piece.sample[: len(piece.sample) // m] // every
        each = piece.white.reshape(len(piece.white), m, -1)
        if not len(boxes):
            return 0, np.zeros((len(each), m, 0))
        starts = np.searchsorted(boxes, np.arange(boxes[0], boxes[-1] + 1))
        ends = np.append(starts[1:], len(boxes))
        found = np.add.reduceat(each, starts, axis=2)
        found[:, :, starts == ends] = 0.0  # of no sample
        return int(boxes[0]), found

    for first, part in passed(at, o, unwhitened, summed):
        if sums is None:
            sums = np.zeros((len(part), m, len(count)))
        sums[:, :, first : first + part.shape[2]] += part
    valid = count >= FULL * every
    if sums is None or np.sum(valid) < ENOUGH * len(sums):
        return None
    rate = o.record.rate / every
    longest = max(s.rows.stop - s.rows.start for s in flight_segments(o)) / o.record.rate
    below = min(PERIODS / longest, rate / RESOLVED)
    found = []
    for k in range(m):
        flat = sums[:, k, valid] / count[valid]
        left = left_over(flat, valid, rate, None)
        found.append(Averages(rest=placed(left.rest, valid), kept=left.kept, rate=rate, below=below))
    return found
