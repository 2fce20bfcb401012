"""The command line, ``ragg``: commands, terminal texts, the demonstration.

Imports ``base``, ``diagnosis``, ``fit``, ``flight``, ``report``, ``survey``, ``wording`` and ``workflow``.
"""
