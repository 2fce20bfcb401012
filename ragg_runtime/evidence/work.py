"""A flight prepared for diagnosis: whitened columns of model and candidates, and their triangles in time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ragg_runtime import design
from ragg_runtime.calibrate import Calibration, Linearised, Noise, linearise, nuisance_basis, whitened
from ragg_runtime.design import Observation
from ragg_runtime.evaluate import vector
from ragg_runtime.instrument import Instrument
from ragg_runtime.load import Model

Array = NDArray[np.float64]

BLOCKS = 24
"""Stretches of time of which each keeps a triangle of its own: for held-out time and for steps."""


@dataclass(frozen=True)
class Work:
    """One flight about the calibrated parameters.

    Attributes
    ----------
    lin
        Residual and columns in volts.
    columns
        (n, rows): whitened base, candidates, residual.
    sample
        (rows,): the sample of the record that a whitened row ends at.
    triangles
        One triangle a block of time, of the same columns.
    edges
        (BLOCKS + 1,): samples at which the blocks begin and end.
    nuisance
        (rows, k): orthonormal basis of what was projected out of all columns, if anything was.
    """

    lin: Linearised
    noise: Noise
    columns: Array
    sample: NDArray[np.intp]
    triangles: tuple[Array, ...]
    edges: NDArray[np.intp]
    nuisance: Array | None

    @cached_property
    def gradient(self) -> Array | None:
        """(m N valid, k): orthonormal basis of the unknown gradient before whitening, if there is one."""
        if not len(self.lin.nuisance):
            return None
        valid = self.observation.record.valid
        X = self.lin.nuisance[:, :, valid].reshape(len(self.lin.nuisance), -1)
        return design.orthonormal(X)

    def without_gradient(self, e: Array) -> Array:
        """Take the fitted unknown gradient out of a residual (m, N): it is signal, not error."""
        Q = self.gradient
        if Q is None:
            return e
        valid = self.observation.record.valid
        y = e[:, valid].reshape(-1)
        left = e.copy()
        left[:, valid] = (y - Q @ (Q.T @ y)).reshape(e.shape[0], -1)
        return left

    def projection(self, n_base: int, given: Sequence[int]) -> Array:
        """(rows, k): basis of all that is projected out: unknown gradient, base, ``given`` candidates."""
        taken = [*range(n_base), *(n_base + n for n in given)]
        Q = basis(self.columns[taken])
        return Q if self.nuisance is None else np.hstack([self.nuisance, Q])

    @property
    def observation(self) -> Observation:
        return self.lin.observation


def basis(columns: Array) -> Array:
    """(rows, k): orthonormal basis of whitened columns (n, rows) as far as the data determine them.

    A direction that the data see worse than its prior of unit width is shrunk away by the prior: it
    absorbs nothing, and is left out.
    """
    norms = np.linalg.norm(columns, axis=1)
    U, s, _ = np.linalg.svd(columns[norms > 0].T, full_matrices=False)
    return np.asarray(U[:, s > 1.0])


def prepare(
    model: Model, instrument: Instrument, observations: Sequence[Observation], c: Calibration
) -> list[Work]:
    """Linearise and whiten every flight about the calibrated parameters."""
    works = []
    for o, noise in zip(observations, c.noise, strict=True):
        lin = linearise(model, instrument, o, c.p, with_candidates=True)
        Q = nuisance_basis(lin.nuisance, noise, o.record.valid)
        w = whitened(lin, noise, Q)
        edges = np.linspace(0, len(o.record.time), BLOCKS + 1).astype(np.intp)
        block = np.clip(np.searchsorted(edges, w.sample, side="right") - 1, 0, BLOCKS - 1)
        triangles = tuple(design.triangle(w.columns[:, block == k]) for k in range(BLOCKS))
        works.append(Work(lin, noise, w.columns, w.sample, triangles, edges, Q))
    return works


def to_nominal(model: Model, instrument: Instrument, c: Calibration) -> Array:
    """(n_base,): how far the nominal values are from the calibrated ones, in scales: the prior's centre."""
    scale = np.array([q.scale for q in c.columns])
    return np.asarray((vector(model, instrument)[c.index] - c.p[c.index]) / scale)
