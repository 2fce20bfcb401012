"""Whole commands, the start of Python included, in processor time; and what each further sample costs that is compensated.

Processor time of the command's own process and its children, which other work on the machine lengthens less than the wall
clock. Each command has run once before: what it derives and compiles is kept (the first time is a row of its own).
"""

from __future__ import annotations

import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks import Row

if TYPE_CHECKING:
    from ragg_runtime.io import Flight

REPEATS = 3
HIDDEN = "thermal-scale:dK1_dT=0/0/6e-8/0"
SHORT, LONG = 1_000_000, 3_000_000
"""Samples of the flights of which the difference is what a further sample costs."""


def run() -> list[Row]:
    """Rows of all commands."""
    from ragg_runtime.io import write_flight
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow.simulate import simulated

    rows = [
        _row("import ragg", [sys.executable, "-c", "import ragg"], 0.2),
        _row("ragg --help", _ragg("--help"), 0.2),
        _row("ragg effects", _ragg("effects"), 0.2),
    ]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        m = loop.new(folder / "model")
        flight = simulated(m.instrument, [HIDDEN], seed=1, duration=1800.0, rate=16.0)
        known, unknown = folder / "flight.parquet", folder / "unknown.parquet"
        write_flight(flight, known)
        write_flight(_without_gradient(flight), unknown)
        cold = {"XDG_CACHE_HOME": str(folder / "cold")}
        first = _processor(_ragg("diagnose", str(folder / "model"), str(known)), cold)
        rows.append(Row("ragg diagnose, the very first time", first, "s CPU", "derives and compiles"))
        model = str(folder / "model")
        rows += [
            _row("ragg compare", _ragg("compare", model, str(known)), None),
            _row("ragg diagnose", _ragg("diagnose", model, str(known)), 1.5),
            _row("ragg diagnose, gradient unknown", _ragg("diagnose", model, str(unknown)), None),
            _row("ragg add", _ragg("add", str(folder / "copy"), "thermal-scale", str(known)), 2.5,
                 lambda: _fresh(folder / "model", folder / "copy")),
        ]  # fmt: skip
        rows += _compensation(flight, folder)
    return [*rows, *_preview()]


def _ragg(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "ragg_runtime", *arguments]


def _processor(command: list[str], environment: dict[str, str] | None = None) -> float:
    """Processor time, s, of a command whose modules are kept as bytecode, as an installed package has them."""
    own = {k: x for k, x in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True, env={**own, **(environment or {})})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _row(
    name: str, command: list[str], target: float | None, before: Callable[[], None] = lambda: None
) -> Row:
    found = []
    for _ in range(REPEATS + 1):
        before()
        found.append(_processor(command))
    middle = statistics.median(found[1:])
    return Row(
        name,
        middle,
        "s CPU",
        target=None if target is None else f"at most {target:g} s",
        low=min(found[1:]),
        high=max(found[1:]),
        met=None if target is None else middle <= target,
    )


def _without_gradient(flight: Flight) -> Flight:
    return type(flight)(
        flight.time,
        {n: x for n, x in flight.channels.items() if not n.startswith("Gamma")},
        flight.outputs,
        units={n: u for n, u in flight.units.items() if not n.startswith("Gamma")},
    )


def _fresh(model: Path, copy: Path) -> None:
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(model, copy)


def _compensation(flight: Flight, folder: Path) -> list[Row]:
    """Frozen, from Parquet to Parquet, on one thread: what a further sample costs."""
    import numpy as np

    from ragg_runtime.io import write_flight

    known = folder / "flight.parquet"
    subprocess.run(
        _ragg("calibrate", str(folder / "model"), str(known), "--save"), check=True, capture_output=True
    )
    commands = {}
    for samples in (SHORT, LONG):
        times = -(-samples // len(flight.time))
        repeated = replace(
            flight,
            time=np.arange(samples) / flight.rate,
            channels={n: np.tile(x, times)[:samples] for n, x in flight.channels.items()},
            outputs={n: np.tile(x, times)[:samples] for n, x in flight.outputs.items()},
            valid=np.ones(samples, dtype=np.bool_),
        )
        path = folder / f"{samples}.parquet"
        write_flight(repeated, path)
        commands[samples] = [
            *_ragg("compensate", str(folder / "model"), str(path), "--calibration", "frozen"),
            *("-o", str(folder / "compensated.parquet")),
        ]
    # in turn, the first of each for nothing: a difference of two times alone may come out at half of it or twice
    spent: dict[int, list[float]] = {SHORT: [], LONG: []}
    for _ in range(REPEATS + 1):
        for samples, command in commands.items():
            spent[samples].append(_processor(command))
    brief, long = (spent[n][1:] for n in (SHORT, LONG))
    further = [(b - a) / (LONG - SHORT) for a, b in zip(brief, long, strict=True)]
    each = (statistics.median(long) - statistics.median(brief)) / (LONG - SHORT)
    return [
        Row(
            "ragg compensate, a million samples",
            statistics.median(brief),
            "s CPU",
            "frozen; Parquet to Parquet",
            low=min(brief),
            high=max(brief),
        ),
        Row(
            "ragg compensate, samples a second",
            1e-6 / each,
            "million",
            "of the further ones, on one core",
            "at least 5",
            low=1e-6 / max(further),
            high=1e-6 / max(min(further), 1e-12),
            met=each <= 0.2e-6,
        ),
    ]


def _preview() -> list[Row]:
    """An effect foreseen from triangles in memory."""
    from ragg_runtime.estimation.fitted import fit
    from ragg_runtime.estimation.observation import observations_of
    from ragg_runtime.identification.foresee import foreseen, unwhitened
    from ragg_runtime.identification.strong import with_steps
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow.simulate import simulated

    with tempfile.TemporaryDirectory() as name:
        m = loop.new(Path(name) / "model")
        flight = simulated(m.instrument, [HIDDEN], seed=1, duration=1800.0, rate=16.0)
        field, f, _ = with_steps(fit(m.model, m.instrument, observations_of([flight], m.instrument)))
        known = unwhitened(f)
        found = []
        for effect in [*field.candidates][:12]:
            begun = time.process_time()
            foreseen(f, known, field, [effect])
            found.append(1e3 * (time.process_time() - begun))
    middle = statistics.median(found[1:])
    return [
        Row("preview of an effect", middle, "ms CPU", "from triangles in memory", "at most 20 ms",
            low=min(found[1:]), high=max(found[1:]), met=middle <= 20.0)
    ]  # fmt: skip
