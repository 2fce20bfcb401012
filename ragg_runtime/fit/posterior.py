"""Fitted values and their uncertainty, of parameters and of combinations of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.fit.fitted import Fitted

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Posterior:
    """Fitted values (k,) in scales, and their covariance (k, k)."""

    value: Array
    covariance: Array

    def std(self, weights: Array) -> float:
        """Standard deviation of ``weights @ value``."""
        return float(np.sqrt(max(0.0, float(weights @ self.covariance @ weights))))

    def of(self, places: Sequence[int]) -> Posterior:
        """Of some of the parameters."""
        return Posterior(self.value[list(places)], self.covariance[np.ix_(places, places)])


def posterior(f: Fitted, extra: Sequence[int] = ()) -> Posterior:
    """Base parameters (as steps from the calibrated ones) and ``extra`` candidates, priors of both included."""
    return Posterior(*f.coefficients(extra))
