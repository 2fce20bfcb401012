"""Whole commands, the start of Python included, in processor time; and what each further sample costs that is compensated.

Processor time of the command's own process and its children, which other work on the machine lengthens less than the wall
clock. Medians of three, but of what takes long: what the first one derives and compiles is kept (the very
first time is a row of its own).
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
SHORT, LONG = 100_000, 300_000
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
        first = measure("diagnose", model, known, XDG_CACHE_HOME=str(folder / "cold"))
        without_gradient, in_hour = (measure("diagnose", model, x) for x in (unknown, hour))
        memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024

        def copy_model() -> None:
            shutil.rmtree(copy, ignore_errors=True)
            shutil.copytree(model, copy)

        return [
            _row("import ragg", 0.2, python=("-c", "import ragg")),
            _row("ragg --help", 0.2, "--help"),
            _row("ragg effects", 0.2, "effects"),
            Row("ragg derive, everything", measure("derive", "--out", str(folder / "derived")), "s CPU", 3.0),
            Row("ragg diagnose, the very first time", first, "s CPU"),
            _row("ragg compare", None, "compare", model, known),
            _row("ragg diagnose", 1.5, "diagnose", model, known),
            Row("ragg diagnose, gradient unknown", without_gradient, "s CPU"),
            Row("ragg diagnose, an hour at 100 Hz", in_hour, "s CPU", 20.0),
            Row("ragg diagnose, an hour at 100 Hz, peak memory", memory, "MB"),
            _row("ragg add", 2.5, "add", str(copy), "thermal-scale", known, prepare=copy_model),
            *_compensation(flight, folder),
        ]


def measure(*arguments: str, python: tuple[str, ...] = ("-m", "ragg_runtime"), **environment: str) -> float:
    """Processor time, s, of ``ragg`` with these arguments, whose modules are kept as bytecode, as an installed package has them."""
    own = {k: x for k, x in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"} | environment
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *python, *arguments], check=True, capture_output=True, env=own)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _row(
    name: str,
    limit: float | None,
    *arguments: str,
    prepare: Callable[[], None] = lambda: None,
    **how: tuple[str, ...],
) -> Row:
    found = []
    for _ in range(REPEATS):
        prepare()
        found.append(measure(*arguments, **how))
    return Row(name, found, "s CPU", limit)


def _compensation(flight: Flight, folder: Path) -> list[Row]:
    """Frozen, from Parquet to Parquet: what a further sample costs."""
    model = str(folder / "model")
    measure("calibrate", model, str(folder / "flight.parquet"), "--save")
    paths = [folder / f"{samples}.parquet" for samples in (SHORT, LONG)]
    for samples, path in zip((SHORT, LONG), paths, strict=True):
        repeated = replace(
            flight,
            time=np.arange(samples) / flight.rate,
            channels={n: np.resize(x, samples) for n, x in flight.channels.items()},
            outputs={n: np.resize(x, samples) for n, x in flight.outputs.items()},
            valid=np.ones(samples, dtype=np.bool_),
        )
        write_flight(repeated, path)
    options = ("--calibration", "frozen", "-o", str(folder / "compensated.parquet"))
    # in turn: a difference of two times alone may come out at half of it or twice
    spent = [[measure("compensate", model, str(p), *options) for p in paths] for _ in range(REPEATS)]
    short, long = np.transpose(spent)
    return [
        Row("ragg compensate, 100,000 samples", short, "s CPU"),
        Row("ragg compensate, further samples a second", (LONG - SHORT) / 1e6 / (long - short), "million", 5.0, True),
    ]  # fmt: skip
