"""Output voltages of a generated module and their derivatives: in machine code, called by ctypes, or in NumPy.

Generated C becomes a shared library, in a cache of the user under the digest of source, command and processor. The
compiler is ``CC``, else ``cc``, ``gcc`` or ``clang``, else that of the package ``ziglang`` (``pip install 'ragg[compiler]'``).
``RAGG_NATIVE=off``: never compile. Compiled is only text that this program has derived or that comes with it.
"""

from __future__ import annotations

import ctypes
import hashlib
import importlib.util
import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from generated.folded import disc_angle
from ragg_runtime.base.files import find_private_folder
from ragg_runtime.base.progress import remark, split_range
from ragg_runtime.instrument.layout import Layout

VARIABLE = "RAGG_NATIVE"

OPTIONS = ("-std=c17", "-ffp-contract=off", "-fno-math-errno", "-fPIC", "-shared")
"""No -ffast-math: it gains nothing and costs exactness. Contraction is off, as the code itself fuses products: a sample has the
same bits at any place in an array and at any level of optimisation."""

FOR_PROCESSOR: tuple[tuple[str, ...], ...] = (
    ("-march=native", "-mprefer-vector-width=512"),
    ("-march=native",),
    ("-mcpu=native",),
    (),
)
"""Tried in turn: not every compiler knows every processor."""

# how long a compiler is waited for, s: half a second is usual, and half a minute for ziglang, which compiles its own library first
PATIENCE = 60.0


class BuildError(Exception):
    """The C cannot be compiled or loaded; the message has the reason."""


def compile_library(sources: Mapping[str, str], folder: Path | None = None, *, quick: bool = False) -> Path:
    """Compile C files (name -> text) to one library in ``folder`` (by default the user's cache), unless it is there.

    Raises
    ------
    BuildError
        If there is no compiler, or if it fails.
    """
    command = [*find_compiler(), "-O1" if quick else "-O3", *OPTIONS]
    place = find_private_folder("native", folder)
    text = [f"{name}\0{sources[name]}" for name in sorted(sources)]
    identity = "\0".join((*text, *command, repr(FOR_PROCESSOR), describe_processor()))
    library = place / f"{hashlib.sha256(identity.encode()).hexdigest()[:32]}.so"
    if library.exists():
        return library
    command += ["-o", "library.so", *(n for n in sorted(sources) if n.endswith(".c")), "-lm"]
    message = ""
    try:
        with tempfile.TemporaryDirectory(prefix=".", dir=place) as work:
            for name, content in sources.items():
                (Path(work) / name).write_text(content, "utf-8")
            for options in FOR_PROCESSOR:
                # a file, as a child that hangs would keep a pipe open
                with (Path(work) / "log").open("w+", errors="replace") as log:
                    io: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": log, "stderr": log}
                    done = subprocess.run([*command, *options], cwd=work, timeout=PATIENCE, check=False, **io)
                    log.seek(0)
                    message = message or next((line for line in log if "error" in line), "")
                if done.returncode == 0:
                    os.replace(Path(work) / "library.so", library)
                    return library
    except subprocess.TimeoutExpired:
        raise BuildError(f"the C compiler {command[0]} does not answer within {PATIENCE:g} s") from None
    except OSError as refused:
        raise BuildError(f"{command[0]} or the cache {place} cannot be used: {refused.strerror}") from None
    raise BuildError(f"the C compiler {command[0]} fails: {message.strip() or 'without a message'}")


def is_off() -> bool:
    """Whether nothing is to be compiled."""
    return os.environ.get(VARIABLE, "").lower() in ("off", "0", "none")


def find_compiler() -> list[str]:
    """The C compiler as the beginning of a command; BuildError if there is none."""
    try:
        named = shlex.split(os.environ.get("CC", ""))
    except ValueError as error:
        raise BuildError(f"CC cannot be read as a command: {error}") from None
    for command in (named,) if named else (["cc"], ["gcc"], ["clang"]):
        path = shutil.which(command[0])
        if path:
            return [path, *command[1:]]
    if not named and importlib.util.find_spec("ziglang") is not None:
        return [sys.executable, "-m", "ziglang", "cc"]
    looked = named[0] if named else "cc, gcc, clang"
    remedy = "install one (pip install 'ragg[compiler]' brings one), or name it in CC"
    raise BuildError(f"there is no C compiler ({looked}): {remedy}")


@cache
def describe_processor() -> str:
    """What ``native`` means here: caches are shared between machines where home directories are."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
    except OSError:
        lines = []
    features = (x for x in lines if x.startswith(("model name", "flags", "Features", "CPU part")))
    return "\n".join((platform.system(), platform.machine(), platform.processor(), *dict.fromkeys(features)))


def load(file: Path) -> ctypes.CDLL:
    """A library of functions ragg_<model>_<function>; a damaged one is removed and made anew the next time (BuildError)."""
    try:
        return ctypes.CDLL(str(file))
    except OSError as error:
        file.unlink(missing_ok=True)
        raise BuildError(f"the compiled model cannot be loaded: {error}") from None


Array = NDArray[np.float64]


class ChainModule(Protocol):
    """A generated module: one accelerometer's V_j and its derivatives (see ``generated/chain.py``)."""

    INPUTS: tuple[str, ...]
    PARAMETERS: tuple[tuple[str, int], ...]
    ROWS: tuple[tuple[str, bool], ...]
    SIZE: int
    accelerometer: Callable[..., Array]
    derivatives: Callable[..., Array]
    values_of: Callable[[int, Array], Array]


Inputs = Sequence[ArrayLike] | NDArray[np.floating]  # one series of N samples each, in the order of the model
BLOCK = 4096  # samples that NumPy evaluates at a time, in cache


@dataclass(frozen=True, eq=False)
class Chain:
    """A generated module for the accelerometers of a layout.

    Times t in s, (N,); parameters p in SI, in the order of PARAMETERS. ``angle``: rad, (N,), of the disc of the accelerometers
    evaluated; by default 2 pi spin_frequency t, reduced exactly. ``sources``: its C, file name -> text, compiled at the first
    evaluation, ``quick``: with less optimisation, for one fit. ``folded``: the module for outputs in NumPy. ``name``: of the
    generated module.
    """

    module: ChainModule
    layout: Layout
    name: str = "chain"
    sources: Mapping[str, str] = field(default_factory=dict)
    quick: bool = True
    folded: ModuleType | None = None

    @property
    def INPUTS(self) -> tuple[str, ...]:
        return self.module.INPUTS

    @property
    def PARAMETERS(self) -> tuple[tuple[str, int], ...]:
        return self.module.PARAMETERS

    @property
    def ROWS(self) -> tuple[tuple[str, bool], ...]:
        return self.module.ROWS

    @property
    def SIZE(self) -> int:
        return self.module.SIZE

    @cached_property
    def places(self) -> Mapping[str, slice]:
        """Where each parameter is in the parameter vector."""
        ends = np.cumsum([size for _, size in self.PARAMETERS])
        return {n: slice(int(e) - size, int(e)) for (n, size), e in zip(self.PARAMETERS, ends, strict=True)}

    @cached_property
    def library(self) -> ctypes.CDLL | None:
        """The machine code; ``None``: NumPy serves."""
        if not self.sources or is_off():
            return None
        try:
            return load(compile_library(self.sources, quick=self.quick))
        except BuildError as error:
            _say_once(str(error))
            return None

    def output(
        self, t: ArrayLike, inputs: Inputs, p: ArrayLike, angle: ArrayLike | None = None, which: int = 0
    ) -> Array:
        """G_out, or another of the layout's outputs, (N,), V."""
        t, x, p, angle = self._case(t, inputs, p, angle)
        index = () if self.layout.like_paper else (which,)
        G = np.empty(len(t))
        if self.library is not None:
            name = "folded" if hasattr(self.library, "ragg_folded_output") else self.name
            self._call(f"{name}_output", index, (t, x, p, angle), G)
        elif self.folded is not None:
            for rows in split_range(len(t), BLOCK):
                phi = None if angle is None else angle[rows]
                G[rows] = self.folded.output(t[rows], np.stack([v[rows] for v in x]), p, phi, *index)
        else:
            o = self.layout.outputs[which]
            G[:] = o.combined(self.voltages(t, x, p, angle, o.members))
        return G

    def voltages(
        self,
        t: ArrayLike,
        inputs: Inputs,
        p: ArrayLike,
        angle: ArrayLike | None = None,
        members: Sequence[int] | None = None,
    ) -> Array:
        """V_1 ... V_4, or those of some accelerometers (counted from 0), (members, N), V."""
        case = self._case(t, inputs, p, angle)
        indices = tuple(range(self.layout.size) if members is None else members)
        if self.library is not None and self.layout.like_paper:
            four = np.empty((4, len(case[0])))
            self._call(f"{self.name}_voltages", (), case, four)
            return four if indices == (0, 1, 2, 3) else four[list(indices)]
        V = np.empty((len(indices), len(case[0])))
        for v, j in zip(V, indices, strict=True):
            self._fill(v, "voltage", self.module.accelerometer, j, case)
        return V

    def derivatives(
        self, j: int, t: ArrayLike, inputs: Inputs, p: ArrayLike, angle: ArrayLike | None = None
    ) -> Array:
        """Derivatives of V_j, j counted from 0, (rows, N), in the order of ROWS."""
        case = self._case(t, inputs, p, angle)
        D = np.empty((len(self.ROWS), len(case[0])))
        self._fill(D, "derivatives", self.module.derivatives, j, case)
        return D

    def _fill(self, result: Array, name: str, by_numpy: Callable[..., Array], j: int, case: _Case) -> None:
        """A result (..., N) of accelerometer j, by the function of this name in machine code, else by NumPy."""
        if self.library is not None:
            self._call(f"{self.name}_{name}", (j,), case, result)
            return
        t, x, p, angle = case
        q = self.module.values_of(j, p)
        for rows in split_range(len(t), BLOCK):
            phi = disc_angle(t[rows], float(q[1])) if angle is None else angle[rows]
            samples = np.stack([v[rows] for v in x])
            result[..., rows] = by_numpy(j, t[rows], np.cos(phi), np.sin(phi), samples, q)

    def _call(self, function: str, leading: tuple[int, ...], case: _Case, result: Array) -> None:
        """The generated C takes n, t, in, p and angle, and what it is to fill."""
        t, x, p, angle = case
        rows = (ctypes.c_void_p * len(x))(*(v.ctypes.data for v in x))
        call = getattr(self.library, f"ragg_{function}")
        call(*map(ctypes.c_size_t, (*leading, len(t))), _at(t), rows, _at(p), _at(angle), _at(result))

    def _case(self, t: ArrayLike, inputs: Inputs, p: ArrayLike, angle: ArrayLike | None) -> _Case:
        """The arguments as the generated code takes them: contiguous float64 is used where it lies, the rest converted."""
        time, values, *rows = (np.ascontiguousarray(x, dtype=np.float64) for x in (t, p, *inputs))
        phi = None if angle is None else np.ascontiguousarray(angle, dtype=np.float64)
        # the generated code reads beyond the end of what is shorter
        assert (len(rows), values.shape) == (len(self.INPUTS), (self.SIZE,))
        assert all(x is None or x.shape == time.shape for x in (*rows, phi))
        return time, rows, values, phi


_Case = tuple[Array, Sequence[Array], Array, Array | None]  # times (N,), inputs, parameters, disc angle (N,)


def _at(x: Array | None) -> ctypes.c_void_p:
    return ctypes.c_void_p(None if x is None else x.ctypes.data)


@cache
def _say_once(reason: str) -> None:
    remark(f"the model is not compiled, the slower NumPy code is used: {reason}")
