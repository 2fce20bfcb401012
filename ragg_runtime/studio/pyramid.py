"""Long series for a page: least and greatest values of segments, coarser and coarser, and what was made already."""

from __future__ import annotations

import struct
import threading
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
T = TypeVar("T")

KEPT = 48
"""Most series that are kept: of a day at 100 Hz each takes 40 MB, of an hour at 16 Hz a quarter of one."""

MOST_BYTES = 1 << 30
"""Most memory that they may take together, bytes."""

Singles = NDArray[np.float32]

FINEST = 16
"""Samples in a segment of the finest level: below it the samples themselves are sent."""

FACTOR = 4
"""How many segments make one of the next level."""

HEAD = struct.Struct("<4sIddI")
"""What is sent: mark, number of points, first abscissa, step, kind (0: values, 1: least and greatest values)."""


@dataclass(frozen=True)
class Pyramid:
    """A uniformly sampled series (N,), NaN where there is none, from ``start`` in steps of ``step`` (s), and its
    extremes.

    ``levels`` are (2, n), least and greatest value of segments of ``FINEST * FACTOR**k`` samples.
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


def pyramid(start: float, step: float, x: NDArray[np.floating[Any]]) -> Pyramid:
    """The pyramid of a series (N,), NaN where there is none."""
    values = np.asarray(x, dtype=np.float32)
    levels: list[Singles] = []
    length = FINEST
    while len(values) > 4 * length:
        levels.append(_coarser(levels[-1], FACTOR) if levels else _coarser(values[None], FINEST))
        length *= FACTOR
    return Pyramid(start=start, step=step, values=values, levels=tuple(levels))


def _coarser(below: Singles, by: int) -> Singles:
    """Extremes of segments of ``by`` samples."""
    whole = np.pad(below, ((0, 0), (0, -below.shape[1] % by)), constant_values=np.nan)
    parts = whole.reshape(len(whole), -1, by)
    return np.stack([np.fmin.reduce(parts[0], axis=1), np.fmax.reduce(parts[-1], axis=1)])


def _packed(values: Singles, start: float, step: float, kind: int) -> bytes:
    head = HEAD.pack(b"RAGG", values.shape[1], start, step, kind)
    return head + np.ascontiguousarray(values, dtype="<f4").tobytes()


def pyramid_with_gaps(time: Array, x: Array, step: float) -> Pyramid:
    """Of a series on a uniform grid some of whose samples are missing: NaN there."""
    places = np.round((time - time[0]) / step).astype(np.intp)
    y = np.full(int(places[-1]) + 1, np.nan)
    y[places] = x
    return pyramid(float(time[0]), step, y)


@dataclass
class Cache:
    """Made things by name, the least used forgotten first."""

    _found: OrderedDict[tuple[object, ...], object] = field(default_factory=OrderedDict)
    _making: dict[tuple[object, ...], threading.Lock] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def get(self, key: tuple[object, ...], make: Callable[[], T]) -> T:
        """What belongs to ``key``; one thread makes it, those that want the same wait."""
        with self._lock:
            own = self._making.setdefault(key, threading.Lock())
        with own:
            with self._lock:
                if key in self._found:
                    self._found.move_to_end(key)
                    return self._found[key]  # type: ignore[return-value]
            made = make()
            with self._lock:
                self._found[key] = made
                while len(self._found) > KEPT or (len(self._found) > 2 and self._bytes() > MOST_BYTES):
                    self._found.popitem(last=False)
            return made

    def _bytes(self) -> int:
        return sum(_size(x) for x in self._found.values())


def _size(x: object) -> int:
    if isinstance(x, Pyramid):
        return x.values.nbytes
    return x.nbytes if isinstance(x, np.ndarray) else sum(map(_size, x)) if isinstance(x, tuple) else 0
