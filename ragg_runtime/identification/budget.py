"""Groups of parameters that do something together, of whose contributions an error budget consists."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.model.evaluate import find_unit_factor
from ragg_runtime.model.model import Model
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ParameterGroup:
    """Parameters that do something together: their name, in words with their symbol, the ``effect`` that they are of, and the
    parameter vector ``without`` (size,) them: at zero, an effect where it is absent, scale factors at their mean.
    """

    name: str
    label: str
    effect: str | None
    without: Array


def list_groups(model: Model, instrument: Instrument, p: Array) -> list[ParameterGroup]:
    """The groups of the parameters p (size,) of which something is there: of accelerometers, then of each effect."""
    places = model.chain.places
    found = []
    for q in (q for q in PARAMETERS if q.name in places):
        without = p.copy()
        # of a gain the mean carries the gradient itself: what disturbs is that the four differ
        without[places[q.name]] = np.mean(p[places[q.name]]) if q.relative else 0.0
        imbalance = "imbalance of the " if q.relative else ""
        label = f"{q.name}  {imbalance}{numbers.unit(q.description)}"
        name = f"imbalance of {q.name}" if q.relative else q.name
        found.append(ParameterGroup(name, label, None, without))
    for e in model.effects:
        without = p.copy()
        for parameter in (x for x in e.parameters if x.symbol in places and x.fitted):
            factor = find_unit_factor(parameter.unit, instrument.units)
            without[places[parameter.symbol]] = (parameter.neutral or 0.0) * factor
        found.append(ParameterGroup(e.id, e.id, e.id, without))
    return [g for g in found if not np.array_equal(g.without, p)]
