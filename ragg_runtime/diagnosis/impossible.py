"""Effects that nature knows at one size alone: a fit that puts them at another has found something else."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ragg_runtime.fit.fitted import Fitted

CERTAIN = 5.0
"""Standard deviations from the only physical value at which an estimate excludes it."""

ROOM = 0.1
"""What an estimate may be off besides, as a share of that value: by what else the model leaves out."""


def impossible(f: Fitted, effects: Iterable[str]) -> tuple[str, ...]:
    """Those of the effects, all in the fitted model, whose parameter has a size that it cannot have."""
    c = f.calibration
    found = []
    for e in effects:
        effect = f.model.effect(e)
        for q in effect.parameters if effect is not None else ():
            for n, column in enumerate(c.columns):
                if q.physical is None or column.name != f"{e}.{q.name}":
                    continue
                true = q.physical * column.unit_factor
                off = abs(float(c.p[c.index[n]]) - true)
                if off > CERTAIN * column.scale * np.sqrt(c.covariance[n, n]) + ROOM * abs(true):
                    found.append(e)
    return tuple(dict.fromkeys(found))
