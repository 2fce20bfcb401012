"""Fuzz the readers: ``python -m tests.fuzz [TARGET ...] [--executions N] [--seconds S] [--seed K]``.

Each target runs in a process of its own, so that a crash of a library is a finding too. Atheris (coverage
guided, ``pip install atheris``) is used where it is installed; without it, or with ``--mutate``, seeded
mutations of the corpus. A finding is written to ``fuzz-findings/`` and ends with status 1.
``--campaign N`` runs N seeded executions over all targets, in batches; cut off, it goes on where it was.
"""

from __future__ import annotations

import argparse
import faulthandler
import gc
import importlib.util
import re
import resource
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

from . import campaign, seeds
from .mutate import mutants

FINDINGS = Path("fuzz-findings")
NAMES = tuple(campaign.BATCH)
MEMORY = 6 << 30  # bytes of address space: what wants more is a bomb that went off
SLOWEST = 20.0  # s, one execution
SLOWEST_MODEL = 120.0  # s, where one is derived and compiled


def mutate(name: str, executions: int, seconds: float, seed: int) -> int:
    """Run a target on mutants; prints the count, returns the number of findings."""
    from .targets import TARGETS

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    warnings.simplefilter("error")  # a warning is as good as a traceback to who sees it
    faulthandler.enable()
    gc.collect()
    gc.freeze()  # the reader of NetCDF collects garbage after each damaged file
    target, began, done, read, found = TARGETS[name], time.monotonic(), 0, 0, 0
    last = FINDINGS / f"{name}-last"
    FINDINGS.mkdir(exist_ok=True)
    seen: set[str] = set()
    for data in mutants(list(seeds.corpus(name).values()), seed):
        if done >= executions or time.monotonic() - began > seconds:
            break
        if name in ("flight_parquet", "flight_netcdf"):
            last.write_bytes(data)  # these libraries may take the process with them
        start = time.monotonic()
        try:
            read += target(data) == "read"
            if time.monotonic() - start > (SLOWEST_MODEL if name == "generated_model" else SLOWEST):
                raise TimeoutError(f"{time.monotonic() - start:.0f} s")
        except Exception as error:
            place = traceback.extract_tb(error.__traceback__)[-1]
            kind = f"{type(error).__name__} in {Path(place.filename).name}:{place.lineno}"
            if kind not in seen:
                seen.add(kind)
                found += 1
                file = FINDINGS / f"{name}-{seed}-{done}"
                file.write_bytes(data)
                print(f"{name}: {kind}: {str(error)[:200]}\n  {file}", flush=True)
                traceback.print_exc(limit=-4)
        done += 1
    last.unlink(missing_ok=True)
    spent = time.monotonic() - began
    print(
        f"{name}: {done} executions in {spent:.0f} s (mutation, seed {seed}), {read} read, {found} findings"
    )
    return found


def guided(name: str, executions: int, seconds: float, seed: int) -> None:
    """Run a target under atheris; does not return."""
    import atheris

    with atheris.instrument_imports(include=["derive", "ragg_runtime", "tomllib", "tomlkit", "pint"]):
        from .targets import TARGETS
    target = TARGETS[name]
    warnings.simplefilter("error")
    FINDINGS.mkdir(exist_ok=True)
    words = FINDINGS / "words.txt"
    words.write_text("".join(f'"{_escaped(w)}"\n' for w in _words()))
    grown = tempfile.mkdtemp(prefix="corpus-")
    arguments = [
        sys.argv[0],
        f"-runs={executions}",
        f"-max_total_time={int(seconds)}",
        f"-seed={seed + 1}",
        f"-dict={words}",
        f"-artifact_prefix={FINDINGS}/{name}-",
        f"-timeout={int(SLOWEST)}",
        "-rss_limit_mb=6000",
        "-max_len=4096",
        "-print_final_stats=1",
        grown,
        str(seeds.CORPUS / name),
    ]
    atheris.Setup(arguments, lambda data: target(data) and None)
    atheris.Fuzz()


def _words() -> list[bytes]:
    from .mutate import WORDS

    return [w for w in WORDS if 0 < len(w) < 60]


def _escaped(word: bytes) -> str:
    return "".join(f"\\x{b:02x}" for b in word)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("targets", nargs="*", metavar="TARGET", help=", ".join(NAMES))
    parser.add_argument("--executions", type=int, default=1_000_000, help="of each target")
    parser.add_argument("--seconds", type=float, default=60.0, help="of each target; of a campaign, in all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument(
        "--mutate", action="store_true", help="seeded mutations even where atheris is installed"
    )
    parser.add_argument(
        "--campaign",
        type=int,
        metavar="N",
        help="N executions in all, resumable (fuzz-findings/campaign.json)",
    )
    parser.add_argument("--child", choices=["mutate", "guided"], help=argparse.SUPPRESS)
    a = parser.parse_args()
    if a.child == "mutate":
        return int(mutate(a.targets[0], a.executions, a.seconds, a.seed) > 0)
    if a.child == "guided":
        guided(a.targets[0], a.executions, a.seconds, a.seed)
    if a.campaign is not None:
        names = tuple(a.targets) or NAMES
        return campaign.run(a.campaign, a.seconds, FINDINGS / "campaign.json", names)
    kind = "mutate" if a.mutate or importlib.util.find_spec("atheris") is None else "guided"
    bad, total = [], 0
    for name in a.targets or NAMES:
        command = [sys.executable, "-m", "tests.fuzz", name, "--child", kind, "--seed", str(a.seed)]
        command += ["--executions", str(a.executions), "--seconds", str(a.seconds)]
        run = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
        done = re.search(r"number_of_executed_units: (\d+)|(\d+) executions", run.stdout + run.stderr)
        count = int(done[1] or done[2]) if done else 0
        total += count
        print(f"{name}: {count} executions, {'no finding' if run.returncode == 0 else 'FOUND'}", flush=True)
        if run.returncode != 0:
            bad.append(name)
            said = run.stdout + run.stderr
            print(
                said[said.find("=== Uncaught") :][:6000] if "=== Uncaught" in said else said[-6000:],
                flush=True,
            )
    print(f"{total} executions in all ({kind}); findings in: {', '.join(bad) or 'none'}")
    return int(bool(bad))


if __name__ == "__main__":
    sys.exit(main())
