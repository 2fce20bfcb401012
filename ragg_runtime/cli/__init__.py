"""The command line, ``ragg``: commands, terminal texts, the demonstration.

Imports ``base``, ``flight``, ``report``, ``survey`` and ``workflow``.
"""
