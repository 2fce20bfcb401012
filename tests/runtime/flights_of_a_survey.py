"""A model directory and small flights for the tests of the survey."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from ragg_runtime import api
from ragg_runtime.io import write_flight
from ragg_runtime.simulate import simulate_flight
from ragg_runtime.survey.examine import Job, Record, examine

HIDDEN = "thermal-scale:dK1_dT=0/0/6e-7/0"
COUNT = 3
WITH_EFFECT = ("flight-0.parquet",)


def make(folder: Path) -> tuple[Path, list[Path]]:
    """Three flights of 150 s at 8 Hz, an effect hidden in one of them, and a damaged file after them."""
    m = api.new(folder / "model")
    paths = []
    for k in range(COUNT):
        path = folder / f"flight-{k}.parquet"
        hidden = [HIDDEN] if path.name in WITH_EFFECT else []
        write_flight(simulate_flight(m.instrument, hidden, seed=k + 50, duration=150.0, rate=8.0), path)
        paths.append(path)
    damaged = folder / "flight-2b.parquet"
    shutil.copy(paths[1], damaged)
    damaged.write_bytes(damaged.read_bytes()[:5000])
    return folder / "model", [*paths, damaged]


def without_effect(paths: list[Path]) -> list[Path]:
    """Those that are diagnosed soonest: no effect to derive, the damaged file among them."""
    return [p for p in paths if p.name not in WITH_EFFECT]


def in_process(job: Job, files: Sequence[str], *_: object) -> Iterator[tuple[str, Record]]:
    """Stands in for a pool, whose processes would import everything anew: for what is not about the pool."""
    return ((f, examine(job, f)) for f in files)


def lines_of(path: Path) -> list[Any]:
    """Every complete line of a results file."""
    text = path.read_bytes()
    return [json.loads(line) for line in text[: text.rfind(b"\n") + 1].splitlines()]
