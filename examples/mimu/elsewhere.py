"""Whether what the page says holds elsewhere: other parts of a recording, other quadruples of the board, worse data.

    python -m examples.mimu.elsewhere RAW.bin.gz [NAME ...]

Each case is a gradiometer made of the raw packets of a recording, and asked the questions of the page: what is left out one at
a time must be found and agree with the survey. Prints a line for every question, and how many hold.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from examples.mimu import record
from examples.mimu.record import FRONT, RATE, Array
from examples.mimu.sheet import sheet
from examples.mimu.story import MISREAD, RADIUS, SHORT, diagnosed_of, flights, sure_of_angles
from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.flight import Flight, write_flight
from ragg_runtime.instrument.read_toml import parse_instrument

BACK = tuple(k + 1 for k in FRONT)
MIXED = (FRONT[0], FRONT[1], BACK[2], BACK[3])
"""A1, A2 of the front, A3, A4 of the back."""

THINNED = 2
"""Of so many samples one is kept."""

NOISE = 0.3, 0.01
"""m/s^2 and rad/s that are added: several times what the chips have."""

FAR = 3.0
"""Standard deviations within which a value agrees with what is known."""

SCATTER = 0.3
"""mm: how far the sensing elements of a quadruple may be from the middles of its chips, on average of four."""


TURNS = ("imu-acceleration-misalignment", "imu-misalignment")
"""One side turned against the other: of the forces alone, or of the rates as well, where a milliradian is next to nothing."""


@dataclass(frozen=True)
class Case:
    """A gradiometer: which sensors it is made of, its rests and its motion; and the motion with nothing marked as saturated."""

    name: str
    picked: Sequence[int]
    rests: Flight
    moved: Flight
    unmarked: Flight

    @property
    def lifts(self) -> Array:
        """(4,) mm above the motion sensors."""
        return 1e3 * record.lifts(self.picked)


@dataclass(frozen=True)
class Raw:
    """A recording: (N, 8, 3) m/s^2 and rad/s, (N,) saturated; where it rests, and from where it is thrown about."""

    force: Array
    rate: Array
    saturated: NDArray[np.bool_]
    quiet: NDArray[np.bool_]
    start: int

    @staticmethod
    def of(path: Path) -> Raw:
        force, rate, saturated = record.read(path)
        quiet, start = record.parts(rate)
        return Raw(force=force, rate=rate, saturated=saturated, quiet=quiet, start=start)

    def case(
        self,
        name: str,
        picked: Sequence[int] = FRONT,
        seconds: tuple[float, float] = (0.0, record.LENGTH),
        *,
        rested: float = 1.0,
        thin: int = 1,
        noise: tuple[float, float] = (0.0, 0.0),
    ) -> Case:
        """``seconds`` of the motion, and of the time before it the share ``rested``."""
        rng = np.random.default_rng(15)
        force, rate = (
            x + s * rng.standard_normal(x.shape) for x, s in zip((self.force, self.rate), noise, strict=True)
        )
        before = slice(0, round(rested * self.start))
        lying = record.rests(force[before], rate[before], self.quiet[before], picked)
        at = slice(*(self.start + round(s * RATE) for s in seconds), thin)
        marked, none = self.saturated[at], np.zeros_like(self.saturated[at])
        flown = [record.motion(force[at], rate[at], x, picked) for x in (marked, none)]
        flown = [replace(x, time=x.time * thin) for x in flown]
        return Case(name=name, picked=picked, rests=lying, moved=flown[0], unmarked=flown[1])


def cases(raw: Raw) -> Iterator[Case]:
    """The record of the page, and others."""
    yield raw.case("page")
    yield raw.case("first half", seconds=(0.0, record.LENGTH / 2))
    yield raw.case("second half", seconds=(record.LENGTH / 2, record.LENGTH))
    yield raw.case("later", seconds=(record.LENGTH, 2 * record.LENGTH))
    yield raw.case("half of the rests", rested=0.5)
    yield raw.case("back", BACK)
    yield raw.case("mixed", MIXED)
    yield raw.case("half rate", thin=THINNED)
    yield raw.case("noise", noise=NOISE)


def questions(c: Case) -> Iterator[tuple[str, bool, str]]:
    """What is asked, whether the answer holds, and the answer in words."""
    own = [f"{x:.4g} mm" for x in c.lifts]
    flat = sheet(height="0 mm", lift="10")
    same = bool(np.ptp(c.lifts) == 0.0)
    if same:
        d = ask(c, sheet(height="0 mm", lift="0.3"))
        yield "lever arm", *agrees(d, "imu-lever-arm", {"l_z": -1e-3 * c.lifts.mean()}, 0.2e-3)
    free = flat if same else sheet(height=own, lift="10")
    short = sheet(height="0 mm" if same else own, lift="10", radius=f"{RADIUS - SHORT:.5g} mm", arm="0.02")
    yield "arm length", *agrees(ask(c, short), "arm-length", {"delta_R": SHORT}, SCATTER)
    yield "gyro scale", *agrees(ask(c, free, MISREAD), "gyro-scale", {"s_x": 0.03, "s_y": 0.03}, 0.0)
    d = ask(c, sure_of_angles(free))
    yield "misalignments", any(e in d.found for e in TURNS), said(d)
    d = ask(replace(c, moved=c.unmarked), free)
    yield "saturation", "imu-saturation" in d.found, said(d)


def ask(c: Case, text: str, factor: float = 1.0) -> Diagnosis:
    """What ``ragg diagnose`` says of a case with this sheet, the rates times a factor."""
    i = parse_instrument(text)
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{n}.parquet" for n in ("rests", "motion")]
        for x, path in zip((c.rests, c.moved), paths, strict=True):
            write_flight(x, path)
        return diagnosed_of(i, flights(i, paths[1], factor, rests=paths[0]))


def agrees(d: Diagnosis, effect: str, known: Mapping[str, float], scatter: float) -> tuple[bool, str]:
    """Whether it is found, with these values within :data:`FAR` sigmas and what is not known better; and the answer in words."""
    values = {q.name: q for r in d.ranking if r.effect == effect for q in r.parameters}
    there = effect in d.found
    near = there and all(
        n in values and abs(values[n].value - x) < FAR * np.hypot(values[n].std, scatter / FAR)
        for n, x in known.items()
    )
    parts = [f"{n} = {values[n].value:.4g} ± {values[n].std:.2g}" for n in known if n in values]
    return bool(near), "; ".join([*parts, said(d)])


def said(d: Diagnosis) -> str:
    return f"{d.verdict} {', '.join(d.found)}"


def main(raw: str, *names: str) -> None:
    found = []
    for c in cases(Raw.of(Path(raw))):
        if names and c.name not in names:
            continue
        for question, holds, words in questions(c):
            found.append(holds)
            print(f"{c.name:18} {question:14} {'yes' if holds else 'NO':4} {words}", flush=True)
    print(f"{sum(found)} of {len(found)} hold")


if __name__ == "__main__":
    main(*sys.argv[1:])
