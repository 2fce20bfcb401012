"""Run the benchmarks of speed: the usual, or those named; a run of the usual writes the tables of ``docs/contributors/benchmarks.md``."""

from __future__ import annotations

import argparse
import multiprocessing
import os
import platform
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from importlib import metadata
from pathlib import Path

from benchmarks import ROOT, commands, commit, evaluation, table

PAGE = ROOT / "docs" / "contributors" / "benchmarks.md"
TABLES = "Measured on: "  # where the tables begin on the page; what is above is written by hand
# Functions that return the rows of a table; their first line is what is said above it
BENCHMARKS = {"commands": commands.run, "day": commands.run_day, "evaluation": evaluation.run}
USUAL = ("commands", "evaluation")  # what runs if none is named: a day takes much longer


def describe_machine() -> str:
    """Commit, processor, cores, vector instructions, system, Python and packages; nothing that names a host."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text("utf-8").split("\n\n", 1)[0].splitlines() if info.exists() else []
    cpu = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}
    flags = cpu.get("flags", cpu.get("Features", "")).split()
    versions = " ".join(f"{name} {metadata.version(name)}" for name in ("numpy", "scipy", "sympy"))
    return (
        f"commit {commit()}; processor {cpu.get('model name', platform.machine())}; cores {os.cpu_count()}; vector instructions "
        f"{' '.join(v for v in ('avx512f', 'avx2', 'avx', 'sse4_2', 'asimd', 'sve') if v in flags)}; "
        f"system {platform.system()} {platform.machine()}; Python {platform.python_version()}; {versions}."
    )


def measure(name: str) -> str:
    """The section of a benchmark, which runs in a process of its own."""
    run = BENCHMARKS[name]
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        try:
            rows = pool.submit(run).result()
            text = table(("what", "value", "target"), (r.cells() for r in rows), right=[1])
        except Exception as error:
            text = f"Failed: {type(error).__name__}: {error}."
    return f"### {name}\n\n{(run.__doc__ or name).splitlines()[0]}\n\n{text}\n"


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    known, usual = ", ".join(BENCHMARKS), ", ".join(USUAL)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"{known}; none: {usual}")
    names = parser.parse_args(arguments).names
    if unknown := [a for a in names if a not in BENCHMARKS]:
        parser.error(f"unknown benchmark: {', '.join(unknown)}; known: {known}")
    sections = []
    for name in names or USUAL:
        sections.append(measure(name))
        print(sections[-1], flush=True)
    if not names:
        by_hand = PAGE.read_text("utf-8").partition(TABLES)[0]
        PAGE.write_text("\n".join([by_hand + TABLES + describe_machine(), "", *sections]), "utf-8")
        print(f"written: {PAGE.relative_to(ROOT)}", file=sys.stderr)
    return int(any("\nFailed: " in s for s in sections))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
