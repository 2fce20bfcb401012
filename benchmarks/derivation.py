"""How long deriving takes: processor time (user and system) of a fresh process, start of the interpreter included."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from benchmarks import Row, at_most

ROOT = Path(__file__).resolve().parents[1]

MOST = 3.0
"""s CPU that deriving everything may take, cold."""


def cpu_seconds(arguments: Sequence[str], repeats: int = 1) -> float:
    """Smallest CPU time, s, of a fresh Python process with these arguments; it must succeed."""
    times = []
    for _ in range(repeats):
        process = subprocess.Popen([sys.executable, *arguments], cwd=ROOT, stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise RuntimeError(f"python {' '.join(arguments)}: exit status {process.returncode}")
        times.append(used.ru_utime + used.ru_stime)
    return min(times)


def run() -> list[Row]:
    """Cold derivation of everything, and of the harmonics alone."""
    start = cpu_seconds(["-c", "import sympy"], repeats=2)
    series = cpu_seconds(["-c", "from derive.propagation import collect; collect()"], repeats=3)
    with tempfile.TemporaryDirectory() as folder:
        whole = cpu_seconds(["-m", "ragg_runtime", "derive", "--out", folder])
    return [
        Row("start of Python and SymPy", start, "s CPU"),
        at_most("derive everything, cold", whole, "s CPU", MOST, "all models in Python, C, LaTeX"),
        Row("derive the harmonics, cold", series, "s CPU", "start included"),
    ]
