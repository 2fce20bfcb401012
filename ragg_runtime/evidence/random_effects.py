"""Effects that no column can express: random ones, by a score test of their variance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.evidence.likelihood_ratio import Test
from ragg_runtime.fit.passes import Piece

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Variance:
    """Sums over samples for a score test of a random effect: is the residual larger where it would show?"""

    count: int
    sums: Array

    @staticmethod
    def of(piece: Piece, place: int, residual: Array) -> Variance:
        """Of a segment; ``place`` is the effect's column, ``residual`` (rows,) is whitened and projected."""
        s2, e2 = piece.white[place] ** 2, residual**2
        return Variance(len(e2), np.array([np.sum(s2), np.sum(e2), s2 @ s2, e2 @ e2, s2 @ e2]))

    def test(self) -> Test:
        """Score test of the variance, with the residual's own fourth moment, so that heavy tails raise no alarm."""
        s2, e2, s4, e4, s2e2 = self.sums / max(self.count, 1)
        spread, ratio = s4 - s2**2, e4 / e2**2 - 1.0
        if spread <= 0.0 or ratio <= 0.0:
            return Test(0.0, 0, 0.0, (0,))
        z = float(np.sqrt(self.count) * (s2e2 / e2 - s2) / np.sqrt(spread * ratio))
        return Test(max(z, 0.0) ** 2, 1, float(special.log_ndtr(-z)), (0,))


def pooled(parts: Sequence[Variance]) -> Variance:
    """The sums of several segments or flights together."""
    return Variance(sum(p.count for p in parts), np.sum([p.sums for p in parts], axis=0))
