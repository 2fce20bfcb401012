"""How long evaluating the analytical model takes, a sample, on one core: ours, other ways, and the memory's bound.

A million samples, all fifteen channels as series ("streaming": everything comes from memory), and some thousand again and again
("in cache"). Processor time of a process held to one core, calls from Python included; all get series that begin at multiples
of 64 bytes. What each yields is compared with the 50-digit value first: the rivals (``benchmarks/rivals.py``) form omega t in
float64 and lose there. Generated C of other instruments and orders is timed against the paper's.
"""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

from benchmarks import Row
from benchmarks.rivals import aligned
from benchmarks.timing import Timing, interleaved, ratio

ENVIRONMENT = {
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
}
SIZES = {"streaming": (1_000_000, 1), "in cache": (16_000, 20)}
"""Samples, and calls in a row."""
START, RATE = 1e4, 100.0  # s, Hz
OURS, OURS_NUMPY, PAPER = "generated C, compiled", "generated NumPy", "the paper's model"
SLOW = ("SymPy lambdify", "NumPy in blocks", OURS_NUMPY)
TARGETS: Mapping[str, tuple[float, float]] = {"heyoka cfunc": (1.4, 2.2)}
"""Rival -> at least so many times our time, streaming and in cache."""
GOALS: Mapping[str, tuple[float, float]] = {OURS: (15.0, 10.0), OURS_NUMPY: (350.0, 350.0)}
"""Largest time a sample, ns, on a machine of 2.5 GHz with AVX-512 and 11 GB/s."""

Call = Callable[[Any, Any, Any], object]


def instrument_and_motion(n: int) -> tuple[Any, Any, Any]:
    """(t, inputs, p): Tables V and VI of the paper, at random; t from START s on."""
    import numpy as np

    from ragg_runtime.model.model import load_packaged

    draw = np.random.default_rng(5)
    arcsec, per_g, g = math.pi / 648000, 1e-6 / 9.8, 9.8
    sizes = {"dR": 35e-6, "K0": 10e-6 * g, "k_VI": 0.0, "K1": 1e-3 / g}
    middle = {"k_VI": 1e9, "K1": 11e-3 / g}
    p = [0.1, 0.25]
    for name, size in load_packaged().chain.PARAMETERS[2:]:
        spread = sizes.get(name, 20 * (per_g if name.startswith("K") else arcsec))
        p += list(middle.get(name, 0.0) + spread * draw.uniform(-1, 1, size))
    rate = 2000 * arcsec
    scale = [0.8, 0.8, 1.5, *[rate] * 3, *[rate * math.pi / 2] * 3, *[1e-6] * 6]
    inputs = draw.uniform(-1, 1, (15, n)) * np.array(scale)[:, None]
    return START + np.arange(n) / RATE, inputs, np.array(p)


def contenders(p: Any) -> tuple[dict[str, Call], dict[str, str]]:
    """Name -> (t, inputs, out) -> anything; and what is missing, with the reason."""
    from benchmarks import rivals
    from ragg_runtime.model.model import load_packaged

    compiled, blocks = load_packaged().compiled(), load_packaged().compiled(native=False)
    ours: dict[str, Call] = {
        # which allocate what they return, as for users
        OURS: lambda t, x, out: compiled.output(t, x, p),
        OURS_NUMPY: lambda t, x, out: blocks.output(t, x, p),
    }
    others, missing = rivals.available(p)
    return {**ours, **others}, missing


def errors(p: Any, functions: Mapping[str, Call]) -> dict[str, float]:
    """Largest difference from the 50-digit value, Eo."""
    import numpy as np

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


def rows_of(times: Mapping[str, Timing], label: str, wrong: Mapping[str, float]) -> list[Row]:
    """Times a sample, and ratios to ours."""
    n, which = SIZES[label][0], list(SIZES).index(label)
    rows, ratios = [], []
    for name, timing in times.items():
        middle, low, high = (1e9 * s / n for s in (timing.median, *timing.quartiles))
        least, goal = 1e9 * timing.least / n, GOALS[name][which] if name in GOALS else None
        target, met = (None, None) if goal is None else (f"at most {goal:g}", least <= goal)
        note = f"best {least:.1f}; off by {wrong[name]:.1e} Eo"
        rows.append(Row(f"{name}, {label}", middle, "ns", note, target, low, high, met))
        if name != OURS:
            aim = f"at least {TARGETS[name][which]:g}" if name in TARGETS else None
            ratios.append(ratio(f"{name} / {OURS}, {label}", timing, times[OURS], aim))
    return rows + ratios


def layouts(p: Any) -> Iterator[tuple[str, Any, Any, float]]:
    """Name, evaluator, parameters and the largest ratio to the paper's model aimed at; the paper's first."""
    from ragg_runtime.instrument.form import PRESETS, Form
    from ragg_runtime.instrument.read_toml import parse_instrument
    from ragg_runtime.model import derive
    from ragg_runtime.model.evaluate import make_vector
    from ragg_runtime.model.model import load_packaged
    from tests.layouts import sheets

    exact = Form(kinematics="full", **dict(PRESETS["exact"]))  # type: ignore[arg-type]
    yield PAPER, load_packaged().compiled(), p, 1.0
    yield "full kinematics", load_packaged("full").compiled(), p, 1.3
    yield "full kinematics and exact order", derive.derived((), (), exact)[0].compiled(), p, 2.0
    for name, discs, count in (
        ("two complements on a disc, an output", sheets.complements(), 8),
        ("an umbrella of three discs, an output", sheets.umbrella(), 12),
    ):
        i = parse_instrument(sheets.sheet(discs, count))
        model = derive.derived((), (), i.form, i.layout)[0]
        yield name, model.compiled(), make_vector(model, i), 1.3


def layout_rows(t: Any, x: Any, p: Any) -> list[Row]:
    """Ratios of other instruments; an output of four accelerometers each, so a ratio a sample is one an accelerometer."""
    import numpy as np

    turning = np.stack([np.full(len(t), 2 * np.pi * p[1]), np.zeros(len(t))])
    wide, models = np.vstack([x, turning]), list(layouts(p))
    found = []
    for label, (n, inner) in SIZES.items():
        s, y = aligned(t[:n]), aligned(wide[:, :n])
        calls = {name: partial(e.output, s, y[: len(e.inputs)], q) for name, e, q, _ in models}
        times = interleaved(calls, 15, inner, prime=inner > 1)
        found += [
            ratio(f"{name} / {PAPER}, {label}", times[name], times[PAPER], f"at most {limit:g}")
            for name, _, _, limit in models[1:]
        ]
    return found


def run() -> list[Row]:
    """Accuracy, times streaming and in cache, ratios, the memory's bound, other instruments."""
    import numpy as np

    from benchmarks import rivals

    cores = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
    if cores:
        os.sched_setaffinity(0, cores[:1])
    t, x, p = instrument_and_motion(SIZES["streaming"][0])
    functions, missing = contenders(p)
    wrong = errors(p, functions)
    rows: list[Row] = []
    fast = {name: f for name, f in functions.items() if name not in SLOW}
    few = {name: f for name, f in functions.items() if name in (*SLOW, OURS)}
    for label, (n, inner) in SIZES.items():
        s, y, out = aligned(t[:n]), aligned(x[:, :n]), aligned(np.zeros(n))

        def timed(
            among: Mapping[str, Call], rounds: int, inner: int, s: Any = s, y: Any = y, out: Any = out
        ) -> dict[str, Timing]:
            calls = {name: partial(f, s, y, out) for name, f in among.items()}
            return interleaved(calls, rounds, inner, time.process_time, prime=inner > 1)

        times = timed({**fast, "bound": rivals.memory_traffic()}, 25, inner)
        slow = timed(few, 5, min(inner, 2))
        floor = times.pop("bound")
        rows += rows_of(times, label, wrong)
        rows += [r for r in rows_of(slow, label, wrong) if not r.name.startswith(OURS)]
        low, high = (1e9 * q / n for q in floor.quartiles)
        name, note = f"reading 16 series, writing one, {label}", "nothing is computed: the memory bound"
        rows.append(Row(name, 1e9 * floor.median / n, "ns", note, low=low, high=high))
        near = "at most 1.3" if inner == 1 else None
        rows.append(ratio(f"{OURS} / memory bound, {label}", times[OURS], floor, near))
    rows += layout_rows(t, x, p)
    for name, reason in missing.items():
        print(f"missing: {name}: {reason}", file=sys.stderr)
        rows.append(Row(f"{name}: missing", float("nan"), "ns", reason))
    return rows
