"""A survey that is killed, or whose disc is full: what was done is kept, and it continues to the same result."""

from __future__ import annotations

import contextlib
import io
import json
import os
import random
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ragg_runtime.cli.main import main
from ragg_runtime.flight import write_flight
from ragg_runtime.model_dir.directory import load_model_dir
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

from .injected import Fault, run

KINDS = ("kill at", "kill at", "full", "quota", "forbidden")


@dataclass(frozen=True)
class Place:
    """A model, two short flights, and the survey of them that nothing disturbed."""

    base: Path
    flights: tuple[Path, ...]
    records: Any
    spent: float

    def arguments(self, results: Path, answer: Path) -> list[str]:
        files = map(str, self.flights)
        return [
            "survey",
            str(self.base / "model"),
            *files,
            "--jobs",
            "1",
            "--resume",
            str(results),
            "--json",
            str(answer),
        ]


def made(base: Path) -> Place:
    """The place of all trials, in a folder that exists."""
    m = loop.new(base / "model")
    flights = []
    for seed in (1, 2):
        flights.append(base / f"{seed}.parquet")
        write_flight(simulated(m.instrument, [], seed=seed, duration=90.0, rate=16.0), flights[-1])
    (base / "scratch").mkdir()
    place = Place(base, tuple(flights), None, 0.0)
    # A refusal in this process first: a fork that becomes another user may not be able to import anything.
    with contextlib.redirect_stderr(io.StringIO()), contextlib.suppress(SystemExit):
        main(place.arguments(base / "nowhere" / "r.jsonl", base / "answer.json"))
    began = time.monotonic()
    answer = base / "answer.json"
    ended = run(place.arguments(base / "r.jsonl", answer), Fault("none"), base / "scratch", main)
    assert ended.status == 0, ended.said
    return Place(
        base, tuple(flights), json.loads(answer.read_text("utf-8"))["flights"], time.monotonic() - began
    )


def trial(place: Place, kind: str, number: int, chance: random.Random) -> tuple[str, list[str]]:
    """What became of the survey (done of two flights when the fault had struck), and what was wrong."""
    folder = place.base / f"survey-{number}"
    folder.mkdir()
    results, answer = folder / "r.jsonl", folder / "answer.json"
    arguments = place.arguments(results, answer)
    before = load_model_dir(place.base / "model").digest
    at = {"kill at": chance.uniform(0.0, 1.2 * place.spent), "quota": chance.randrange(4000)}
    fault = Fault(kind, at.get(kind, chance.randrange(1, 6)))
    if kind == "forbidden" and os.geteuid() != 0:
        folder.chmod(0o555)
    ended = run(arguments, fault, place.base / "scratch", main)
    folder.chmod(0o755)
    wrong = []
    if "Traceback" in ended.said or ended.status not in (0, 2, -9):
        wrong.append(f"status {ended.status}: {ended.said[-1500:]}")
    kept = results.read_bytes().count(b"\n") - 1 if results.exists() else 0
    again = run(arguments, Fault("none"), place.base / "scratch", main)
    if again.status != 0:
        wrong.append(f"it does not continue: {again.said[-1500:]}")
    elif json.loads(answer.read_text("utf-8"))["flights"] != place.records:
        wrong.append("it continues to another result")
    if load_model_dir(place.base / "model").digest != before:
        wrong.append("the model was changed")
    left = sorted(p.name for p in folder.iterdir() if p not in (results, answer))
    if left:
        wrong.append(f"left over: {left}")
    how = f"struck, {max(kept, 0)} done" if ended.struck or ended.status else "not struck"
    return how, wrong
