"""The command line, ``ragg``: commands, terminal texts, the demonstration.

Imports ``base``, ``compensation``, ``derive``, ``diagnosis``, ``experiments``, ``fit``, ``flight``, ``instrument``,
``model``, ``model_dir``, ``report``, ``studio``, ``survey``, ``wording`` and ``workflow``.
"""
