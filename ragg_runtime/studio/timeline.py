"""What a record lacks, for its timeline: gaps, and samples that stand alone (spikes, mostly)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

ALONE = 3
"""Most samples in a row that are no gap on a timeline: as long as a spike is at most."""

MOST = 300
"""Marks of either kind on a timeline, the longest and the first: it has no more pixels for them."""


def missing(valid: NDArray[np.bool_], rate: float) -> dict[str, Any]:
    """Stretches (from, to, s since the first sample) without usable samples, and instants of those too short for a gap."""
    edges = np.flatnonzero(np.diff(np.concatenate(([True], valid, [True])).astype(np.int8)))
    starts, ends = edges[::2], edges[1::2]
    alone = ends - starts <= ALONE
    longest = np.sort(np.flatnonzero(~alone)[np.argsort(starts[~alone] - ends[~alone], kind="stable")][:MOST])
    return {
        "gaps": [
            [float(a / rate), float(b / rate)] for a, b in zip(starts[longest], ends[longest], strict=True)
        ],
        "alone": [float(a / rate) for a in starts[alone][:MOST]],
    }
