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

Array = NDArray[np.float64]

HIGHEST = 4
"""Highest multiple of the spin rate: what second-order terms of a rotating force reach (Eq. 17)."""

_MOTION = tuple(f"{n}_{k}" for n in ("a", "omega", "omegadot") for k in "xyz")
_CUBIC = tuple(f"{n}_{k}" for n in ("a", "omega") for k in "xyz")
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
    """The terms that a record allows, and their series."""

    def __init__(self, r: Record) -> None:
        self._record = r
        self._series: dict[str, Array] = {n: r.channels[n] for n in _MOTION if n in r.channels}
        auxiliary = sorted(n for n in r.channels if n not in _MOTION and n not in _NOT_A_CHANNEL)
        for name in auxiliary:  # only changes of an auxiliary are physics here: its mean is in the base
            x = r.channels[name]
            self._series[name] = x - np.mean(x[r.valid])
        self._series["time"] = r.time - np.mean(r.time)
        derivatives = [f"d_a_{k}" for k in "xyz"]
        for name in derivatives:
            rate = r.series(name)
            if rate is not None:
                self._series[name] = rate
        self._series = {n: x for n, x in self._series.items() if np.ptp(x[r.valid]) > 0.0}
        names = tuple(self._series)
        motion = [n for n in names if n in _MOTION]
        other = [n for n in names if n not in _MOTION]
        products: list[tuple[str, ...]] = [(), *((n,) for n in names)]
        products += list(combinations_with_replacement(motion, 2))
        products += [(m, o) for m in motion if m.startswith(("a_", "omega_")) for o in other if o[:2] != "d_"]
        products += list(combinations_with_replacement([n for n in names if n in _CUBIC], 3))
        self.terms: tuple[Term, ...] = tuple(
            Term(h, c) for c in products for h in harmonics() if h != "const" or c
        )

    def series(self, term: Term) -> Array:
        """(N,), SI (auxiliary channels less their mean)."""
        x = _carrier(self._record, term.harmonic)
        for name in term.channels:
            x = x * self._series[name]
        return x

    def chunks(self, size: int = 128) -> Iterator[tuple[Sequence[Term], NDArray[np.float32]]]:
        """The dictionary in pieces: terms and their series to unit rms, (len(terms), N)."""
        products: dict[tuple[str, ...], Array] = {}
        carriers = {h: _carrier(self._record, h) for h in harmonics()}
        for start in range(0, len(self.terms), size):
            part = self.terms[start : start + size]
            x = np.empty((len(part), len(self._record.time)), dtype=np.float32)
            for n, t in enumerate(part):
                if t.channels not in products:
                    products = {t.channels: self.series(Term("const", t.channels))}
                product = products[t.channels] * carriers[t.harmonic]
                x[n] = product / self._rms(product)
            yield part, x

    def _rms(self, x: Array) -> float:
        return float(np.sqrt(np.mean(x[self._record.valid] ** 2))) or 1.0

    def rms(self, term: Term) -> float:
        """Root mean square of a term's series over the valid samples, SI."""
        return self._rms(self.series(term))


def harmonics() -> tuple[str, ...]:
    return ("const", *(f"{f} {k}" for k in range(1, HIGHEST + 1) for f in ("cos", "sin")))


def _carrier(r: Record, harmonic: str) -> Array:
    if harmonic == "const":
        return np.ones(len(r.time))
    kind, k = harmonic.split()
    z = (r.cos_phi + 1j * r.sin_phi) ** int(k)
    return np.asarray(z.real if kind == "cos" else z.imag)
