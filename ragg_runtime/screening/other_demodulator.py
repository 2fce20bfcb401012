"""Channels that another demodulator has made: which low-pass would explain them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from ragg_runtime.instrument.demodulation import Demodulation
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import make_kernel
from ragg_runtime.screening.linear_fit import Hypothesis, LinearFit, linearise
from ragg_runtime.screening.sampler import Sampler
from ragg_runtime.screening.timing import COST

Array = NDArray[np.float64]
Family = Callable[[float], Demodulation]
"""Low-passes of one kind and order, by their corner, Hz."""

CORNERS = (0.02, 0.04, 0.07, 0.12, 0.2, 0.35)
"""Hz: corners that are tried first of every low-pass; the best is then refined between its neighbours."""

ORDERS = (1, 2, 3, 4, 6, 8)
"""Of Butterworth filters, causal, or in each direction."""

FLAT = 0.443
"""Half-power frequency of a moving average times its length."""

FINE = 1e-4
"""Relative precision of a corner that is searched for."""

HIGHEST = 0.45
"""Times the sampling rate: no low-pass is sought beyond, for half the rate is what a digital one can have at most."""

CLEARLY = 1.1
"""Factor by which less must be left than without any low-pass."""


def propose_demodulator(model: Model, instrument: Instrument, s: Sampler) -> Hypothesis:
    """The low-pass, of those that people use, with which the model leaves least of inline and cross."""
    rows = s.take(s.rows())
    linear = linearise(model, instrument, rows)
    rate, half = s.flight.rate, len(s.taps) // 2

    def fit(how: Demodulation) -> LinearFit:
        if how.cutoff is not None and how.cutoff > HIGHEST * rate:
            how = replace(how, cutoff=HIGHEST * rate)
        taps = make_kernel(how, rate).centred
        spare = len(taps) // 2 - half
        return linear.fit(replace(rows, taps=taps[spare:-spare] if spare > 0 else np.pad(taps, -spare)))

    how = _find_best(lambda how: fit(how).share, rate)
    made = "have passed" if how.kind == "none" else "were made by another demodulator, such as"
    return Hypothesis(
        what=f"inline and cross {made} {how.words()}",
        remedy=f"if so, describe it in model.toml or in a mapping: [demodulator] {how.toml()}; else record G_out itself",
        fitted=fit(how),
        cost=COST,
    )


def list_families() -> Iterator[Family]:
    """Every kind of low-pass; a causal one also with what it delays slow things by taken back."""
    for n in ORDERS:
        slow = 1.0 / (2 * np.pi * np.sin(np.pi / (2 * n)))
        for kind, early in (("causal", 0.0), ("causal", slow), ("butterworth", 0.0)):
            yield partial(_make_butterworth, kind, n, early)
    for kind in ("average", "causal average"):
        yield partial(_make_average, kind)


def _make_butterworth(kind: str, order: int, early: float, corner: float) -> Demodulation:
    return Demodulation(kind=kind, order=order, cutoff=corner, delay=-early / corner)


def _make_average(kind: str, corner: float) -> Demodulation:
    return Demodulation(kind=kind, length=FLAT / corner)


def _find_best(share: Callable[[Demodulation], float], rate: float) -> Demodulation:
    """The low-pass that leaves the least share: of every family the best corner, between the neighbours of the best of a few."""
    corners = [f for f in CORNERS if f < rate / 4]
    best, least = Demodulation(kind="none"), share(Demodulation(kind="none")) / CLEARLY
    for family in list_families() if corners else ():
        corner = corners[int(np.argmin([share(family(f)) for f in corners]))]

        def loss(x: float, family: Family = family) -> float:
            return float(np.log(max(share(family(float(np.exp(x)))), 1e-300)))

        bounds = (np.log(corner / 2), np.log(2 * corner))
        found = optimize.minimize_scalar(loss, bounds=bounds, method="bounded", options={"xatol": FINE})
        fine = family(float(np.exp(found.x)))
        if share(fine) < least:
            best, least = fine, share(fine)
    return best
