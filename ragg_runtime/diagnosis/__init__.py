"""Which physical effect a model lacks: the steps of the diagnosis.

Imports ``base``, ``evidence``, ``fit``, ``flight``, ``instrument``, ``lack_of_fit``, ``model``, ``signals`` and
``wording``.
"""
