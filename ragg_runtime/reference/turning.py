"""How a disc turns: steadily, with swings, to and fro, or not at all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.reference.angle import disc_angle, turns
from ragg_runtime.reference.taylor import Taylor

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Turning:
    """Angle 2 pi frequency t + start + sum of amplitude sin(2 pi f t + phase).

    Attributes
    ----------
    frequency
        Hz; negative: backwards; 0 with swings: to and fro.
    swings
        (amplitude rad, frequency Hz, phase rad) each.
    start
        rad.
    """

    frequency: float
    swings: tuple[tuple[float, float, float], ...] = ()
    start: float = 0.0

    def at(self, time: Array, delay: float = 0.0) -> Taylor:
        """The angle and its rates at ``time - delay``, (N,) s; whole turns of the steady part are dropped."""
        phi = disc_angle(self.frequency, time, delay)
        steady = np.full(time.shape, 2 * np.pi * self.frequency)
        found = Taylor(phi + self.start if self.start else phi, steady, np.zeros(time.shape))
        for amplitude, f, phase in self.swings:
            rate = 2 * np.pi * f
            beat = 2 * np.pi * (turns(f, time) - turns(f, delay)) + phase
            swing = Taylor(beat, np.full(time.shape, rate), np.zeros(time.shape)).sine()
            found = found + swing * amplitude
        return found

    def encoder(self, time: Array) -> Array:
        """What an encoder reads, (N,) rad, between -pi and pi."""
        return np.asarray(np.angle(np.exp(1j * self.at(time).value)))
