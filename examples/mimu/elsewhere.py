"""Whether what the page says holds elsewhere: other parts of a recording, other quadruples of the board, worse data.

    python -m examples.mimu.elsewhere [RAW.bin.gz [NAME ...]]

Each case is a gradiometer made of the raw packets of a recording (without one, of what is shipped), and asked the questions of the
page. Prints a line for every question, and how many hold. An answer holds if

- what is left out is claimed, under whatever verdict, and its values agree with the survey (:func:`agrees`); or
- what is left out, fixed at the value of the survey, is worth less than :data:`WORTH` sigma on this record, nothing is claimed without
  evidence, and the answer says by name that the record does not suffice: in ``reason``, or among what is not testable.

Claims of effects for which the survey has no evidence (all but :data:`FOUNDED`) are counted beside that.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from examples.mimu import record
from examples.mimu.record import FRONT, RATE, Array
from examples.mimu.sheet import sheet
from examples.mimu.story import (
    FLAT,
    HERE,
    MISREAD,
    SHORT,
    UNLIFTED,
    diagnosed_of,
    flights,
    short_arm,
    sure_of_angles,
)
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight, write_flight

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

WORTH = 5.0
"""Sigmas below which an effect of known size need not be found."""

FOUNDED = frozenset(
    {*TURNS, "gyro-delay", "imu-lever-arm", "imu-acceleration-bias"}
    | {"gyro-scale", "arm-length", "imu-saturation"}
)
"""Effects for which the survey of the array gives evidence."""

CASES: Mapping[str, Mapping[str, Any]] = {
    "page": {},
    "first half": {"seconds": (0.0, record.LENGTH / 2)},
    "second half": {"seconds": (record.LENGTH / 2, record.LENGTH)},
    "later": {"seconds": (record.LENGTH, 2 * record.LENGTH)},
    "half of the rests": {"rested": 0.5},
    "back": {"picked": BACK},
    "mixed": {"picked": MIXED},
    "half rate": {"thin": THINNED},
    "noise": {"noise": NOISE},
}
"""Cases of a recording: what of it is taken, and how."""

SHIPPED = ("page", "first half", "second half", "half rate")
"""Those that can be made of what is shipped."""


@dataclass(frozen=True)
class SensorSet:
    """A gradiometer: which sensors it is made of, its rests and its motion; and the motion with nothing marked as saturated."""

    name: str
    picked: Sequence[int]
    rests: Flight
    moved: Flight
    unmarked: Flight | None = None

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
    ) -> SensorSet:
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
        return SensorSet(name=name, picked=picked, rests=lying, moved=flown[0], unmarked=flown[1])


def cases(path: Path | None) -> Iterator[SensorSet]:
    """The record of the page, and others, of a recording, or of what is shipped."""
    if path is None:
        yield from _shipped()
        return
    raw = Raw.of(path)
    for name, how in CASES.items():
        yield raw.case(name, **how)


def _shipped() -> Iterator[SensorSet]:
    """Of the flights beside this file, in which saturated samples are marked already."""
    lying, moved = (read_flight(HERE / f"{n}.parquet", record.G0) for n in ("rests", "motion"))
    half = len(moved) // 2
    parts = (slice(None), slice(0, half), slice(half, None), slice(None, None, THINNED))
    for name, rows in zip(SHIPPED, parts, strict=True):
        channels, outputs = ({n: v[rows] for n, v in x.items()} for x in (moved.channels, moved.outputs))
        part = replace(
            moved, time=moved.time[rows], channels=channels, outputs=outputs, valid=moved.valid[rows]
        )
        yield SensorSet(name, FRONT, lying, part)


@dataclass(frozen=True)
class Answer:
    """To a question: whether it holds, in words, and which of its claims have no evidence."""

    question: str
    holds: bool
    words: str
    unfounded: tuple[str, ...]

    @staticmethod
    def of(question: str, d: Diagnosis, holds: bool, values: str = "") -> Answer:
        words = "; ".join(x for x in (values, f"{d.verdict} {', '.join(d.found)}".strip()) if x)
        return Answer(question, holds, words, tuple(e for e in d.found if e not in FOUNDED))


def questions(c: SensorSet) -> Iterator[Answer]:
    """What is asked, and the answers."""
    own = [f"{x:.4g} mm" for x in c.lifts]
    same = bool(np.ptp(c.lifts) == 0.0)
    if same:
        yield agrees("lever arm", ask(c, FLAT), "imu-lever-arm", {"l_z": -1e-3 * c.lifts.mean()}, 0.2e-3)
    free = UNLIFTED if same else sheet(height=own, lift="10")
    short = short_arm("0 mm" if same else own)
    yield agrees("arm length", ask(c, short), "arm-length", {"delta_R": SHORT}, SCATTER)
    d = ask(c, free, MISREAD)
    yield agrees("gyro scale", d, "gyro-scale", {"s_x": 0.03, "s_y": 0.03}, 0.0)
    d = ask(c, sure_of_angles(free))
    yield Answer.of("misalignments", d, any(e in d.found for e in TURNS))
    if c.unmarked is None:
        return
    d = ask(replace(c, moved=c.unmarked), free)
    yield Answer.of("saturation", d, "imu-saturation" in d.found)


def ask(c: SensorSet, text: str, factor: float = 1.0) -> Diagnosis:
    """What ``ragg diagnose`` says of a case with this sheet, the rates times a factor."""
    i = parse_instrument(text)
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{n}.parquet" for n in ("rests", "motion")]
        for x, path in zip((c.rests, c.moved), paths, strict=True):
            write_flight(x, path)
        return diagnosed_of(i, flights(i, paths[1], factor, rests=paths[0]))


def agrees(question: str, d: Diagnosis, effect: str, known: Mapping[str, float], scatter: float) -> Answer:
    """Whether an effect is claimed with these values, within :data:`FAR` sigmas and what is not known better; or need not be."""
    values = {q.name: q for r in d.ranking if r.effect == effect for q in r.parameters}
    near = effect in d.found and all(
        n in values and abs(values[n].value - x) < FAR * np.hypot(values[n].std, scatter / FAR)
        for n, x in known.items()
    )
    parts = [f"{n} = {values[n].value:.4g} ± {values[n].std:.2g}" for n in known if n in values]
    if not near:
        sigmas = worth(d.fitted, effect, known)
        parts.append(f"worth {sigmas:.1f} sigma")
        near = sigmas < WORTH and set(d.found) <= FOUNDED - {effect} and effect in _insufficient(d)
    return Answer.of(question, d, bool(near), "; ".join(parts))


def _insufficient(d: Diagnosis) -> str:
    """Where an answer may say that the record does not suffice for an effect."""
    j = d.as_json()
    return " ".join([str(j["reason"]), *(n.effect for n in d.not_testable)])


def worth(f: Fitted, effect: str, known: Mapping[str, float]) -> float:
    """Sigmas by which an effect of known size (display units) shows beside a calibration whose sheet is as sure as it says.

    What is left once its size is fitted counts as noise, whatever it is.
    """
    n, rows = f.n_base, f.calibration.rows
    sizes = np.zeros(f.size - n)
    for k, c in enumerate(f.candidates):
        if c.effect == effect and c.name.split(".", 1)[1] in known:
            sizes[k] = known[c.name.split(".", 1)[1]] * c.unit_factor / c.scale
    sure = np.diag([f.instrument.widths.get(c.name, 1.0) for c in f.calibration.columns])
    T = np.vstack([f.data, np.hstack([sure, np.zeros((n, f.data.shape[1] - n))])])
    Q = np.linalg.qr(T[:, :n])[0]
    own, rest = (x - Q @ (Q.T @ x) for x in (T[:, n:-1] @ sizes, T[:, -1]))
    rest = rest - own * (own @ rest) / (own @ own)
    return float(np.sqrt(own @ own / (rest @ rest / rows)))


def main(raw: str | None = None, *names: str) -> None:
    answers = []
    for c in cases(None if raw is None else Path(raw)):
        if names and c.name not in names:
            continue
        for a in questions(c):
            answers.append(a)
            print(f"{c.name:18} {a.question:14} {'yes' if a.holds else 'NO':4} {a.words}", flush=True)
    unfounded = [e for a in answers for e in a.unfounded]
    print(f"{len(unfounded)} claims without evidence" + (f": {', '.join(unfounded)}" if unfounded else ""))
    print(f"{sum(a.holds for a in answers)} of {len(answers)} hold")


if __name__ == "__main__":
    main(*sys.argv[1:])
