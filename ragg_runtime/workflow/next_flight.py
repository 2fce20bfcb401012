"""Which flight next: the motion that tells apart what flights so far cannot, as a file that can be flown and simulated."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.identification.motion_design import Separation, design, even, multisine, tones_of
from ragg_runtime.identification.next_motion import APART, AXES, HIGHEST, Sinusoid, moved
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.workflow.loop import Loaded, diagnose

Array = NDArray[np.float64]


@dataclass(frozen=True)
class NextFlight:
    """A multisine about the mean of the flights, and what it promises of each pair of rivals."""

    sinusoids: tuple[Sinusoid, ...]
    mean: Mapping[str, float]
    separations: tuple[Separation, ...]
    duration: float
    rate: float

    def motion(self) -> Flight:
        """The motion as a flight without output."""
        time = np.arange(round(self.duration * self.rate)) / self.rate
        channels: dict[str, Array] = {n: np.full(len(time), v) for n, v in self.mean.items()}
        channels |= {f"omegadot_{k}": np.zeros(len(time)) for k in "xyz"}
        return Flight(
            time=time,
            channels=channels | moved(channels, self.sinusoids, time),
            outputs={},
            name="next motion",
        )

    def in_words(self) -> str:
        """What is to be flown, and why."""
        head = f"{len(self.sinusoids)} sinusoids, {self.duration:g} s at {self.rate:g} Hz"
        if not self.separations:
            return f"{head}\nnothing is left to tell apart: a multisine about all axes, which excites every effect"
        return "\n".join([head, *map(_promise, self.separations)])

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
            "separations": [x.as_json() for x in self.separations],
        }


def _promise(x: Separation) -> str:
    size = f"({x.now:.2g} -> {x.then:.3g} sigma)"
    if x.then < APART:
        return (
            f"if it is {x.effect}: no motion within the limits rules out {x.rival}, which acts alike {size}"
        )
    return f"if it is {x.effect}: {x.rival} is ruled out {size}"


def next_flight(
    m: Loaded,
    flights: Sequence[Flight],
    limits: Mapping[str, float],
    *,
    duration: float = 600.0,
    rate: float | None = None,
    band: tuple[float, float] | None = None,
) -> NextFlight:
    """The multisine for the rivals left; ``rate``, Hz, is that of the flights unless given; ``band``, Hz, all that it can hold."""
    rate = flights[0].rate if rate is None else rate
    band = (0.0, HIGHEST * rate) if band is None else band
    tones = tones_of(m.instrument.spin_frequency, limits, band)
    if not tones or band[1] > HIGHEST * rate:
        raise UserError(
            "no motion can be made of these frequencies",
            where="--band",
            found=f"{band[0]:g} to {band[1]:g} Hz at {rate:g} samples a second",
            expected=f"multiples of the spin frequency among them, none above {HIGHEST * rate:g} Hz",
            remedy="give a wider band or a higher --rate",
        )
    d = diagnose(m, flights)
    pairs = [(r.effect, o) for r in d.ranking if r.effect in d.found for o in r.indistinguishable_from]
    made = design(d.fitted, pairs, limits, duration=duration, band=band)
    mean = {n: float(np.mean([np.mean(x.channels[n][x.valid]) for x in flights])) for n in AXES}
    return NextFlight(
        sinusoids=multisine(tones, even(tones)) if made is None else made.sinusoids,
        mean=mean,
        separations=() if made is None else made.separations,
        duration=duration,
        rate=rate,
    )


def write_motion(found: NextFlight, path: Path) -> None:
    """Write the motion as a flight file without output, which `ragg simulate --motion` flies."""
    write_flight(found.motion(), path)
