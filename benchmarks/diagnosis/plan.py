"""Which flights are flown: a fixed list, every flight determined by its index within its kind."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from ragg_runtime.flight import Flight, read_flight
from ragg_runtime.reference.motion import Motion, recorded_motion
from ragg_runtime.reference.scenario import Scenario, scenario

DURATION = 640.0
RATE = 16.0

COUNTS = {"effect-free": 64, "single-10": 62, "single-5": 62, "two": 40, "outside": 36}
"""Flights of every kind."""

STRENGTH = {"single-10": 10.0, "single-5": 5.0, "two": 10.0, "outside": 10.0}
"""Strength of what is hidden, in sigmas after the projection (``inject``)."""

RECORD = Path(__file__).parents[2] / "examples" / "demo-flight.parquet"
"""A flight whose motion channels are flown again, as a record."""

_SEEDS = {"effect-free": 10_000, "single-10": 20_000, "single-5": 30_000, "two": 40_000, "outside": 50_000}

PAGE = 141
"""The sample that the page in docs shows. Raise it before the page is flown anew: 0 is what the method was once chosen on, and a
sample that has been looked at is no proof of what was changed afterwards."""

_APART = 1_000_000
"""Between the seeds of two samples."""


@dataclass(frozen=True)
class Spec:
    """One flight.

    Attributes
    ----------
    kind, index
        The kind of flight, and its number within it.
    seed
        Of everything that is drawn.
    trim
        As in ``scenario``.
    motion
        A shape of spectrum, ``mixed`` (one for each component) or ``recorded``.
    bursts, turbulence
        Non-stationarity and scale of the motion.
    noise_Eo, red_corner
        White density of the cross channel, Eo/sqrt(Hz); Hz below which 1/f noise exceeds it, or ``None``.
    gradient
        ``constant`` or ``varying`` (20 Eo rms), then ``recorded`` or ``unrecorded``.
    sensor_noise
        White noise of the motion record, as the error of G_out that it causes over the noise.
    """

    kind: str
    index: int
    seed: int
    trim: str
    motion: str
    bursts: float
    turbulence: float
    noise_Eo: float
    red_corner: float | None
    gradient: tuple[str, str]
    sensor_noise: float

    @property
    def id(self) -> str:
        return f"{self.kind}/{self.index:03d}"

    @property
    def digest(self) -> str:
        """Of the conditions: a changed plan is flown anew."""
        return hashlib.sha256(json.dumps(asdict(self)).encode()).hexdigest()[:12]

    def rng(self, stream: int) -> np.random.Generator:
        """Random numbers of a purpose of the benchmark's own (``scenario`` has other streams)."""
        return np.random.default_rng([self.seed, 900 + stream])


def specs(kinds: Sequence[str] | None = None, most: int | None = None, sample: int = 0) -> list[Spec]:
    """All flights of these kinds (default: of every kind), at most ``most`` of each, of one sample.

    The kinds in turn, so that a run cut short says something of each.
    """
    counts = {k: COUNTS[k] if most is None else min(most, COUNTS[k]) for k in kinds or COUNTS}
    order = sorted((index / count, kind) for kind, count in counts.items() for index in range(count))
    return [spec(kind, round(place * counts[kind]), sample) for place, kind in order]


def spec(kind: str, index: int, sample: int = 0) -> Spec:
    """The flight of this kind and number; another ``sample`` draws everything anew."""
    seed = _SEEDS[kind] + index + _APART * sample
    rng = np.random.default_rng([seed, 899])
    motions = ("mixed", "dryden", "kolmogorov", "flat", "resonant", "recorded")
    gradients = (
        ("constant", "recorded"),
        ("varying", "recorded"),
        ("constant", "recorded"),
        ("varying", "unrecorded"),
    )
    return Spec(
        kind,
        index,
        seed,
        trim=("matched", "table-v")[index % 2],
        motion=str(rng.choice(motions)),
        bursts=float(rng.choice([0.0, 0.3, 0.6, 1.0])),
        turbulence=float(rng.choice([0.5, 1.0, 2.0])),
        noise_Eo=float(rng.choice([1.0, 2.0, 5.0])),
        red_corner=[None, 0.05, 0.2][int(rng.integers(3))],
        gradient=gradients[int(rng.integers(4))],
        sensor_noise=float(rng.choice([0.0, 0.2])),
    )


def scenario_of(s: Spec) -> Scenario:
    """The instrument and the world of a flight."""
    drawn = scenario(
        s.seed,
        trim="matched" if s.trim == "matched" else "table-v",
        duration=DURATION,
        rate=RATE,
        shape=None if s.motion in ("mixed", "recorded") else s.motion,
        bursts=s.bursts,
        turbulence_scale=s.turbulence,
        noise_density=s.noise_Eo * 1e-9,
        red_corner=s.red_corner,
        gradient_rms=20e-9 if s.gradient[0] == "varying" else 0.0,
    )
    return replace(drawn, motion=_recorded(s.rng(0))) if s.motion == "recorded" else drawn


def _recorded(rng: np.random.Generator) -> Motion:
    flight: Flight = read_flight(RECORD, 9.8)
    a, omega = (np.stack([flight.channels[f"{q}_{k}"] for k in "xyz"]) for q in ("a", "omega"))
    spare = flight.time[-1] - flight.time[0] - DURATION
    start = flight.time[0] + 1.0 + (spare - 2.0) * rng.random()
    return recorded_motion(flight.time - start, a, omega)
