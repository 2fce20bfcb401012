"""Which flight next: the motion that tells apart what flights so far cannot, as a file that can be flown and simulated."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis.next_motion import AT_REST, AXES, RATIOS, Proposal
from ragg_runtime.flight import Flight, write_flight
from ragg_runtime.workflow.loop import Loaded, diagnose

Array = NDArray[np.float64]


@dataclass(frozen=True)
class NextFlight:
    """Sinusoids (axis, frequency in Hz, amplitude in SI, phase in rad) about the mean of the flights, and what they promise."""

    sinusoids: tuple[tuple[str, float, float, float], ...]
    mean: Mapping[str, float]
    proposals: tuple[Proposal, ...]
    duration: float
    rate: float

    def motion(self) -> Flight:
        """The motion as a flight without output."""
        time = np.arange(round(self.duration * self.rate)) / self.rate
        channels: dict[str, Array] = {n: np.full(len(time), v) for n, v in self.mean.items()}
        channels |= {f"omegadot_{k}": np.zeros(len(time)) for k in "xyz"}
        for axis, frequency, amplitude, phase in self.sinusoids:
            w = 2 * np.pi * frequency
            channels[axis] = channels[axis] + amplitude * np.sin(w * time + phase)
            if axis.startswith("omega_"):
                name = axis.replace("omega_", "omegadot_")
                channels[name] = channels[name] + amplitude * w * np.cos(w * time + phase)
        return Flight(time=time, channels=channels, outputs={}, name="next motion")

    def in_words(self) -> str:
        """What is to be flown, and why."""
        why = [p.in_words() for p in self.proposals]
        if not why:
            why = ["nothing is left to tell apart: a multisine about all axes, which excites every effect"]
        return "\n".join([f"{len(self.sinusoids)} sinusoids, {self.duration:g} s at {self.rate:g} Hz", *why])

    def as_json(self) -> dict[str, object]:
        return {
            "duration_s": self.duration,
            "rate_Hz": self.rate,
            "sinusoids": [
                {
                    "axis": axis,
                    "frequency_Hz": frequency,
                    "amplitude": amplitude,
                    "unit": "m/s^2" if axis.startswith("a_") else "rad/s",
                    "phase_rad": phase,
                }
                for axis, frequency, amplitude, phase in self.sinusoids
            ],
            "proposals": [p.as_json() for p in self.proposals],
        }


def next_flight(
    m: Loaded,
    flights: Sequence[Flight],
    limits: Mapping[str, float],
    *,
    duration: float = 600.0,
    rate: float = 16.0,
) -> NextFlight:
    """The sinusoids that :mod:`ragg_runtime.diagnosis.next_motion` proposes for the rivals left, in one motion.

    Sinusoids about one axis share its limit. Where nothing is left to tell apart: all frequencies about all axes,
    with the phases of M. Schroeder (IEEE Trans. Inf. Theory 16, 1970), which keep the peak low.
    """
    proposals = tuple(p for p in diagnose(m, flights, limits).next_motion if p.separates)
    spin = abs(m.instrument.spin_frequency) or AT_REST
    wanted = sorted({(p.axis, p.frequency) for p in proposals})
    if not wanted:
        wanted = [(axis, k * spin) for axis in AXES for k in RATIOS if k * spin <= 0.2 * rate]
    made = []
    for axis in dict.fromkeys(a for a, _ in wanted):
        own = [f for a, f in wanted if a == axis]
        size = limits["a" if axis.startswith("a_") else "omega"] / len(own)
        made += [(axis, f, size, -np.pi * k * (k + 1) / len(own)) for k, f in enumerate(own)]
    mean = {n: float(np.mean([np.mean(x.channels[n][x.valid]) for x in flights])) for n in AXES}
    return NextFlight(sinusoids=tuple(made), mean=mean, proposals=proposals, duration=duration, rate=rate)


def write_motion(found: NextFlight, path: Path) -> None:
    """Write the motion as a flight file without output, which `ragg simulate --motion` flies."""
    write_flight(found.motion(), path)
