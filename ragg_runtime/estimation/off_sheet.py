"""Parameters that a record puts far from the test sheet."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from ragg_runtime.estimation.calibrate import Calibration
from ragg_runtime.estimation.columns import spelt
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
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
            sigmas=float((c.p[k] - sheet[k]) / q.scale) * instrument.widths.get(q.name, 1.0),
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
"""Root mean square of the distances of one kind of parameter, in the sheet's sigmas, from which the sheet is less sure of this kind
than it says (or than is plausible), by that factor."""

STATED = "stated"
"""The kind of all parameters of which the sheet says how sure it is."""

AGAIN = 1.5
"""Factor by which a width must have changed for the fit to be made again: the logarithm of a prior's width hardly matters."""

QUIET = 2.0
"""Excess of chi-square up to which the record says how far off the sheet parameters are; beyond it an effect is missing."""

HELD = 0.5
"""Share of what is left that must be the sheet's doing for a sheet that is less sure to be worth a fit: of what stays however wide it
is (linearised), not even a curved valley takes most."""


def widened(model: Model, instrument: Instrument, c: Calibration) -> Instrument | None:
    """The instrument with a sheet as sure of each kind of parameter as the record says it is, if that is less than it says.

    The widths are those of greatest evidence (empirical Bayes; MacKay, Neural Computation 4, 1992): the squared distances over the
    number of parameters that the record tells. ``None`` if nothing changes, or if no width brings what is left down to noise.
    """
    if c.unheld > max(QUIET, HELD * c.excess):
        return None
    now, then = instrument.widths, _widths(model, instrument, c)
    changed = any(
        not 1 / AGAIN < then.get(n, 1.0) / now.get(n, 1.0) < AGAIN for n in dict.fromkeys((*now, *then))
    )
    return replace(instrument, widths=MappingProxyType(then)) if changed else None


def as_said(instrument: Instrument) -> Instrument:
    """The instrument with a sheet as sure as it says: its parameters' widths are given back."""
    return replace(instrument, widths=MappingProxyType({}))


def _widths(model: Model, instrument: Instrument, c: Calibration) -> dict[str, float]:
    """How many times less sure than it says the sheet is of each parameter, at least 1.

    Those of one unit are a kind; all with a sigma on the sheet are another one, doubted only where nothing speaks for an effect.
    """
    kinds = {q.name: STATED if q.name in instrument.sigmas else q.si_unit for q in PARAMETERS}
    squares = dict.fromkeys(kinds.values(), 0.0)
    told = dict.fromkeys(kinds.values(), 0.0)
    sheet = vector(model, instrument)
    for q, k, variance in zip(c.columns, c.index, np.diag(c.covariance), strict=True):
        if q.effect is None:
            x = float((c.p[k] - sheet[k]) / q.scale) * instrument.widths.get(q.name, 1.0)
            squares[kinds[q.name]] += x**2
            told[kinds[q.name]] += max(0.0, 1.0 - float(variance))
    width = {k: float(np.sqrt(x / max(told[k], 1.0))) for k, x in squares.items()}
    wide = {k: w >= WIDE and squares[k] >= FAR**2 for k, w in width.items()}
    wide[STATED] = wide.get(STATED, False) and c.excess <= QUIET
    return {n: width[k] for n, k in kinds.items() if wide[k]}


def room_taken(instrument: Instrument, c: Calibration) -> float:
    """What wider priors cost, in chi-square: the logarithm of the volume that they add to, of every parameter that the record tells."""
    width = np.array([instrument.widths.get(q.name, 1.0) if q.effect is None else 1.0 for q in c.columns])
    return float(2.0 * np.log(width) @ np.maximum(0.0, 1.0 - np.diag(c.covariance)))
