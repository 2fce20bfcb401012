"""Long series for a page: a window of one in so many points, and what was made already."""

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

HEAD = struct.Struct("<4sIddI")
"""What is sent: mark, number of points, first abscissa, step, kind (0: values, 1: least and greatest values)."""


@dataclass(frozen=True)
class Sampled:
    """A uniformly sampled series (N,), NaN where there is none, from ``start`` in steps of ``step`` (s)."""

    start: float
    step: float
    values: NDArray[np.float32]

    @staticmethod
    def of(start: float, step: float, x: NDArray[np.floating[Any]]) -> Sampled:
        """In single precision: a page draws no more digits."""
        return Sampled(start, step, np.asarray(x, dtype=np.float32))

    @staticmethod
    def with_gaps(time: Array, x: Array, step: float) -> Sampled:
        """Of a series on a uniform grid some of whose samples are missing: NaN there."""
        places = np.round((time - time[0]) / step).astype(np.intp)
        values = np.full(int(places[-1]) + 1, np.nan, dtype=np.float32)
        values[places] = x
        return Sampled(float(time[0]), step, values)

    def window(self, first: float, last: float, points: int) -> bytes:
        """The series between two abscissae, as :data:`HEAD` and floats: its samples, or the extremes of about ``points`` segments."""
        n = len(self.values)
        a = int(np.clip(np.floor((first - self.start) / self.step), 0, n))
        b = int(np.clip(np.ceil((last - self.start) / self.step) + 1, a, n))
        if b - a <= 2 * points:
            return self._packed(self.values[None, a:b], float(a), 1)
        length = -(-(b - a) // points)
        a -= a % length  # segments stay the same ones where the window moves
        x = self.values[a:b]
        parts = np.pad(x, (0, -len(x) % length), constant_values=np.nan).reshape(-1, length)
        extremes = np.stack([np.fmin.reduce(parts, axis=1), np.fmax.reduce(parts, axis=1)])
        return self._packed(extremes, a + 0.5 * (length - 1), length)

    def _packed(self, values: NDArray[np.float32], first: float, length: int) -> bytes:
        start, step = self.start + first * self.step, length * self.step
        head = HEAD.pack(b"RAGG", values.shape[1], start, step, len(values) - 1)
        return head + np.ascontiguousarray(values, dtype="<f4").tobytes()


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
    if isinstance(x, Sampled):
        return x.values.nbytes
    return x.nbytes if isinstance(x, np.ndarray) else sum(map(_size, x)) if isinstance(x, tuple) else 0
