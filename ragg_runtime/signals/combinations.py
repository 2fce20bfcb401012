"""Combinations of the series of an output in which noise that its accelerometers share stands alone.

What shakes a whole disc (a servo of the spin, an angular acceleration that the motion sensors see poorly) is in all voltages at
once: taken one by one each seems as noisy as that. In the paper's sums and differences over the accelerometers (D^1234, Sigma, D^12,
D^34 of Eq. 18-19, made orthonormal) it is in one of them and spares the others.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SHARED = 0.1
"""Gain in log likelihood a sample from which the combinations are taken. Independent noise of equal size gains nothing, of
unequal size loses; in a record of a thousand independent samples chance gains a hundredth."""


def basis(signs: Array) -> Array:
    """(m, m), orthonormal rows: the output itself, the sum, then differences of neighbours, as far as they are new."""
    s, one = signs, np.eye(len(signs))
    rows: list[Array] = []
    for v in (s, np.ones(len(s)), *(one[::2][: len(s) // 2] - one[1::2]), *one):
        left = v - sum((float(v @ r) * r for r in rows), np.zeros(len(s)))
        length = float(np.linalg.norm(left))
        if length > 1e-9 * float(np.linalg.norm(v)):
            rows.append(left / length)
    return np.stack(rows[: len(s)])


def telling(residuals: Array, signs: Array) -> Array | None:
    """The combinations of residuals (m, N), if these are told apart better in them (:data:`SHARED`); else ``None``."""
    if len(residuals) < 2:
        return None
    C = residuals @ residuals.T / residuals.shape[1]
    Q = basis(signs)
    each, combined = np.diag(C), np.diag(Q @ C @ Q.T)
    if not (np.min(each) > 0.0 and np.min(combined) > 0.0):
        return None
    gain = 0.5 * float(np.sum(np.log(each)) - np.sum(np.log(combined)))
    return Q if gain > SHARED else None
