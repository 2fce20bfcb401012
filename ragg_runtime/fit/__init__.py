"""Fits: the columns of a model, whitened, as triangles; calibration and its score. May import model, flight,
signals and below.
"""
