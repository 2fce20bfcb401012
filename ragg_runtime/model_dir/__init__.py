"""A model directory: reading, changing it whole or not at all, deriving its code."""
