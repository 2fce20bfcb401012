"""Speed of the commands: processor time of a command's process and its children, which other work lengthens less than the wall clock.

Medians of three of what is short; what the first diagnosis derives and compiles is kept for the others.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import Row
from ragg_runtime import api
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.simulate import simulate_flight

HIDDEN = "thermal-scale:dK1_dT=0/0/6e-8/0"
SHORT, LONG = 300_000, 1_300_000
"""Samples of the flights of which the difference is what a further sample costs: of more than 260,000 the noise is not estimated."""


def run() -> list[Row]:
    """Whole commands, the start of Python included, in processor time; and what each further sample costs that is compensated."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        model, flight = str(folder / "model"), simulate(folder, no_gradient=False)
        known, unknown, hour = (str(folder / f"{n}.parquet") for n in ("known", "unknown", "hour"))
        write_flight(flight, known)
        write_flight(simulate(folder), unknown)
        write_flight(simulate(folder, duration=3600.0, rate=100.0), hour)
        calls = [("import ragg", partial(measure, python=("-c", "import ragg")))]
        calls += [(f"ragg {x}", partial(measure, x)) for x in ("--help", "effects")]
        rows = [Row(n, [call() for _ in range(3)], "s CPU", 0.2) for n, call in calls]
        cold = str(folder / "cold")
        rows += [
            Row("ragg derive, everything", measure("derive", "--out", str(folder / "derived")), "s CPU", 3.0),
            Row("ragg diagnose, the very first time", measure("diagnose", model, known, cache=cold), "s CPU"),
            Row("ragg compare", measure("compare", model, known), "s CPU"),
            Row("ragg diagnose", measure("diagnose", model, known), "s CPU", 1.5),
            Row("ragg diagnose, gradient unknown", measure("diagnose", model, unknown), "s CPU"),
            *measure_diagnosis("an hour", model, hour, 20.0),
            *measure_compensation(flight, folder, known),
        ]
        return [*rows, Row("ragg add", measure("add", model, "thermal-scale", known), "s CPU", 2.5)]


def run_day() -> list[Row]:
    """A diagnosis of a day at 100 Hz, from a file."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_flight(simulate(folder, duration=86_400.0, rate=100.0), folder / "day.parquet")
        return measure_diagnosis("a day", str(folder / "model"), str(folder / "day.parquet"), 300.0, 5000.0)


def simulate(folder: Path, **options: Any) -> Flight:
    """A flight of the model in a folder, which is made if there is none."""
    path = folder / "model"
    m = api.load(path) if path.exists() else api.new(path)
    return simulate_flight(m.instrument, [HIDDEN], seed=1, **options)


def measure(*arguments: str, python: tuple[str, ...] = ("-m", "ragg_runtime"), cache: str = "") -> float:
    """Processor time, s, of ``ragg`` with these arguments, whose modules are kept as bytecode, as an installed package has them."""
    environment = {k: x for k, x in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    environment |= {"XDG_CACHE_HOME": cache} if cache else {}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *python, *arguments], check=True, capture_output=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure_diagnosis(of: str, model: str, path: str, limit: float, most: float | None = None) -> list[Row]:
    """Time and memory of the diagnosis of a long record: nothing before it has taken as much memory."""
    spent = measure("diagnose", model, path)
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    name = f"ragg diagnose, {of} at 100 Hz"
    return [Row(name, spent, "s CPU", limit), Row(f"{name}, peak memory", memory, "MB", most)]


def measure_compensation(flight: Flight, folder: Path, known: str) -> list[Row]:
    """Frozen, from Parquet to Parquet: what a further sample costs."""
    model = str(folder / "model")
    measure("calibrate", model, known, "--save")
    repeated = replace(
        flight,
        time=np.arange(LONG) / flight.rate,
        channels={n: np.resize(x, LONG) for n, x in flight.channels.items()},
        outputs={n: np.resize(x, LONG) for n, x in flight.outputs.items()},
        valid=np.ones(LONG, dtype=np.bool_),
    )
    path, target = str(folder / "repeated.parquet"), str(folder / "compensated.parquet")
    spent = []
    for samples in (SHORT, LONG):
        write_flight(repeated.part(slice(0, samples)), path)
        spent.append(measure("compensate", model, path, "--calibration", "frozen", "-o", target))
    short, long = spent
    return [
        Row("ragg compensate, 300,000 samples", short, "s CPU"),
        Row("ragg compensate, further samples a second", (LONG - SHORT) / 1e6 / (long - short), "million", 5.0, True),
    ]  # fmt: skip
