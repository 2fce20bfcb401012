"""``python -m tests.faults [--trials N] [--surveys N] [--seed K]``: the trials, with a table of what was struck."""

from __future__ import annotations

import argparse
import collections
import random
import sys
import tempfile
import time
from pathlib import Path

from ragg_runtime.cli.main import main as command_line

from . import surveys
from .injected import Fault, run
from .trials import COMMANDS, KINDS, Command, trial, warm


def undisturbed(command: Command, base: Path) -> float:
    """How long the command takes, s: the shortest of three times, or many kills would come too late."""
    spent = []
    for n in range(3):
        again = base / str(n)
        again.mkdir(parents=True)
        place = command.prepare(again)
        (again / "scratch").mkdir()
        began = time.monotonic()
        ended = run(command.arguments(place), Fault("none"), again / "scratch", command_line)
        spent.append(time.monotonic() - began)
        assert ended.status == 0, ended.said
    return min(spent)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=188, help="of add, remove and derive")
    parser.add_argument("--surveys", type=int, default=12, help="trials of survey, which take longer")
    parser.add_argument("--seed", type=int, default=0)
    a = parser.parse_args()
    chance = random.Random(a.seed)
    counts: collections.Counter[tuple[str, str, str]] = collections.Counter()
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)  # another user must be able to reach it
        warm()
        spent = {c.name: undisturbed(c, Path(folder) / c.name) for c in COMMANDS}
        for n in range(a.trials):
            command = COMMANDS[n % len(COMMANDS)]
            # Half of the trials are kills at a random moment: what nobody thought of.
            kind = "kill at" if n % 2 else KINDS[1 + n // 2 % (len(KINDS) - 1)]
            base = Path(folder) / f"trial-{n}"
            base.mkdir()
            outcome = trial(command, kind, base, chance, spent[command.name])
            how = f"struck, {outcome.state}" if outcome.ended.struck or outcome.ended.status else "not struck"
            counts[command.name, kind, how] += 1
            for wrong in outcome.wrong:
                failed += 1
                print(f"trial {n}: {command.name}, {outcome.fault}: {wrong}", flush=True)
        if a.surveys:
            base = Path(folder) / "surveys"
            base.mkdir()
            place = surveys.made(base)
            for n in range(a.surveys):
                kind = surveys.KINDS[n % len(surveys.KINDS)]
                how, found = surveys.trial(place, kind, n, chance)
                counts["survey", kind, how] += 1
                failed += len(found)
                for wrong in found:
                    print(f"survey {n}: {kind}: {wrong}", flush=True)
    print(f"{'command':8} {'fault':10} {'state found':14} trials")
    for (name, kind, how), count in sorted(counts.items()):
        print(f"{name:8} {kind:10} {how:14} {count:4}")
    print(f"{a.trials + a.surveys} trials, {failed} failures (seed {a.seed})")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
