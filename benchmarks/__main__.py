"""Run the measurements of this package: all, or those named."""

from __future__ import annotations

import importlib
import json
import pkgutil
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from types import ModuleType

import benchmarks
from benchmarks import Row

RESULTS = Path(__file__).with_name("results")


def modules() -> Mapping[str, ModuleType]:
    """Modules of this package that have a function ``run``, by name."""
    names = sorted(m.name for m in pkgutil.iter_modules(benchmarks.__path__) if not m.name.startswith("_"))
    found = {name: importlib.import_module(f"benchmarks.{name}") for name in names}
    return {name: module for name, module in found.items() if callable(getattr(module, "run", None))}


def table(rows: Sequence[Row]) -> str:
    """Rows as lines of text."""
    width = max(len(r.name) for r in rows)
    lines = []
    for r in rows:
        target = f"  ({r.target})" if r.target else ""
        lines.append(f"  {r.name:<{width}}  {r.value:>12.4g} {r.unit:<8} {r.note}{target}".rstrip())
    return "\n".join(lines)


def main(arguments: Sequence[str]) -> int:
    known = modules()
    unknown = [a for a in arguments if a not in known]
    if unknown:
        print(f"unknown benchmark: {', '.join(unknown)}; known: {', '.join(known)}", file=sys.stderr)
        return 2
    RESULTS.mkdir(exist_ok=True)
    for name in arguments or known:
        print(f"... {name}", file=sys.stderr)
        rows = list(known[name].run())
        print(f"{name}\n{table(rows)}\n", flush=True)
        text = json.dumps([asdict(r) for r in rows], indent=1)
        (RESULTS / f"{name}.json").write_text(text + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
