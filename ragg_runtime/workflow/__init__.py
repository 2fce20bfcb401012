"""The steps of the loop, for the command line and Python: load, compare, diagnose, add, remove, simulate.

Imports ``base``, ``compensation``, ``diagnosis``, ``flight``, ``instrument``, ``model``, ``model_dir``,
``plausibility``, ``reference``, ``survey`` and ``wording``.
"""
