"""What is done to a record to make it awkward, without any effect in it."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.flight import Flight, read_flight
from ragg_runtime.reference.simulate import Simulation

Array = NDArray[np.float64]

DURATION = 300.0
RATE = 16.0

SENSORS = {"a": 1e-6, "omega": 1e-9, "omegadot": 1e-8}
"""White noise of a motion record, SI: 0.1 ug, 2e-4 deg/h, and what a good derivative makes of it."""

Change = Callable[[Flight, Simulation, np.random.Generator], Flight]
"""What is done to the record."""


def nothing(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    return x


def _noise(x: Flight, sim: Simulation, e: Array) -> Flight:
    """The flight with other noise of G_out, (N,) V."""
    return replace(x, outputs={"G_out": sim.G_out_noise_free + e})


def _e(sim: Simulation) -> Array:
    return np.asarray(sim.G_out - sim.G_out_noise_free)


def _rms(sim: Simulation) -> float:
    return float(np.std(_e(sim)))


def heavy(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """Student's t with three degrees of freedom."""
    return _noise(x, sim, _rms(sim) * rng.standard_t(3, len(x)) / np.sqrt(3.0))


def level(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """Tenfold noise from a random instant on, or until then."""
    at = int(len(x) * rng.uniform(0.2, 0.8))
    loud = (np.arange(len(x)) >= at) == (rng.random() < 0.5)
    return _noise(x, sim, _e(sim) * np.where(loud, 10.0, 1.0))


def ramp(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """Noise that grows or falls by a factor of 2 to 6."""
    s = np.linspace(0.0, 1.0, len(x))
    factor = rng.uniform(2.0, 6.0)
    return _noise(x, sim, _e(sim) * factor ** (s if rng.random() < 0.5 else 1.0 - s))


def step(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """Noise that is 1.5 to 4 times larger for a third to two thirds of the record."""
    a = rng.uniform(0.0, 0.5)
    s = np.linspace(0.0, 1.0, len(x))
    loud = (s > a) & (s < a + rng.uniform(1 / 3, 2 / 3))
    return _noise(x, sim, _e(sim) * np.where(loud, rng.uniform(1.5, 4.0), 1.0))


def mains(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """50 Hz, which wanders by some mHz, seen through the sampling, 0.3 to 3 times the noise."""
    f = 50.0 + 0.005 * np.cumsum(rng.standard_normal(len(x))) / np.sqrt(len(x))
    hum = np.sqrt(2.0) * rng.uniform(0.3, 3.0) * np.cos(2 * np.pi * np.cumsum(f) / RATE + rng.uniform(0, 6))
    return _noise(x, sim, _e(sim) + _rms(sim) * hum)


def bursts(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """One to four stretches of 2 to 8 s that are 3 to 20 times as noisy."""
    factor = np.ones(len(x))
    for _ in range(int(rng.integers(1, 5))):
        a = rng.uniform(0.0, DURATION - 8.0)
        factor[int(a * RATE) : int((a + rng.uniform(2.0, 8.0)) * RATE)] = rng.uniform(3.0, 20.0)
    return _noise(x, sim, _e(sim) * factor)


def coarse(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """Output in steps of 0.3 to 3 times the noise."""
    q = rng.uniform(0.3, 3.0) * _rms(sim)
    return replace(x, outputs={"G_out": np.round(sim.G_out / q) * q})


def gaps(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """30 % of the samples are missing, in gaps of 0.1 to 10 s."""
    lost = np.zeros(len(x), dtype=np.bool_)
    while np.mean(lost) < 0.3:
        a = int(rng.integers(len(x)))
        lost[a : a + 1 + int(10 ** rng.uniform(-1, 1) * RATE)] = True
    return replace(x, valid=x.valid & ~lost)


def rough_gaps(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """The record fails where it is rough."""
    a = np.hypot(*(x.channels[n] - np.mean(x.channels[n]) for n in ("a_x", "a_z")))
    return replace(x, valid=x.valid & (a < np.quantile(a, rng.uniform(0.7, 0.95))))


def clock(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """The true disc turns at another rate: see ``Kind.clock``."""
    return x


def follows(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """Noise proportional to abs(a_x), with a floor of a fifth."""
    a = np.abs(x.channels["a_x"])
    return _noise(x, sim, _e(sim) * (0.2 + a / np.sqrt(np.mean(a**2))))


def cyclic(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """Noise that swells once or twice a turn."""
    phi = 2 * np.pi * 0.25 * x.time * int(rng.integers(1, 3)) + rng.uniform(0, 6)
    return _noise(x, sim, _e(sim) * (1.0 + rng.uniform(0.3, 0.9) * np.cos(phi)))


def line(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """A line beside one or two turns, 0.05 to 1 times the noise."""
    f = (0.2503, 0.5003)[int(rng.integers(2))]
    size = np.sqrt(2.0) * _rms(sim) * 10 ** rng.uniform(-1.3, 0.0)
    return _noise(x, sim, _e(sim) + size * np.cos(2 * np.pi * f * x.time + rng.uniform(0, 6)))


def sensors(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """White noise of every sensor of motion."""
    noisy = dict(x.channels)
    for q, sigma in SENSORS.items():
        for k in "xyz":
            noisy[f"{q}_{k}"] = noisy[f"{q}_{k}"] + sigma * rng.standard_normal(len(x))
    return replace(x, channels=noisy)


def digits(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """As a file of 5 to 9 significant digits holds it."""
    n = int(rng.integers(5, 10))

    def written(values: Array) -> Array:
        return np.array([float(f"{v:.{n}g}") for v in values])

    return replace(
        x,
        channels={k: written(v) for k, v in x.channels.items()},
        outputs={k: written(v) for k, v in x.outputs.items()},
    )


def without_omegadot(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """No angular acceleration, and gaps of 1 to 20 samples every few seconds."""
    lost = np.zeros(len(x), dtype=np.bool_)
    at = 0
    while at < len(x):
        at += int(rng.uniform(1.0, 20.0) * RATE)
        lost[at : at + int(rng.integers(1, 20))] = True
    kept = {n: v for n, v in (dict(x.channels) | dict(x.outputs)).items() if not n.startswith("omegadot")}
    table = np.column_stack([x.time, *kept.values()])[~lost]
    header = ",".join(["time [s]", *(f"{n} [{x.units[n]}]" for n in kept)])
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "flight.csv"
        np.savetxt(path, table, delimiter=",", header=header, comments="", fmt="%.17g")
        return read_flight(path, 9.8)


def shuffled(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    return replace(x, outputs={"G_out": rng.permutation(sim.G_out)})


def pure_noise(x: Flight, sim: Simulation, rng: np.random.Generator) -> Flight:
    """White noise of the size of the output."""
    return replace(x, outputs={"G_out": float(np.std(sim.G_out)) * rng.standard_normal(len(x))})
