"""The figures of docs/trust.md, in one run of one command: ``python -m tests.promises`` (``make promises``).

Fuzzing is a campaign of the commit at hand, which goes on where it was cut off; the rest is run anew. Writes the table between
the markers of the page, with the commit; ``--print`` only shows it.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tests.fuzz import campaign

PAGE = Path(__file__).parents[1] / "docs" / "trust.md"
BEGIN, END = "<!-- figures: python -m tests.promises -->", "<!-- end of the figures -->"
STATE = Path("fuzz-findings/campaign.json")
SEEDS = ("0", "12345")


def fuzzing(executions: int, seconds: float) -> str:
    campaign.run(executions, seconds, STATE, tuple(campaign.BATCH))
    every = json.loads(STATE.read_text("utf-8"))
    own = every[campaign.commit()]
    each = ", ".join(f"{n} {sum(b['executions'] for b in own[n]):,}" for n in campaign.BATCH)
    found = sum(b["findings"] for batches in own.values() for b in batches)
    return f"{campaign.count(own):,} executions, {found} findings ({each})"


def faults(trials: int, surveys: int) -> subprocess.Popen[str]:
    """Begun beside the fuzzing, which takes as long: the commands that are struck wait for the disc."""
    command = [sys.executable, "-m", "tests.faults", "--trials", str(trials), "--surveys", str(surveys)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)


def ended(process: subprocess.Popen[str]) -> str:
    said, _ = process.communicate()
    if process.returncode:
        print(said, flush=True)
    last = (said.strip().splitlines() or ["nothing was said"])[-1]
    return f"{last} (exit status {process.returncode})"


def derivation() -> str:
    digests = set()
    for seed in SEEDS:
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, "-m", "ragg_runtime", "derive", "--out", folder]
            environment = os.environ | {"PYTHONHASHSEED": seed}
            subprocess.run(command, env=environment, check=True, capture_output=True)
            files = sorted(p for p in Path(folder).rglob("*") if p.is_file())
            content = b"".join(p.relative_to(folder).as_posix().encode() + p.read_bytes() for p in files)
            digests.add(hashlib.sha256(content).hexdigest())
    same = "the same bytes" if len(digests) == 1 else "DIFFERENT bytes"
    return f"{same} with hash seeds {' and '.join(SEEDS)} (SHA-256 {min(digests)[:16]})"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--executions", type=int, default=1_000_000)
    parser.add_argument("--seconds", type=float, default=1e9, help="for fuzzing")
    parser.add_argument("--trials", type=int, default=160)
    parser.add_argument("--surveys", type=int, default=40)
    parser.add_argument("--print", action="store_true", dest="show")
    a = parser.parse_args()
    began = time.strftime("%Y-%m-%d", time.gmtime())
    struck = faults(a.trials, a.surveys)
    rows = {
        "fuzzing": fuzzing(a.executions, a.seconds),
        "faults": ended(struck),
        "`ragg derive`": derivation(),
    }
    python = ".".join(map(str, sys.version_info[:2]))
    table = [f"Commit {campaign.commit()}, {began}, Python {python}.", "", "| what | measured |", "|---|---|"]
    text = "\n".join([*table, *(f"| {k} | {v} |" for k, v in rows.items())])
    print(text)
    if not a.show:
        page = PAGE.read_text("utf-8")
        head, rest = page.split(BEGIN)
        PAGE.write_text(f"{head}{BEGIN}\n{text}\n{END}{rest.split(END)[1]}", "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
