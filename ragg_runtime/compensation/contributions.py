"""What each effect, and each parameter of the paper's instrument, contributes to the demodulated channels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.series import NO_VALUE, Segment, Setting
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.instrument.units import units
from ragg_runtime.model.evaluate import unit_factor
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]


def neutral(model: Model, instrument: Instrument, p: Array) -> list[tuple[str, str | None, Array]]:
    """(name, effect, p with it at its neutral value) of everything that a model removes."""
    places, start = {}, 0
    for name, size in model.chain.PARAMETERS:
        places[name] = slice(start, start + size)
        start += size
    found: list[tuple[str, str | None, Array]] = []
    known = units(instrument.g0)
    for e in model.effects:
        changed = p.copy()
        for q in e.parameters:
            if q.fitted:
                changed[places[q.symbol]] = (q.neutral or 0.0) * unit_factor(q.unit, known)
        found.append((e.id, e.id, changed))
    for q0 in PARAMETERS:
        changed = p.copy()
        own = changed[places[q0.name]]
        # of a gain the mean carries the gradient itself: what disturbs is that the four differ
        changed[places[q0.name]] = np.mean(own) if q0.required else 0.0
        name = f"imbalance of {q0.name}" if q0.required else q0.name
        if not np.array_equal(changed, p):
            found.append((name, None, changed))
    return found


def of(s: Setting, samples: Sequence[slice], model: Model, instrument: Instrument) -> list[dict[str, Any]]:
    """Root mean squares of inline and cross, Eo, on some stretches of a flight, largest first."""
    totals: dict[tuple[str, str | None], Array] = {}
    count = 0
    for rows in samples:
        p = s.stretches[0].p
        segment = Segment(
            replace(s, stretches=(replace(s.stretches[0], first=0, last=_end(s)),)), rows, holes=False
        )
        good = (segment.quality()[segment.own] & NO_VALUE) == 0
        count += int(np.sum(good))
        for name, effect, changed in [("everything", None, np.zeros_like(p)), *neutral(model, instrument, p)]:
            e = segment.bare if name == "everything" else segment.bare - segment.by(changed)
            g = segment.demodulated(e)[segment.own][good]
            part = np.array([np.sum(g.real**2), np.sum(g.imag**2)])
            totals[name, effect] = totals.get((name, effect), np.zeros(2)) + part
    rows_ = []
    for (name, effect), squares in totals.items():
        inline, cross = np.sqrt(squares / count) if count else (np.nan, np.nan)
        if inline or cross:
            rows_.append({"of": name, "effect": effect, "inline_Eo": float(inline), "cross_Eo": float(cross)})
    return sorted(rows_, key=lambda r: -float(r["inline_Eo"] ** 2 + r["cross_Eo"] ** 2)) if count else []


def _end(s: Setting) -> int:
    return len(s.observation.record.time)
