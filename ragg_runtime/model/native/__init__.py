"""The derived model as machine code: generated C, compiled on first use, called without copies.

``model.compiled()`` gives an :class:`Evaluator`. The C is compiled by the compiler that is there (``CC``, else
cc, gcc or clang) into a cache of the user, once for each source, compiler and processor. Where
there is no compiler the generated NumPy code serves, which is said once. The environment variable
``RAGG_NATIVE`` may be ``off`` (always NumPy).
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
