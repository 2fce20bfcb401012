"""Run the benchmarks of speed: all, or those named; a run of all writes the tables of ``docs/contributors/benchmarks.md``."""

from __future__ import annotations

import argparse
import importlib
import math
import multiprocessing
import os
import pkgutil
import platform
import subprocess
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from importlib import metadata
from pathlib import Path
from types import ModuleType

import benchmarks
from benchmarks import Row

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "contributors" / "benchmarks.md"
TABLES = "Measured on: "
"""Where the tables begin on the page; what is above is written by hand."""


def find_benchmarks() -> Mapping[str, ModuleType]:
    """Modules of this package that have a function ``run``, by name."""
    names = sorted(m.name for m in pkgutil.iter_modules(benchmarks.__path__) if not m.name.startswith("_"))
    found = {name: importlib.import_module(f"benchmarks.{name}") for name in names}
    return {name: module for name, module in found.items() if callable(getattr(module, "run", None))}


def describe_machine() -> str:
    """Commit, processor, cores, vector instructions, system, Python and packages; nothing that names a host."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text("utf-8").split("\n\n", 1)[0].splitlines() if info.exists() else []
    cpu = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}
    flags = cpu.get("flags", cpu.get("Features", "")).split()
    words = ["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"]
    versions = " ".join(f"{name} {metadata.version(name)}" for name in ("numpy", "scipy", "sympy"))
    return (
        f"commit {subprocess.run(words, capture_output=True, text=True, check=False).stdout.strip()}; "
        f"processor {cpu.get('model name', platform.machine())}; cores {os.cpu_count()}; vector instructions "
        f"{' '.join(v for v in ('avx512f', 'avx2', 'avx', 'sse4_2', 'asimd', 'sve') if v in flags)}; "
        f"system {platform.system()} {platform.machine()}; Python {platform.python_version()}; {versions}."
    )


def number(value: float) -> str:
    """Three digits, without an exponent where that can be helped."""
    if not math.isfinite(value) or value == 0:
        return str(value)
    digits = max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{value:,.{digits}f}" if digits <= 8 else f"{value:.2e}"


def write_table(rows: Sequence[Row]) -> str:
    """Rows in Markdown: value, quartiles, what it is held against, a note."""
    lines = ["| what | value | quartiles | target | |", "|---|---:|---|---|---|"]
    for r in rows:
        spread = "" if math.isnan(r.low) else f"{number(r.low)} to {number(r.high)}"
        lines.append(f"| {r.name} | {number(r.value)} {r.unit} | {spread} | {r.target} | {r.note} |")
    return "\n".join(lines)


def measure(name: str, module: ModuleType) -> str:
    """The section of a benchmark, which runs in a process of its own."""
    title = (module.__doc__ or name).splitlines()[0]
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        try:
            found = write_table(pool.submit(module.run).result())
        except Exception as error:
            found = f"Failed: {type(error).__name__}: {error}."
    return f"### {name}\n\n{title}\n\n{found}\n"


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    known = find_benchmarks()
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"{', '.join(known)}; none: all of them")
    names = parser.parse_args(arguments).names
    if unknown := [a for a in names if a not in known]:
        print(f"unknown benchmark: {', '.join(unknown)}; known: {', '.join(known)}", file=sys.stderr)
        return 2
    sections = []
    for name in names or known:
        sections.append(measure(name, known[name]))
        print(sections[-1], flush=True)
    if not names:
        by_hand = PAGE.read_text("utf-8").partition(TABLES)[0]
        PAGE.write_text("\n".join([by_hand + TABLES + describe_machine(), "", *sections]), "utf-8")
        print(f"written: {PAGE.relative_to(ROOT)}", file=sys.stderr)
    return int(any("\nFailed: " in s for s in sections))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
