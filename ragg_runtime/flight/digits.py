"""With how many digits the columns of a flight were written: a number of significant ones, or of decimals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.flight.record import ANGULAR_ACCELERATION, ANGULAR_RATE, Flight
from ragg_runtime.instrument.units import Units

Array = NDArray[np.float64]

LOOKED_AT = 512
"""Values of a column that show how it was written: of full ones none in a thousand million ends in zeros."""

MOST = 11
"""Significant digits from which what is written is taken for whole: beside them the noise of any record is large."""

SAME = 1e-13
"""Relative difference up to which a value is a rounded one: what conversion of units leaves of a double."""

FEWEST = 16
"""Values from which their digits are looked at."""

ROUNDING = 1e-6
"""Distance from a multiple of the last digit, in such digits, that double precision may make."""


@dataclass(frozen=True)
class Written:
    """How a column was written: with so many significant ``digits``, or in steps of ``step`` where that is not zero.

    ``unit_factor``: SI value of one unit of the file.
    """

    digits: int
    step: float
    unit_factor: float

    def steps(self, values: Array) -> Array:
        """Distance of neighbouring numbers that could stand there, in SI, of values in SI."""
        if self.step:
            return np.full(values.shape, self.step * self.unit_factor)
        size = np.abs(values) / self.unit_factor
        with np.errstate(divide="ignore"):
            power = np.where(size > 0, np.floor(np.log10(size)), -300.0)
        return np.asarray(10.0 ** (power + 1 - self.digits) * self.unit_factor)

    def mean_square(self, values: Array) -> float:
        """Of what was cut off, SI: a twelfth of the steps' square."""
        some = values[:: max(1, len(values) // LOOKED_AT)]
        return float(np.mean(self.steps(some) ** 2)) / 12 if len(some) else 0.0

    def words(self, column: str) -> str:
        return f"{column} in steps of {self.step:g}" if self.step else f"{column} with {self.digits} digits"


@dataclass(frozen=True)
class Digits:
    """Columns that were written with few digits, and whether the angular acceleration is derived of the rate."""

    columns: Mapping[str, Written] = field(default_factory=dict)
    derived: bool = False


def digits_of(flight: Flight, known: Units) -> Digits:
    """Of every column of a flight that changes."""
    found = {}
    for name, values in (*flight.channels.items(), *flight.outputs.items()):
        if flight.written and name not in flight.written:
            continue  # made by us
        at = np.linspace(0, len(values) - 1, min(len(values), LOOKED_AT)).astype(np.intp)
        some = np.asarray(values[at])
        some = some[np.isfinite(some) & flight.valid[at]]
        if len(some) < FEWEST or np.ptp(some) == 0.0:
            continue
        factor = _factor(name, flight, known)
        w = None if factor is None else written(some, factor)
        if w is not None:
            found[name] = w
    made = bool(flight.written) and ANGULAR_ACCELERATION[0] not in flight.written
    return Digits(columns=found, derived=made and ANGULAR_RATE[0] in found)


def _factor(name: str, flight: Flight, known: Units) -> float | None:
    """SI value of one unit of the file; ``None`` of units with another zero, such as degC."""
    unit, si = flight.written.get(name), flight.units[name]
    if not unit:
        return 1.0
    one, none = known.to_si(1.0, unit, si), known.to_si(0.0, unit, si)
    return None if none != 0.0 else one


def written(values: Array, unit_factor: float) -> Written | None:
    """How values (n,), SI, were written; ``None``: in full."""
    x = values / unit_factor
    size = float(np.max(np.abs(x)))
    digits = next((n for n in range(1, MOST + 1) if _holds(x, _significant(x, n))), None)
    if digits is None:
        return None
    top = int(np.floor(np.log10(size))) + 1 - digits  # the step of the largest, if all have decimals alike
    step = 10.0**top
    alike = bool(np.all(np.abs(x / step - np.rint(x / step)) < ROUNDING))
    return Written(digits=digits, step=step if alike else 0.0, unit_factor=unit_factor)


def _significant(x: Array, digits: int) -> Array:
    with np.errstate(divide="ignore"):
        power = np.where(x == 0.0, 0.0, np.floor(np.log10(np.abs(x)))) + 1 - digits
    # by a power of ten that is exact: of two halves, the one that is no fraction
    up, down = 10.0 ** np.maximum(-power, 0.0), 10.0 ** np.maximum(power, 0.0)
    return np.asarray(np.rint(x * up / down) * down / up)


def _holds(x: Array, rounded: Array) -> bool:
    return bool(np.all(np.abs(x - rounded) <= SAME * np.abs(x)))
