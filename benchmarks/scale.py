"""A survey of ten thousand flights on a Dask cluster: what grows with their number, and what does not.

``python -m benchmarks.scale`` starts a scheduler and two workers on this machine and surveys 10,000 files (three minutes).
What is looked at is the way of the flights through the queue, the results file, the table and the summary, not the
diagnosis, which is the same for each: workers answer with records as a survey of short flights makes them, read the
whole file for its digest, and mark each flight with landmarks of its own. ``--diagnose SECONDS`` has flights of that length
simulated and diagnosed for real (0.6 s of a processor for each of 60 s).

The survey is cut short after 40 %, continued from its results file, and its table compared, byte for byte, with that of a
survey that nobody cut.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.files import file_digest
from ragg_runtime.flight import write_flight
from ragg_runtime.survey import cluster, task
from ragg_runtime.survey.task import Job, Record
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

ROOT = Path(__file__).resolve().parents[1]
CUT = 0.4
"""Share of the flights after which the first survey is cut short."""
TEMPLATES = 8
"""Flights that are diagnosed to make the records that workers answer with."""
WORKERS = 2


@dataclass
class Seen:
    """What was seen during a survey, at every twentieth of it."""

    client: Any
    scheduler: int
    cut: bool = False
    rows: list[tuple[int, float, float, int, float]] = field(default_factory=list)
    begun: float = field(default_factory=time.perf_counter)

    def __call__(self, done: int, total: int, record: Record | None) -> None:
        if self.cut and done >= CUT * total:
            raise KeyboardInterrupt
        if done % max(total // 20, 1) == 0 and record is not None:
            known = self.client.run_on_scheduler(_tasks)
            spent = time.perf_counter() - self.begun
            self.rows.append((done, resident(self.scheduler), resident(os.getpid()), known, spent))


def _tasks(dask_scheduler: Any = None) -> int:
    return len(dask_scheduler.tasks)


def resident(process: int) -> float:
    """Memory of a process, MB."""
    for line in Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    return float("nan")


@cache
def _templates(path: str) -> list[Record]:
    found: list[Record] = json.loads(Path(path).read_text())
    return found


def stand_in(path: str, job: Job, file: str) -> Record:
    """The record of a flight that was not diagnosed: that of another, with the digest and landmarks of its own."""
    digest = file_digest(Path(file))
    rng = np.random.default_rng(int(digest[:15], 16))
    record = _templates(path)[int(rng.integers(TEMPLATES))]
    marks = record[task.LANDMARKS]
    columns = {n: rng.normal(size=len(v)).tolist() for n, v in marks["columns"].items()}
    own = {"flight": Path(file).name, "file": file, "sha256": digest}
    return record | own | {task.LANDMARKS: marks | {"columns": columns}}


@contextlib.contextmanager
def running(folder: Path) -> Iterator[tuple[str, int]]:
    """A scheduler and its workers: its address and process."""
    file = folder / "scheduler.json"
    environment = os.environ | {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}

    def start(*words: object) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", *map(str, words)]
        return subprocess.Popen(command, cwd=folder, env=environment, stderr=subprocess.DEVNULL)

    processes = [start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", 0,
                       "--no-dashboard", "--scheduler-file", file)]  # fmt: skip
    try:
        for _ in range(WORKERS):
            processes.append(start("distributed.cli.dask_worker", "--scheduler-file", file, "--no-nanny",
                                   "--nthreads", 1, "--no-dashboard"))  # fmt: skip
        while not file.exists():
            time.sleep(0.1)
        yield json.loads(file.read_text())["address"], processes[0].pid
    finally:
        for p in reversed(processes):
            p.kill()
            p.wait(30)
        file.unlink(missing_ok=True)


def files_of(m: loop.Loaded, folder: Path, count: int, seconds: float | None) -> list[Path]:
    """Flights to diagnose, or files whose content alone is theirs."""
    found = []
    for k in range(count):
        path = folder / f"flight-{k:05}.parquet"
        if seconds is None:
            path.write_bytes(k.to_bytes(4, "big") * 1000)
        else:
            write_flight(simulated(m.instrument, [], seed=k, duration=seconds, rate=16.0), path)
        found.append(path)
    return found


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.scale", description=__doc__)
    parser.add_argument("--flights", type=int, default=10000)
    parser.add_argument("--diagnose", type=float, metavar="SECONDS")
    options = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        m = loop.new(folder / "model")
        flights = files_of(m, folder, options.flights, options.diagnose)
        if options.diagnose is None:
            short = [folder / f"short-{k}.parquet" for k in range(TEMPLATES)]
            for k, path in enumerate(short):
                write_flight(simulated(m.instrument, [], seed=k, duration=60.0, rate=16.0), path)
            toml = folder / "model" / "model.toml"
            given = task.job(toml.read_text(), toml)
            templates = folder / "templates.json"
            templates.write_text(json.dumps([task.examine(given, str(p)) for p in short]))
            cluster.examine = partial(stand_in, str(templates))
        tables = [
            bytes_
            for kept, cut in (("cut.jsonl", True), ("cut.jsonl", False), ("whole.jsonl", False))
            if (bytes_ := surveyed(m, flights, folder, folder / kept, cut=cut)) is not None
        ]
        print("the tables are the same, byte for byte" if tables[0] == tables[1] else "THE TABLES DIFFER")
        return int(tables[0] != tables[1])


def surveyed(m: loop.Loaded, flights: Sequence[Path], folder: Path, kept: Path, *, cut: bool) -> bytes | None:
    """The table of a survey on a cluster of its own, its figures printed; ``None`` if it was to be cut short."""
    import distributed

    from ragg_runtime.survey.table import parquet

    with (
        running(folder) as (address, process),
        distributed.Client(address, set_as_default=False) as client,
    ):
        client.wait_for_workers(WORKERS)
        seen = Seen(client=client, scheduler=process, cut=cut)
        try:
            s = loop.survey(m, flights, scheduler=address, resume=kept, progress=seen)
        except KeyboardInterrupt:
            print("cut short", flush=True)
            return None
    start = time.process_time()
    table = parquet(s.records)
    made = time.process_time()
    counts = dict(s.summary.counts)
    print(f"{kept.name}: {counts}; table {len(table) / 1e6:.1f} MB in {made - start:.1f} s,", end=" ")
    print(f"summary in {time.process_time() - made:.1f} s")
    print("flights   scheduler MB   client MB   flights it knows   s")
    for done, there, here, known, at in seen.rows:
        print(f"{done:7} {there:14.0f} {here:11.0f} {known:18} {at:5.0f}", flush=True)
    return table


if __name__ == "__main__":
    from benchmarks import scale  # by its name: the workers import what they are sent from there

    sys.exit(scale.main(sys.argv[1:]))
