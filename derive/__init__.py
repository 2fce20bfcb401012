"""Symbolic derivation of the instrument models. See ``stages`` (physics), ``chain`` (composition),
``harmonics`` and ``propagation`` (the paper's form), ``ir`` and ``emit`` (code).
"""

import os

# SymPy caches a thousand results unless this is set before it is imported; a derivation needs many times as many
# again, and takes a quarter less time when they are remembered.
os.environ.setdefault("SYMPY_CACHE_SIZE", "200000")
