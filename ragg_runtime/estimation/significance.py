"""Tails of distributions, as logarithms, beyond the range of floating point."""

from __future__ import annotations

import math

import numpy as np
from scipy import special

INDISTINGUISHABLE = 9.0
"""Chi-square by which one explanation may be worse than another and still not be told apart (3 sigma)."""


def log_sf(chi2: float, rank: int, freedom: float = np.inf) -> float:
    """Logarithm of the chi-square survival function, also where the function itself underflows.

    ``freedom``: degrees of freedom of the noise's variance, where that was estimated: chi2 / rank then follows Fisher's F.
    """
    if rank == 0:
        return 0.0
    if np.isfinite(freedom):
        return log_sf_f(chi2 / rank, rank, freedom)
    value = float(special.chdtrc(rank, chi2))
    if value > 0.0:
        return math.log(value)
    # leading asymptotic term of the incomplete gamma function
    h = rank / 2
    return float(-chi2 / 2 + (h - 1) * np.log(chi2 / 2) - special.gammaln(h))


def log_sf_t(z: float, freedom: float) -> float:
    """Logarithm of the survival function of Student's t (of the normal distribution where ``freedom`` is infinite)."""
    if np.isfinite(freedom) and freedom > 0.0:
        if z > 0.0:
            return log_sf_f(z**2, 1.0, freedom) - math.log(2.0)
        return math.log(special.stdtr(freedom, -z))
    return float(special.log_ndtr(-z))


def log_sf_f(ratio: float, d1: float, d2: float) -> float:
    """Logarithm of the F distribution's survival function, also where the function itself underflows."""
    value = float(special.fdtrc(d1, d2, ratio))
    if value > 0.0:
        return math.log(value)
    # leading term of the incomplete beta function
    x = d1 * ratio / (d2 + d1 * ratio)
    log_rest = -float(np.log1p(d1 * ratio / d2))
    return float(
        d2 / 2 * log_rest + (d1 / 2 - 1) * np.log(x) - np.log(d2 / 2) - special.betaln(d1 / 2, d2 / 2)
    )
