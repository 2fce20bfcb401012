"""Fitting a model to flights: nonlinear least squares on the R factors of whitened columns."""
