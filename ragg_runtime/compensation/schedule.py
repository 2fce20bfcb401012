"""Which parameters compensate which samples of a flight, and in which directions they may be wrong."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.calibrated import base, inverse, with_sheet
from ragg_runtime.fit.calibrate import Calibration
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.fit.segments import BLOCKS, block_edges
from ragg_runtime.fit.square_root import join

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Stretch:
    """Samples ``first`` to ``last`` of a flight with one parameter vector.

    ``p`` (size,) in SI; ``directions`` (k, size): steps of one standard deviation, independent of one another, from
    ``about``, where the fit was linearised: what it sees nothing of there it would seem to see elsewhere.
    """

    first: int
    last: int
    p: Array
    about: Array
    directions: Array

    def along(self, basis: Array) -> Stretch:
        """The same with fewer directions: ``basis`` (k, r), orthonormal columns."""
        return replace(self, directions=basis.T @ self.directions)


def _stretch(c: Calibration, first: int, last: int, p: Array, root: Array) -> Stretch:
    scale = np.array([q.scale for q in c.columns])
    directions = np.zeros((root.shape[1], len(p)))
    directions[:, c.index] = root.T * scale
    return Stretch(first=first, last=last, p=p, about=c.p, directions=directions)


def whole(c: Calibration, root: Array, samples: int) -> tuple[Stretch, ...]:
    """One calibration for all samples; ``root`` (n, k) of its covariance, in scales."""
    return (_stretch(c, 0, samples, c.p, root),)


def crossed(f: Fitted) -> list[tuple[Stretch, ...]]:
    """Of every observation: each block of time with the calibration on everything else.

    Of that block none of the outputs of the observation's flight counts.
    """
    c = f.calibration
    scale = np.array([q.scale for q in c.columns])
    all_of = [base(x, f.n_base) for x in f.triangles]
    found = []
    for o in f.observations:
        edges = block_edges(len(o.record.time))
        stretches = []
        for b in range(BLOCKS):
            block = (o.flight, b)
            others = [
                t
                for x, ts in zip(f.observations, all_of, strict=True)
                for y, t in enumerate(ts)
                if (x.flight, y) != block
            ]
            normal = with_sheet(join(others), f.to_nominal)
            p = c.p.copy()
            p[c.index] += normal.step * scale
            stretches.append(_stretch(c, int(edges[b]), int(edges[b + 1]), p, inverse(normal.R)))
        found.append(tuple(stretches))
    return found


def within(stretches: Sequence[Stretch], first: int, last: int) -> list[tuple[slice, Stretch]]:
    """The stretches of samples first ... last, with their places counted from ``first``."""
    found = []
    for s in stretches:
        a, b = max(s.first, first), min(s.last, last)
        if a < b:
            found.append((slice(a - first, b - first), s))
    return found
