"""What a record lacks, for its timeline: gaps, and samples that stand alone (spikes, mostly)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.flight.record import WIDEST_SPIKE
from ragg_runtime.signals.derivative import runs

MOST = 300
"""Marks of either kind on a timeline, the longest and the first: it has no more pixels for them."""


def missing(valid: NDArray[np.bool_], rate: float) -> dict[str, Any]:
    """Stretches (from, to, s since the first sample) without usable samples, and instants of those too short for a gap."""
    lacking = runs(~valid)
    gaps = [x for x in lacking if x.stop - x.start > WIDEST_SPIKE]
    longest = sorted(gaps, key=lambda x: x.start - x.stop)[:MOST]
    return {
        "gaps": [[x.start / rate, x.stop / rate] for x in sorted(longest, key=lambda x: x.start)],
        "alone": [x.start / rate for x in lacking if x.stop - x.start <= WIDEST_SPIKE][:MOST],
    }
