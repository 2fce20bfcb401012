"""Parameters that a record puts far from the test sheet."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from ragg_runtime.fit.calibrate import Calibration
from ragg_runtime.fit.columns import Column, spelt
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model.model import Model

FAR = 5.0
"""Standard errors of the sheet from which a parameter is named: none of a few dozen should be there by chance."""


@dataclass(frozen=True)
class OffSheet:
    """One parameter: its calibrated and the sheet's value in ``unit``, and their distance in the sheet's sigmas."""

    name: str
    accelerometer: int | None
    sigmas: float
    value: float
    sheet: float
    unit: str
    accelerometer_name: str = ""

    def in_words(self) -> str:
        """``K1 of A2 is 40 sigma off its sheet: 10.4 where it says 10 mA/g``."""
        of = "" if self.accelerometer is None else f" of {self.accelerometer_name}"
        return (
            f"{self.name}{of} is {abs(self.sigmas):.3g} sigma off its sheet: "
            f"{self.value:.6g} where it says {self.sheet:.6g} {self.unit}"
        )

    def as_json(self) -> dict[str, object]:
        return {
            "name": self.name,
            "accelerometer": self.accelerometer,
            "sigmas": self.sigmas,
            "value": self.value,
            "sheet": self.sheet,
            "unit": self.unit,
            **spelt(self.accelerometer, self.accelerometer_name),
        }


def off_sheet(model: Model, instrument: Instrument, c: Calibration) -> list[OffSheet]:
    """The instrument's parameters that ended more than :data:`FAR` sigmas from their sheet, farthest first."""
    sheet = vector(model, instrument)
    found = [
        OffSheet(
            name=q.name,
            accelerometer=q.accelerometer,
            sigmas=float((c.p[k] - sheet[k]) / q.scale * c.widening),
            value=float(c.p[k] / q.unit_factor),
            sheet=float(sheet[k] / q.unit_factor),
            unit=q.unit,
            accelerometer_name=q.accelerometer_name,
        )
        for q, k in zip(c.columns, c.index, strict=True)
        if q.effect is None
    ]
    return sorted((x for x in found if abs(x.sigmas) > FAR), key=lambda x: -abs(x.sigmas))


WIDE = 2.0
"""Root mean square of the parameters' distances, in the sheet's sigmas, from which the whole sheet is less sure than it says
(or than is plausible), by that factor: a sheet for an instrument of another class, say. Of an effect, the largest distance."""

MOST_ROOM = 3.0
"""Factor by which the prior of an effect is widened at the most (thirty times its usual size): with more, a gyroscope's bias of
7,000 deg/h passed for a term that no effect of the catalogue makes, to the noise."""

QUIET = 2.0
"""Excess of chi-square up to which the record says so, not an effect that is missing."""


def widened(model: Model, instrument: Instrument, c: Calibration) -> tuple[Instrument, float] | None:
    """The instrument with a sheet as sure as the record says it is, if that is far less than it says; and by what factor.

    The same of the sizes that are usual of effects in the model (:func:`with_room`). ``None`` if nothing is to be widened.
    """
    roomy = with_room(model, instrument, c)
    off = _off(model, instrument, c)
    factor = float(np.sqrt(np.mean([x**2 for q, x in off if q.effect is None])))
    if factor < WIDE or c.excess > QUIET:
        return None if roomy is None else (roomy, 1.0)
    sigmas = {q.name: factor * instrument.sigma(q.name) for q, _ in off if q.effect is None}
    return replace(roomy or instrument, sigmas=MappingProxyType(sigmas)), factor


def with_room(model: Model, instrument: Instrument, c: Calibration) -> Instrument | None:
    """The instrument with the prior of every effect in the model as wide as the record says its parameters are large.

    Of a fault nothing is known but what size is usual: a prior that holds it there against the data would leave some of it in
    the residual, and another one in its place would be taken for it. Beyond ``MOST_ROOM`` it is held: that is no such fault any
    more. ``None`` if all are wide enough.
    """
    largest = {e.id: 0.0 for e in model.effects}
    for q, x in _off(model, instrument, c):
        if q.effect is not None:
            largest[q.effect] = max(largest[q.effect], abs(x))
    now = {e: instrument.widths.get(e, 1.0) for e in largest}
    wider = {e: min(x * now[e], MOST_ROOM) for e, x in largest.items() if x >= WIDE and now[e] < MOST_ROOM}
    if not wider or c.excess > QUIET:
        return None
    return replace(instrument, widths=MappingProxyType({**instrument.widths, **wider}))


def _off(model: Model, instrument: Instrument, c: Calibration) -> list[tuple[Column, float]]:
    """Every fitted parameter, and how far it is from its sheet, in scales."""
    sheet = vector(model, instrument)
    return [(q, float((c.p[k] - sheet[k]) / q.scale)) for q, k in zip(c.columns, c.index, strict=True)]
