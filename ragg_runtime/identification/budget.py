"""The error budget of a calibrated model: what each group of its parameters contributes to the output."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.scores import error
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.model.evaluate import output, unit_factor
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Contribution:
    """What one group of parameters contributes: before demodulation, and in the two channels, Eo; ``strong``: an effect."""

    label: str
    rms: float
    inline: float
    cross: float
    strong: bool


def contributions(f: Fitted) -> list[Contribution]:
    """rms before demodulation and standard deviations of the channels, Eo, largest first: the change of the model's output when one
    group of parameters is put to zero (an effect: to where it is absent; scale factors: to their mean).
    """
    found = []
    full = [output(f.model.chain, o.record, f.calibration.p, o.output) for o in f.observations]
    for label, without, effect in _groups(f):
        squares = []
        for o, G, k in zip(f.observations, full, f.scales, strict=True):
            e = error(G - output(f.model.chain, o.record, without, o.output), o.record, k)
            squares.append([e.rms_Eo**2, e.inline_Eo**2, e.cross_Eo**2])
        rms, inline, cross = np.sqrt(np.mean(squares, axis=0))
        found.append(
            Contribution(label=label, rms=float(rms), inline=float(inline), cross=float(cross), strong=effect)
        )
    return sorted((c for c in found if c.rms > 0.0), key=lambda c: (-c.rms, c.label))


def _groups(f: Fitted) -> list[tuple[str, Array, bool]]:
    """(label, parameter vector without the group, whether it is an added effect)."""
    p, known = f.calibration.p, f.instrument.units
    places, start = {}, 0
    for name, size in f.model.chain.PARAMETERS:
        places[name] = slice(start, start + size)
        start += size
    groups = []
    for q in PARAMETERS:
        if q.name not in places:
            continue
        without = p.copy()
        without[places[q.name]] = np.mean(p[places[q.name]]) if q.relative else 0.0
        text = "".join(f"_{piece}" if lowered else piece for piece, lowered in numbers.symbol(q.symbol))
        kind = "imbalance of the " if q.relative else ""
        groups.append((f"{text}  {kind}{numbers.unit(q.description)}", without, False))
    for e in f.model.effects:
        without = p.copy()
        for parameter in e.parameters:
            if parameter.symbol in places and parameter.fitted:
                without[places[parameter.symbol]] = (parameter.neutral or 0.0) * unit_factor(
                    parameter.unit, known
                )
        groups.append((e.id, without, True))
    return groups
