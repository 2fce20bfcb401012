"""The flights that are open, as the page is told of them: examined, or at a first look."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.flight.record import WIDEST_SPIKE
from ragg_runtime.signals.derivative import runs
from ragg_runtime.studio.session import State
from ragg_runtime.wording import numbers

Json = dict[str, Any]


def shown(s: State) -> list[Json]:
    """Every flight that is open; before it is compared, what a first look tells."""
    if not s.flights:  # they are being read
        return []
    observed = () if s.compared is None else s.compared.fitted.observations
    return [
        {
            "name": numbers.clean(x.name),
            "path": str(p),
            "samples": len(x),
            "valid": int(x.valid.sum()),
            "rate_Hz": x.rate,
            "start_s": 0.0,  # figures count from the first sample
            "duration_s": x.duration,
            "notes": [numbers.clean(n) for n in x.notes],
            "channels": [{"name": n, "unit": x.units[n]} for n in x.channels],
            "outputs": list(x.outputs),
            "cuts": [list(c) for c in cuts],
            "parts": [
                {"name": o.output.name, "spin_Hz": abs(o.record.spin_frequency) * o.record.turning}
                for o in seen
            ],
            "missing": missing(seen[0].record.valid if seen else x.valid, x.rate),
        }
        for n, (x, p, cuts) in enumerate(zip(s.flights, s.paths, s.cuts, strict=True))
        for seen in [[o for o in observed if o.flight == n]]
    ]


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
