"""The disc angle, reduced exactly however long the instrument has been turning."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

_SPLITTER = float(2**27 + 1)


def _halves(x: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Veltkamp's split of a double into two that carry at most 26 bits each."""
    scaled = _SPLITTER * x
    high = scaled - (scaled - x)
    return high, x - high


def turns(frequency: ArrayLike, time: ArrayLike) -> NDArray[np.float64]:
    """Fractional part of frequency (Hz) * time (s), between -0.5 and 0.5, to one rounding.

    The rounding error of the product is recovered (Dekker 1971) before whole turns are dropped.
    """
    f = np.asarray(frequency, dtype=np.float64)
    t = np.asarray(time, dtype=np.float64)
    product = f * t
    f_high, f_low = _halves(f)
    t_high, t_low = _halves(t)
    error = ((f_high * t_high - product) + f_high * t_low + f_low * t_high) + f_low * t_low
    return np.asarray((product - np.rint(product)) + error, dtype=np.float64)


def disc_angle(frequency: float, time: ArrayLike, shift: float = 0.0) -> NDArray[np.float64]:
    """Angle 2 pi f (time - shift), (N,) rad, of the disc from A1's position on the x axis; ``time`` (N,) s,
    ``frequency`` Hz.

    The ``shift``, s, is kept separate: added to thousands of seconds, nanoseconds would be lost.
    """
    return 2 * np.pi * (turns(frequency, time) - turns(frequency, shift))
