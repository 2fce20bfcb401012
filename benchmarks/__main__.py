"""Run the benchmarks of this package: all, or those named; tables, ``build/bench.json``, ``docs/benchmarks.md``."""

from __future__ import annotations

import argparse
import importlib
import json
import os
import pkgutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from types import ModuleType
from typing import Any

import benchmarks
from benchmarks import Row, machine, page

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "build" / "bench.json"
PAGE = ROOT / "docs" / "benchmarks.md"


def modules() -> Mapping[str, ModuleType]:
    """Modules of this package that have a function ``run``, by name."""
    names = sorted(m.name for m in pkgutil.iter_modules(benchmarks.__path__) if not m.name.startswith("_"))
    found = {name: importlib.import_module(f"benchmarks.{name}") for name in names}
    return {name: module for name, module in found.items() if callable(getattr(module, "run", None))}


def measure(name: str, module: ModuleType) -> dict[str, Any]:
    """One benchmark in a process of its own: its rows, or how it failed."""
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "rows.json"
        environment = {**os.environ, **getattr(module, "ENVIRONMENT", {})}
        command = [sys.executable, "-m", "benchmarks", name, "--rows", str(file)]
        done = subprocess.run(command, cwd=ROOT, env=environment, stdout=sys.stderr, check=False)
        if done.returncode:
            return {"failed": f"exit status {done.returncode}", "rows": []}
        rows = json.loads(file.read_text("utf-8"))
    return {"seconds": round(time.perf_counter() - start, 1), "rows": rows}


def rows_of(result: Mapping[str, Any]) -> list[Row]:
    return [Row(**r) for r in result["rows"]]


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
    failed = []
    for name in options.names or known:
        print(f"... {name}", file=sys.stderr, flush=True)
        results[name] = {**measure(name, known[name]), "load": round(machine.load(), 2)}
        if "failed" in results[name]:
            failed.append(name)
            print(f"{name}: {results[name]['failed']}", file=sys.stderr)
            continue
        print(f"{name}\n{page.text(rows_of(results[name]))}\n", flush=True)
    RESULTS.parent.mkdir(exist_ok=True)
    everything = {"machine": machine.describe(), "results": dict(sorted(results.items()))}
    RESULTS.write_text(json.dumps(everything, indent=1) + "\n", "utf-8")
    if not options.names:
        titles = {n: (m.__doc__ or n).splitlines()[0] for n, m in known.items()}
        PAGE.write_text(page.page(everything, titles), "utf-8")
        print(f"written: {PAGE.relative_to(ROOT)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
