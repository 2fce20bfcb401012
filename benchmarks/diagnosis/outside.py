"""Physics that no effect of the catalogue can make: further terms of V_1, the recorder, a suspension.

Each term is a specific force in the first accelerometer up to a factor, which is chosen so that what *neither the calibration nor any
combination of catalogue effects* can absorb has the strength asked for. (What a catalogue effect could mimic comes on top.)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from benchmarks.diagnosis.plan import COUNTS, Spec
from benchmarks.diagnosis.records import QUARTERS
from benchmarks.diagnosis.strength import Oracle
from ragg_runtime.reference.scenario import Scenario
from ragg_runtime.reference.simulate import Simulation

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Surroundings:
    """What a term may depend on: (N,) series, (4, N) forces in the accelerometers' nominal axes."""

    plain: Simulation
    scenario: Scenario

    def __getitem__(self, name: str) -> Array:
        return self.plain.channels[name]

    @property
    def time(self) -> Array:
        return self.plain.time

    @property
    def output(self) -> Array:
        return self.plain.G_out_noise_free

    @property
    def phi(self) -> Array:
        return 2 * np.pi * self.scenario.sheet.spin_frequency * self.time

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
    "omega_z": lambda w: w["omega_z"],
    "omega_x cos phi": lambda w: w["omega_x"] * np.cos(w.phi),
    "omegadot_x^2": lambda w: w["omegadot_x"] ** 2,
    "omegadot_z a_x": lambda w: w["omegadot_z"] * w["a_x"],
    "a_x omega_y": lambda w: w["a_x"] * w["omega_y"],
    "f_i omega_z (scale by rate)": lambda w: w.f_i[0] * w["omega_z"],
    "f_i omega^2 (scale by rate squared)": lambda w: (
        w.f_i[0] * (w["omega_x"] ** 2 + w["omega_y"] ** 2 + w["omega_z"] ** 2)
    ),
    "a_x pressure": lambda w: w["a_x"] * w.change("pressure"),
    "a_z B_x": lambda w: w["a_z"] * w.change("B_x"),
    "f_i pressure (scale by pressure)": lambda w: w.f_i[0] * w.change("pressure"),
    "f_i temperature^2": lambda w: w.f_i[0] * w.change("temperature") ** 2,
    "omega_z temperature": lambda w: w["omega_z"] * w.change("temperature"),
    "sin 5 phi": lambda w: np.sin(5 * w.phi),
    "a_z cos 6 phi": lambda w: w["a_z"] * np.cos(6 * w.phi),
    "f_i^4": lambda w: w.f_i[0] ** 4,
    "abs(f_o)": lambda w: np.abs(w.f_o[0]),
    "f_i^2 sign(da_z/dt) (friction)": lambda w: w.f_i[0] ** 2 * np.sign(np.gradient(w["a_z"])),
    "creep of f_p over 20 s": lambda w: _creep(w["a_z"] - w["a_z"][0], w.scenario.rate, 20.0),
    "creep of f_i over 0.4 s": lambda w: _creep(w.f_i[0], w.scenario.rate, 0.4),
    "f_i cos 2 pi t/45 s (supply)": lambda w: w.f_i[0] * np.cos(2 * np.pi * w.time / 45),
    "line at 0.37 Hz (pump)": lambda w: np.sin(2 * np.pi * 0.37 * w.time),
    "misalignment jump": lambda w: np.where(w.time > 0.45 * w.scenario.duration, w["a_z"], 0.0),
    "burst of a_x for 40 s": lambda w: np.where(
        np.abs(w.time - 0.7 * w.scenario.duration) < 20, w["a_x"], 0.0
    ),
    "misalignment drift": lambda w: w["a_z"] * (w.time - w.time[-1] / 2),
    # further ones, of which the dictionary of the diagnosis holds most in no such form
    "dead zone of f_i": lambda w: np.clip(w.f_i[0], -0.4 * _rms(w.f_i[0]), 0.4 * _rms(w.f_i[0])),
    "play in f_i (hysteresis)": lambda w: _play(w.f_i[0], 0.3 * _rms(w.f_i[0])),
    "f_i^2 temperature": lambda w: w.f_i[0] ** 2 * w.change("temperature"),
    "f_i roll": lambda w: w.f_i[0] * w["roll"],
    "sqrt(abs(f_o))": lambda w: np.sqrt(np.abs(w.f_o[0])),
    "resonance at 3 Hz": lambda w: _resonant(w.f_i[0], w.scenario.rate, 3.0, 0.1),
    "cross-talk of A3, 0.3 s late": lambda w: _late(w.f_i[2], w.scenario.rate, 0.3),
    "heating by f_i^2, 30 s": lambda w: _creep(w.f_i[0] ** 2, w.scenario.rate, 30.0),
    "play in a_x": lambda w: _play(w["a_x"] - np.mean(w["a_x"]), 0.5 * float(np.std(w["a_x"]))),
    "mount resonant at 3 Hz, Q 15": lambda w: _resonant(w.f_i[0], w.scenario.rate, 3.0, 1 / 30),
    "abs(G_out)": lambda w: np.abs(w.output),
    "cube of G_out (converter)": lambda w: w.output**3,
    "square of G_out (converter)": lambda w: w.output**2,
}
"""Terms by name, (N,) m/s^2 in the first accelerometer; of the first ones the dictionary of the diagnosis holds many."""

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

NAMES = tuple(TERMS)


def name_of(s: Spec) -> str:
    """What is put into a flight with physics outside the catalogue."""
    return NAMES[(s.index + COUNTS["outside"] * (s.sample % 3)) % len(NAMES)]


@dataclass(frozen=True)
class Outside:
    """A term in a flight: what it adds to G_out (N,) V, and its strength with what effects could feign of it, in sigmas."""

    name: str
    change: Array
    with_mimics: float


def drawn(oracle: Oracle, w: Surroundings, name: str, strength: float) -> Outside:
    """A term of this strength beyond the calibration and all effects of the catalogue together."""
    k = w.scenario.instrument.accelerometers
    unit = k["k_VI"][0] * k["K1"][0] * TERMS[name](w)
    factor = strength / oracle.beyond_all(unit)
    return Outside(name, factor * unit, factor * float(np.linalg.norm(oracle.row(unit))))
