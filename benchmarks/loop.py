"""The loop on a flight of 30 minutes at 16 Hz: compare, diagnose over the whole catalogue, add.

What is timed includes everything but reading the file: calibration, the noise, the derivation of the extended
model, its nonlinear check, held-out errors. The processor time stands beside the wall clock, which other work on
the machine lengthens.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from benchmarks import Row

REPEATS = 3


def run() -> list[Row]:
    """Wall-clock and processor times."""
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow.simulate import simulated

    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as folder:
        m = loop.new(Path(folder) / "model")
        flight = simulated(
            m.instrument, ["thermal-scale:dK1_dT=0/0/6e-8/0"], seed=1, duration=1800.0, rate=16.0
        )
        unknown = type(flight)(
            flight.time,
            {n: x for n, x in flight.channels.items() if not n.startswith("Gamma")},
            flight.outputs,
            units={n: u for n, u in flight.units.items() if not n.startswith("Gamma")},
        )
        added = 0

        def add() -> None:
            nonlocal added
            added += 1
            copy = loop.new(Path(folder) / f"copy-{added}")
            loop.add(copy, "thermal-scale", [flight])

        rows += timed("compare", lambda: loop.compare(m, [flight]), None)
        rows += timed("diagnose", lambda: loop.diagnose(m, [flight]), 1.0)
        rows += timed("diagnose, gradient unknown", lambda: loop.diagnose(m, [unknown]), 1.5)
        rows += timed("add", add, None)
    return rows


def timed(name: str, work: Callable[[], object], target: float | None, repeats: int = REPEATS) -> list[Row]:
    """Rows of wall clock and processor time, medians; ``target`` in s holds for the wall clock."""
    wall, processor = [], []
    for _ in range(repeats):
        a, b = time.perf_counter(), time.process_time()
        work()
        wall.append(time.perf_counter() - a)
        processor.append(time.process_time() - b)
    middle = statistics.median(wall)
    return [
        Row(
            name,
            middle,
            "s",
            f"processor time {statistics.median(processor):.2f} s",
            None if target is None else f"at most {target:g} s",
            low=min(wall),
            high=max(wall),
            met=None if target is None else middle <= target,
        )
    ]
