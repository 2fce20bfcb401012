"""Run the benchmarks of this package: all, or those named; tables, ``build/bench.json``, ``docs/contributors/benchmarks.md``."""

from __future__ import annotations

import argparse
import importlib
import json
import math
import multiprocessing
import os
import pkgutil
import platform
import subprocess
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from importlib import metadata
from pathlib import Path
from types import ModuleType
from typing import Any

import benchmarks
from benchmarks import Row

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "build" / "bench.json"
PAGE = ROOT / "docs" / "contributors" / "benchmarks.md"
TABLES = "Measured on: "
"""Where the tables begin on the page; what is above is written by hand."""


def find_benchmarks() -> Mapping[str, ModuleType]:
    """Modules of this package that have a function ``run``, by name."""
    names = sorted(m.name for m in pkgutil.iter_modules(benchmarks.__path__) if not m.name.startswith("_"))
    found = {name: importlib.import_module(f"benchmarks.{name}") for name in names}
    return {name: module for name, module in found.items() if callable(getattr(module, "run", None))}


def measure(module: ModuleType) -> dict[str, Any]:
    """One benchmark in a process of its own: its rows, or how it failed."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        try:
            return {"rows": [asdict(r) for r in pool.submit(module.run).result()]}
        except Exception as error:
            return {"failed": f"{type(error).__name__}: {error}", "rows": []}


def describe_machine() -> dict[str, str]:
    """Commit, processor, cores, vector instructions, system, Python and packages; nothing that names a host."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").split("\n\n", 1)[0].splitlines()
    except OSError:
        lines = []
    cpu = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}
    flags = cpu.get("flags", cpu.get("Features", "")).split()
    words = ["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"]
    return {
        "commit": subprocess.run(words, capture_output=True, text=True, check=False).stdout.strip(),
        "processor": cpu.get("model name", platform.machine()),
        "cores": str(os.cpu_count()),
        "vector instructions": " ".join(
            v for v in ("avx512f", "avx2", "avx", "sse4_2", "asimd", "sve") if v in flags
        ),
        "clock": f"{float(cpu.get('cpu MHz', 'nan')) / 1e3:.2f} GHz",
        "system": f"{platform.system()} {platform.machine()}",
        "Python": platform.python_version(),
        **{name: metadata.version(name) for name in ("numpy", "scipy", "sympy")},
    }


def number(value: float) -> str:
    """Three digits, without an exponent where that can be helped."""
    if not math.isfinite(value) or value == 0:
        return str(value)
    digits = max(0, 2 - math.floor(math.log10(abs(value))))
    return f"{value:,.{digits}f}" if digits <= 8 else f"{value:.2e}"


def text(rows: Sequence[Row]) -> str:
    """Rows as lines for a terminal."""
    width = max((len(r.name) for r in rows), default=0)
    lines = []
    for r in rows:
        spread = "" if math.isnan(r.low) else f"{number(r.low)} ... {number(r.high)}"
        extra = "; ".join(p for p in (spread, r.note, r.target) if p)
        lines.append(f"  {r.name:<{width}}  {number(r.value):>10} {r.unit:<9} {extra}".rstrip())
    return "\n".join(lines)


def page(everything: Mapping[str, Any], titles: Mapping[str, str]) -> str:
    """The tables of the documentation: values and targets; spreads and notes are in the JSON."""
    lines = [TABLES + "; ".join(f"{k} {v}" for k, v in everything["machine"].items()) + ".", ""]
    for name, result in everything["results"].items():
        lines += [f"### {name}", "", titles.get(name, ""), ""]
        if "failed" in result:
            lines += [f"Failed: {result['failed']}.", ""]
            continue
        rows = [Row(**x) for x in result["rows"]]
        lines += ["| what | value | target |", "|---|---:|---|"]
        lines += [*(f"| {r.name} | {number(r.value)} {r.unit} | {r.target} |" for r in rows), ""]
    return "\n".join(lines)


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    known = find_benchmarks()
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"{', '.join(known)}; none: all of them")
    names = parser.parse_args(arguments).names
    if unknown := [a for a in names if a not in known]:
        print(f"unknown benchmark: {', '.join(unknown)}; known: {', '.join(known)}", file=sys.stderr)
        return 2
    results: dict[str, Any] = {}
    if RESULTS.exists():
        results = {n: r for n, r in json.loads(RESULTS.read_text("utf-8"))["results"].items() if n in known}
    for name in names or known:
        print(f"... {name}", file=sys.stderr, flush=True)
        results[name] = measure(known[name])
        print(f"{name}\n{text([Row(**r) for r in results[name]['rows']])}\n", flush=True)
    RESULTS.parent.mkdir(exist_ok=True)
    everything = {"machine": describe_machine(), "results": dict(sorted(results.items()))}
    RESULTS.write_text(json.dumps(everything, indent=1) + "\n", "utf-8")
    if not names:
        titles = {n: (m.__doc__ or n).splitlines()[0] for n, m in known.items()}
        by_hand = PAGE.read_text("utf-8").partition(TABLES)[0]
        PAGE.write_text(by_hand + page(everything, titles), "utf-8")
        print(f"written: {PAGE.relative_to(ROOT)}", file=sys.stderr)
    failed = [f"{n}: {results[n]['failed']}" for n in names or known if "failed" in results[n]]
    print(*failed, sep="\n", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
