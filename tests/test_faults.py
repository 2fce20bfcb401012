"""Commands that are cut off between any two files, or (``python -m tests.test_faults [--trials N] [--seed K]``) killed at random moments.

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
from typing import Any

import pytest

from ragg_runtime import api
from ragg_runtime.io import write_flight
from ragg_runtime.model.directory import load_model_dir
from ragg_runtime.simulate import simulate_flight
from tests.runtime.commands import ragg

SURVEY = ["survey", "model", "flight.parquet", "--jobs", "1", "--resume", "r.jsonl", "--json", "s.json"]
OLD = ([], ["new"], False)
COMMANDS = {
    "add": (["add", "model", "lag", "flight.parquet"], (["lag"], ["new", "add"], False)),
    "calibrate": (["calibrate", "model", "flight.parquet", "--save"], ([], ["new", "calibrate"], True)),
    "survey": (SURVEY, OLD),
    "compensate": (["compensate", "model", "flight.parquet", "-o", "out.csv"], OLD),
}
"""Name -> the command, and the state (effects, steps, calibrated) in which it leaves the model."""
ENVIRONMENT = os.environ | {
    "PYTHONPATH": str(Path(__file__).resolve().parents[1]),
    "OPENBLAS_NUM_THREADS": "1",
}


def prepared(base: Path) -> Path:
    """A folder with a model and a short flight."""
    m = api.new(base / "model")
    write_flight(simulate_flight(m.instrument, [], seed=1, duration=60.0, rate=8.0), base / "flight.parquet")
    return base


def run(arguments: Sequence[str], base: Path, seconds: float | None = None) -> tuple[int, str]:
    """Exit status and stderr of a command that is killed, with all its processes, after so many seconds."""
    with subprocess.Popen(
        [sys.executable, "-m", "ragg_runtime", *arguments], cwd=base, env=ENVIRONMENT, text=True,
        start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
    ) as process:  # fmt: skip
        try:
            stderr = process.communicate(timeout=seconds)[1]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            stderr = process.communicate()[1]
    return process.returncode, stderr[-1000:]


def state(base: Path) -> tuple[list[str], list[str], bool]:
    """Effects, steps, and whether a calibration is kept; raises UserError where anything is damaged."""
    d = load_model_dir(base / "model")
    return [e.id for e in d.instrument.effects], [s.action for s in d.history], d.calibration is not None


def trial(command: str, base: Path, seconds: float) -> tuple[str, str]:
    """What became of a killed command (``old``, ``new``), and what was wrong, if anything."""
    arguments, new = COMMANDS[command]
    status, stderr = run(arguments, base, seconds)
    after = state(base)
    if after not in (OLD, new) or (status == 0 and after != new) or status not in (0, -signal.SIGKILL):
        return "broken", f"{status}, {after}: {stderr}"
    undone = command == "add" and after == new
    status, stderr = run(["remove", "model", "lag"] if undone else arguments, base)
    effects = state(base)[0]
    if status != 0 or effects != ([] if undone else new[0]):
        return "broken", f"the next command: {status}, {effects}: {stderr}"
    if command == "survey":
        assert len(json.loads((base / "s.json").read_text("utf-8"))["flights"]) == 1
    left = [p.name for p in (base / "model").iterdir() if p.name.startswith(".")]
    return "new" if after == new != OLD else "old", ", ".join(left)


@pytest.mark.parametrize("command", ["add", "calibrate"])
def test_a_command_that_is_cut_off_leaves_the_old_or_the_new_model(command, tmp_path, monkeypatch) -> None:
    """What lies there whenever a file is put in place is kept, as a kill would leave it, and the command repeated."""
    base = prepared(tmp_path / "base")
    places: list[Path] = []
    arguments, new = COMMANDS[command]
    words = arguments[:3] if command == "add" else arguments  # an effect is added without a flight as well
    replace = os.replace

    def photographed(source: Any, target: Any) -> None:
        places.append(Path(shutil.copytree(base, tmp_path / f"cut-{len(places)}")))
        replace(source, target)

    monkeypatch.chdir(base)
    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", photographed)
        assert ragg(*words).returncode == 0
    assert state(base) == new
    assert len(places) >= 2
    assert all(state(p) in (OLD, new) for p in places)
    monkeypatch.chdir(places[1])  # the history is written, the file that it tells of is not
    assert state(places[1]) == OLD
    assert ragg(*words).returncode == 0
    assert state(places[1]) == new


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
                base = Path(shutil.copytree(start, Path(folder, command)))
                began = time.monotonic()
                assert run(COMMANDS[command][0], base)[0] == 0
                spent[command] = time.monotonic() - began
            base = Path(shutil.copytree(start, Path(folder, str(n))))
            found, wrong = trial(command, base, chance.uniform(0.3, 1.05) * spent[command])
            shutil.rmtree(base)
            counts[command, found] += 1
            failed += bool(wrong)
            if wrong:
                print(f"trial {n}: {command}: {wrong}", flush=True)
    for (command, found), count in sorted(counts.items()):
        print(f"{command:10} {found:6} {count:4}")
    print(f"{a.trials} trials, {failed} failures (seed {a.seed})", flush=True)
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
