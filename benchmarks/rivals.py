"""Other ways to evaluate the same model fast: each is given the chain as straight-line code with one sincos.

The rivals get what one would write by hand before reaching for them: motion numbers once, one cosine and sine a
sample, four accelerometers, the instrument's parameters as numbers, shared subexpressions apart. A rival that is
not installed is left out and named.
"""

from __future__ import annotations

import ctypes
import importlib
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
FLAGS = ("-O3", "-march=native", "-ffp-contract=fast", "-fno-math-errno", "-fPIC", "-shared")


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


def numba(code: Program, f: float) -> Rival:
    import math

    nb = importlib.import_module("numba")
    lines = python_source(code, "", "math").splitlines()[1:-1]
    loads = [f"        {n} = x[{k}, i]" for k, n in enumerate(INPUTS)]
    source = "\n".join(
        ["def g(t, x, out):", "    for i in range(t.shape[0]):", *loads,
         f"        phi = {2 * np.pi * f!r} * t[i]",
         "        cos_phi, sin_phi = math.cos(phi), math.sin(phi)",
         *(f"    {line}" for line in lines), "        out[i] = G", ""]
    )  # fmt: skip
    return nb.njit(_function(source, {"math": math}))  # type: ignore[no-any-return]


def jax(code: Program, f: float) -> Rival:
    j = importlib.import_module("jax")
    j.config.update("jax_enable_x64", True)
    jnp = importlib.import_module("jax.numpy")
    g = _function(python_source(code, f"def g(cos_phi, sin_phi, {ARGUMENTS}):", "jnp"), {"jnp": jnp})

    @j.jit  # type: ignore[untyped-decorator]
    def whole(t: Any, x: Any) -> Any:
        phi = 2 * np.pi * f * t
        return g(jnp.cos(phi), jnp.sin(phi), *x)

    there: dict[int, tuple[Any, Any]] = {}

    def run(t: Array, x: Array, out: Array) -> None:
        if id(x) not in there:  # bringing the series over is not timed
            there.clear()
            there[id(x)] = (j.numpy.asarray(t), tuple(j.numpy.asarray(row) for row in x))
        found = whole(*there[id(x)])
        found.block_until_ready()
        run.found = found  # type: ignore[attr-defined]

    return run


def result(rival: Any, out: Array) -> Array:
    """What a rival has just computed: JAX writes into arrays of its own."""
    return np.asarray(rival.found) if hasattr(rival, "found") else out


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


def compile_c(name: str, text: str, compiler: str = "gcc", flags: Sequence[str] = FLAGS) -> ctypes.CDLL:
    """C (or C++) text -> loaded library."""
    place = Path(_folder().name)
    source = place / (f"{name}.cpp" if compiler.endswith("++") else f"{name}.c")
    source.write_text(text, "utf-8")
    subprocess.run(
        [compiler, *flags, str(source), "-lm", "-o", str(place / f"{name}.so")],
        check=True,
        capture_output=True,
    )
    return ctypes.CDLL(str(place / f"{name}.so"))


def _loop(library: ctypes.CDLL) -> Rival:
    def run(t: Array, x: Array, out: Array) -> None:
        library.run(
            ctypes.c_size_t(len(t)),
            ctypes.c_void_p(t.ctypes.data),
            ctypes.c_void_p(x.ctypes.data),
            ctypes.c_void_p(out.ctypes.data),
        )

    return run


def casadi(code: Program, f: float) -> Rival:
    ca = importlib.import_module("casadi")
    t, inputs = ca.SX.sym("t"), [ca.SX.sym(n) for n in INPUTS]
    phi = 2 * np.pi * f * t
    g = _function(python_source(code, f"def g(cos_phi, sin_phi, {ARGUMENTS}):", "ca"), {"ca": ca})
    function = ca.Function("g", [t, *inputs], [g(ca.cos(phi), ca.sin(phi), *inputs)])
    generator = ca.CodeGenerator("g", {"with_header": False})
    generator.add(function)
    text = generator.dump()
    loop = (
        "#include <stddef.h>\n"
        "void run(size_t n, const double *t, const double *x, double *out) {\n"
        "  for (size_t i = 0; i < n; ++i) {\n    const double *arg[16]; double *res[1];\n"
        "    arg[0] = t + i;\n    for (int k = 0; k < 15; ++k) arg[k + 1] = x + k * n + i;\n"
        "    res[0] = out + i;\n    g(arg, res, 0, 0, 0);\n  }\n}\n"
    )
    return _loop(compile_c("casadi_g", text + loop))


def symforce(code: Program, f: float) -> Rival:
    """C++ by symforce's code generator, without the headers that scalars do not need."""
    importlib.import_module("symforce").set_epsilon_to_number()  # there is nothing singular; it asks for one
    sf = importlib.import_module("symforce.symbolic")
    codegen = importlib.import_module("symforce.codegen")
    inputs = [sf.Symbol(n) for n in ("cos_phi", "sin_phi", *INPUTS)]
    space = {s.name: s for s in inputs}
    g = _function(python_source(code, f"def g(cos_phi, sin_phi, {ARGUMENTS}):", "sf"), {"sf": sf})
    values = importlib.import_module("symforce.values").Values
    generator = codegen.Codegen(
        inputs=values(**space),
        outputs=values(G=g(*inputs)),
        config=codegen.CppConfig(),
        name="g",
        return_key="G",
    )
    folder = Path(_folder().name) / "symforce"
    made = generator.generate_function(output_dir=folder, skip_directory_nesting=True)
    header = next(file for file in made.generated_files if file.suffix == ".h")
    text = "\n".join(x for x in header.read_text("utf-8").splitlines() if not x.startswith("#include <Eigen"))
    rows = ", ".join(f"x[{k} * n + i]" for k in range(len(INPUTS)))
    loop = (
        '\nextern "C" void run(size_t n, const double *t, const double *x, double *out) {\n'
        "  for (size_t i = 0; i < n; ++i) {\n"
        f"    const double phi = {2 * np.pi * f!r} * t[i];\n"
        f"    out[i] = sym::G<double>(std::cos(phi), std::sin(phi), {rows});\n  }}\n}}\n"
    )
    return _loop(compile_c("symforce_g", f"#include <cmath>\n#include <cstddef>\n{text}{loop}", "g++"))


RIVALS: Mapping[str, Callable[[Program, float], Rival]] = {
    "heyoka cfunc": heyoka,
    "JAX jit": jax,
    "numba": numba,
    "symforce C++": symforce,
    "CasADi C": casadi,
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
        except (OSError, subprocess.CalledProcessError) as error:
            missing[name] = f"cannot be compiled: {error}"
    return made, missing
