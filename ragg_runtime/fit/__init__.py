"""Fitting a model to flights: nonlinear least squares on the triangles of whitened columns.

Imports ``base``, ``flight``, ``generated``, ``instrument``, ``model`` and ``signals``.
"""
