"""Other ways to evaluate the same model fast: each is given the chain as straight-line code with one sincos.

The rivals get what one would write by hand before reaching for them: motion numbers once, one cosine and sine a
sample, four accelerometers, the instrument's parameters as numbers, shared subexpressions apart. A rival that is
not installed is left out and named.
"""

from __future__ import annotations

import ctypes
import importlib
import platform
import subprocess
import tempfile
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Rival = Callable[[Array, Array, Array], None]
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


def python_source(code: Program, head: str, module: str) -> str:
    """The program as a Python function body."""
    from sympy.printing.pycode import pycode

    lines = [f"    {name} = {pycode(e)}" for name, e in code]
    return "\n".join([head, *lines, "    return G", ""]).replace("math.", f"{module}.")


def _function(source: str, names: Mapping[str, Any]) -> Callable[..., Any]:
    space = dict(names)
    exec(source, space)
    return space["g"]  # type: ignore[no-any-return]


ARGUMENTS = ", ".join(INPUTS)


def numpy_blocks(code: Program, f: float) -> Rival:
    g = _function(python_source(code, f"def g(cos_phi, sin_phi, {ARGUMENTS}):", "np"), {"np": np})

    def run(t: Array, x: Array, out: Array) -> None:
        for start in range(0, len(t), 4096):
            part = slice(start, start + 4096)
            phi = 2 * np.pi * f * t[part]
            out[part] = g(np.cos(phi), np.sin(phi), *x[:, part])

    return run


def lambdify(code: Program, f: float) -> Rival:
    """SymPy's own, of the whole expression with cse=True, over whole series."""
    import sympy as sp

    values: dict[Any, Any] = {}
    for name, e in code:
        values[sp.Symbol(name, real=True)] = e.xreplace(values)
    symbols = [sp.Symbol(n, real=True) for n in ("cos_phi", "sin_phi", *INPUTS)]
    g = sp.lambdify(symbols, values[sp.Symbol("G", real=True)], "numpy", cse=True)

    def run(t: Array, x: Array, out: Array) -> None:
        phi = 2 * np.pi * f * t
        out[:] = g(np.cos(phi), np.sin(phi), *x)

    return run


def heyoka(code: Program, f: float) -> Rival:
    hy = importlib.import_module("heyoka")
    variables = hy.make_vars("t", *INPUTS)
    phi = 2 * np.pi * f * variables[0]
    g = _function(python_source(code, f"def g(cos_phi, sin_phi, {ARGUMENTS}):", "hy"), {"hy": hy})
    G = g(hy.cos(phi), hy.sin(phi), *variables[1:])
    compiled = hy.cfunc([G], list(variables))
    there: dict[int, Array] = {}

    def run(t: Array, x: Array, out: Array) -> None:
        if id(x) not in there:  # it wants one matrix: putting that together is not timed
            there.clear()
            there[id(x)] = aligned(np.vstack([t, x]))
        compiled(inputs=there[id(x)], outputs=out.reshape(1, -1))

    return run


@cache
def _folder() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory()


def compile_c(name: str, text: str, flags: Sequence[str]) -> ctypes.CDLL:
    """C text -> loaded library."""
    place = Path(_folder().name)
    source, made = place / f"{name}.c", place / f"{name}.so"
    source.write_text(text, "utf-8")
    subprocess.run(["gcc", *flags, str(source), "-lm", "-o", str(made)], check=True, capture_output=True)
    return ctypes.CDLL(str(made))


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
    wide = ("-mprefer-vector-width=512",) if platform.machine() in ("x86_64", "AMD64") else ()
    library = compile_c("traffic", TRAFFIC % streams, ("-O3", "-march=native", *wide, "-fPIC", "-shared"))

    def run(t: Array, x: Array, out: Array) -> None:
        library.traffic(ctypes.c_size_t(len(t)), *(ctypes.c_void_p(a.ctypes.data) for a in (t, x, out)))

    return run


RIVALS: Mapping[str, Callable[[Program, float], Rival]] = {
    "heyoka cfunc": heyoka,
    "NumPy in blocks": numpy_blocks,
    "SymPy lambdify": lambdify,
}


def available(p: Array) -> tuple[dict[str, Rival], dict[str, str]]:
    """Rivals for an instrument's parameters, and those that cannot be had, with the reason."""
    code, made, missing = program(p), {}, {}
    for name, make in RIVALS.items():
        try:
            made[name] = make(code, float(p[1]))
        except ModuleNotFoundError as error:
            missing[name] = f"{error.name} is not installed"
    return made, missing
