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
from ragg_runtime.model.record import kernel
from ragg_runtime.screening.linear_fit import Explained, Hypothesis, low_passes
from ragg_runtime.screening.sampler import Sampler

Array = NDArray[np.float64]
Family = Callable[[float], Demodulation]
"""Low-passes of one kind and order, by their corner, Hz."""

CORNERS = (0.02, 0.04, 0.07, 0.12, 0.2, 0.35)
"""Hz: corners that are tried first of every low-pass; the best is then refined between its neighbours."""

ORDERS = (1, 2, 3, 4, 6, 8)
"""Of Butterworth filters, causal, or in each direction."""

FLAT = 0.443
"""Half-power frequency of a moving average times its length."""

ROUGH, FINE = 1e-2, 1e-4
"""Relative precision of a corner that is searched for: of each kind of low-pass, and of the best ``PROMISING`` of them."""

PROMISING = 6
"""Low-passes that are looked at finely."""

HIGHEST = 0.45
"""Times the sampling rate: no low-pass is sought beyond, for half the rate is what a digital one can have at most."""

CLEARLY = 1.1
"""Factor by which less must be left than without any low-pass."""

COST = 8.0
"""Minus the logarithm of the probability that channels were made otherwise than is said."""


def hypothesis(model: Model, instrument: Instrument, s: Sampler) -> Hypothesis:
    """The low-pass, of those that people use, with which the model leaves least of inline and cross."""
    explained = low_passes(model, instrument, s.take(s.rows()))
    how, fitted = _best(partial(_left, explained, s.flight.rate, len(s.taps) // 2), s.flight.rate)
    made = "have passed" if how.kind == "none" else "were made by another demodulator, such as"
    return Hypothesis(
        what=f"inline and cross {made} {how.words()}",
        remedy=f"if that is so, say it in model.toml or in a mapping: [demodulator] {how.toml()}; else record G_out itself",
        fitted=fitted,
        cost=COST,
    )


def families() -> Iterator[Family]:
    """Every kind of low-pass; a causal one also with what it delays slow things by taken back."""
    for n in ORDERS:
        yield lambda f, n=n: Demodulation(kind="causal", order=n, cutoff=f)  # type: ignore[misc]
        yield lambda f, n=n: Demodulation(  # type: ignore[misc]
            kind="causal", order=n, cutoff=f, delay=-1.0 / (2 * np.pi * f * np.sin(np.pi / (2 * n)))
        )
        yield lambda f, n=n: Demodulation(kind="butterworth", order=n, cutoff=f)  # type: ignore[misc]
    yield lambda f: Demodulation(kind="average", length=FLAT / f)
    yield lambda f: Demodulation(kind="causal average", length=FLAT / f)


def _left(explained: Callable[[Array], Explained], rate: float, half: int, how: Demodulation) -> Explained:
    """What is left with a low-pass, of which at most so many samples on either side count."""
    if how.cutoff is not None and how.cutoff > HIGHEST * rate:
        how = replace(how, cutoff=HIGHEST * rate)
    taps = kernel(how, rate).centred
    spare = len(taps) // 2 - half
    return explained(taps[spare:-spare] if spare > 0 else np.pad(taps, -spare))


def _best(left: Callable[[Demodulation], Explained], rate: float) -> tuple[Demodulation, Explained]:
    """The low-pass that leaves least: the best corner of every family, then a finer one of those that promise most."""

    def share(how: Demodulation) -> float:
        return left(how).share

    best = none = Demodulation(kind="none")
    corners = np.array([f for f in CORNERS if f < rate / 4])
    found: list[tuple[Family, Demodulation]] = []
    for family in families() if len(corners) else ():
        k = int(np.argmin([share(family(float(f))) for f in corners]))
        low, high = corners[max(k - 1, 0)], corners[min(k + 1, len(corners) - 1)]
        found.append((family, _refined(family, share, (low, high), ROUGH)))
    found.sort(key=lambda x: share(x[1]))
    for family, how in found[:PROMISING]:
        corner = how.cutoff if how.cutoff is not None else FLAT / (how.length or 1.0)
        fine = _refined(family, share, (corner / 1.05, corner * 1.05), FINE)
        best = fine if share(fine) * (CLEARLY if best is none else 1.0) < share(best) else best
    return best, left(best)


def _refined(
    family: Family, share: Callable[[Demodulation], float], between: tuple[float, float], precision: float
) -> Demodulation:
    """The low-pass whose corner, between two, Hz, leaves least."""
    x = optimize.minimize_scalar(
        lambda x: np.log(max(share(family(float(np.exp(x)))), 1e-300)),
        bounds=(float(np.log(between[0])), float(np.log(between[1]))),
        method="bounded",
        options={"xatol": precision},
    ).x
    return family(float(np.exp(x)))
