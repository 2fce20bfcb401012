"""How a disc turns: steadily, with swings, to and fro, as an encoder recorded it, or not at all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.reference.motion import RecordedSignal, disc_angle, turns
from ragg_runtime.reference.taylor import Taylor

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Turning:
    """Angle 2 pi frequency t + start + sum of amplitude sin(2 pi f t + phase) + recorded, rad.

    ``frequency``: Hz; negative: backwards; 0 with swings: to and fro. ``swings``: (amplitude rad, frequency Hz, phase
    rad) each. ``recorded``: what a record has beyond the steady turning, rad.
    """

    frequency: float
    swings: tuple[tuple[float, float, float], ...] = ()
    start: float = 0.0
    recorded: RecordedSignal | None = None

    @classmethod
    def of_record(cls, time: Array, angle: Array) -> Turning:
        """As an encoder saw it: ``angle`` (N,) rad, in which whole turns may be missing, at ``time`` (N,) s."""
        whole = np.unwrap(angle)
        frequency = float((whole[-1] - whole[0]) / (time[-1] - time[0]) / (2 * np.pi))
        steady = 2 * np.pi * frequency * (time - time[0])
        rest = RecordedSignal(time, whole - whole[0] - steady)
        start = float(angle[0] - 2 * np.pi * turns(frequency, time[0]))
        return cls(frequency=frequency, start=start, recorded=rest)

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
        if self.recorded is not None:
            of = self.recorded
            found = found + Taylor(of.value(time, delay), of.rate(time, delay), of.acceleration(time, delay))
        return found

    def encoder(self, time: Array) -> Array:
        """What an encoder reads, (N,) rad, between -pi and pi."""
        return np.asarray(np.angle(np.exp(1j * self.at(time).value)))
