"""The machine a benchmark runs on: in words, and its bounds (memory traffic, arithmetic), measured."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Mapping
from importlib import metadata
from pathlib import Path

VECTORS = ("avx512f", "avx2", "avx", "sse4_2", "asimd", "sve")
PACKAGES = ("numpy", "scipy", "sympy")


def describe() -> Mapping[str, str]:
    """Processor, cores, vector instructions, memory, system, Python and packages; nothing that names a host."""
    cpu = _cpu()
    vectors = [v for v in VECTORS if v in cpu.get("flags", cpu.get("Features", "")).split()]
    return {
        "processor": cpu.get("model name", platform.machine()),
        "cores": str(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()),
        "vector instructions": " ".join(vectors) or "unknown",
        "clock": f"{float(cpu['cpu MHz']) / 1e3:.2f} GHz" if "cpu MHz" in cpu else "unknown",
        "last cache": _last_cache(),
        "system": f"{platform.system()} {platform.machine()}",
        "Python": platform.python_version(),
        **{name: metadata.version(name) for name in PACKAGES},
    }


def load() -> float:
    """Processes that wanted to run over the last minute: above the number of cores, times are not to be trusted."""
    return os.getloadavg()[0] if sys.platform != "win32" else float("nan")


def _cpu() -> dict[str, str]:
    try:
        text = Path("/proc/cpuinfo").read_text("utf-8")
    except OSError:
        return {}
    first = text.split("\n\n", 1)[0]
    pairs = (line.split(":", 1) for line in first.splitlines() if ":" in line)
    return {key.strip(): value.strip() for key, value in pairs}


def _last_cache() -> str:
    sizes = sorted(Path("/sys/devices/system/cpu/cpu0/cache").glob("index*/size"))
    return sizes[-1].read_text("utf-8").strip() if sizes else "unknown"
