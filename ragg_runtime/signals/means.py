"""Series between means over neighbouring samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def between(means: Array, few: int, n: int) -> Array:
    """(..., n): linear between means (..., count) of ``few`` samples each, which stand at their centres; constant before the
    first centre and after the last.
    """
    share = (np.arange(few) + (0.5 if few % 2 == 0 else 0.0)) / few
    steps = np.diff(means)[..., None] * share + means[..., :-1, None]
    inside = steps.reshape(*means.shape[:-1], -1)
    before = few // 2
    found = np.empty((*means.shape[:-1], n))
    found[..., :before] = means[..., :1]
    found[..., before : before + inside.shape[-1]] = inside
    found[..., before + inside.shape[-1] :] = means[..., -1:]
    return found
