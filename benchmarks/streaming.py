"""A diagnosis of an hour at 100 Hz, from a file: processor time and memory."""

from __future__ import annotations

import resource
import tempfile
import time
from pathlib import Path

from benchmarks import Row

MOST = 20.0
"""s CPU that it may take."""


def run() -> list[Row]:
    """Diagnosis of an hour, and its memory."""
    from ragg_runtime.io import write_flight
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow.simulate import simulated

    hidden = ["thermal-scale:dK1_dT=0/0/6e-8/0"]
    with tempfile.TemporaryDirectory() as folder:
        m = loop.new(Path(folder) / "model")
        path = Path(folder) / "hour.parquet"
        write_flight(simulated(m.instrument, hidden, seed=1, duration=3600.0, rate=100.0), path)
        start = time.process_time()
        found = loop.diagnose(m, loop.read_flights(m, [path])).found
        spent = time.process_time() - start
    if found != ("thermal-scale",):
        raise RuntimeError(f"the diagnosis is wrong: {found}")
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return [
        Row(
            "diagnose an hour at 100 Hz, reading it included",
            spent,
            "s CPU",
            target=f"at most {MOST:g} s",
            met=spent <= MOST,
        ),
        Row("peak memory", memory, "MB", "of the process, all imports in"),
    ]
