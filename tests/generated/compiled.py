"""Generated C as shared libraries, called through ctypes."""

from __future__ import annotations

import ctypes
import hashlib
import os
import subprocess
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SOURCES = Path(__file__).resolve().parents[2] / "generated" / "c"
STRICT = ("-std=c17", "-Wall", "-Wextra", "-Wconversion", "-Werror", "-pedantic")

_double = ctypes.POINTER(ctypes.c_double)


def compile_with(compiler: str, arguments: Sequence[str]) -> None:
    """Run a compiler; what it says is the error."""
    done = subprocess.run([compiler, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{compiler} {' '.join(arguments)}\n{done.stderr}"


def _pointer(x: Array) -> ctypes._Pointer[ctypes.c_double]:
    assert x.flags.c_contiguous
    assert x.dtype == np.float64
    return x.ctypes.data_as(_double)


class Library:
    """One generated model: the functions ragg_<name>_... of a shared library."""

    def __init__(self, file: Path, name: str) -> None:
        self._library = ctypes.CDLL(str(file))
        self._name = name

    def _call(
        self,
        function: str,
        t: Array,
        inputs: Array,
        p: Array,
        rows: int,
        leading: Sequence[int] = (),
        angle: Array | None = None,
    ) -> Array:
        series = np.ascontiguousarray(inputs)
        pointers = (_double * len(series))(*(_pointer(row) for row in series))
        found = np.full((rows, len(t)), np.nan)
        getattr(self._library, f"ragg_{self._name}_{function}")(
            *(ctypes.c_size_t(v) for v in (*leading, len(t))),
            _pointer(np.ascontiguousarray(t)),
            pointers,
            _pointer(np.ascontiguousarray(p)),
            None if angle is None else _pointer(angle),
            _pointer(found),
        )
        return found

    def output(self, t: Array, inputs: Array, p: Array, angle: Array | None = None) -> Array:
        return self._call("output", t, inputs, p, 1, angle=angle)[0]

    def voltages(self, t: Array, inputs: Array, p: Array) -> Array:
        return self._call("voltages", t, inputs, p, 4)

    def jacobian(self, t: Array, inputs: Array, p: Array) -> Array:
        return self._call("jacobian", t, inputs, p, len(p))

    def derivatives(self, j: int, t: Array, inputs: Array, p: Array, rows: int) -> Array:
        return self._call("derivatives", t, inputs, p, rows, (j,))

    def amplitudes(self, inputs: Array, p: Array, count: int) -> Array:
        found = np.full((count, inputs.shape[1]), np.nan)
        for n in range(inputs.shape[1]):
            column, result = np.ascontiguousarray(inputs[:, n]), np.empty(count)
            getattr(self._library, f"ragg_{self._name}_amplitudes")(
                _pointer(column), _pointer(np.ascontiguousarray(p)), _pointer(result)
            )
            found[:, n] = result
        return found


NATIVE = ("-march=native",)


@cache
def committed(processor: Sequence[str] = NATIVE, names: tuple[str, ...] = ()) -> dict[str, Library]:
    """The packaged models, all or some, by name, compiled by gcc with every warning an error; once for all tests."""
    names = names or tuple(sorted(f.stem for f in SOURCES.glob("*.c")))
    sources = [str(SOURCES / f"{n}.c") for n in names]
    # vectors, and the scalar code for what they leave over
    options = [*STRICT, "-O3", *processor, "-ffp-contract=off", "-shared", "-fPIC"]
    texts = [f.read_bytes() for f in sorted(SOURCES.iterdir())]
    digest = hashlib.sha256(b"".join([*texts, " ".join([*options, *sources]).encode()])).hexdigest()
    file = Path(os.environ["RAGG_TESTS_CACHE"]) / f"{digest[:16]}.so"
    if not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        made = file.with_suffix(f".{os.getpid()}")
        compile_with("gcc", [*options, *sources, "-lm", "-o", str(made)])
        made.replace(file)
    return {n: Library(file, n) for n in names}


def chains(folder: Path, texts: Mapping[str, Mapping[str, str]]) -> dict[str, Library]:
    """The chain of each derived model (label -> its files), one shared library each, two compilers at a time."""

    def build(label: str) -> Library:
        place = folder / label
        place.mkdir()
        for name in ("chain.h", "chain.c"):
            (place / name).write_text(texts[label][f"c/{name}"])
        file = place / "chain.so"
        compile_with(
            "gcc", [*STRICT, "-O0", "-shared", "-fPIC", str(place / "chain.c"), "-lm", "-o", str(file)]
        )
        return Library(file, "chain")

    with ThreadPoolExecutor(2) as pool:
        return dict(zip(texts, pool.map(build, texts), strict=True))
