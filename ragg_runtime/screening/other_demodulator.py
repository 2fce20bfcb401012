"""Channels that another demodulator has made: which low-pass would explain them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from ragg_runtime.instrument.demodulation import Demodulation
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.demodulation import built
from ragg_runtime.model.model import Model
from ragg_runtime.screening.quick_fit import Explained, low_passes
from ragg_runtime.screening.subsample import Picker

Array = NDArray[np.float64]
Family = Callable[[float], Demodulation]
"""Low-passes of one kind and order, by their corner, Hz."""

CORNERS = (0.02, 0.04, 0.07, 0.12, 0.2, 0.35)
"""Hz: corners that are tried first of every low-pass; the best is then refined between its neighbours."""

ORDERS = (1, 2, 3, 4, 6, 8)
"""Of causal Butterworth filters."""

BOTH_WAYS = (1, 2, 3, 4, 6, 8)
"""Of those that go forward and backward, in each direction."""

THINNED = (2, 4, 8, 16)
"""Times the record's rate at which the channels may have been made before they were thinned out."""

FLAT = 0.443
"""Half-power frequency of a moving average times its length."""

ROUGH, FINE = 1e-2, 1e-4
"""Relative precision of a corner that is searched for: of each kind of low-pass, and of the best ``PROMISING`` of them."""

PROMISING = 6


@dataclass(frozen=True)
class Made:
    """How the channels were made, and what the model then leaves of them."""

    how: Demodulation
    left: Explained


def _families() -> Iterator[Family]:
    for n in ORDERS:
        yield lambda f, n=n: Demodulation(kind="causal", order=n, cutoff=f)  # type: ignore[misc]
        yield lambda f, n=n: Demodulation(  # type: ignore[misc]
            kind="causal", order=n, cutoff=f, delay=-1.0 / (2 * np.pi * f * np.sin(np.pi / (2 * n)))
        )  # what it delays slow things by, taken back
    for n in BOTH_WAYS:
        yield lambda f, n=n: Demodulation(kind="butterworth", order=n, cutoff=f)  # type: ignore[misc]
    yield lambda f: Demodulation(kind="average", length=FLAT / f)
    yield lambda f: Demodulation(kind="causal average", length=FLAT / f)


FAMILIES: tuple[Family, ...] = tuple(_families())


def best(model: Model, instrument: Instrument, p: Picker) -> Made:
    """The low-pass, of those that people use, with which the model leaves least of inline and cross."""
    rate = p.flight.rate
    explained = low_passes(model, instrument, p.pick(p.rows()))
    corners = np.array([f for f in CORNERS if f < rate / 4])

    def left(how: Demodulation) -> Explained:
        if how.cutoff is not None and how.cutoff > HIGHEST * (how.rate or rate):
            how = replace(how, cutoff=HIGHEST * (how.rate or rate))
        return explained(_taps(how, rate, len(p.taps) // 2))

    unfiltered = Made(NO_LOW_PASS, left(NO_LOW_PASS))
    found = []
    for family in FAMILIES:
        k = int(np.argmin([left(family(float(f))).share for f in corners]))
        between = corners[[max(k - 1, 0), min(k + 1, len(corners) - 1)]]
        found.append(_refined(family, left, between, ROUGH))
    if not found:
        return unfiltered
    found.sort(key=lambda m: m[1].left.share)
    about = np.array([1 / NEAR, NEAR])
    found = [_refined(family, left, _corner(made.how) * about, FINE) for family, made in found[:PROMISING]]
    found.sort(key=lambda m: m[1].left.share)
    family, made = found[0]
    for near, there in found[:LATE_TRIED]:
        late = _late(near, left, there)
        if late[1].left.share * PLAINLY < made.left.share:
            family, made = late
    # where they were thinned out the corner is another one by a little: a digital low-pass bends its frequencies
    for every in THINNED:
        faster = _faster(family, every * rate)
        other = _refined(faster, left, _corner(made.how) * about, FINE)[1]
        if other.left.share * CLEARLY < made.left.share:
            made = other
    return made if made.left.share * CLEARLY < unfiltered.left.share else unfiltered


NO_LOW_PASS = Demodulation(kind="none")

HIGHEST = 0.45
"""Times the sampling rate: no low-pass is sought beyond, for half the rate is what a digital one can have at most."""

NEAR = 1.05
"""Factor about a corner within which it is searched for once more."""

LATE_TRIED = 3
"""Low-passes of which it is asked whether they fit better with a delay: the best without one."""

NO_DELAY = 1e-3
"""s: less is none, but what else the low-pass is not quite."""

PLAINLY = 2.0
"""Factor by which less must be left for a delay to be said: it is one more number that is fitted."""

CLEARLY = 1.1
"""Factor by which less must be left for channels to be taken for thinned out."""


def _late(family: Family, left: Callable[[Demodulation], Explained], made: Made) -> tuple[Family, Made]:
    """The same low-pass with a delay, s, or without some of its own: corner and delay at which least is left."""

    def at(x: Array) -> Demodulation:
        return replace(family(float(np.exp(x[0]))), delay=float(x[1]))

    def cost(x: Array) -> float:
        return float(np.log(max(left(at(x)).share, 1e-300)))

    begin = np.log(_corner(made.how))
    x = optimize.fmin(
        cost,
        np.array([begin, made.how.delay]),
        initial_simplex=np.array([begin, made.how.delay]) + np.array([[0.0, 0.0], [0.1, 0.0], [0.0, 0.3]]),
        xtol=FINE,
        maxfun=120,
        disp=False,
    )
    how = at(x)
    if abs(how.delay) < NO_DELAY:
        how = replace(how, delay=0.0)
    return lambda f: replace(family(f), delay=how.delay), Made(how, left(how))


def _corner(how: Demodulation) -> float:
    return how.cutoff if how.cutoff is not None else FLAT / (how.length or 1.0)


def _faster(family: Family, rate: float) -> Family:
    return lambda f: replace(family(f), rate=rate)


def _refined(
    family: Family, left: Callable[[Demodulation], Explained], near: Array, precision: float
) -> tuple[Family, Made]:
    """The corner between two, Hz, at which least is left."""
    low, high = np.log(near)
    x = optimize.minimize_scalar(
        lambda x: np.log(max(left(family(float(np.exp(x)))).share, 1e-300)),
        bounds=(low, high),
        method="bounded",
        options={"xatol": precision},
    ).x
    how = family(float(np.exp(x)))
    return family, Made(how, left(how))


def _taps(how: Demodulation, rate: float, half: int) -> Array:
    """A low-pass, of which at most so many samples on either side count."""
    taps = built(how, rate).centred
    spare = len(taps) // 2 - half
    return taps[spare:-spare] if spare > 0 else np.pad(taps, -spare)
