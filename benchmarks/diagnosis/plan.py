"""Which flights are flown: a fixed list for every seed, and the instrument, the motion and the world of each."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import tomlkit
from numpy.typing import NDArray

from benchmarks.diagnosis import records
from ragg_runtime.instrument.instrument import DISC_UNITS, PARAMETERS, Instrument
from ragg_runtime.instrument.layout import paper
from ragg_runtime.io import read_flight
from ragg_runtime.reference.gravity import Gradient
from ragg_runtime.reference.motion import MotionSignals, Signal, recorded_motion
from ragg_runtime.reference.scenario import (
    SHAPES,
    Scenario,
    draw_gradient,
    draw_motion,
    perturb,
    table_v,
    trimmed,
)
from ragg_runtime.reference.simulate import draw_rare, draw_usual, eotvos_noise

Array = NDArray[np.float64]

# Seeds of the reference: flown once on commit 0e1d107, and on whatever is compared with it
REFERENCE = (4401, 4402, 4403)
HELD = (4411, 4412, 4413)  # seeds that nobody has looked at: for the code that is written next
ABLATION = 4420  # seed of the flights of the ablation
RECORDS = 5501  # seed of the flights of one kind of record
FIRST_CATALOGUE = (
    "adc-nonlinearity", "angular-jitter", "anisoinertia", "arm-length", "arm-sag", "arm-stretch", "bearing-run-out",
    "bias-drift", "bias-step", "clock-drift", "cubic-cross", "cubic-input", "disc-spin", "encoder-harmonic",
    "fuel-gradient", "gain-drift", "gain-step", "gradient-offset", "gyro-bias", "gyro-delay", "gyro-g-sensitivity",
    "gyro-scale", "imu-acceleration-bias", "imu-acceleration-misalignment", "imu-acceleration-scale", "imu-lever-arm",
    "imu-misalignment", "imu-saturation", "lag", "magnetic-bias", "mount-compliance", "near-mass", "odd-quadratic",
    "output-filter", "output-gain-step", "pendulum-angular", "pressure-bias", "quantisation", "saturation",
    "second-order-loop", "second-order-misalignment", "self-gradient", "self-gradient-yaw", "spin-axis-tilt",
    "spin-axis-wobble", "spin-phase-offset", "spin-rate-jitter", "spin-rate-offset", "spin-servo", "thermal-bias",
    "thermal-lag", "thermal-scale", "time-offset", "vibration-level", "vibration-rectification",
)  # fmt: skip
"""Effects that there were when the seeds above were chosen: their flights are made of these, whatever has been added."""

# Flights of every kind in a seed
COUNTS = {"quiet": 100, "outside": 40, "five": 20, "ten": 20, "strong": 20, "pair": 20, "off-sheet": 20}
WHAT = {
    "quiet": "nothing is hidden",
    "outside": "physics that no effect makes, 10 sigma beyond all effects together",
    "five": "an effect of 5 sigma",
    "ten": "an effect of 10 sigma",
    "strong": "an effect of 300 to 3,000 sigma",
    "pair": "two effects: 10 and 300 sigma, or 10 and 10",
    "off-sheet": "off its sheet by ten times what is usual, or by per cent and milliradians; in two of three 10 to 1,000 sigma",
}

DURATION, QUIET_DURATION = 400.0, 300.0
RATE = 16.0

RECORD = Path(__file__).parent / "motion.parquet"  # a flight whose motion channels are flown again
# How far an instrument is off its sheet, SI (K1: of its value): 1 mm, 5 mrad, 5 mg, 2 %, 100 ug/g^2
OFF_SHEET = {"dR": 1e-3, "beta_x": 5e-3, "beta_z": 5e-3, "vartheta_y": 5e-3, "vartheta_z": 5e-3} | {
    "K0": 0.05,
    "K1": 0.02,
    **{f"K{k}": 1e-5 for k in (2, 4, 5, 6, 7, 8)},
}


@dataclass(frozen=True)
class Spec:
    """A flight: its kind, the kind of its record, its number, and the seed; they determine everything."""

    kind: str
    record: str
    index: int
    sample: int

    @property
    def catalogue(self) -> tuple[str, ...] | None:
        """The effects that the flight is made of; ``None``: all."""
        return FIRST_CATALOGUE if self.sample <= ABLATION else None

    @property
    def id(self) -> str:
        return f"{self.sample}/{self.kind}/{self.record}/{self.index:03d}"

    def rng(self, stream: int) -> np.random.Generator:
        """Random numbers for one purpose."""
        text = f"{self.id}/{stream}".encode()
        return np.random.default_rng(int.from_bytes(hashlib.sha256(text).digest()[:8], "big"))


def specs(sample: int) -> list[Spec]:
    """All flights of a seed, the kinds in turn, so that a run cut short says something of each."""
    order = sorted((n / count, kind, n) for kind, count in COUNTS.items() for n in range(count))
    return [spec(kind, n, sample) for _, kind, n in order]


def spec(kind: str, index: int, sample: int) -> Spec:
    """The flight of a kind and number: quiet ones over all kinds of record, others over those in which strengths are known."""
    if kind == "off-sheet":
        return Spec(kind, "white" if index % 2 else "red", index, sample)
    names = records.FIRST if kind == "quiet" else records.KNOWN
    return Spec(kind, names[(index + sample) % len(names)], index, sample)


@dataclass(frozen=True)
class World:
    """A flight before anything is hidden in it: sheet, instrument, motion, gravity and auxiliaries (the noise of ``scenario`` is ``None``).

    ``known`` is the true instrument, as sure of itself as a sheet is, for the oracle: what it must absorb is small. ``density`` is that of
    the white noise of an accelerometer, (m/s^2)^2/Hz; ``output`` is ``G_out``, ``voltages`` or ``channels``; ``gradient``: whether it is
    recorded; ``start`` of the record, s.
    """

    scenario: Scenario
    known: Instrument
    density: float
    output: str
    gradient: bool
    start: float


def world(s: Spec) -> World:
    """The world of a flight."""
    rng = s.rng(0)
    options: Mapping[str, Any] = records.KINDS[s.record].world
    rate = options.get("rate", RATE)
    duration = options.get("duration", QUIET_DURATION if s.kind == "quiet" else DURATION)
    sheet, true, known, loud = _elsewhere(rng) if options.get("elsewhere") else _paper(s, rng)
    if "spin_off" in options:
        spin = true.layout.discs[0].spin_frequency * (
            1.0 + options["spin_off"] * float(rng.choice([-1.0, 1.0]))
        )
        true = replace(true, layout=paper(true.radius, spin))
    motion = draw_motion(
        rng,
        duration,
        shape=str(rng.choice(list(SHAPES))) if rng.random() < 0.5 else None,
        bursts=float(rng.choice([0.0, 0.3, 0.6, 1.0])),
        turbulence_scale=float(rng.choice([0.5, 1.0, 2.0])),
    )
    if options.get("recorded") or rng.random() < 0.1:
        motion = _recorded(rng, duration)
    gravity = draw_gradient(rng, 20e-9 if rng.random() < 0.5 else 0.0)
    auxiliaries = {**draw_usual(rng), **draw_rare(rng)}
    if s.catalogue is not None:
        del auxiliaries["balance_current"], auxiliaries["second_order_current"]
    start = options.get("start", 0.0)
    if start:
        motion = MotionSignals(*(_later(part, start) for part in (motion.a, motion.omega)))
        tensor = gravity.tensor
        gravity = Gradient(lambda time: tensor(time - start))
        auxiliaries = {n: (lambda time, f=f: f(time - start)) for n, f in auxiliaries.items()}
    density = loud * float(rng.choice([1.0, 2.0, 5.0])) * 1e-9
    density *= options.get("density", 1.0)
    scenario = Scenario(
        sheet=sheet,
        instrument=true,
        motion=motion,
        gravity=gravity,
        noise=None,
        auxiliaries=auxiliaries,
        duration=duration,
        rate=rate,
        seed=int(s.rng(1).integers(2**31)),
    )
    return World(
        scenario=scenario,
        known=known,
        density=eotvos_noise(density, sheet.radius).omega_T,
        output=options.get("output", "G_out"),
        gradient=options.get("gradient", True),
        start=start,
    )


def _later(part: Sequence[Any], by: float) -> tuple[Signal, Signal, Signal]:
    """Recorded signals that begin so many seconds later."""
    x, y, z = (replace(signal, time=signal.time + by) for signal in part)
    return x, y, z


def _recorded(rng: np.random.Generator, duration: float) -> MotionSignals:
    x = read_flight(RECORD, 9.8, need_output=False)
    a, omega = (np.stack([x.channels[f"{q}_{k}"] for k in "xyz"]) for q in ("a", "omega"))
    spare = x.time[-1] - x.time[0] - duration - 2.0
    return recorded_motion(x.time - x.time[0] - 1.0 - spare * rng.random(), a, omega)


def _paper(s: Spec, rng: np.random.Generator) -> tuple[Instrument, Instrument, Instrument, float]:
    """Sheet, true instrument, the same for a sheet, and a factor on the noise: of the paper's layout."""
    sheet = trimmed() if rng.random() < 0.5 else table_v()
    if s.kind != "off-sheet" or s.index % 2:
        true = perturb(sheet, rng, 10.0 if s.kind == "off-sheet" else 1.0)
        return sheet, true, true, 1.0
    sigma = {
        n: x * 10 ** rng.uniform(-0.5, 0.2) * (np.abs(sheet.accelerometers[n]) if n == "K1" else np.ones(4))
        for n, x in OFF_SHEET.items()
    }
    true = sheet.replace(
        **{n: sheet.accelerometers[n] + x * rng.standard_normal(4) for n, x in sigma.items()}
    )
    sure = replace(true, sigmas={n: np.maximum(x, sheet.sigma(n)) for n, x in sigma.items()})
    if rng.random() < 0.3:  # the sheet says how little it is sure
        sheet = replace(sheet, sigmas=sure.sigmas)
    return sheet, true, sure, 1.0


_MEMS: Mapping[str, float] = {
    "dR": 5e-4,
    **dict.fromkeys(("beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z"), 5e-3),
    "K0": 0.2,
    "K1": 1e-2,
    **{f"K{k}": 1e-5 for k in (2, 4, 5, 6, 7, 8)},
}
"""How far a MEMS accelerometer may be from its sheet, SI (K1: of its value): 20 mg, per cent, milliradians, 100 ug/g^2."""


def _elsewhere(rng: np.random.Generator) -> tuple[Instrument, Instrument, Instrument, float]:
    """The same of another radius, spin rate and class of accelerometers: navigation, ten times worse, MEMS whose sheet says so."""
    grade = int(rng.integers(3))
    radius, spin = float(10 ** rng.uniform(-1.5, -0.3)), float(10 ** rng.uniform(-1.0, -0.1))
    base = table_v() if rng.random() < 0.5 else trimmed()
    values = dict(base.accelerometers)
    sigma = {n: base.sigma(n) / 20.0 * (1.0, 10.0, 1.0)[grade] for n in _MEMS}
    stated: dict[str, Array] = {}
    if grade == 2:
        sigma = {n: x * (np.abs(values[n]) if n == "K1" else np.ones(4)) for n, x in _MEMS.items()}
        stated = sigma
    drawn = {n: values[n] + x * rng.standard_normal(4) for n, x in sigma.items()}

    def of(accelerometers: Mapping[str, Array], sigmas: Mapping[str, Array]) -> Instrument:
        return Instrument.build(paper(radius, spin), 9.8, accelerometers, sigmas=sigmas)

    true = {**values, **drawn}
    return of(values, stated), of(true, {}), of(true, stated), (1.0, 10.0, 1e4)[grade]


def model_text(instrument: Instrument) -> str:
    """A model.toml in SI, which reads back to the same numbers; effects are left out."""
    document: dict[str, Any] = {
        "effects": [],
        "model": {"kinematics": instrument.form.kinematics, "order": instrument.form.preset},
        "disc": {n: f"{getattr(instrument, n)!r} {unit}" for n, unit in DISC_UNITS.items()},
    }
    if instrument.demodulation is not None:
        document["demodulator"] = dict(instrument.demodulation.entries())
    table = {
        p.name: {"value": instrument.accelerometers[p.name].tolist(), "unit": p.si_unit} for p in PARAMETERS
    }
    for name, sigma in instrument.sigmas.items():
        table[name]["sigma"] = sigma.tolist()
    document["accelerometers"] = table
    return tomlkit.dumps(document)
