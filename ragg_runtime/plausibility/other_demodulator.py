"""Channels that another demodulator has made: which low-pass would explain them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model
from ragg_runtime.plausibility.quick_fit import Explained, explain
from ragg_runtime.plausibility.subsample import Picker

Array = NDArray[np.float64]

CORNERS = (0.02, 0.04, 0.07, 0.12, 0.2, 0.35)
"""Hz: corners that are tried first of every low-pass; the best is then refined between its neighbours."""

ORDERS = (1, 2, 3, 4, 6, 8)
"""Of causal Butterworth filters."""

BOTH_WAYS = (1, 2, 4)
"""Of those that go forward and backward, in each direction."""

FLAT = 0.443
"""Half-power frequency of a moving average times its length."""

FINE = 1e-4
"""Relative precision of a corner that is searched for."""


@dataclass(frozen=True)
class Made:
    """How the channels were made, in words, and what the model then leaves of them."""

    what: str
    left: Explained


@dataclass(frozen=True)
class _LowPass:
    """A family of low-passes: Butterworth of an ``order``, or moving averages (order 0)."""

    order: int
    causal: bool

    def kernel(self, corner: float, rate: float, half: int) -> Array:
        """(2 half + 1,): centred, for a corner, Hz."""
        if not self.order:
            return _average(FLAT / corner, rate, half, causal=self.causal)
        from scipy import signal  # slow to import, and only records of channels need it

        impulse = np.zeros(half + 1)
        impulse[0] = 1.0
        h = signal.sosfilt(signal.butter(self.order, corner, fs=rate, output="sos"), impulse)
        return np.concatenate([np.zeros(half), h]) if self.causal else np.asarray(signal.convolve(h, h[::-1]))

    def words(self, corner: float) -> str:
        if self.order:
            way = (
                "a causal Butterworth low-pass"
                if self.causal
                else "a Butterworth low-pass, forward and backward,"
            )
            return f"{way} of order {self.order} at {corner:.3g} Hz"
        return f"a moving average over the {'last' if self.causal else 'surrounding'} {FLAT / corner:.3g} s"


FAMILIES = (
    *(_LowPass(order=n, causal=True) for n in ORDERS),
    *(_LowPass(order=n, causal=False) for n in BOTH_WAYS),
    *(_LowPass(order=0, causal=c) for c in (False, True)),
)


def best(model: Model, instrument: Instrument, p: Picker) -> Made | None:
    """The low-pass, of those that people use, with which the model leaves least of inline and cross."""
    half, rate, rows = len(p.taps) // 2, p.flight.rate, p.pick(p.rows())
    corners = np.array([f for f in CORNERS if f < rate / 4])
    found: list[Made] = []
    for family in FAMILIES:

        def left(corner: float, family: _LowPass = family) -> Explained:
            return explain(model, instrument, replace(rows, taps=family.kernel(corner, rate, half)))

        k = int(np.argmin([left(float(f)).share for f in corners]))
        near = np.log(corners[[max(k - 1, 0), min(k + 1, len(corners) - 1)]])
        x = optimize.minimize_scalar(
            lambda x, left=left: np.log(max(left(float(np.exp(x))).share, 1e-300)),
            bounds=(near[0], near[1]),
            method="bounded",
            options={"xatol": FINE},
        ).x
        corner = float(np.exp(x))
        found.append(Made(family.words(corner), left(corner)))
    return min(found, key=lambda m: m.left.share, default=None)


def _average(seconds: float, rate: float, half: int, *, causal: bool) -> Array:
    """Samples at the ends count in part, so that the length may be any."""
    n = np.arange(-half, half + 1)
    length = min(seconds * rate, float(half))
    edges = (n - 0.5, n + 0.5) if not causal else (n.astype(np.float64), n + 1.0)
    low, high = (0.0, length) if causal else (-length / 2, length / 2)
    taps = np.clip(np.minimum(edges[1], high) - np.maximum(edges[0], low), 0.0, None)
    return np.asarray(taps / np.sum(taps))
