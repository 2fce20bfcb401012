"""A flight in segments that fit into memory: whole blocks of time out of ``BLOCKS``, or equal parts of one, of at most ``ROWS``
samples; filters carry on from one to the next.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

BLOCKS = 24
"""Stretches of time of which each keeps a triangle of its own."""

ROWS = 30000
"""Most samples of a segment: a few hundred columns of them in float64 take less than 100 MB."""

THINNER = 4
"""Times that segments and filters of a thinned flight have fewer samples: its samples are as much further apart, and its columns
take as much less memory."""


@dataclass(frozen=True)
class Segment:
    """Samples ``rows`` of a flight, in runs of the blocks of time: (block, its rows in the flight)."""

    rows: slice
    blocks: tuple[tuple[int, slice], ...]


def block_edges(samples: int) -> NDArray[np.intp]:
    """(BLOCKS + 1,): samples at which the blocks of time begin and end."""
    return np.linspace(0, samples, BLOCKS + 1).astype(np.intp)


def segments(samples: int, most: int = ROWS) -> list[Segment]:
    """The segments of a flight, in order."""
    edges = [int(e) for e in block_edges(samples)]
    found: list[Segment] = []
    waiting: list[tuple[int, slice]] = []
    for b in range(BLOCKS):
        for part in _parts(edges[b], edges[b + 1], most):
            if waiting and part.stop - waiting[0][1].start > most:
                found.append(_joined(waiting))
                waiting = []
            waiting.append((b, part))
    return [*found, _joined(waiting)]


def spread(found: Sequence[Segment], most: int) -> list[Segment]:
    """At most so many of the segments, evenly spread."""
    if len(found) <= most:
        return list(found)
    return [found[k] for k in np.linspace(0, len(found) - 1, most).round().astype(int)]


def beginnings(found: Sequence[Segment], samples: int) -> list[Segment]:
    """As much of the beginnings of segments as makes at most so many samples together, without their blocks."""
    each = samples // max(1, len(found))
    return [Segment(slice(s.rows.start, min(s.rows.stop, s.rows.start + each)), ()) for s in found]


def _parts(start: int, stop: int, most: int) -> Iterator[slice]:
    count = max(1, -(-(stop - start) // most))
    edges = np.linspace(start, stop, count + 1).astype(np.intp)
    for a, b in pairwise(edges):
        yield slice(int(a), int(b))


def _joined(parts: list[tuple[int, slice]]) -> Segment:
    return Segment(slice(parts[0][1].start, parts[-1][1].stop), tuple(parts))
