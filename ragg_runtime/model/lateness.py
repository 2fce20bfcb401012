"""The record as a model with certain parameters takes it: motion from where it stands, and through resonances.

A Taylor series in a lateness fails at half a sample: so it is taken about the lateness that a fit has come to.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.model.model import EffectParameter, Model
from ragg_runtime.model.record import Record
from ragg_runtime.model.resonance import values_of, with_responses

Array = NDArray[np.float64]

STEP = 1 / 32
"""Samples between the latenesses to which motion is moved: by the series the rest of at most half of it is described to 1e-6 of
the change, as well as derivatives are known (up to 42 % of the Nyquist frequency)."""


def about(model: Model, r: Record, p: Array) -> tuple[Record, Array]:
    """The record with its motion moved, and what of the parameters p (size,), SI, is left for the series beside it.

    Parameters of resonances are left at their neutral values, about which the chain has its series.
    """
    resonant = [*values_of(model, p)]
    if resonant:
        r, p = with_responses(r, resonant, model.chain.INPUTS), _at_neutral(model, p)
    rest = p
    moves: dict[str, tuple[float, float]] = {}
    end = float((r.whole or r).time[-1])
    for k, q in late(model):
        span = end if q.growing else 1.0
        steps = np.rint(p[k] * span * r.rate / STEP) if span > 0.0 else 0.0
        if steps:
            by = float(steps) * STEP / (r.rate * span)
            rest = rest - by * (np.arange(len(p)) == k)
            for quantity in q.late:
                offset, drift = moves.get(quantity, (0.0, 0.0))
                moves[quantity] = (offset, drift + by) if q.growing else (offset + by, drift)
    return (r.moved(moves) if moves else r), rest


def _at_neutral(model: Model, p: Array) -> Array:
    neutral = {q.symbol: q.neutral for e in model.effects for q in e.parameters if q.shape}
    rest, place = p.copy(), 0
    for name, size in model.chain.PARAMETERS:
        rest[place : place + size] = neutral.get(name, rest[place : place + size])
        place += size
    return rest


def late(model: Model) -> Iterator[tuple[int, EffectParameter]]:
    """Parameters of a model that make motion late, each with its place in the parameter vector."""
    found = {q.symbol: q for e in model.effects for q in e.parameters if q.late}
    place = 0
    for name, size in model.chain.PARAMETERS if found else ():
        if name in found:
            yield place, found[name]
        place += size
