"""Tails of distributions, as logarithms, beyond the range of floating point."""

from __future__ import annotations

import numpy as np
from scipy import stats


def log_sf(chi2: float, rank: int) -> float:
    """Logarithm of the chi-square survival function, also where the function itself underflows."""
    if rank == 0:
        return 0.0
    value = float(stats.chi2.logsf(chi2, rank))
    if np.isfinite(value):
        return value
    # leading asymptotic term of the incomplete gamma function
    from scipy.special import gammaln

    h = rank / 2
    return float(-chi2 / 2 + (h - 1) * np.log(chi2 / 2) - gammaln(h))


def log_sf_f(ratio: float, d1: float, d2: float) -> float:
    """Logarithm of the F distribution's survival function, also where the function itself underflows."""
    value = float(stats.f.logsf(ratio, d1, d2))
    if np.isfinite(value):
        return value
    # leading term of the incomplete beta function
    from scipy.special import betaln

    x = d1 * ratio / (d2 + d1 * ratio)
    log_rest = -float(np.log1p(d1 * ratio / d2))
    return float(d2 / 2 * log_rest + (d1 / 2 - 1) * np.log(x) - np.log(d2 / 2) - betaln(d1 / 2, d2 / 2))
