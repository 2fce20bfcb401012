"""Fitting a model to flights: nonlinear least squares on the triangles of whitened columns."""
