"""The angle that Table V leaves out, and how far it moves a number.

In the output, vartheta_x enters times a second-order coefficient (Eq. 5b) and, beyond rounding, linearly:
five runs give every draw of the four angles.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.experiments import paper
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.reference.instruments import table_v

Array = NDArray[np.float64]

LARGEST = 30.0
"""arcsec: the largest misalignment angle of Table V."""

DRAWS = 1000


@dataclass(frozen=True)
class Reach:
    """Least and greatest of a quantity over vartheta_x within ``LARGEST``: name -> values over the draws."""

    values: dict[str, Array]

    def of(self, name: str) -> tuple[float, float]:
        """Least and greatest."""
        v = self.values[name]
        return float(v.min()), float(v.max())


def with_angles(arcsec: Array) -> Instrument:
    """Table V with four vartheta_x in arcsec."""
    return table_v().replace(vartheta_x=np.asarray(arcsec) * paper.ARCSEC)


def response(measure: Callable[[Instrument], Array]) -> tuple[Array, Array]:
    """A measured array without vartheta_x, shape (...), and its change per arcsec of each, (4, ...)."""
    base = measure(with_angles(np.zeros(4)))
    step = LARGEST
    slopes = np.stack([(measure(with_angles(step * np.eye(4)[j])) - base) / step for j in range(4)])
    return base, slopes


def draws(seed: int = 0) -> Array:
    """Four vartheta_x, uniform within +-``LARGEST``, (DRAWS, 4) arcsec; the corners of that cube first."""
    corners = LARGEST * np.array(list(product((1.0, -1.0), repeat=4)))
    rng = np.random.default_rng(seed)
    return np.concatenate([corners, rng.uniform(-LARGEST, LARGEST, (DRAWS - 16, 4))])


def smallest_angles(base: Array, slopes: Array, target: Array) -> Array:
    """The four vartheta_x of least square, (4,) arcsec, with which a measure (2,) becomes ``target``."""
    return np.asarray(np.linalg.lstsq(slopes.T, target - base, rcond=None)[0], dtype=np.float64)
