"""How long evaluating the analytical model takes, a sample, on one core: ours, other ways, and the machine's bounds.

A million samples, all fifteen channels as series ("streaming": everything comes from memory), and some
thousand again and again ("in cache"). Processor time of a process held to one core, calls from Python
included; all get series that begin at multiples of 64 bytes. The rivals (``benchmarks/rivals.py``) are timed in
turn with us. What each yields is compared with the 50-digit value first: the rivals form omega t in float64
and lose there.
"""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Callable, Mapping
from typing import Any

from benchmarks import RATIO, Row
from benchmarks.rivals import aligned
from benchmarks.timing import Timing, interleaved, ratio

ENVIRONMENT = {
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false",
    "CUDA_VISIBLE_DEVICES": "",
    "JAX_PLATFORMS": "cpu",
}
STREAMING, IN_CACHE = 1_000_000, 16_000
START, RATE = 1e4, 100.0  # s, Hz
OURS, OURS_NUMPY = "generated C, compiled", "generated NumPy"
TARGETS: Mapping[str, tuple[float, float]] = {
    "heyoka cfunc": (1.4, 2.2), "JAX jit": (2.5, 2.5), "numba": (3.0, 3.0),
}  # fmt: skip
"""Rival -> at least so many times our time, streaming and in cache."""
NEAR = 1.3
"""Most times the memory bound that ours may take, streaming."""
GOALS: Mapping[str, tuple[float, float]] = {OURS: (15.0, 10.0), OURS_NUMPY: (350.0, 350.0)}
"""Largest time a sample, ns, on a machine of 2.5 GHz with AVX-512 and 11 GB/s."""
SLOW = ("SymPy lambdify", "NumPy in blocks", OURS_NUMPY)


def instrument_and_motion(n: int) -> tuple[Any, Any, Any]:
    """(t, inputs, p): Tables V and VI of the paper, at random; t from START s on."""
    import numpy as np

    from ragg_runtime.model.model import packaged

    draw = np.random.default_rng(5)
    arcsec, per_g, g = math.pi / 648000, 1e-6 / 9.8, 9.8
    sizes = {"dR": 35e-6, "K0": 10e-6 * g, "k_VI": 0.0, "K1": 1e-3 / g}
    middle = {"k_VI": 1e9, "K1": 11e-3 / g}
    p = [0.1, 0.25]
    for name, size in packaged().chain.PARAMETERS[2:]:
        spread = sizes.get(name, 20 * (per_g if name.startswith("K") else arcsec))
        p += list(middle.get(name, 0.0) + spread * draw.uniform(-1, 1, size))
    rate = 2000 * arcsec
    scale = [0.8, 0.8, 1.5, *[rate] * 3, *[rate * math.pi / 2] * 3, *[1e-6] * 6]
    inputs = draw.uniform(-1, 1, (15, n)) * np.array(scale)[:, None]
    return START + np.arange(n) / RATE, inputs, np.array(p)


def contenders(p: Any) -> tuple[dict[str, Callable[[Any, Any, Any], object]], dict[str, str]]:
    """Name -> (t, inputs, out) -> anything; and what is missing, with the reason."""
    from benchmarks import rivals
    from ragg_runtime.model.model import packaged

    compiled, blocks = packaged().compiled("c"), packaged().compiled("numpy")
    ours = {
        OURS: lambda t, x, out: compiled.output(t, x, p, out=out),
        OURS_NUMPY: lambda t, x, out: blocks.output(t, x, p, out=out),
    }
    others, missing = rivals.available(p)
    return {**ours, **others}, missing


def errors(p: Any, functions: Mapping[str, Callable[[Any, Any, Any], object]]) -> dict[str, float]:
    """Largest difference from the 50-digit value, Eo."""
    import numpy as np

    from benchmarks.rivals import result
    from tests.generated import fifty_digits as fifty

    t, x, _ = instrument_and_motion(40)
    q = fifty.exact(p)
    true = [fifty.output(s, fifty.exact(x[:, n]), q) for n, s in enumerate(fifty.exact(t))]
    scale = 1e-9 * float(np.sum(p[-4:] * p[30:34] * (p[0] + p[2:6])))
    found = {}
    for name, f in functions.items():
        out = np.empty(len(t))
        f(t, x, out)
        values = result(f, out)
        found[name] = (
            max(abs(float(fifty.real(float(g)) - v)) for g, v in zip(values, true, strict=True)) / scale
        )
    return found


def rows_of(
    times: Mapping[str, Timing], n: int, label: str, which: int, wrong: Mapping[str, float]
) -> list[Row]:
    rows = []
    for name, timing in times.items():
        ns = [1e9 * s / n for s in (timing.median, *timing.quartiles)]
        goal = GOALS.get(name)
        extra: dict[str, Any] = {}
        if goal:
            extra = {"target": f"at most {goal[which]:g}", "met": 1e9 * timing.least / n <= goal[which]}
        note = f"best {1e9 * timing.least / n:.1f}; off by {wrong[name]:.1e} Eo"
        rows.append(Row(f"{name}, {label}", ns[0], "ns", note, low=ns[1], high=ns[2], **extra))
    for name, timing in times.items():
        if name != OURS:
            r = ratio(timing, times[OURS])
            aim = TARGETS.get(name)
            extra = {"target": f"at least {aim[which]:g}", "met": r.value >= aim[which]} if aim else {}
            title = f"{name} / {OURS}, {label}"
            rows.append(Row(title, r.value, RATIO, low=r.low, high=r.high, **extra))
    return rows


def bound_rows(ours: Timing, floor: Timing, n: int, label: str) -> list[Row]:
    """What the machine allows, and how near we come."""
    low, high = (1e9 * q / n for q in floor.quartiles)
    r = ratio(ours, floor)
    extra = {"target": f"at most {NEAR:g}", "met": r.value <= NEAR} if n == STREAMING else {}
    return [
        Row(f"reading 16 series, writing one, {label}", 1e9 * floor.median / n, "ns",
            "nothing is computed: the memory bound", low=low, high=high),
        Row(f"{OURS} / memory bound, {label}", r.value, RATIO, low=r.low, high=r.high, **extra),
    ]  # fmt: skip


def run() -> list[Row]:
    """Accuracy, times streaming and in cache, ratios, bounds, other instruments, threads."""
    import numpy as np

    from benchmarks import bounds, instruments

    cores = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
    if cores:
        os.sched_setaffinity(0, cores[:1])  # the rivals' thread pools too
    t, x, p = instrument_and_motion(STREAMING)
    functions, missing = contenders(p)
    wrong = errors(p, functions)
    limits = bounds.Bounds()
    rows: list[Row] = []

    def timed(n: int, rounds: int, inner: int, among: Mapping[str, Any]) -> dict[str, Timing]:
        s, y, out = aligned(t[:n]), aligned(x[:, :n]), aligned(np.zeros(n))
        calls: dict[str, Callable[[], object]] = {
            name: lambda f=f: f(s, y, out)
            for name, f in among.items()  # type: ignore[misc]
        }
        return interleaved(
            {**calls, "bound": lambda: limits.traffic(s, y, out)},
            rounds,
            inner,
            clock=time.process_time,
            prime=inner > 1,
        )

    fast = {name: f for name, f in functions.items() if name not in SLOW}
    few = {name: f for name, f in functions.items() if name in (*SLOW, OURS)}
    for label, which, n, rounds, inner in (
        ("streaming", 0, STREAMING, 25, 1),
        ("in cache", 1, IN_CACHE, 25, 20),
    ):
        times = timed(n, rounds, inner, fast)
        slow = timed(n, 5, 1 if n == STREAMING else 2, few)
        floor = times.pop("bound")
        rows += rows_of(times, n, label, which, wrong)
        slow.pop("bound")
        rows += [r for r in rows_of(slow, n, label, which, wrong) if not r.name.startswith(OURS)]
        rows += bound_rows(times[OURS], floor, n, label)
    rows += limits.rows(1e9 * times[OURS].median / IN_CACHE)
    rows += instruments.rows(t, x, p)
    for name, reason in missing.items():
        print(f"missing: {name}: {reason}", file=sys.stderr)
        rows.append(Row(f"{name}: missing", float("nan"), "ns", reason))
    return rows
