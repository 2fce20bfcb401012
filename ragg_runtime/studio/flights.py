"""The flights that are open, as the page is told of them: examined, or at a first look."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ragg_runtime.flight import timeline
from ragg_runtime.flight.glance import Glance
from ragg_runtime.studio.pyramid import Pyramid
from ragg_runtime.studio.session import State
from ragg_runtime.wording import numbers

Json = dict[str, Any]


def shown(s: State) -> list[Json]:
    """Every flight that is open; before it is compared, what a first look tells."""
    if not s.flights:
        return [_glance(p, look) for p, look in zip(s.paths, s.glances, strict=False) if look is not None]
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
            "missing": timeline.missing(seen[0].record.valid if seen else x.valid, x.rate),
        }
        for n, (x, p, cuts) in enumerate(zip(s.flights, s.paths, s.cuts, strict=True))
        for seen in [[o for o in observed if o.flight == n]]
    ]


def _glance(path: Path, look: tuple[Glance, Pyramid]) -> Json:
    """What is known of a flight at a first look."""
    found = look[0]
    n = len(found.values)
    return {
        "name": numbers.clean(found.name),
        "path": str(path),
        "samples": n,
        "valid": n,
        "rate_Hz": 1.0 / found.step,
        "start_s": found.start,
        "duration_s": n * found.step,
        "notes": [],
        "channels": [],
        "outputs": ["G_out"],
        "glanced": True,
    }
