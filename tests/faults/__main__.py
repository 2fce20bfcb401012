"""``python -m tests.faults [--trials N] [--seed K]``: add, calibrate --save, survey and compensate, killed at random moments.

After each: model.toml and history.json are the old or the new ones, whole, and the next command works.
"""

from __future__ import annotations

import argparse
import collections
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from ragg_runtime.flight import write_flight
from ragg_runtime.model_dir.directory import load_model_dir
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

COMMANDS = {
    "add": ["add", "model", "cubic-input", "flight.parquet"],
    "calibrate": ["calibrate", "model", "flight.parquet", "--save"],
    "survey": [
        "survey",
        "model",
        "flight.parquet",
        "--jobs",
        "1",
        "--resume",
        "results.jsonl",
        "--json",
        "s.json",
    ],
    "compensate": ["compensate", "model", "flight.parquet", "-o", "out.csv"],
}
ROOT = Path(__file__).resolve().parents[2]
RAGG = [sys.executable, "-m", "ragg_runtime"]
ENVIRONMENT = os.environ | {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}


def prepared(base: Path) -> Path:
    """A folder with a model and a short flight."""
    m = loop.new(base / "model")
    write_flight(simulated(m.instrument, [], seed=1, duration=90.0, rate=16.0), base / "flight.parquet")
    return base


def run(arguments: Sequence[str], base: Path, seconds: float | None = None) -> tuple[int, str]:
    """Exit status and stderr of a command that is killed, with all its processes, after so many seconds."""
    process = subprocess.Popen(
        [*RAGG, *arguments], cwd=base, env=ENVIRONMENT, text=True, start_new_session=True,
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
    )  # fmt: skip
    try:
        said = process.communicate(timeout=seconds)[1]
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        said = process.communicate()[1]
    return process.returncode, said


def state(base: Path) -> tuple[list[str], list[str], bool]:
    """Effects, steps, and whether a calibration is kept; raises UserError where anything is damaged."""
    d = load_model_dir(base / "model")
    return [e.id for e in d.instrument.effects], [s.action for s in d.history], d.calibration is not None


NEW = {
    "add": (["cubic-input"], ["new", "add"], False),
    "calibrate": ([], ["new", "calibrate"], True),
    "survey": ([], ["new"], False),
    "compensate": ([], ["new"], False),
}
OLD = ([], ["new"], False)


def trial(command: str, start: Path, base: Path, seconds: float) -> tuple[str, str]:
    """What became of a killed command (``old``, ``new``), and what was wrong, if anything."""
    shutil.copytree(start, base)
    status, said = run(COMMANDS[command], base, seconds)
    found = state(base)
    if found not in (OLD, NEW[command]) or status not in (0, -signal.SIGKILL):
        return "broken", f"{status}, {found}: {said[-1000:]}"
    if status == 0 and found != NEW[command]:
        return "broken", "it said that it was done, and it was not"
    undo = command == "add" and found == NEW["add"]
    status, said = run(["remove", "model", "cubic-input"] if undo else COMMANDS[command], base)
    effects = state(base)[0]
    wrong = ""
    if status != 0 or (effects != [] if undo else effects != NEW[command][0]):
        wrong = f"the next command: {status}, {effects}: {said[-1000:]}"
    if command == "survey":
        json.loads((base / "s.json").read_text("utf-8"))
    left = [p.name for p in (base / "model").iterdir() if p.name.startswith(".")]
    shutil.rmtree(base)
    return "new" if found == NEW[command] != OLD else "old", wrong or ", ".join(left)


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    a = parser.parse_args(arguments)
    chance, failed = random.Random(a.seed), 0
    counts: collections.Counter[tuple[str, str]] = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        start, spent = prepared(Path(folder, "start")), {}
        for n in range(a.trials):
            command = list(COMMANDS)[n % len(COMMANDS)]
            if command not in spent:
                began = time.monotonic()
                shutil.copytree(start, Path(folder, command))
                assert run(COMMANDS[command], Path(folder, command))[0] == 0
                spent[command] = time.monotonic() - began
            found, wrong = trial(
                command, start, Path(folder, str(n)), chance.uniform(0.3, 1.05) * spent[command]
            )
            counts[command, found] += 1
            failed += bool(wrong)
            if wrong:
                print(f"trial {n}: {command}: {wrong}", flush=True)
    for (command, found), count in sorted(counts.items()):
        print(f"{command:10} {found:6} {count:4}")
    print(f"{a.trials} trials, {failed} failures (seed {a.seed})")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
