"""What the machine could do at best: memory traffic like the model's, copying, and arithmetic, measured."""

from __future__ import annotations

import ctypes
import platform
import re
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from benchmarks import RATIO, Row
from benchmarks.rivals import compile_c
from benchmarks.timing import interleaved

Array = NDArray[np.float64]

LANES = 12
"""Independent chains of multiply-adds, a register each: enough to keep two units busy, few enough for sixteen registers."""

SOURCE = """
#include <stddef.h>
/* As many streams as the model reads and writes, and as little arithmetic as keeps the reads alive. */
void traffic(size_t n, const double *restrict t, const double *restrict x, double *restrict out) {
    for (size_t i = 0; i < n; ++i) {
        out[i] = t[i] %(sum)s;
    }
}
void triad(size_t n, double *restrict a, const double *restrict b, const double *restrict c) {
    for (size_t i = 0; i < n; ++i) {
        a[i] = b[i] + 3.0 * c[i];
    }
}
#if defined __AVX512F__
enum { WIDE = 8 };
#elif defined __AVX__
enum { WIDE = 4 };
#else
enum { WIDE = 2 };
#endif
typedef double vector __attribute__((vector_size(8 * WIDE)));
int wide(void) { return WIDE; }
double arithmetic(size_t n, double factor) {
    vector v[%(lanes)d];
    for (int k = 0; k < %(lanes)d; ++k) {
        for (int l = 0; l < WIDE; ++l) v[k][l] = k + 0.1 * l;
    }
    for (size_t i = 0; i < n; ++i) {
        _Pragma("GCC unroll 16") for (int k = 0; k < %(lanes)d; ++k) v[k] = v[k] * factor + 0.5;
    }
    double total = 0.0;
    for (int k = 0; k < %(lanes)d; ++k) total += v[k][0] + v[k][WIDE - 1];
    return total;
}
"""
FLAGS = ("-O3", "-march=native", "-mprefer-vector-width=512", "-ffp-contract=fast", "-fPIC", "-shared")


class Bounds:
    """The machine's bounds, by small C loops."""

    def __init__(self) -> None:
        streams = " ".join(f"+ x[{k} * n + i]" for k in range(15))
        flags = (
            FLAGS
            if platform.machine() in ("x86_64", "AMD64")
            else tuple(f for f in FLAGS if "prefer" not in f)
        )
        self._library = compile_c("bounds", SOURCE % {"sum": streams, "lanes": LANES}, flags)
        self._library.arithmetic.restype = ctypes.c_double

    def traffic(self, t: Array, x: Array, out: Array) -> None:
        """Read t and the 15 rows of x, write out."""
        self._library.traffic(ctypes.c_size_t(len(t)), *(ctypes.c_void_p(a.ctypes.data) for a in (t, x, out)))

    def triad_rate(self, n: int = 8_000_000) -> float:
        """a = b + 3 c, GB/s of what is asked for (the write's own read is not counted), best of ten."""
        a, b, c = (np.full(n, v) for v in (0.0, 1.0, 2.0))
        arguments = (ctypes.c_size_t(n), *(ctypes.c_void_p(v.ctypes.data) for v in (a, b, c)))
        return 24e-9 * n / _best(lambda: self._library.triad(*arguments))

    def fused_rate(self, n: int = 400_000) -> float:
        """Multiply-adds of float64, 1e9/s, best of ten."""
        seconds = _best(lambda: self._library.arithmetic(ctypes.c_size_t(n), ctypes.c_double(0.999)))
        return 1e-9 * n * LANES * int(self._library.wide()) / seconds

    def rows(self, in_cache: float) -> list[Row]:
        """Triad, arithmetic, and how far our time in cache, ns a sample, is from what arithmetic alone takes."""
        fused, operations = self.fused_rate(), instructions()
        bound = operations / fused
        return [
            Row("triad", self.triad_rate(), "GB/s", "24 bytes an element"),
            Row("multiply-adds of float64", fused, "1e9/s"),
            Row(
                "arithmetic bound", bound, "ns", f"{operations} operations a sample, each as one multiply-add"
            ),
            Row("generated C, compiled / arithmetic bound, in cache", in_cache / bound, RATIO),
        ]


def instructions() -> int:
    """Arithmetic of the generated C, a sample, with FMA counted once."""
    from ragg_runtime.model.model import load_packaged

    text = load_packaged().sources["folded.c"]
    loops = [
        text[text.index(f"static inline void {name}(") :].split("\n}\n")[0] for name in ("disc", "block")
    ]
    turn = text.partition("static inline void turn(")[2]
    turn = turn.partition("uint64_t")[0]  # the rest moves bits
    code = "".join(x.split("for (", 1)[1].split("{", 1)[1] for x in loops) + turn.split("{", 1)[1]
    code = re.sub(r"/\*.*?\*/", "", code, flags=re.DOTALL).replace("const double *", "")
    code = re.sub(r"two_product\([^;]*\);", "a * b; FMA(a);", code)  # one product and its error
    fused = code.count("FMA(")
    plain = len(re.findall(r"(?<=[\w)\]]) ?[*+-] ?(?=[\w(])", code))
    return fused + plain


def _best(work: Callable[[], object]) -> float:
    return interleaved({"": work}, 10)[""].least
