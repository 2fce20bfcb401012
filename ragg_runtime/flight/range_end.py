"""Motion sensors at the end of their range: values that pile up at the largest that there is."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.flight.record import ANGULAR_RATE, SPECIFIC_FORCE
from ragg_runtime.flight.spool import let_go

Array = NDArray[np.float64]

PILED = 10
"""Samples at one and the same extreme value that make the end of a range, and by what factor they outnumber those at the
next value below: on the lattice of a converter a slow swing repeats its maximum, too, but its neighbours as well."""

RUN = 3
"""Samples in a row there, at least once: a sinusoid has two equal ones at its top at most."""

EXCURSIONS = 3
"""Times that the value came there: one plateau may be a table that turned steadily."""

SAME = 1e-9
"""Relative difference up to which two values are one: the mean of several sensors is rounded."""


CHUNK = 1 << 16
"""Samples that are looked at at a time: a long flight stays on disk."""


def at_the_end(x: Array, there: NDArray[np.bool_]) -> NDArray[np.bool_] | None:
    """(N,): which samples of a channel (N,) stand at the end of its range, above or below; ``None``: it has not been there.

    ``there`` (N,): those that count.
    """
    found = [m for sign in (1.0, -1.0) if (m := _side(x, there, sign)) is not None]
    return np.any(found, axis=0) if found else None


def _side(x: Array, there: NDArray[np.bool_], sign: float) -> NDArray[np.bool_] | None:
    parts = [slice(k, k + CHUNK) for k in range(0, len(x), CHUNK)]
    top = max((float(np.max(sign * x[p][there[p]], initial=-np.inf)) for p in parts), default=-np.inf)
    if not np.isfinite(top) or top <= 0.0:
        return None
    end = top * (1.0 - SAME)
    at, below, next_, beside = 0, 0, -np.inf, 0
    for p in parts:
        v = sign * x[p][there[p]]
        inner = v[v < end]
        at, below = at + len(v) - len(inner), below + len(inner)
        highest = float(np.max(inner, initial=-np.inf))
        if highest > next_:
            next_, beside = highest, 0
        beside += int(np.sum(inner >= next_ - SAME * abs(next_))) if np.isfinite(next_) else 0
    if at > below or at < PILED * max(beside, 1):
        return None  # that is where it mostly is, or a lattice
    mask = np.concatenate([there[p] & (sign * x[p] >= end) for p in parts])
    edges = np.flatnonzero(np.diff(mask.astype(np.int8), prepend=0, append=0))
    lengths = edges[1::2] - edges[::2]
    return mask if len(lengths) >= EXCURSIONS and np.max(lengths) >= RUN else None


def motion_at_the_end(
    channels: Mapping[str, Array], valid: NDArray[np.bool_]
) -> dict[str, NDArray[np.bool_]]:
    """Which samples of the specific force and of the rate stand at the end of a range, (N,) by channel; those with any."""
    found = {}
    for name in (*SPECIFIC_FORCE, *ANGULAR_RATE):
        if name in channels:
            mask = at_the_end(channels[name], valid)
            let_go(channels[name])
            if mask is not None:
                found[name] = mask
    return found
