"""The record as a model with certain parameters takes it: motion shifted in time, and what an instrument remembers of it.

A Taylor series in a lateness fails at half a sample: so it is taken about the lateness that a fit has come to, exactly. Moved in
steps, with the rest left to the series, chi-square would jump from step to step.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.model.evaluator import find_places
from ragg_runtime.model.memory import add_responses, list_memories
from ragg_runtime.model.model import DerivedParameter, Model
from ragg_runtime.model.record import Record

Array = NDArray[np.float64]


def move_record(model: Model, r: Record, p: Array) -> tuple[Record, Array]:
    """The record with its motion shifted, and the parameters p (size,), SI, without what moved it.

    What describes a memory is left at its neutral values, about which the chain has its series.
    """
    rest, memories = p.copy(), [*list_memories(model, p)]
    if memories:
        r, places = add_responses(r, memories, model.chain.INPUTS), find_places(model.chain)
        for q in (q for e in model.effects if e.memory for q in e.parameters if q.shape):
            rest[places[q.symbol]] = q.neutral
    moves: dict[str, tuple[float, float]] = {}
    for k, q in list_late(model):
        if not p[k]:
            continue
        rest[k] = 0.0
        for quantity in q.late:
            offset, drift = moves.get(quantity, (0.0, 0.0))
            moves[quantity] = (offset, drift + p[k]) if q.growing else (offset + p[k], drift)
    return (r.moved(moves) if moves else r), rest


def list_late(model: Model) -> Iterator[tuple[int, DerivedParameter]]:
    """Parameters of a model that make motion late, each with its place in the parameter vector."""
    found = [q for e in model.effects for q in e.parameters if q.late]
    places = find_places(model.chain) if found else {}
    yield from sorted(((places[q.symbol].start, q) for q in found), key=lambda x: x[0])
