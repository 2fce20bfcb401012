"""Whole commands, the start of Python included, in processor time; an hour at 100 Hz; what a further compensated sample costs.

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

from benchmarks import Row, at_most

if TYPE_CHECKING:
    from ragg_runtime.io import Flight

REPEATS = 3
HIDDEN = "thermal-scale:dK1_dT=0/0/6e-8/0"
SHORT, LONG = 1_000_000, 3_000_000
"""Samples of the flights of which the difference is what a further sample costs."""


def run() -> list[Row]:
    """Rows of all commands."""
    from ragg_runtime import api
    from ragg_runtime.io import write_flight
    from ragg_runtime.simulate import simulate_flight

    rows = [
        _row("import ragg", [sys.executable, "-c", "import ragg"], 0.2),
        _row("ragg --help", _ragg("--help"), 0.2),
        _row("ragg effects", _ragg("effects"), 0.2),
    ]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        m = api.new(folder / "model")
        model, copy = str(folder / "model"), folder / "copy"
        flight = simulate_flight(m.instrument, [HIDDEN], seed=1, duration=1800.0, no_gradient=False)
        known, unknown = str(folder / "flight.parquet"), str(folder / "unknown.parquet")
        write_flight(flight, known)
        write_flight(simulate_flight(m.instrument, [HIDDEN], seed=1, duration=1800.0), unknown)
        first = _processor(_ragg("diagnose", model, known), {"XDG_CACHE_HOME": str(folder / "cold")})

        def fresh() -> None:
            shutil.rmtree(copy, ignore_errors=True)
            shutil.copytree(model, copy)

        rows += [
            Row("ragg diagnose, the very first time", first, "s CPU", "derives and compiles"),
            _row("ragg compare", _ragg("compare", model, known)),
            _row("ragg diagnose", _ragg("diagnose", model, known), 1.5),
            _row("ragg diagnose, gradient unknown", _ragg("diagnose", model, unknown)),
            _row("ragg add", _ragg("add", str(copy), "thermal-scale", known), 2.5, fresh),
            *_compensation(flight, folder),
            *_preview(m, flight),
            *_hour(m, folder / "hour.parquet"),
        ]
    return rows


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
    name: str, command: list[str], limit: float | None = None, before: Callable[[], None] = lambda: None
) -> Row:
    found = []
    for _ in range(REPEATS + 1):
        before()
        found.append(_processor(command))
    return at_most(
        name, statistics.median(found[1:]), "s CPU", limit, low=min(found[1:]), high=max(found[1:])
    )


def _compensation(flight: Flight, folder: Path) -> list[Row]:
    """Frozen, from Parquet to Parquet, on one thread: what a further sample costs."""
    import numpy as np

    from ragg_runtime.io import write_flight

    model = str(folder / "model")
    _processor(_ragg("calibrate", model, str(folder / "flight.parquet"), "--save"))
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
        options = ("--calibration", "frozen", "-o", str(folder / "compensated.parquet"))
        commands[samples] = _ragg("compensate", model, str(path), *options)
    # in turn, the first of each for nothing: a difference of two times alone may come out at half of it or twice
    spent: dict[int, list[float]] = {SHORT: [], LONG: []}
    for _ in range(REPEATS + 1):
        for samples, command in commands.items():
            spent[samples].append(_processor(command))
    brief, long = (spent[n][1:] for n in (SHORT, LONG))
    further = [(b - a) / (LONG - SHORT) for a, b in zip(brief, long, strict=True)]
    each = (statistics.median(long) - statistics.median(brief)) / (LONG - SHORT)
    rates = {"low": 1e-6 / max(further), "high": 1e-6 / max(min(further), 1e-12), "met": each <= 0.2e-6}
    return [
        at_most("ragg compensate, a million samples", statistics.median(brief), "s CPU", None,
                "frozen; Parquet to Parquet", low=min(brief), high=max(brief)),
        Row("ragg compensate, samples a second", 1e-6 / each, "million", "of the further ones, on one core",
            "at least 5", **rates),
    ]  # fmt: skip


def _preview(m: object, flight: Flight) -> list[Row]:
    """An effect predicted from R factors in memory."""
    from ragg_runtime.estimation.fitted import fit
    from ragg_runtime.estimation.observation import observe_flights
    from ragg_runtime.identification.predict import pass_unwhitened, predict_error
    from ragg_runtime.identification.strong import add_steps

    field, f, _ = add_steps(fit(m.model, m.instrument, observe_flights([flight], m.instrument)))  # type: ignore[attr-defined]
    known = pass_unwhitened(f)
    found = []
    for effect in [*field.candidates][:12]:
        begun = time.process_time()
        predict_error(f, known, field, [effect])
        found.append(1e3 * (time.process_time() - begun))
    middle, note = statistics.median(found[1:]), "from R factors in memory"
    return [
        at_most("preview of an effect", middle, "ms CPU", 20.0, note, low=min(found[1:]), high=max(found[1:]))
    ]


def _hour(m: object, path: Path) -> list[Row]:
    """A diagnosis of an hour at 100 Hz, from a file."""
    from ragg_runtime.io import write_flight
    from ragg_runtime.simulate import simulate_flight

    write_flight(simulate_flight(m.instrument, [HIDDEN], seed=1, duration=3600.0, rate=100.0), path)  # type: ignore[attr-defined]
    script = (
        "import ragg, resource, sys; m = ragg.load(sys.argv[1]);"
        "d = ragg.diagnose(m, ragg.read_flights(m, [sys.argv[2]])); assert d.found == ('thermal-scale',), d.found;"
        "u = resource.getrusage(resource.RUSAGE_SELF); print(u.ru_utime + u.ru_stime, u.ru_maxrss / 1024)"
    )
    command = [sys.executable, "-c", script, str(path.parent / "model"), str(path)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    spent, memory = map(float, done.stdout.split())
    return [
        at_most("diagnose an hour at 100 Hz, reading it included", spent, "s CPU", 20.0),
        Row("the same, peak memory", memory, "MB", "of the process, all imports in"),
    ]
