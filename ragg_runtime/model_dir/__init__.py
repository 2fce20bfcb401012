"""A model directory: reading, changing it whole or not at all, deriving its code.

Imports ``base``, ``derive``, ``instrument`` and ``model``.
"""
