"""Speed of the model's evaluation.

A million samples, all fifteen channels as series ("streaming": everything comes from memory), and some thousand again and again
("in cache"). Processor time of a process held to one core, calls from Python included; all get series that begin at multiples
of 64 bytes. What each yields is compared with the 50-digit value first: heyoka forms omega t in float64 and loses there.

heyoka gets what one would write by hand before reaching for it: motion numbers once, one cosine and sine a sample, four
accelerometers, the instrument's parameters as numbers, shared subexpressions apart.
"""

from __future__ import annotations

import ctypes
import importlib
import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks import RATIO, Row
from ragg_runtime.model import chain
from ragg_runtime.model.model import load_packaged

Array = NDArray[np.float64]
Function = Callable[[Array], Array]  # evaluates (16, n) series: t, and the inputs
SIZES = {"streaming": (1_000_000, 1), "in cache": (16_000, 20)}  # samples, and calls in a row
START, RATE = 1e4, 100.0  # s, Hz
OURS, HEYOKA = "generated C, compiled", "heyoka cfunc"
ROUNDS = 25
FASTER = {"streaming": 1.4, "in cache": 1.9}  # at least so many times our time heyoka takes
# Largest time a sample of ours, ns, on a machine of 2.5 GHz with AVX-512 and 11 GB/s
GOALS = {"streaming": 15.0, "in cache": 10.0}
INPUTS = ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z", "omegadot_x", "omegadot_y", "omegadot_z",
          "Gamma_xx", "Gamma_xy", "Gamma_xz", "Gamma_yy", "Gamma_yz", "Gamma_zz")  # fmt: skip


def interleave(functions: Mapping[str, Callable[[], object]], inner: int) -> dict[str, Array]:
    """(ROUNDS,) s of every function: one after the other in each round, so that whatever else the machine does strikes all alike.

    Each is called once for nothing, then ``inner`` times in a row. If these are several, its data are put into the caches before.
    """
    for function in functions.values():
        function()
    times = {name: np.empty(ROUNDS) for name in functions}
    for k in range(ROUNDS):
        for name, function in functions.items():
            if inner > 1:
                function()
            start = time.process_time()
            for _ in range(inner):
                function()
            times[name][k] = (time.process_time() - start) / inner
    return times


def aligned(x: Array) -> Array:
    """A contiguous copy that begins at a multiple of 64 bytes, as its rows do if their length allows it."""
    room = np.empty(x.size + 8)
    first = -(room.ctypes.data // 8) % 8
    copy = room[first : first + x.size].reshape(x.shape)
    copy[...] = x
    return copy


def motion_and_instrument(n: int) -> tuple[Array, Array]:
    """(16, n) series and p: Tables V and VI of the paper, at random; t from START s on."""
    from tests.generated import draws

    draw = np.random.default_rng(5)
    return np.vstack([START + np.arange(n) / RATE, draws.motion(draw, n)]), draws.instrument(draw)


# --- what is timed ---------------------------------------------------------------------------------------


def contenders(p: Array) -> dict[str, Function]:
    """Ours allocate what they return, as for users; heyoka only where it is installed."""
    compiled = load_packaged().chain
    functions: dict[str, Function] = {OURS: lambda x: compiled.output(x[0], x[1:], p)}
    try:
        return functions | {HEYOKA: heyoka(p)}
    except ModuleNotFoundError as error:
        print(f"missing: {error.name} is not installed", file=sys.stderr)
        return functions


def heyoka(p: Array) -> Function:
    """The program compiled by heyoka. Raises ModuleNotFoundError."""
    hy = importlib.import_module("heyoka")
    variables = hy.make_vars("t", *INPUTS)
    phi = 2 * np.pi * float(p[1]) * variables[0]
    G = write_function(program(p), hy)(hy.cos(phi), hy.sin(phi), *variables[1:])
    compiled = hy.cfunc([G], list(variables))
    room = cache(lambda n: aligned(np.zeros((1, n))))  # making it is not timed
    return lambda x: compiled(inputs=x, outputs=room(x.shape[1]))[0]  # type: ignore[no-any-return]


def program(p: Array) -> Sequence[tuple[str, Any]]:
    """Name -> SymPy expression, in order; the last is G. Inputs, cos_phi and sin_phi are free."""
    import sympy as sp

    from derive.chain import accelerometer
    from derive.symbols import ACCELEROMETER, COS_J, QUARTER_TURNS, SIGNS, SIN_J, symbol
    from derive.tape import settled

    a = accelerometer()
    total, assignments = sp.Integer(0), [x for x in a.tape.assignments if x[0].name.startswith("M_")]
    of_each = [x for x in a.tape.assignments if not x[0].name.startswith("M_")]
    for j, (sign, quarter) in enumerate(zip(SIGNS, QUARTER_TURNS, strict=True)):
        values = {q.symbol: sp.Float(float(p[2 + 4 * n + j]), 17) for n, q in enumerate(ACCELEROMETER)}
        values |= {symbol("radius"): sp.Float(float(p[0]), 17)}
        values |= {COS_J: sp.Integer((1, 0, -1, 0)[quarter]), SIN_J: sp.Integer((0, 1, 0, -1)[quarter])}
        for s, e in of_each:
            values[s] = symbol(f"{s.name}_{j + 1}")
            assignments.append((values[s], e.xreplace(values)))
        total += sign * a.voltage.xreplace(values)
    straight = settled(assignments, {}).program([("G", total)])
    return [*((s.name, e) for s, e in straight.assignments), *straight.outputs]


def write_function(code: Sequence[tuple[str, Any]], module: Any) -> Callable[..., Any]:
    """The program as a Python function of (cos_phi, sin_phi, *inputs), with the functions of a module."""
    import sympy as sp

    *assignments, (_, G) = ((sp.Symbol(name), e) for name, e in code)
    inputs = ("cos_phi", "sin_phi", *INPUTS)
    return sp.lambdify(inputs, G, module, cse=lambda _: (assignments, G))  # type: ignore[no-any-return]


TRAFFIC = """
#include <stddef.h>
/* As many streams as the model reads and writes, and as little arithmetic as keeps the reads alive. */
void traffic(size_t n, const double *restrict x, double *restrict out) {
    for (size_t i = 0; i < n; ++i) {
        out[i] = %s;
    }
}
"""


def memory_traffic(out: Array) -> Function:
    """Reads the 16 series and writes ``out``, by a small C loop: the memory bound."""
    streams = " + ".join(f"x[{k} * n + i]" for k in range(1 + len(INPUTS)))
    library = chain.load(chain.compile_library({"traffic.c": TRAFFIC % streams}))

    def run(x: Array) -> Array:
        library.traffic(ctypes.c_size_t(len(out)), *(ctypes.c_void_p(a.ctypes.data) for a in (x, out)))
        return out

    return run


def errors(p: Array, functions: Mapping[str, Function]) -> dict[str, float]:
    """Largest difference from the 50-digit value, Eo."""
    from tests.generated import fifty_digits as fifty

    x, _ = motion_and_instrument(40)
    q = fifty.exact(p)
    true = [fifty.output(t, now, q) for t, *now in (fifty.exact(column) for column in x.T)]
    scale = 1e-9 * float(np.sum(p[-4:] * p[30:34] * (p[0] + p[2:6])))
    return {
        name: max(abs(float(fifty.real(float(g)) - v)) for g, v in zip(f(x), true, strict=True)) / scale
        for name, f in functions.items()
    }


def run() -> list[Row]:
    """How long evaluating the analytical model takes, a sample, on one core: ours, heyoka, and the memory's bound."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:1])
    series, p = motion_and_instrument(SIZES["streaming"][0])
    functions = contenders(p)
    wrong = errors(p, functions)
    rows = [Row(f"{name}, error", e, "Eo", 1.2e-7 if name == OURS else None) for name, e in wrong.items()]
    for label, (n, inner) in SIZES.items():
        x = aligned(series[:, :n])
        bound = memory_traffic(aligned(np.zeros(n)))
        calls = {name: partial(f, x) for name, f in (functions | {"bound": bound}).items()}
        times = interleave(calls, inner)
        memory, ours = times.pop("bound"), times[OURS]
        for name, s in times.items():
            goal = GOALS[label] if name == OURS else None
            rows.append(Row(f"{name}, {label}", 1e9 / n * s, "ns", goal))
        if HEYOKA in times:
            name = f"{HEYOKA} / {OURS}, {label}"
            rows.append(Row(name, times[HEYOKA] / ours, RATIO, FASTER[label], at_least=True))
        rows.append(Row(f"reading 16 series, writing one, {label}", 1e9 / n * memory, "ns"))
        limit = 1.4 if inner == 1 else None
        rows.append(Row(f"{OURS} / memory bound, {label}", ours / memory, RATIO, limit))
    return rows
