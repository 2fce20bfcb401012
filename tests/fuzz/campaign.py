"""A long campaign in batches: each is a target and a seed, in a process of its own; what is done is put down.

A batch that was done is not done again, so that a campaign goes on where it was cut off, and one that is repeated elsewhere
runs the same inputs. ``fuzz-findings/campaign.json`` holds, by commit, the batches, their executions and findings.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

BATCH = {
    "expression": 4000,
    "model_toml": 3000,
    "edited_toml": 3000,
    "mapping": 20_000,
    "history": 20_000,
    "unfinished": 8000,
    "calibration": 20_000,
    "flight_csv": 4000,
    "flight_parquet": 4000,
    "flight_netcdf": 100,
    "generated_model": 15,
}
"""Executions of a batch: some ten seconds of each target."""


def run(total: int, seconds: float, state: Path, targets: tuple[str, ...]) -> int:
    """Batches of each target in turn until ``total`` executions are done in all sessions together; 1 if anything was found.

    Stops after ``seconds``; the next call goes on.
    """
    state.parent.mkdir(parents=True, exist_ok=True)
    done: dict[str, Any] = json.loads(state.read_text("utf-8")) if state.exists() else {}
    own = done.setdefault(commit(), {name: [] for name in BATCH})
    began = time.monotonic()
    while count(own) < total and time.monotonic() - began < seconds:
        name = min(targets, key=lambda n: len(own[n]))
        own[name].append(batch(name, len(own[name])))
        state.write_text(json.dumps(done, indent=1) + "\n", "utf-8")
    for name in targets:
        executions = sum(b["executions"] for b in own[name])
        print(f"{name}: {executions} executions, {sum(b['findings'] for b in own[name])} findings")
    found = sum(b["findings"] for batches in own.values() for b in batches)
    left = max(0, total - count(own))
    print(
        f"{count(own)} executions of commit {commit()}, {found} findings"
        + (f"; {left} to go" if left else "")
    )
    return int(found > 0)


def batch(name: str, seed: int) -> dict[str, int]:
    """Run one batch; a child that dies has one finding."""
    command = [sys.executable, "-m", "tests.fuzz", name, "--child", "mutate", "--seed", str(seed)]
    command += ["--executions", str(BATCH[name]), "--seconds", "600"]
    child = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    told = re.search(r": (\d+) executions.* (\d+) findings", child.stdout)
    found = int(told[2]) if told else 1
    if found:
        print((child.stdout + child.stderr)[-6000:], flush=True)
    return {"seed": seed, "executions": int(told[1]) if told else 0, "findings": found}


def count(batches: dict[str, list[dict[str, int]]]) -> int:
    """Executions in all."""
    return sum(b["executions"] for one in batches.values() for b in one)


def commit() -> str:
    """The commit that is tried, with a + if files differ from it."""
    try:
        found = subprocess.run(
            ["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=True
        )
        changed = subprocess.run(["git", "diff", "--quiet", "HEAD"], check=False).returncode
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return found.stdout.strip() + ("+" if changed else "")
