"""The record as a model with certain parameters takes it: motion shifted in time, and what an instrument remembers of it.

A Taylor series in a lateness fails at half a sample: so it is taken about the lateness that a fit has come to.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.model.evaluator import find_places
from ragg_runtime.model.memory import list_memories, with_responses
from ragg_runtime.model.model import DerivedParameter, Model
from ragg_runtime.model.record import Record

Array = NDArray[np.float64]

STEP = 1 / 32
"""Samples between the latenesses to which motion is moved: by the series the rest of at most half of it is described to 1e-6 of
the change, as well as derivatives are known (up to 42 % of the Nyquist frequency)."""


def about(model: Model, r: Record, p: Array) -> tuple[Record, Array]:
    """The record with its motion shifted, and the remaining parts of the parameters p (size,), SI, for the series of derivatives.

    What describes a memory is left at its neutral values, about which the chain has its series.
    """
    memories = [*list_memories(model, p)]
    if memories:
        r, p = with_responses(r, memories, model.chain.INPUTS), _at_neutral(model, p)
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
    neutral = {q.symbol: q.neutral for e in model.effects if e.memory for q in e.parameters if q.shape}
    rest, places = p.copy(), find_places(model.chain)
    for name, value in neutral.items():
        rest[places[name]] = value
    return rest


def late(model: Model) -> Iterator[tuple[int, DerivedParameter]]:
    """Parameters of a model that make motion late, each with its place in the parameter vector."""
    found = [q for e in model.effects for q in e.parameters if q.late]
    places = find_places(model.chain) if found else {}
    yield from sorted(((places[q.symbol].start, q) for q in found), key=lambda x: x[0])
