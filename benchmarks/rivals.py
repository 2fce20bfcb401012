"""What our evaluation is held against: heyoka, given the chain as straight-line code with one sincos, and the memory's bound.

heyoka gets what one would write by hand before reaching for it: motion numbers once, one cosine and sine a sample, four
accelerometers, the instrument's parameters as numbers, shared subexpressions apart.
"""

from __future__ import annotations

import ctypes
import importlib
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.model import chain as compilation

Array = NDArray[np.float64]
Rival = Callable[[Array, Array, Array], object]
"""Evaluates (t, inputs) into an array that it is given."""

Program = Sequence[tuple[str, Any]]
INPUTS = ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z", "omegadot_x", "omegadot_y", "omegadot_z",
          "Gamma_xx", "Gamma_xy", "Gamma_xz", "Gamma_yy", "Gamma_yz", "Gamma_zz")  # fmt: skip


def aligned(x: Array) -> Array:
    """A contiguous copy that begins at a multiple of 64 bytes, as its rows do if their length allows it."""
    room = np.empty(x.size + 8)
    first = -(room.ctypes.data // 8) % 8
    found = room[first : first + x.size].reshape(x.shape)
    found[...] = x
    return found


def program(p: Array) -> Program:
    """Name -> SymPy expression, in order; the last is G. Inputs, cos_phi and sin_phi are free."""
    import sympy as sp

    from derive.chain import accelerometer
    from derive.symbols import ACCELEROMETER, COS_J, QUARTER_TURNS, SIGNS, SIN_J, symbol
    from derive.tape import settled

    a = accelerometer()
    total, assignments = sp.Integer(0), []
    for j, (sign, quarter) in enumerate(zip(SIGNS, QUARTER_TURNS, strict=True)):
        own: dict[Any, Any] = {
            q.symbol: sp.Float(float(p[2 + 4 * n + j]), 17) for n, q in enumerate(ACCELEROMETER)
        }
        own[symbol("radius")] = sp.Float(float(p[0]), 17)
        own[COS_J] = sp.Integer((1, 0, -1, 0)[quarter])
        own[SIN_J] = sp.Integer((0, 1, 0, -1)[quarter])
        for s, e in a.tape.assignments:
            if s.name.startswith("M_"):
                if j == 0:
                    assignments.append((s, e))
                continue
            own[s] = symbol(f"{s.name}_{j + 1}")
            assignments.append((own[s], e.xreplace(own)))
        total += sign * a.voltage.xreplace(own)
    found = settled(assignments, {}).program([("G", total)])
    return [*((s.name, e) for s, e in found.assignments), *found.outputs]


def write_function(code: Program, module: Any) -> Callable[..., Any]:
    """The program as a Python function of (cos_phi, sin_phi, *inputs), with the functions of a module."""
    from sympy.printing.pycode import pycode

    lines = [f"    {name} = {pycode(e)}" for name, e in code]
    head = f"def g(cos_phi, sin_phi, {', '.join(INPUTS)}):"
    space: dict[str, Any] = {"math": module}
    exec("\n".join([head, *lines, "    return G"]), space)
    return space["g"]  # type: ignore[no-any-return]


def heyoka(p: Array) -> Rival:
    """The program compiled by heyoka. Raises ModuleNotFoundError."""
    hy = importlib.import_module("heyoka")
    variables = hy.make_vars("t", *INPUTS)
    phi = 2 * np.pi * float(p[1]) * variables[0]
    G = write_function(program(p), hy)(hy.cos(phi), hy.sin(phi), *variables[1:])
    compiled = hy.cfunc([G], list(variables))
    there: dict[int, Array] = {}

    def run(t: Array, x: Array, out: Array) -> None:
        if id(x) not in there:  # it wants one matrix: putting that together is not timed
            there.clear()
            there[id(x)] = aligned(np.vstack([t, x]))
        compiled(inputs=there[id(x)], outputs=out.reshape(1, -1))

    return run


TRAFFIC = """
#include <stddef.h>
/* As many streams as the model reads and writes, and as little arithmetic as keeps the reads alive. */
void traffic(size_t n, const double *restrict t, const double *restrict x, double *restrict out) {
    for (size_t i = 0; i < n; ++i) {
        out[i] = t[i] %s;
    }
}
"""


def memory_traffic() -> Rival:
    """Reads t and the 15 rows of x and writes out, by a small C loop: the memory bound."""
    streams = " ".join(f"+ x[{k} * n + i]" for k in range(len(INPUTS)))
    library = compilation.load(compilation.build({"traffic.c": TRAFFIC % streams}))

    def run(t: Array, x: Array, out: Array) -> None:
        library.traffic(ctypes.c_size_t(len(t)), *(ctypes.c_void_p(a.ctypes.data) for a in (t, x, out)))

    return run
