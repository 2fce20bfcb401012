"""A flight prepared for diagnosis: whitened columns of model and candidates, and their triangles in time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime import design
from ragg_runtime.calibrate import Calibration, Linearised, Noise, linearise, whitened
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
    """

    lin: Linearised
    noise: Noise
    columns: Array
    sample: NDArray[np.intp]
    triangles: tuple[Array, ...]
    edges: NDArray[np.intp]

    @property
    def observation(self) -> Observation:
        return self.lin.observation


def prepare(
    model: Model, instrument: Instrument, observations: Sequence[Observation], c: Calibration
) -> list[Work]:
    """Linearise and whiten every flight about the calibrated parameters."""
    works = []
    for o, noise in zip(observations, c.noise, strict=True):
        lin = linearise(model, instrument, o, c.p, with_candidates=True)
        w = whitened(lin, noise)
        edges = np.linspace(0, len(o.record.time), BLOCKS + 1).astype(np.intp)
        block = np.clip(np.searchsorted(edges, w.sample, side="right") - 1, 0, BLOCKS - 1)
        triangles = tuple(design.triangle(w.columns[:, block == k]) for k in range(BLOCKS))
        works.append(Work(lin, noise, w.columns, w.sample, triangles, edges))
    return works


def to_nominal(model: Model, instrument: Instrument, c: Calibration) -> Array:
    """(n_base,): how far the nominal values are from the calibrated ones, in scales: the prior's centre."""
    scale = np.array([q.scale for q in c.columns])
    return np.asarray((vector(model, instrument)[c.index] - c.p[c.index]) / scale)
