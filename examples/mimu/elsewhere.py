"""What the page on real measurements (docs/explanation/real-measurements.md) computes, and whether it holds elsewhere.

    python -m examples.mimu.elsewhere [RAW.bin.gz [NAME ...]]

Elsewhere: on other parts of a recording, other quadruples of the board, worse data. Each case is a gradiometer made of the raw packets of
a recording (without one, of what is shipped), and asked the questions of the page. Prints a line for every question, and how many hold. An
answer holds if

- what is left out is claimed, under whatever verdict, and its values agree with the survey (:func:`agrees`); or
- what is left out, fixed at the value of the survey, is worth less than :data:`WORTH` sigma on this record, nothing is claimed without
  evidence, and the answer says by name that the record does not suffice: in ``reason``, or among what is not testable.

Claims of effects for which the survey has no evidence (all but :data:`FOUNDED`) are counted beside that.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import table
from examples.mimu import record
from examples.mimu.record import FRONT, RADIUS, RATE, Array, sheet
from ragg_runtime.estimation.fitted import Fitted, fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.io.record import ANGULAR_RATE
from ragg_runtime.model import derive

# A sheet that knows nothing of the 2 mm between the two sides of the board, and not that it does not
UNLIFTED = sheet(height="0 mm", lift="10")
FLAT = sheet(height="0 mm", lift="0.3")  # one that is sure, to 0.3 degrees, that they are in one plane
SHORT = 1.4  # mm by which a sheet that is sure of its radius (to 0.02 mm) has it too small
MISREAD = 1.03  # factor on all rates, as of one who takes 15.9 counts per deg/s where the chip gives 16.4
BACK = tuple(k + 1 for k in FRONT)
MIXED = (FRONT[0], FRONT[1], BACK[2], BACK[3])  # A1, A2 of the front, A3, A4 of the back
THINNED = 2  # of so many samples one is kept
NOISE = 0.3, 0.01  # m/s^2 and rad/s that are added: several times what the chips have
FAR = 3.0  # standard deviations within which a value agrees with what is known
# mm: how far the sensing elements of a quadruple may be from the middles of its chips, on average of four
SCATTER = 0.3
TURNS = ("imu-acceleration-misalignment", "imu-misalignment")
"""One side turned against the other: of the forces alone, or of the rates as well, where a milliradian is next to nothing."""

WORTH = 5.0  # sigmas below which an effect of known size need not be found
# Effects for which the survey of the array gives evidence
FOUNDED = frozenset(
    {*TURNS, "gyro-delay", "imu-lever-arm", "imu-acceleration-bias"}
    | {"gyro-scale", "arm-length", "imu-saturation"}
)

# Cases of a recording: what of it is taken, and how
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

SHIPPED = ("page", "first half", "second half", "half rate")  # those that can be made of what is shipped


@dataclass(frozen=True)
class SensorSet:
    """A gradiometer: the sensors it is made of, its rests and its motion; and the motion with nothing marked as saturated."""

    picked: Sequence[int]
    rests: Flight
    moved: Flight
    unmarked: Flight | None = None

    @property
    def lifts(self) -> Array:
        """(4,) mm above the motion sensors."""
        return 1e3 * record.lifts(self.picked)


def make_case(path: Path | None, name: str) -> SensorSet:
    """A case of a recording, or of what is shipped."""
    return _recorded(record.read(path), **CASES[name]) if path else _shipped(**CASES[name])


def _recorded(
    raw: record.Raw,
    picked: Sequence[int] = FRONT,
    seconds: tuple[float, float] = (0.0, record.LENGTH),
    rested: float = 1.0,
    thin: int = 1,
    noise: tuple[float, float] = (0.0, 0.0),
) -> SensorSet:
    """``seconds`` of the motion, and of the time before it the share ``rested``."""
    *measured, saturated = raw
    quiet, start = record.parts(measured[1])
    rng = np.random.default_rng(15)
    force, rate = (x + s * rng.standard_normal(x.shape) for x, s in zip(measured, noise, strict=True))
    before = slice(0, round(rested * start))
    lying = record.rests(force[before], rate[before], quiet[before], picked)
    at = slice(*(start + round(s * RATE) for s in seconds), thin)
    marks = saturated[at], np.zeros_like(saturated[at])
    flown = [record.motion(force[at], rate[at], x, picked) for x in marks]
    return SensorSet(picked, lying, *(replace(x, time=x.time * thin) for x in flown))


def _shipped(seconds: tuple[float, float] = (0.0, record.LENGTH), thin: int = 1) -> SensorSet:
    """Of the flights beside this file, in which saturated samples are marked already."""
    lying, x = (read_flight(Path(__file__).with_name(f"{n}.parquet"), record.G0) for n in ("rests", "motion"))
    rows = slice(*(int(len(x) * s / record.LENGTH) for s in seconds), thin)
    return SensorSet(FRONT, lying, x.part(rows))


def read_back(c: SensorSet, i: Instrument, misread: float = 1.0) -> list[Flight]:
    """Rests and motion from files, the rates times a factor."""
    flights = []
    with tempfile.TemporaryDirectory() as folder:
        for x, path in ((c.rests, Path(folder, "rests.parquet")), (c.moved, Path(folder, "motion.parquet"))):
            write_flight(x, path)
            read = read_flight(path, i.g0, accelerometers=i.layout)
            channels = {n: v * misread if n in ANGULAR_RATE else v for n, v in read.channels.items()}
            flights.append(replace(read, channels=channels))
    return flights


def diagnosed(text: str, c: SensorSet | None = None, misread: float = 1.0) -> Diagnosis:
    """What ``ragg diagnose`` says of a case (of the page's) with this sheet, the rates times a factor."""
    i = parse_instrument(text)
    flights = read_back(c or _shipped(), i, misread)
    return diagnose(derive.load_model(i), i, flights, partial(derive.with_effects, i))


# --- the page --------------------------------------------------------------------------------------------


def short_arm(height: str | Sequence[str] = "0 mm") -> str:
    """A sheet whose radius is too small by :data:`SHORT`."""
    return sheet(height=height, lift="10", radius=f"{RADIUS - SHORT:.5g} mm", arm="0.02")


def calibrated(text: str, *effects: str) -> tuple[Array, Array]:
    """Arms and lifts, each values and uncertainties (2, 4), mm, of a calibration with these effects in the model beside its own."""
    i = parse_instrument(text)
    i = replace(i, effects=(*i.effects, *(EffectSetting(e) for e in effects)))
    model = derive.load_model(i, candidates=False)
    f = fit(model, i, observe_flights(read_back(_shipped(), i), i))
    c = f.calibration
    std = np.sqrt(np.diag(c.covariance)) * np.array([q.scale for q in c.columns])

    def of(name: str, factor: float) -> Array:
        at = [n for n, q in enumerate(c.columns) if q.name == name]
        return factor * np.array([c.p[c.index[at]], std[at]])

    return of("dR", 1e3) + np.array([[f.instrument.radius * 1e3], [0.0]]), of("beta_x", RADIUS)


def known() -> str:
    """What is known from elsewhere, beside what the fit says."""

    def four(x: Array) -> str:
        return ", ".join(f"{v:.2f} ± {s:.2f}" for v, s in x.T) + " mm"

    (arm, lift), (later, _) = calibrated(UNLIFTED), calibrated(UNLIFTED, "gyro-delay")
    return table(
        ("quantity", "found", "known"),
        (
            ("arms A1 ... A4, sheet 13.364 ± 0.5 mm", four(arm), "13.364 mm (survey)"),
            ("the same, `gyro-delay` in the model", four(later), "13.364 mm"),
            ("front above back, as height of each (sheet: 0)", four(lift), "2.00 mm"),
        ),
    )


def ranked(d: Diagnosis, most: int = 4) -> str:
    """The best of a ranking, the verdict, and what remains in the residual."""
    rows = []
    for r in d.ranking[:most]:
        fit = [f"{q.name} = {q.value:.2g} ± {q.std:.1g} {q.unit.removesuffix('1')}" for q in r.parameters[:3]]
        log_p = f"{r.log_p / np.log(10.0):.0f}" if np.isfinite(r.log_p) else "certain"
        rows.append((f"`{r.effect}`", log_p, ", ".join(x.rstrip() for x in fit)))
    verdict = f"\n\nVerdict: `{d.verdict}`" + (f", {', '.join(d.found)}" if d.found else "")
    terms = [f"{x['harmonic']} × `{x['term']}`" for x in d.terms()[:3]] if d.verdict == "unexplained" else []
    residual = [f"left over: {', '.join(terms)}"] if terms else []
    return table(("effect", "log10 p", "parameters"), rows) + "; ".join([verdict, *residual]) + "."


# --- the questions ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Answer:
    """To a question: whether it holds, which of its claims have no evidence, and in words."""

    question: str
    holds: bool
    unfounded: tuple[str, ...]
    words: str

    @staticmethod
    def of(question: str, d: Diagnosis, holds: bool, values: str = "") -> Answer:
        words = "; ".join(x for x in (values, f"{d.verdict} {', '.join(d.found)}".strip()) if x)
        return Answer(question, holds, tuple(e for e in d.found if e not in FOUNDED), words)


def questions(c: SensorSet) -> Iterator[Answer]:
    """What is asked, and the answers."""
    same = bool(np.ptp(c.lifts) == 0.0)
    heights = "0 mm" if same else [f"{x:.4g} mm" for x in c.lifts]
    free, short = sheet(height=heights, lift="10"), short_arm(heights)
    if same:
        arm = {"l_z": -1e-3 * c.lifts.mean()}
        yield agrees("lever arm", diagnosed(FLAT, c), "imu-lever-arm", arm, 0.2e-3)
    yield agrees("arm length", diagnosed(short, c), "arm-length", {"delta_R": SHORT}, SCATTER)
    yield agrees("gyro scale", diagnosed(free, c, MISREAD), "gyro-scale", {"s_x": 0.03, "s_y": 0.03}, 0.0)
    d = diagnosed(sheet(height=heights, lift="10", turn="0.02"), c)
    yield Answer.of("misalignments", d, any(e in d.found for e in TURNS))
    if c.unmarked is not None:
        d = diagnosed(free, replace(c, moved=c.unmarked))
        yield Answer.of("saturation", d, "imu-saturation" in d.found)


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
        text = " ".join([str(d.as_json()["reason"]), *(n.effect for n in d.not_testable)])
        near = sigmas < WORTH and set(d.found) <= FOUNDED - {effect} and effect in text
    return Answer.of(question, d, bool(near), "; ".join(parts))


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
    signature, rest = (x - Q @ (Q.T @ x) for x in (T[:, n:-1] @ sizes, T[:, -1]))
    rest = rest - signature * (signature @ rest) / (signature @ signature)
    return float(np.sqrt(signature @ signature / (rest @ rest / rows)))


def answer(path: Path | None, case: str) -> dict[str, Any]:
    """The answers about a case as JSON, and the processor time they took, s."""
    begin = time.process_time()
    answers = [asdict(a) for a in questions(make_case(path, case))]
    return {"answers": answers, "cpu": round(time.process_time() - begin, 1)}


def main(raw: str | None = None, *names: str) -> None:
    answers = []
    path = None if raw is None else Path(raw)
    for name in names or (CASES if path else SHIPPED):
        for a in questions(make_case(path, name)):
            answers.append(a)
            print(f"{name:18} {a.question:14} {'yes' if a.holds else 'NO':4} {a.words}", flush=True)
    unfounded = [e for a in answers for e in a.unfounded]
    print(f"{len(unfounded)} claims without evidence" + (f": {', '.join(unfounded)}" if unfounded else ""))
    print(f"{sum(a.holds for a in answers)} of {len(answers)} hold")


if __name__ == "__main__":
    main(*sys.argv[1:])
