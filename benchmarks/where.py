"""Where the processor time of a diagnosis goes, step by step: ``python -m benchmarks.where [FLIGHT ...]``.

Steps are functions of the program that are timed from outside; what a step takes is in the step that called it. It costs
the diagnosis next to nothing, unlike a profiler that listens to every call.
"""

from __future__ import annotations

import functools
import importlib
import os
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

STEPS = (
    "fit.fitted:fit",
    "fit.fitted:about",
    "fit.trust_region:minimise",
    "fit.noise:estimate_noise",
    "fit.left_over:left_over",
    "fit.linearise:linearised",
    "fit.passes:whitened_columns",
    "fit.unknown_gradient:windows",
    "fit.unknown_gradient:project",
    "fit.square_root:triangle",
    "diagnosis.step_scan:with_steps",
    "evidence.steps:best_steps",
    "evidence.selection:choose",
    "diagnosis.strong:_strongest",
    "diagnosis.contenders:left",
    "diagnosis.confirm:confirmed",
    "lack_of_fit.omnibus:search",
    "diagnosis.line_rival:line_rival",
    "diagnosis.ranking:_ranking",
    "diagnosis.credence:weighed",
    "diagnosis.next_motion:proposals",
)
LEAST = 0.02
"""Share of the whole below which a step is not shown."""

DEMONSTRATION = Path(__file__).resolve().parents[1] / "examples" / "demo-flight.parquet"

Path_ = tuple[str, ...]


def watched() -> tuple[Counter[Path_], Counter[Path_]]:
    """Seconds and calls of every step by the steps that it is within, counted from here on."""
    seconds: Counter[Path_] = Counter()
    calls: Counter[Path_] = Counter()
    within: list[str] = []

    def timed(function: Callable[..., Any], name: str) -> Callable[..., Any]:
        @functools.wraps(function)
        def wrapped(*arguments: Any, **options: Any) -> Any:
            within.append(name)
            begun = time.process_time()
            try:
                return function(*arguments, **options)
            finally:
                seconds[tuple(within)] += time.process_time() - begun
                calls[tuple(within)] += 1
                within.pop()

        return wrapped

    for step in STEPS:
        module, _, name = step.partition(":")
        original = getattr(importlib.import_module(f"ragg_runtime.{module}"), name)
        replaced = timed(original, step.rpartition(":")[0] + "." + name)
        for other in [m for k, m in list(sys.modules.items()) if k.startswith("ragg_runtime")]:
            for key, value in list(vars(other).items()):
                if value is original:
                    setattr(other, key, replaced)
    return seconds, calls


def main(flights: list[str]) -> None:
    """Diagnose once to compile and derive, once to measure, and print a table."""
    os.environ["RAGG_THREADS"] = "1"
    from ragg_runtime.workflow import loop

    with tempfile.TemporaryDirectory() as folder:
        m = loop.new(Path(folder) / "model")
        loop.diagnose(m, loop.read_flights(m, flights))
        seconds, calls = watched()
        read = loop.read_flights(m, flights)
        seconds.clear()
        calls.clear()
        begun = time.process_time()
        loop.diagnose(m, read)
        total = time.process_time() - begun
    print(f"| step | calls | s CPU |\n|---|---:|---:|\n| diagnose | 1 | {total:.2f} |")

    def show(above: Path_) -> None:
        below = [k for k in seconds if k[:-1] == above and seconds[k] > LEAST * total]
        for k in sorted(below, key=lambda k: -seconds[k]):
            indent = "&nbsp;" * 4 * len(k)
            print(f"| {indent}`{k[-1]}` | {calls[k]} | {seconds[k]:.2f} |")
            show(k)

    show(())


if __name__ == "__main__":
    main(sys.argv[1:] or [str(DEMONSTRATION)])
