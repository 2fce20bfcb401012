"""Effects that are something else in disguise: the sheet's own parameters, and of a disc that stands still, constants.

A prior holds each parameter of the accelerometers at the sheet's value. An effect that is what all of them have in common
(``common_of``) is testable because of that prior alone, and one that another parameter imitates (``told_from``) as well: then it is the
prior that the record contradicts, which need not be an effect. Both are seen on a triangle from which the prior is taken.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.evidence import likelihood_ratio
from ragg_runtime.fit.fitted import Fitted

Array = NDArray[np.float64]

MOST = 0.5
"""Share of a signature that must be left beside a parameter that the sheet does not know, to count as told from it; and of what such
a parameter explains, accelerometer by accelerometer, that the effect must explain by itself: one arm of four that is off
has a quarter in common with all, two have the half."""


def doubtful(f: Fitted, effect: str) -> str | None:
    """Why an effect is not offered on these flights, in words: the sheet, if it was wrong, or a constant would do as well."""
    e = f.model.effect(effect)
    if e is None:
        return None
    if e.turning and not any(o.record.turning for o in f.observations):
        return "the disc stands still: what would turn with it is a constant"
    if not e.told_from and e.common_of is None:
        return None
    own = [n for n, c in enumerate(f.candidates) if c.effect == effect]
    P = likelihood_ratio.project(f.whole, f.n_base)
    known = float(np.linalg.norm(P[:, own]))
    for name in e.told_from:
        if float(np.linalg.norm(_freed(f, name, own)[:, :-1])) < MOST * known:
            return f"only the sheet's word about {name} tells it from an error of {name}"
    if e.common_of is not None:
        by_each = float(np.sum(P[:, -1] ** 2) - np.sum(_freed(f, e.common_of, own)[:, -1] ** 2))
        by_all, _ = likelihood_ratio.explained(P, own, np.zeros(P.shape[1]))
        if by_all < MOST * by_each:
            return f"what the record says of {e.common_of} is not what all accelerometers have in common"
    return None


def _freed(f: Fitted, name: str, own: list[int]) -> Array:
    """Columns and residual once a base is projected out of which the sheet does not know that parameter."""
    return likelihood_ratio.project(f.freed(name, own), f.n_base)
