"""Symbolic derivation of the instrument models. See ``stages`` (physics), ``chain`` (composition),
``harmonics`` and ``propagation`` (the paper's form), ``ir`` and ``emit`` (code).
"""
