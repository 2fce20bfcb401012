"""Generic terms, harmonic x product of channels: where a residual lives, in no effect's name.

The dictionary behind ``where`` and ``unexplained``: harmonics 0 ... 4 of the spin times products of up to
three channels (motion, its time derivatives, auxiliary channels), searched sparsely.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.evaluate import GRADIENTS, Record
from ragg_runtime.segments import segments

Array = NDArray[np.float64]

HIGHEST = 4
"""Highest multiple of the spin rate: what second-order terms of a rotating force reach (Eq. 17)."""

HIGHEST_OF_ONE = 6
"""The same of constants and single channels, which are few."""

_MOTION = tuple(f"{n}_{k}" for n in ("a", "omega", "omegadot") for k in "xyz")
_CUBIC = tuple(f"{n}_{k}" for n in ("a", "omega") for k in "xyz")
_RATES = tuple(f"{d}_{n}_{k}" for d, n in (("d", "a"), ("d2", "a"), ("d", "omegadot")) for k in "xyz")
_NOT_A_CHANNEL = frozenset({"spin_angle", *GRADIENTS})


@dataclass(frozen=True)
class Term:
    """``harmonic`` (const, cos k, sin k) times the product of ``channels`` (none: 1)."""

    harmonic: str
    channels: tuple[str, ...]

    @property
    def product(self) -> str:
        """Names joined by ``*``, ``1`` for none."""
        return "*".join(self.channels) or "1"


class Dictionary:
    """The terms that a flight allows, and their series over the flight or a part of it.

    Of auxiliary channels and of time only the changes are physics here (their means are in the base), so
    these enter less their means.
    """

    def __init__(self, r: Record) -> None:
        centred = sorted(n for n in r.wide if n not in _MOTION and n not in _NOT_A_CHANNEL)
        rates = [n for n in _RATES if n.partition("_")[2] in r.wide]
        names = [*(n for n in _MOTION if n in r.wide), *centred, "time", *rates, *(f"d_{n}" for n in centred)]
        found = _statistics(r, names)
        self._centre = {n: found[n].mean for n in (*centred, "time")}
        self._size = {n: s.rms if n not in self._centre else s.spread for n, s in found.items() if s.varies}
        names = [n for n in names if n in self._size]
        motion = [n for n in names if n in _MOTION]
        other = [n for n in names if n not in _MOTION]
        products: list[tuple[str, ...]] = [(), *((n,) for n in names)]
        products += list(combinations_with_replacement(motion, 2))
        products += [
            (m, o) for m in motion if m.startswith(("a_", "omega_")) for o in other if o in self._centre
        ]
        products += list(combinations_with_replacement([n for n in names if n in _CUBIC], 3))
        alone = [Term(h, c) for c in products if len(c) <= 1 for h in harmonics(HIGHEST_OF_ONE)]
        several = [Term(h, c) for c in products if len(c) > 1 for h in harmonics(HIGHEST)]
        steady = [t for t in several if t.harmonic == "const"]
        self.terms: tuple[Term, ...] = (*alone, *steady, *(t for t in several if t.harmonic != "const"))
        self.first_order = len(alone)
        """Constants and single channels: so many of the terms, the first."""
        self.slow = len(alone) + len(steady)
        """These and products on no harmonic: so many of the terms, the first."""

    def size(self, term: Term) -> float:
        """A fixed size of the term's series, SI: the product of its channels' root mean squares."""
        return float(np.prod([self._size[n] for n in term.channels])) if term.channels else 1.0

    def series(self, term: Term, r: Record) -> Array:
        """(N,), SI, over a record of this flight."""
        x = carrier(r, term.harmonic)
        for name in term.channels:
            x = x * self._channel(name, r)
        return x

    def chunks(
        self, r: Record, terms: Sequence[Term] | None = None, most: int = 128
    ) -> Iterator[tuple[slice, NDArray[np.float32]]]:
        """The terms in pieces: their places, and their series over ``size``, (terms, N); zero where not valid."""
        chosen = self.terms if terms is None else terms
        carriers = {h: carrier(r, h) for h in harmonics(HIGHEST_OF_ONE)}
        channels = {n: np.where(r.valid, self._channel(n, r), 0.0) / self._size[n] for n in self._size}
        product = np.ones(len(r.time))
        of: tuple[str, ...] = ()
        for start in range(0, len(chosen), most):
            part = chosen[start : start + most]
            x = np.empty((len(part), len(r.time)), dtype=np.float32)
            for n, t in enumerate(part):
                if t.channels != of or not of:
                    product, of = np.where(r.valid, 1.0, 0.0), t.channels
                    for name in of:
                        product = product * channels[name]
                np.multiply(product, carriers[t.harmonic], out=x[n], casting="same_kind")
            yield slice(start, start + len(part)), x

    def _channel(self, name: str, r: Record) -> Array:
        x = r.time if name == "time" else r.series(name)
        assert x is not None
        return np.asarray(x - self._centre.get(name, 0.0))


@dataclass(frozen=True)
class _Statistics:
    mean: float
    rms: float
    spread: float
    varies: bool


def _statistics(r: Record, names: Sequence[str]) -> dict[str, _Statistics]:
    """Over the valid samples of a flight, a segment at a time."""
    count = 0.0
    first: dict[str, float] = {}
    sums = {n: np.zeros(2) for n in names}
    ends = {n: np.array([np.inf, -np.inf]) for n in names}
    for s in segments(len(r.time)):
        part = r.part(s.rows)
        count += float(np.sum(part.valid))
        for n in names:
            x = part.time if n == "time" else part.series(n)
            assert x is not None
            x = x[part.valid]
            if not len(x):
                continue
            y = x - first.setdefault(n, float(x[0]))  # squares of differences, so that no digits are lost
            sums[n] += (np.sum(y), y @ y)
            ends[n] = np.array([min(ends[n][0], np.min(x)), max(ends[n][1], np.max(x))])
    found = {}
    for n in names:
        mean, square = sums[n] / max(count, 1.0)
        origin = first.get(n, 0.0)
        spread = float(np.sqrt(max(0.0, square - mean**2)))
        mean = float(mean + origin)
        varies = bool(ends[n][1] > ends[n][0])
        found[n] = _Statistics(mean, float(np.hypot(mean, spread)) or 1.0, spread or 1.0, varies)
    return found


def harmonics(highest: int = HIGHEST) -> tuple[str, ...]:
    """const, cos 1, sin 1 ... up to a multiple of the spin rate."""
    return ("const", *(f"{f} {k}" for k in range(1, highest + 1) for f in ("cos", "sin")))


def carrier(r: Record, harmonic: str) -> Array:
    """(N,): 1, cos(k phi) or sin(k phi)."""
    if harmonic == "const":
        return np.ones(len(r.time))
    kind, k = harmonic.split()
    z = (r.cos_phi + 1j * r.sin_phi) ** int(k)
    return np.asarray(z.real if kind == "cos" else z.imag)
