"""Fitted parameters and the combinations of them that a record sees."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.fit.columns import Column

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ParameterValue:
    """A fitted parameter, in its display unit."""

    name: str
    accelerometer: int | None
    value: float
    std: float
    unit: str

    def as_json(self) -> dict[str, object]:
        return {
            "name": self.name,
            "accelerometer": self.accelerometer,
            "value": self.value,
            "std": self.std,
            "unit": self.unit,
        }


def parameter_values(columns: Sequence[Column], values: Array, covariance: Array) -> list[ParameterValue]:
    """Fitted parameters (in scales) in their display units."""
    found = []
    for k, c in enumerate(columns):
        factor = c.scale / c.unit_factor
        name = c.name.split(".", 1)[1] if c.effect else c.name
        std = float(np.sqrt(covariance[k, k])) * factor
        found.append(ParameterValue(name, c.accelerometer, float(values[k]) * factor, std, c.unit))
    return found


PATTERNS: tuple[tuple[str, tuple[float, ...]], ...] = (
    ("{0}[1] - {0}[2]", (1.0, -1.0, 0.0, 0.0)),
    ("{0}[3] - {0}[4]", (0.0, 0.0, 1.0, -1.0)),
    ("{0}[1] + {0}[2] - {0}[3] - {0}[4]", (1.0, 1.0, -1.0, -1.0)),
    ("{0}[1] + {0}[2] + {0}[3] + {0}[4]", (1.0, 1.0, 1.0, 1.0)),
)
"""The paper's D^12, D^34, D^1234 and Sigma of a parameter: what the output may see of it."""


def visible_combinations(columns: Sequence[Column], values: Array, covariance: Array) -> list[ParameterValue]:
    """The combinations of four values that the record determines, where it does not determine each of them.

    A combination counts as seen where its standard deviation is below a tenth of the prior's.
    """
    found = []
    for name in dict.fromkeys(c.name for c in columns if c.accelerometer is not None):
        at = [k for k, c in enumerate(columns) if c.name == name]
        if len(at) != 4:
            continue
        c = columns[at[0]]
        factor = c.scale / c.unit_factor
        block = covariance[np.ix_(at, at)]
        if np.all(np.diag(block) < 0.01):
            continue  # each value is seen by itself
        for pattern, weights in PATTERNS:
            w = np.array(weights)
            variance = float(w @ block @ w)
            if variance < 0.01 * float(w @ w):
                label = pattern.format(name.split(".", 1)[-1])
                value = float(w @ values[at]) * factor
                found.append(ParameterValue(label, None, value, float(np.sqrt(variance)) * factor, c.unit))
    return found
