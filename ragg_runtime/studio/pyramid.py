"""Long series for a screen: extremes in ever longer stretches, so that any zoom costs no more than its pixels."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.floating[Any]]
Singles = NDArray[np.float32]

FINEST = 16
"""Samples in a stretch of the finest level: below it the samples themselves are sent."""

FACTOR = 4
"""How many stretches make one of the next level."""

CHUNK = 1 << 20
"""Samples that are looked at at a time: a multiple of ``FINEST``."""

HEAD = struct.Struct("<4sIddI")
"""What is sent: mark, number of points, first abscissa, step, kind (0: values, 1: least and greatest values)."""


@dataclass(frozen=True)
class Pyramid:
    """A uniformly sampled series and its extremes.

    Attributes
    ----------
    start, step
        Abscissa of the first sample, and from one to the next (s).
    values
        (N,) float32; NaN where there is none.
    levels
        Of stretches of ``FINEST * FACTOR**k`` samples: (2, n), least and greatest value.
    """

    start: float
    step: float
    values: Singles
    levels: tuple[Singles, ...]

    def window(self, first: float, last: float, points: int) -> bytes:
        """The series between two abscissae in at most about ``points`` values or pairs, as :data:`HEAD` and floats."""
        n = len(self.values)
        a = int(np.clip(np.floor((first - self.start) / self.step), 0, n))
        b = int(np.clip(np.ceil((last - self.start) / self.step) + 1, a, n))
        if b - a <= 2 * points or not self.levels:
            return _packed(self.values[None, a:b], self.start + a * self.step, self.step, 0)
        level = 0
        while level + 1 < len(self.levels) and (b - a) / (FINEST * FACTOR ** (level + 1)) >= points:
            level += 1
        length = FINEST * FACTOR**level
        i, j = a // length, -(-b // length)
        middle = self.start + (i + 0.5) * length * self.step - 0.5 * self.step
        return _packed(self.levels[level][:, i:j], middle, length * self.step, 1)


def pyramid(start: float, step: float, count: int, part: Callable[[slice], Floats]) -> Pyramid:
    """The pyramid of ``count`` samples; ``part`` yields some of them, in any float, NaN where there is none."""
    values = np.empty(count, dtype=np.float32)
    for k in range(0, count, CHUNK):
        some = slice(k, min(k + CHUNK, count))
        values[some] = part(some)
    levels: list[Singles] = []
    length = FINEST
    while count > 4 * length:
        levels.append(_coarser(levels[-1], FACTOR) if levels else _coarser(values[None], FINEST))
        length *= FACTOR
    return Pyramid(start=start, step=step, values=values, levels=tuple(levels))


def _coarser(below: Singles, by: int) -> Singles:
    """Extremes of stretches of ``by`` samples, a power of two: by halves, a quarter of the time of a reduction of each."""
    short = -below.shape[1] % by
    whole = np.pad(below, ((0, 0), (0, short)), constant_values=np.nan) if short else below
    least, greatest = whole[0], whole[-1]
    with np.errstate(invalid="ignore"):  # fmin and fmax pass NaN over
        while by > 1:
            least, greatest = np.fmin(least[::2], least[1::2]), np.fmax(greatest[::2], greatest[1::2])
            by //= 2
    return np.stack([least, greatest])


def _packed(values: Singles, start: float, step: float, kind: int) -> bytes:
    head = HEAD.pack(b"RAGG", values.shape[1], start, step, kind)
    return head + np.ascontiguousarray(values, dtype="<f4").tobytes()
