"""A survey of many flights: from one worker to two, and the local pool against a Dask cluster.

Forty-eight flights of 20 minutes at 16 Hz: few beside hundreds, enough to outweigh the start of the workers, which
is part of what is measured, as it is part of what is waited for. Workers are on this machine. With less than two
free processors the ratio tells nothing: the processors' idle share before the run stands beside it.
"""

from __future__ import annotations

import os
import statistics
import tempfile
import time
from pathlib import Path

from benchmarks import RATIO, Row

FLIGHTS = 48
DURATION = 1200.0
REPEATS = 2

LEAST = 1.9
"""Times as fast that two workers should be."""

ENVIRONMENT = {"OPENBLAS_NUM_THREADS": "1"}


def free_processors(seconds: float = 2.0) -> float:
    """Processors that nobody uses, by the system's own count over so many ``seconds`` (NaN where it has none)."""
    try:
        first, second = _idle(), (time.sleep(seconds), _idle())[1]
    except (OSError, ValueError):
        return float("nan")
    return (second - first) / os.sysconf("SC_CLK_TCK") / seconds


def _idle() -> float:
    return float(Path("/proc/stat").read_text().split("\n", 1)[0].split()[4])


def run() -> list[Row]:
    """Wall-clock times in turn, and their ratio."""
    from ragg_runtime.flight import write_flight
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow.simulate import simulated

    free = free_processors()
    with tempfile.TemporaryDirectory() as folder:
        m = loop.new(Path(folder) / "model")
        files = []
        for k in range(FLIGHTS):
            hidden = ["thermal-scale:dK1_dT=0/0/6e-8/0"] if k % 4 == 0 else []
            flight = simulated(m.instrument, hidden, seed=k, duration=DURATION, rate=16.0)
            files.append(Path(folder) / f"flight-{k:02}.parquet")
            write_flight(flight, files[-1])
        times: dict[int, list[float]] = {1: [], 2: []}
        results = set()
        for _ in range(REPEATS):
            for jobs, spent in times.items():
                start = time.perf_counter()
                found = loop.survey(m, files, jobs=jobs)
                spent.append(time.perf_counter() - start)
                results.add(repr(found.records))
    if len(results) != 1:
        raise RuntimeError("the figures depend on the number of workers")
    ratios = [a / b for a, b in zip(times[1], times[2], strict=True)]
    note = f"{FLIGHTS} flights of {DURATION / 60:g} min at 16 Hz, start of the workers included"
    rows = [
        Row(
            f"survey, {jobs} worker{'s' if jobs > 1 else ''}",
            statistics.median(spent),
            "s",
            note,
            low=min(spent),
            high=max(spent),
        )
        for jobs, spent in times.items()
    ]
    gain = statistics.median(ratios)
    return [
        *rows,
        Row(
            "survey, from one worker to two",
            gain,
            RATIO,
            f"processors free before the run: {free:.1f} of {os.cpu_count()}",
            f"at least {LEAST:g}",
            low=min(ratios),
            high=max(ratios),
            met=gain >= LEAST,
        ),
    ]
