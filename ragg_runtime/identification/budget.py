"""The error budget of a calibrated model: what each group of its parameters contributes to the output."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.scores import measure_error
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.model.evaluate import evaluate_output, find_unit_factor
from ragg_runtime.model.evaluator import find_places
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


@dataclass(frozen=True)
class Contribution:
    """What one group of parameters contributes: before demodulation, and in the two channels, Eo; ``strong``: an effect."""

    label: str
    rms: float
    inline: float
    cross: float
    strong: bool


def list_contributions(f: Fitted) -> list[Contribution]:
    """rms before demodulation and standard deviations of the channels, Eo, largest first: the change of the model's output when one
    group of parameters is put to zero.
    """
    found = []
    full = [evaluate_output(f.model.chain, o.record, f.calibration.p, o.output) for o in f.observations]
    for g in list_groups(f.model, f.instrument, f.calibration.p):
        squares = []
        for o, G, k in zip(f.observations, full, f.scales, strict=True):
            e = measure_error(G - evaluate_output(f.model.chain, o.record, g.without, o.output), o.record, k)
            squares.append([e.rms_Eo**2, e.inline_Eo**2, e.cross_Eo**2])
        rms, inline, cross = (float(x) for x in np.sqrt(np.mean(squares, axis=0)))
        found.append(Contribution(g.label, rms, inline, cross, g.effect is not None))
    return sorted((c for c in found if c.rms > 0.0), key=lambda c: (-c.rms, c.label))


def list_groups(model: Model, instrument: Instrument, p: Array) -> list[ParameterGroup]:
    """The groups of the parameters p (size,) of which something is there: of accelerometers, then of each effect."""
    places = find_places(model.chain)
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
