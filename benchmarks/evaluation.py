"""How long evaluating the analytical model takes, a sample, on one core: ours, heyoka, and the memory's bound.

A million samples, all fifteen channels as series ("streaming": everything comes from memory), and some thousand again and again
("in cache"). Processor time of a process held to one core, calls from Python included; all get series that begin at multiples
of 64 bytes. What each yields is compared with the 50-digit value first: heyoka forms omega t in float64 and loses there.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks import RATIO, Row
from benchmarks.rivals import Rival, aligned, heyoka, memory_traffic

SIZES = {"streaming": (1_000_000, 1), "in cache": (16_000, 20)}
"""Samples, and calls in a row."""
START, RATE = 1e4, 100.0  # s, Hz
OURS, OURS_NUMPY, HEYOKA = "generated C, compiled", "generated NumPy", "heyoka cfunc"
ROUNDS, FEW = 25, 5
"""Rounds; NumPy, a hundred times slower, has fewer."""
FASTER = {"streaming": 1.4, "in cache": 2.2}
"""At least so many times our time heyoka takes."""
GOALS: Mapping[str, Mapping[str, float]] = {
    "streaming": {OURS: 15.0, OURS_NUMPY: 350.0},
    "in cache": {OURS: 10.0, OURS_NUMPY: 350.0},
}
"""Largest time a sample, ns, on a machine of 2.5 GHz with AVX-512 and 11 GB/s."""

Times = NDArray[np.float64]


def interleave(
    functions: Mapping[str, Callable[[], object]],
    repeats: int,
    inner: int = 1,
    clock: Callable[[], float] = time.process_time,
) -> dict[str, Times]:
    """(repeats,) s of every function: one after the other in each round, so that whatever else the machine does strikes all alike.

    Each is called once for nothing, then ``inner`` times in a row. If these are several, its data are put into the caches before.
    """
    for function in functions.values():
        function()
    times: dict[str, list[float]] = {name: [] for name in functions}
    for _ in range(repeats):
        for name, function in functions.items():
            if inner > 1:
                function()
            start = clock()
            for _ in range(inner):
                function()
            times[name].append((clock() - start) / inner)
    return {name: np.array(t) for name, t in times.items()}


def instrument_and_motion(n: int) -> tuple[Any, Any, Any]:
    """(t, inputs, p): Tables V and VI of the paper, at random; t from START s on."""
    from tests.generated import draws

    draw = np.random.default_rng(5)
    return START + np.arange(n) / RATE, draws.motion(draw, n), draws.instrument(draw)


def contenders(p: NDArray[np.float64]) -> dict[str, Rival]:
    """Name -> (t, inputs, out) -> anything; heyoka only where it is installed."""
    from ragg_runtime.model.model import load_packaged

    compiled = load_packaged().chain
    blocks = replace(compiled, sources={})
    found: dict[str, Rival] = {
        # which allocate what they return, as for users
        OURS: lambda t, x, out: compiled.output(t, x, p),
        OURS_NUMPY: lambda t, x, out: blocks.output(t, x, p),
    }
    try:
        return found | {HEYOKA: heyoka(p)}
    except ModuleNotFoundError as error:
        print(f"missing: {error.name} is not installed", file=sys.stderr)
        return found


def errors(p: NDArray[np.float64], functions: Mapping[str, Rival]) -> dict[str, float]:
    """Largest difference from the 50-digit value, Eo."""
    from tests.generated import fifty_digits as fifty

    t, x, _ = instrument_and_motion(40)
    q = fifty.exact(p)
    true = [fifty.output(s, fifty.exact(x[:, n]), q) for n, s in enumerate(fifty.exact(t))]
    scale = 1e-9 * float(np.sum(p[-4:] * p[30:34] * (p[0] + p[2:6])))
    found = {}
    for name, f in functions.items():
        out = np.empty(len(t))
        result = f(t, x, out)
        pairs = zip(result if name in (OURS, OURS_NUMPY) else out, true, strict=True)
        found[name] = max(abs(float(fifty.real(float(g)) - v)) for g, v in pairs) / scale
    return found


def run() -> list[Row]:
    """Accuracy, times streaming and in cache, ratios, the memory's bound."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:1])
    t, x, p = instrument_and_motion(SIZES["streaming"][0])
    functions = contenders(p)
    wrong = errors(p, functions)
    rows: list[Row] = []
    for label, (n, inner) in SIZES.items():
        given = aligned(t[:n]), aligned(x[:, :n]), aligned(np.zeros(n))
        calls = {name: partial(f, *given) for name, f in (functions | {"bound": memory_traffic()}).items()}
        slow = interleave({OURS_NUMPY: calls.pop(OURS_NUMPY)}, FEW, min(inner, 2))
        times = interleave(calls, ROUNDS, inner)
        bound, ours = times.pop("bound"), times[OURS]
        rows += [
            Row.of(
                f"{name}, {label}",
                1e9 / n * s,
                "ns",
                note=f"off by {wrong[name]:.1e} Eo",
                limit=GOALS[label].get(name),
            )
            for name, s in (times | slow).items()
        ]
        if HEYOKA in times:
            name = f"{HEYOKA} / {OURS}, {label}"
            rows.append(Row.of(name, times[HEYOKA] / ours, RATIO, limit=FASTER[label], at_least=True))
        rows.append(
            Row.of(f"reading 16 series, writing one, {label}", 1e9 / n * bound, "ns", note="the memory bound")
        )
        near = 1.3 if inner == 1 else None
        rows.append(Row.of(f"{OURS} / memory bound, {label}", ours / bound, RATIO, limit=near))
    return rows
