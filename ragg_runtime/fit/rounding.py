"""What the digits of a file are in its output: rounded values of the output, and of the motion through the model."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.fit.observation import Observation
from ragg_runtime.flight.record import ANGULAR_ACCELERATION, ANGULAR_RATE
from ragg_runtime.model.evaluate import output
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import Record
from ragg_runtime.signals.derivative import differentiate

Array = NDArray[np.float64]

STRETCH = 4096
"""Samples from which it is known to some per cent."""

MOSTLY = 0.5
"""Share of the noise's power from which the digits of a file are said to be its noise."""

SEED = 12
"""Of the numbers that are added in the place of those that were cut off."""


@dataclass(frozen=True)
class Rounding:
    """Mean squares, V^2 of G_out, that the digits of each column make; none of columns that were written in full."""

    squares: dict[str, float]

    @property
    def rms(self) -> float:
        """Of all, V."""
        return float(np.sqrt(sum(self.squares.values())))

    def prevails(self, noise: float) -> bool:
        """Whether the digits are most of noise of this variance, V^2."""
        return self.rms**2 >= MOSTLY * noise

    @property
    def worst(self) -> str | None:
        return max(self.squares, key=lambda n: (self.squares[n], n), default=None)


def rounding(model: Model, p: Array, o: Observation) -> Rounding:
    """Of an observation, about a parameter vector: what changes if each value stood elsewhere within its last digit.

    The middle of the record alone is looked at.
    """
    n = len(o.record.time)
    size = min(n, STRETCH)
    r = o.record.part(slice((n - size) // 2, (n - size) // 2 + size))
    if not o.digits.columns or not r.valid.any():
        return Rounding(dict(o.rounded))
    rng = np.random.default_rng(SEED)
    plain = output(model.chain, r, p, o.output)
    squares = dict(o.rounded)
    for name, how in o.digits.columns.items():
        if name not in r.wide:
            continue
        off = how.steps(r.wide[name]) * (rng.random(len(r.wide[name])) - 0.5)
        e = output(model.chain, _moved(r, name, off, derived=o.digits.derived), p, o.output) - plain
        e = o.recorded.through(e, r)
        squares[name] = float(np.mean(e[r.valid] ** 2)) * (1.0 if o.thin is None else o.thin.share)
    return Rounding(squares)


def _moved(r: Record, name: str, off: Array, *, derived: bool) -> Record:
    """A record with something added to one channel, and to what was derived of it."""
    wide = dict(r.wide) | {name: r.wide[name] + off}
    if derived and name in ANGULAR_RATE:
        change = ANGULAR_ACCELERATION[ANGULAR_RATE.index(name)]
        slope = np.nan_to_num(differentiate(off, r.rate))
        wide[change] = r.wide[change] + slope
    return replace(r, wide=wide)
