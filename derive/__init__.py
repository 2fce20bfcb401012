"""Symbolic derivation of the instrument models. See ``stages`` (physics), ``chain`` (composition),
``harmonics`` and ``propagation`` (the paper's form), ``ir`` and ``emit`` (code).
"""

import os

# SymPy remembers a thousand results unless told otherwise before it is imported; a derivation asks for many times as many
# again, and takes a quarter less time when they are remembered.
os.environ.setdefault("SYMPY_CACHE_SIZE", "200000")
