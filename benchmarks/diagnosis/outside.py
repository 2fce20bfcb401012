"""Physics that no effect of the catalogue can make: further terms of V_j, the recorder, a suspension.

Each term is a specific force (4, N), m/s^2, of the four accelerometers up to a factor; the factor is chosen so
that what *neither the calibration nor any combination of catalogue effects* can absorb has the strength asked
for. (What a catalogue effect could mimic comes on top.)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from benchmarks.diagnosis.plan import COUNTS, Spec
from benchmarks.diagnosis.records import QUARTERS
from benchmarks.diagnosis.strength import Oracle
from ragg_runtime.identification.dictionary import Dictionary, Term
from ragg_runtime.identification.features import OUTPUT
from ragg_runtime.reference.scenario import Scenario
from ragg_runtime.reference.simulate import combine

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Surroundings:
    """What a term may depend on: (N,) series, (4, N) forces in the accelerometers' nominal axes."""

    time: Array
    phi: Array
    channels: Mapping[str, Array]
    output: Array
    rate: float
    duration: float
    scenario: Scenario

    def __getitem__(self, name: str) -> Array:
        return self.channels[name]

    @property
    def psi(self) -> Array:
        return self.phi[None] + QUARTERS[:, None]

    @property
    def f_i(self) -> Array:
        """Along the tangential (sensitive) axes."""
        return np.asarray(self["a_y"] * np.cos(self.psi) - self["a_x"] * np.sin(self.psi))

    @property
    def f_o(self) -> Array:
        """Along the radial axes."""
        return np.asarray(self["a_x"] * np.cos(self.psi) + self["a_y"] * np.sin(self.psi))

    def change(self, name: str) -> Array:
        x = self[name]
        return np.asarray(x - np.mean(x))


def _first(x: Array) -> Array:
    """In the first accelerometer alone."""
    return np.asarray(np.array([1.0, 0, 0, 0])[:, None] * x)


def _creep(x: Array, rate: float, constant: float) -> Array:
    """x through a relaxation of some time constant, s."""
    c = np.exp(-1 / (rate * constant))
    return np.asarray(signal.lfilter([1 - c], [1, -c], x))


def _rms(x: Array) -> float:
    return float(np.sqrt(np.mean(x**2)))


def _play(x: Array, width: float) -> Array:
    """Hysteresis: what a part with so much play follows of x."""
    y = np.empty_like(x)
    now = 0.0
    for n, value in enumerate(x):
        now = min(max(now, value - width), value + width)
        y[n] = now
    return y


def _resonant(x: Array, rate: float, frequency: float, damping: float) -> Array:
    """What a suspension with this resonance makes of x, less x; in the limit of fine sampling."""
    w, fine = 2 * np.pi * frequency, 8
    y = signal.resample_poly(x - x[0], fine, 1)
    b, a = signal.bilinear([w**2], [1.0, 2 * damping * w, w**2], fs=rate * fine)
    return np.asarray(signal.lfilter(b, a, y)[::fine] - (x - x[0]))


def _late(x: Array, rate: float, delay: float) -> Array:
    """x some time ago, s."""
    time = np.arange(len(x)) / rate
    return np.asarray(np.interp(time - delay, time, x))


TERMS: Mapping[str, Callable[[Surroundings], Array]] = {
    "omega_z": lambda w: _first(w["omega_z"]),
    "omega_x cos phi": lambda w: _first(w["omega_x"] * np.cos(w.phi)),
    "omegadot_x^2": lambda w: _first(w["omegadot_x"] ** 2),
    "omegadot_z a_x": lambda w: _first(w["omegadot_z"] * w["a_x"]),
    "a_x omega_y": lambda w: _first(w["a_x"] * w["omega_y"]),
    "f_i omega_z (scale by rate)": lambda w: _first(w.f_i[0] * w["omega_z"]),
    "f_i omega^2 (scale by rate squared)": lambda w: _first(
        w.f_i[0] * (w["omega_x"] ** 2 + w["omega_y"] ** 2 + w["omega_z"] ** 2)
    ),
    "a_x pressure": lambda w: _first(w["a_x"] * w.change("pressure")),
    "a_z B_x": lambda w: _first(w["a_z"] * w.change("B_x")),
    "f_i pressure (scale by pressure)": lambda w: _first(w.f_i[0] * w.change("pressure")),
    "f_i temperature^2": lambda w: _first(w.f_i[0] * w.change("temperature") ** 2),
    "omega_z temperature": lambda w: _first(w["omega_z"] * w.change("temperature")),
    "sin 5 phi": lambda w: _first(np.sin(5 * w.phi)),
    "a_z cos 6 phi": lambda w: _first(w["a_z"] * np.cos(6 * w.phi)),
    "f_i^4": lambda w: _first(w.f_i[0] ** 4),
    "abs(f_o)": lambda w: _first(np.abs(w.f_o[0])),
    "f_i^2 sign(da_z/dt) (friction)": lambda w: _first(w.f_i[0] ** 2 * np.sign(np.gradient(w["a_z"]))),
    "creep of f_p over 20 s": lambda w: _first(_creep(w["a_z"] - w["a_z"][0], w.rate, 20.0)),
    "creep of f_i over 0.4 s": lambda w: _first(_creep(w.f_i[0], w.rate, 0.4)),
    "f_i cos 2 pi t/45 s (supply)": lambda w: _first(w.f_i[0] * np.cos(2 * np.pi * w.time / 45)),
    "line at 0.37 Hz (pump)": lambda w: _first(np.sin(2 * np.pi * 0.37 * w.time)),
    "misalignment jump": lambda w: _first(np.where(w.time > 0.45 * w.duration, w["a_z"], 0.0)),
    "burst of a_x for 40 s": lambda w: _first(
        np.where(np.abs(w.time - 0.7 * w.duration) < 20, w["a_x"], 0.0)
    ),
    "misalignment drift": lambda w: _first(w["a_z"] * (w.time - w.time[-1] / 2)),
}
"""Terms by name, of which the dictionary of the diagnosis holds many."""

FURTHER: Mapping[str, Callable[[Surroundings], Array]] = {
    "dead zone of f_i": lambda w: _first(np.clip(w.f_i[0], -0.4 * _rms(w.f_i[0]), 0.4 * _rms(w.f_i[0]))),
    "play in f_i (hysteresis)": lambda w: _first(_play(w.f_i[0], 0.3 * _rms(w.f_i[0]))),
    "f_i^2 temperature": lambda w: _first(w.f_i[0] ** 2 * w.change("temperature")),
    "f_i roll": lambda w: _first(w.f_i[0] * w["roll"]),
    "sqrt(abs(f_o))": lambda w: _first(np.sqrt(np.abs(w.f_o[0]))),
    "resonance at 3 Hz": lambda w: _first(_resonant(w.f_i[0], w.rate, 3.0, 0.1)),
    "cross-talk of A3, 0.3 s late": lambda w: _first(_late(w.f_i[2], w.rate, 0.3)),
    "heating by f_i^2, 30 s": lambda w: _first(_creep(w.f_i[0] ** 2, w.rate, 30.0)),
    "play in a_x": lambda w: _first(_play(w["a_x"] - np.mean(w["a_x"]), 0.5 * float(np.std(w["a_x"])))),
    "mount resonant at 3 Hz, Q 15": lambda w: _first(_resonant(w.f_i[0], w.rate, 3.0, 1 / 30)),
    "abs(G_out)": lambda w: _first(np.abs(w.output)),
    "cube of G_out (converter)": lambda w: _first(w.output**3),
    "square of G_out (converter)": lambda w: _first(w.output**2),
}
"""Further terms, of which it holds most in no such form."""

SINCE: Mapping[str, str] = {
    "play in f_i (hysteresis)": "bias-hysteresis",
    "heating by f_i^2, 30 s": "inner-temperature",
    "f_i^2 temperature": "thermal-second-order",
    "misalignment jump": "misalignment-step",
    "misalignment drift": "misalignment-drift",
    "cube of G_out (converter)": "output-curve",
    "square of G_out (converter)": "output-curve",
}
"""Those that have become effects of the catalogue since the terms were chosen: naming these is right."""

NAMES = (*TERMS, *FURTHER)


def name_of(s: Spec) -> str:
    """What is put into a flight with physics outside the catalogue."""
    return NAMES[(s.index + COUNTS["outside"] * (s.sample % 3)) % len(NAMES)]


HARMONICS = (0, 1, 2, 3, 4)
MEMORIES = ("now", "now", "now", "late", "slow")
FACTORS: Mapping[str, Callable[[Array], Array]] = {
    "": lambda x: x,
    "abs": np.abs,
    "square": np.square,
    "sign": np.sign,
}
LEAST_BEYOND = 0.3
"""Share of a term that no combination of effects may make: one that they can is within the catalogue."""


def grown(rng: np.random.Generator, w: Surroundings) -> tuple[str, Array]:
    """A term at random, name and (4, N): harmonic x stage x product x memory.

    A product of one or two channels or functions of them, as it is, some time late, or through a relaxation, at a harmonic of the
    disc, is added to the voltage of A1, to its scale factor, or to the gain of the output.
    """
    names = sorted(n for n in w.channels if n[:5] not in ("time", "Gamma") and np.ptp(w[n]) > 0)
    x, parts = np.ones(len(w.time)), []
    for _ in range(int(rng.integers(1, 3))):
        name, function = str(rng.choice(names)), str(rng.choice(list(FACTORS)))
        centred = w[name] if name.startswith(("a_", "omega")) else w.change(name)
        x = x * FACTORS[function](centred / _rms(centred))
        parts.append(f"{function}({name})" if function else name)
    text, memory, seconds = "*".join(parts), str(rng.choice(MEMORIES)), float(10 ** rng.uniform(-0.5, 1.5))
    if memory != "now":
        x = _creep(x - x[0], w.rate, seconds) if memory == "slow" else _late(x, w.rate, seconds)
        text = f"{memory}({text}; {seconds:.2g} s)"
    k, shift = int(rng.choice(HARMONICS)), float(rng.choice([0.0, np.pi / 2]))
    if k:
        x = x * np.cos(k * w.phi - shift)
        text = f"{'sin' if shift else 'cos'} {k}*{text}"
    stage = str(rng.choice(["voltage", "scale", "gain"]))
    return f"{stage}: {text}", _first(x * {"voltage": 1.0, "scale": w.f_i[0], "gain": w.output}[stage])


def drawn_from_grammar(oracle: Oracle, w: Surroundings, strength: float, rng: np.random.Generator) -> Outside:
    """A term of the grammar that is outside the catalogue, of this strength beyond it."""
    while True:
        name, force = grown(rng, w)
        found = _of_strength(oracle, w, name, force, strength)
        if strength > LEAST_BEYOND * found.with_mimics:
            return found


@dataclass(frozen=True)
class Outside:
    """A term in a flight: what it adds to G_out (N,) V, and its strength with what effects could feign of it, in sigmas."""

    name: str
    change: Array
    strength: float
    with_mimics: float


def drawn(oracle: Oracle, w: Surroundings, name: str, strength: float) -> Outside:
    """A term of this strength beyond the calibration and all effects of the catalogue together."""
    return _of_strength(oracle, w, name, ({**TERMS, **FURTHER})[name](w), strength)


def _of_strength(oracle: Oracle, w: Surroundings, name: str, force: Array, strength: float) -> Outside:
    k = w.scenario.instrument.accelerometers
    unit = combine((k["k_VI"] * k["K1"])[:, None] * force)
    factor = strength / oracle.beyond_all(unit)
    whole = float(np.linalg.norm(oracle.row(unit)))
    return Outside(name, factor * unit, strength, factor * whole)


def share_explained(
    oracle: Oracle, change: Array, terms: Sequence[Mapping[str, Any]]
) -> tuple[str, float] | None:
    """The strongest of a diagnosis' steady terms, and its share of what is hidden, both beside the calibration; ``None``: no term.

    Without noise, so that it is the formula that is judged.
    """
    steady = [x for x in terms if x["kind"] == "steady"]
    if not steady:
        return None
    best = max(steady, key=lambda x: abs(x["z"]))
    term = Term(best["harmonic"], () if best["term"] == "1" else tuple(best["term"].split("*")))
    record = oracle.o.record
    column = Dictionary(record, oracle.flight.outputs.get(OUTPUT)).series(term, record)
    a, b = oracle.row(change), oracle.row(column / _rms(column))
    return f"{term.harmonic}: {term.product}", float((a @ b) ** 2 / ((a @ a) * (b @ b)))
