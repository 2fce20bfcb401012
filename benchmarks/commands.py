"""Whole commands, the start of Python included, in processor time; and what each further sample costs that is compensated.

Processor time of the command's own process and its children, which other work on the machine lengthens less than the wall
clock. Each command has run once before: what it derives and compiles is kept (the first time is a row of its own).
"""

from __future__ import annotations

import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks import Row
from ragg_runtime import api
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.simulate import simulate_flight

REPEATS = 3
HIDDEN = "thermal-scale:dK1_dT=0/0/6e-8/0"
SHORT, LONG = 1_000_000, 3_000_000
"""Samples of the flights of which the difference is what a further sample costs."""


def run() -> list[Row]:
    """Rows of all commands."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        m = api.new(folder / "model")
        model, copy = str(folder / "model"), folder / "copy"
        flight = simulate_flight(m.instrument, [HIDDEN], seed=1, duration=1800.0, no_gradient=False)
        known, unknown, hour = (str(folder / f"{n}.parquet") for n in ("flight", "unknown", "hour"))
        write_flight(flight, known)
        write_flight(simulate_flight(m.instrument, [HIDDEN], seed=1, duration=1800.0), unknown)
        write_flight(simulate_flight(m.instrument, [HIDDEN], seed=1, duration=3600.0, rate=100.0), hour)
        first = measure_processor(_ragg("diagnose", model, known), XDG_CACHE_HOME=str(folder / "cold"))

        def copy_model() -> None:
            shutil.rmtree(copy, ignore_errors=True)
            shutil.copytree(model, copy)

        return [
            _row("start of Python and SymPy", ["-c", "import sympy"]),
            _row("import ragg", ["-c", "import ragg"], 0.2),
            _row("ragg --help", _ragg("--help"), 0.2),
            _row("ragg effects", _ragg("effects"), 0.2),
            _row("ragg derive, everything", _ragg("derive", "--out", str(folder / "derived")), 3.0),
            Row("ragg diagnose, the very first time", first, "s CPU", "derives and compiles"),
            _row("ragg compare", _ragg("compare", model, known)),
            _row("ragg diagnose", _ragg("diagnose", model, known), 1.5),
            _row("ragg diagnose, gradient unknown", _ragg("diagnose", model, unknown)),
            Row("ragg diagnose, an hour at 100 Hz", measure_processor(_ragg("diagnose", model, hour)), "s CPU", limit=20.0),
            _row("ragg add", _ragg("add", str(copy), "thermal-scale", known), 2.5, copy_model),
            *_compensation(flight, folder),
        ]  # fmt: skip


def _ragg(*arguments: str) -> list[str]:
    return ["-m", "ragg_runtime", *arguments]


def measure_processor(arguments: list[str], **environment: str) -> float:
    """Processor time, s, of Python with these arguments, whose modules are kept as bytecode, as an installed package has them."""
    own = {k: x for k, x in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"} | environment
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *arguments], check=True, capture_output=True, env=own)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _row(
    name: str, arguments: list[str], limit: float | None = None, prepare: Callable[[], None] = lambda: None
) -> Row:
    found = []
    for _ in range(REPEATS + 1):
        prepare()
        found.append(measure_processor(arguments))
    return Row.of(name, found[1:], "s CPU", limit=limit)


def _compensation(flight: Flight, folder: Path) -> list[Row]:
    """Frozen, from Parquet to Parquet, on one thread: what a further sample costs."""
    model = str(folder / "model")
    measure_processor(_ragg("calibrate", model, str(folder / "flight.parquet"), "--save"))
    commands = []
    for samples in (SHORT, LONG):
        repeated = replace(
            flight,
            time=np.arange(samples) / flight.rate,
            channels={n: np.resize(x, samples) for n, x in flight.channels.items()},
            outputs={n: np.resize(x, samples) for n, x in flight.outputs.items()},
            valid=np.ones(samples, dtype=np.bool_),
        )
        path = folder / f"{samples}.parquet"
        write_flight(repeated, path)
        options = ("--calibration", "frozen", "-o", str(folder / "compensated.parquet"))
        commands.append(_ragg("compensate", model, str(path), *options))
    # in turn, the first of each for nothing: a difference of two times alone may come out at half of it or twice
    spent = np.array([[measure_processor(c) for c in commands] for _ in range(REPEATS + 1)])[1:]
    millions = (LONG - SHORT) / 1e6 / np.maximum(spent[:, 1] - spent[:, 0], 1e-6)
    note = "of the further ones, on one core"
    return [
        Row.of("ragg compensate, a million samples", list(spent[:, 0]), "s CPU", note="frozen; Parquet to Parquet"),
        Row.of("ragg compensate, samples a second", list(millions), "million", note=note, limit=5.0, at_least=True),
    ]  # fmt: skip
