"""The derived model as machine code: generated C, compiled on first use (``CC``, else cc, gcc or clang), called without
copies.

Where there is no compiler, or the environment variable ``RAGG_NATIVE`` is ``off``, the generated NumPy code serves.
"""

from __future__ import annotations

from ragg_runtime.model.native.backends import Compiled, Evaluator, Interpreted, evaluator, for_fits
from ragg_runtime.model.native.compiler import BuildError, NativeWarning, build

__all__ = [
    "BuildError",
    "Compiled",
    "Evaluator",
    "Interpreted",
    "NativeWarning",
    "build",
    "evaluator",
    "for_fits",
]
