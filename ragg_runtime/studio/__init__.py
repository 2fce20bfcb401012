"""The loop in a browser: a server for one user on this machine, and the page that it serves.

Imports ``base``, ``compensation``, ``diagnosis``, ``evidence``, ``fit``, ``flight``, ``instrument``, ``lack_of_fit``,
``model``, ``model_dir``, ``report``, ``signals``, ``survey``, ``wording`` and ``workflow``.
"""
