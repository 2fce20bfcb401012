"""Run the benchmarks of this package: all, or those named; tables, ``build/bench.json``, ``docs/contributors/benchmarks.md``."""

from __future__ import annotations

import argparse
import importlib
import json
import math
import os
import pkgutil
import platform
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
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
HEAD = """\
# Benchmarks

Measure before and after a change that may matter.

| command | measures | takes |
|---|---|---|
| `make bench` | speed: the tables below; `python -m benchmarks NAME` measures one | 10 to 20 minutes |
| `make bench-diagnosis` | the diagnosis on 720 simulated flights, compared flight by flight with the reference | an hour |
| `python -m benchmarks.diagnosis --ablate` | the diagnosis with one rule after the other switched off | hours, resumable |
| `python -m examples.mimu.elsewhere RAW.bin.gz` | 44 questions about recordings of real sensors | minutes |
| `python -m benchmarks.compensation` | the gain of the compensation | minutes |
| `make faults` | 100 commands killed at random moments | minutes |

[Results of the diagnosis](../_made/benchmark.md) are shown when the site is built.

## Speed

Written by `make bench`: medians; spreads and notes are in `build/bench.json`.
Competitors are timed alternately in one process, and ratios are taken round by round.
"""


def modules() -> Mapping[str, ModuleType]:
    """Modules of this package that have a function ``run``, by name."""
    names = sorted(m.name for m in pkgutil.iter_modules(benchmarks.__path__) if not m.name.startswith("_"))
    found = {name: importlib.import_module(f"benchmarks.{name}") for name in names}
    return {name: module for name, module in found.items() if callable(getattr(module, "run", None))}


def measure(name: str, module: ModuleType) -> dict[str, Any]:
    """One benchmark in a process of its own: its rows, or how it failed."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "rows.json"
        environment = {**os.environ, **getattr(module, "ENVIRONMENT", {})}
        command = [sys.executable, "-m", "benchmarks", name, "--rows", str(file)]
        done = subprocess.run(command, cwd=ROOT, env=environment, stdout=sys.stderr, check=False)
        if done.returncode:
            return {"failed": f"exit status {done.returncode}", "rows": []}
        return {"rows": json.loads(file.read_text("utf-8"))}


def describe_machine() -> dict[str, str]:
    """Commit, processor, cores, vector instructions, system, Python and packages; nothing that names a host."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").split("\n\n", 1)[0].splitlines()
    except OSError:
        lines = []
    cpu = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}
    flags = cpu.get("flags", cpu.get("Features", "")).split()
    vectors = [v for v in ("avx512f", "avx2", "avx", "sse4_2", "asimd", "sve") if v in flags]
    words = ["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"]
    commit = subprocess.run(words, capture_output=True, text=True, check=False).stdout.strip()
    caches = sorted(Path("/sys/devices/system/cpu/cpu0/cache").glob("index*/size"))
    return {
        "commit": commit or "unknown",
        "processor": cpu.get("model name", platform.machine()),
        "cores": str(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()),
        "vector instructions": " ".join(vectors) or "unknown",
        "clock": f"{float(cpu['cpu MHz']) / 1e3:.2f} GHz" if "cpu MHz" in cpu else "unknown",
        "last cache": caches[-1].read_text("utf-8").strip() if caches else "unknown",
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


def _target(r: Row) -> str:
    return f"{r.target or ''}{'' if r.met is None else ': met' if r.met else ': not met'}"


def text(rows: Sequence[Row]) -> str:
    """Rows as lines for a terminal."""
    width = max((len(r.name) for r in rows), default=0)
    lines = []
    for r in rows:
        spread = "" if r.low is None or r.high is None else f"{number(r.low)} ... {number(r.high)}"
        extra = "; ".join(p for p in (spread, r.note, _target(r)) if p)
        lines.append(f"  {r.name:<{width}}  {number(r.value):>10} {r.unit:<9} {extra}".rstrip())
    return "\n".join(lines)


def page(everything: Mapping[str, Any], titles: Mapping[str, str]) -> str:
    """The page of the documentation: values and targets; spreads and notes are in the JSON."""
    lines = [
        HEAD,
        "Measured on: " + "; ".join(f"{k} {v}" for k, v in everything["machine"].items()) + ".",
        "",
    ]
    for name, result in everything["results"].items():
        lines += [f"### {name}", "", titles.get(name, ""), ""]
        if "failed" in result:
            lines += [f"Failed: {result['failed']}.", ""]
            continue
        rows = [Row(**x) for x in result["rows"]]
        lines += ["| what | value | target |", "|---|---:|---|"]
        lines += [*(f"| {r.name} | {number(r.value)} {r.unit} | {_target(r)} |" for r in rows), ""]
    return "\n".join(lines)


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="benchmarks; none: all of them")
    parser.add_argument("--rows", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    known = modules()
    unknown = [a for a in options.names if a not in known]
    if unknown:
        print(f"unknown benchmark: {', '.join(unknown)}; known: {', '.join(known)}", file=sys.stderr)
        return 2
    if options.rows:  # the process of one benchmark
        rows = [asdict(r) for name in options.names for r in known[name].run()]
        options.rows.write_text(json.dumps(rows), "utf-8")
        return 0
    kept = json.loads(RESULTS.read_text("utf-8")) if RESULTS.exists() else {}
    results: dict[str, Any] = {n: r for n, r in kept.get("results", {}).items() if n in known}
    for name in options.names or known:
        print(f"... {name}", file=sys.stderr, flush=True)
        results[name] = measure(name, known[name])
        print(f"{name}\n{text([Row(**r) for r in results[name]['rows']])}\n", flush=True)
    RESULTS.parent.mkdir(exist_ok=True)
    everything = {"machine": describe_machine(), "results": dict(sorted(results.items()))}
    RESULTS.write_text(json.dumps(everything, indent=1) + "\n", "utf-8")
    if not options.names:
        titles = {n: (m.__doc__ or n).splitlines()[0] for n, m in known.items()}
        PAGE.write_text(page(everything, titles), "utf-8")
        print(f"written: {PAGE.relative_to(ROOT)}", file=sys.stderr)
    failed = [n for n in options.names or known if "failed" in results[n]]
    print(*(f"{n}: {results[n]['failed']}" for n in failed), sep="\n", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
