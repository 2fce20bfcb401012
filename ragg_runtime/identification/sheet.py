"""Degenerate effects: those that the sheet's own parameters, or constants of a disc at rest, absorb without the prior."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.identification import likelihood_ratio

Array = NDArray[np.float64]

MOST = 0.5
"""Least share of a signature beside a parameter unknown to the sheet, and of what that explains, that the effect must show by
itself.
"""


def describe_doubt(f: Fitted, effect: str) -> str | None:
    """Why an effect is not offered on these flights, in words: the sheet, if it was wrong, or a constant would do as well."""
    e = f.model.effect(effect)
    if e is None:
        return None
    if e.turning and not any(o.record.turning for o in f.observations):
        return "the disc does not spin, so the effect is constant"
    if not e.told_from and e.common_of is None:
        return None
    own = [n for n, c in enumerate(f.candidates) if c.effect == effect]
    P = likelihood_ratio.project(f.whole, f.n_base)
    known = float(np.linalg.norm(P[:, own]))
    for name in e.told_from:
        if float(np.linalg.norm(_project_freed(f, name, own)[:, :-1])) < MOST * known:
            return f"degenerate with {name}: only the prior of {name} separates them"
    if e.common_of is not None:
        by_each = float(np.sum(P[:, -1] ** 2) - np.sum(_project_freed(f, e.common_of, own)[:, -1] ** 2))
        by_all, _ = likelihood_ratio.measure_explained(P, own, np.zeros(P.shape[1]))
        if by_all < MOST * by_each:
            return f"the errors of {e.common_of} in this record are not common to all accelerometers"
    return None


def _project_freed(f: Fitted, name: str, own: list[int]) -> Array:
    """Columns and residual once a base without the prior of that parameter is projected out."""
    return likelihood_ratio.project(f.freed(name, own), f.n_base)
