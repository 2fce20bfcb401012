"""Samples that a fit does without: those of which the sheet leaves open on which side of a switch (a converter's step at zero
voltage) an accelerometer is, and the ends of a record, which late motion does not cover.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import columns as design
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.estimation.segments import segments
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model.lateness import late
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]

OPEN = 3.0
"""Standard deviations of a voltage, as the sheet knows it, from zero up to which the side is open."""

LATEST = 3.0
"""Times the prior's width of a delay by which motion may be late."""

MOST = 0.2
"""Share of the samples beyond which none is left out: a sheet that knows so little of the switch cannot help."""


def certain(model: Model, instrument: Instrument, observations: Sequence[Observation]) -> list[Observation]:
    """The observations without the samples of which the model says nothing: sides of a switch, ends of the motion."""
    observations = [_inside(model, instrument, o) for o in observations]
    if not any(e.switches for e in model.effects):
        return observations
    # a sample of channels is made of many: of those none is left out
    return [o if o.recorded.demodulated else _certain(model, instrument, o) for o in observations]


def _inside(model: Model, instrument: Instrument, o: Observation) -> Observation:
    """Without as much of either end as motion may be late."""
    moving = dict(late(model))
    if not moving:
        return o
    r = o.record
    most = [
        c.scale * (r.time[-1] if moving[k].growing else 1.0) * r.rate
        for c, k in design.base_columns(model, instrument)
        if k in moving
    ]
    n = int(np.ceil(LATEST * max(most, default=0.0)))
    inside = np.zeros(len(r.valid), dtype=np.bool_)
    inside[n : len(inside) - n] = True
    kept = r.valid & inside
    if np.array_equal(kept, r.valid) or np.sum(kept) < (1.0 - MOST) * np.sum(r.valid):
        return o
    return replace(o, record=replace(r, valid=kept), memo=[])


def _certain(model: Model, instrument: Instrument, o: Observation) -> Observation:
    valid = np.array(o.record.valid)
    for s in segments(len(valid)):
        valid[s.rows] &= ~_open(model, instrument, o.part(s.rows))
    if np.sum(valid) < (1.0 - MOST) * np.sum(o.record.valid):
        return o
    return replace(o, record=replace(o.record, valid=valid), memo=[])


def _open(model: Model, instrument: Instrument, o: Observation) -> NDArray[np.bool_]:
    """(N,): whether the side of any of the output's accelerometers is open."""
    chain, r, p = model.chain, o.record, vector(model, instrument)
    x = r.inputs(chain)
    rows = {name: k for k, (name, shared) in enumerate(chain.ROWS) if not shared}
    base = [c for c, _ in design.base_columns(model, instrument) if c.effect is None]
    found = np.zeros(len(r.time), dtype=np.bool_)
    for j in o.output.members:
        own = [c for c in base if c.accelerometer == j + 1]
        case = (j, r.time, r.cos_phi, r.sin_phi, x, chain.values_of(j, p))
        slopes = chain.derivatives(*case)
        variance = sum((slopes[rows[c.name]] * c.scale) ** 2 for c in own)
        found |= chain.accelerometer(*case) ** 2 < OPEN**2 * variance
    return found
