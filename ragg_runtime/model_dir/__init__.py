"""A model directory: reading, changing it whole or not at all, deriving its code. May import model, instrument,
base, and ``derive``.
"""
