"""Auxiliary channels that were recorded more slowly than the motion: a thermometer read every ten seconds.

Such a channel is interpolated (linearly) if it was sampled regularly and is slow: left out one at a time, its
values must follow from their neighbours. Otherwise it is left out, lest all samples between its own be lost.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SPARSE = 0.5
"""Share of rows without a value from which a channel is one of a lower rate (rather than one with blanks)."""

FEWEST = 8
"""Values that are needed to judge a channel."""

REGULAR = 0.8
"""Share of the channel's steps that must be within a half of the median step."""

BRIDGED_STEPS = 3.0
"""Longest gap, in steps of the channel, that is interpolated."""

SLOW = 0.3
"""Largest error, over the channel's standard deviation, of a value that is interpolated between its neighbours. Of a
sinusoid that is one of eight values in a period; between the values, where half the step is bridged, the error is a
fourth of it at most, rms a twentieth."""


@dataclass(frozen=True)
class Slow:
    """The values of a channel at its own instants, and its step, s."""

    time: Array
    values: Array
    step: float

    @property
    def covered(self) -> float:
        """Time, s, in which there is a value."""
        steps = np.diff(self.time)
        return float(np.sum(steps[steps <= BRIDGED_STEPS * self.step]))

    def at(self, time: Array) -> Array:
        """(N,): interpolated; NaN before the first value, after the last and in gaps of more than ``BRIDGED_STEPS`` steps."""
        found = np.interp(time, self.time, self.values)
        after = np.clip(np.searchsorted(self.time, time), 1, len(self.time) - 1)
        wide = self.time[after] - self.time[after - 1] > BRIDGED_STEPS * self.step
        inside = (time > self.time[after - 1]) & (time < self.time[after])
        outside = (time < self.time[0]) | (time > self.time[-1])
        found[(wide & inside) | outside] = np.nan
        return np.asarray(found)


def judged(time: Array, values: Array) -> Slow | str:
    """The channel, from its values (n,) and their instants, s; or why it cannot be interpolated, in words."""
    if len(values) < FEWEST:
        return f"it has {len(values)} value{'s' * (len(values) != 1)}"
    steps = np.diff(time)
    step = float(np.median(steps))
    if np.mean(np.abs(steps - step) <= 0.5 * step) < REGULAR:
        return "it is not recorded at regular intervals"
    spread = float(np.std(values))
    a, b = steps[:-1], steps[1:]
    between = (values[:-2] * b + values[2:] * a) / (a + b)
    near = np.maximum(a, b) <= BRIDGED_STEPS * step
    error = float(np.sqrt(np.mean((values[1:-1] - between)[near] ** 2))) if near.any() else np.inf
    if error > SLOW * spread:
        return f"it changes too fast for one value in {step:.3g} s"
    return Slow(time, values, step)
