"""Single samples far beyond everything about them: recorder glitches, to be left out like missing ones."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ragg_runtime.io.record import WIDEST_SPIKE
from ragg_runtime.signals.derivative import runs

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

SIDE = 5
"""Samples before and after that a sample is held against."""

BLOCK = 256
"""Samples over which the usual scatter is taken: it changes with the motion."""

FAR = 4.4
"""Distance from both sides, over the 95 % quantile of distances from their mean (9 sigma if Gaussian)."""

GLITCH = 12.0
"""Distance of a sample of motion from the prediction by its neighbours, in robust standard deviations, from which it is off."""

STEP = 0.3
"""Share of a sample's distance by which the sides may differ: more is a step, not a spike."""

USUAL = 0.95
"""Quantile of the distances that tells the usual scatter: spikes are fewer than the rest."""

MEDIAN_OF_NORMAL = 0.67
"""Median of the modulus of a normal variable, in standard deviations."""

PART = 1 << 18
"""Samples that are looked at together in a long record."""

CACHE = 1 << 14
"""Samples that stay in the processor's cache while they are differenced."""

SPARSE = 64
"""Every so many samples are asked for a first guess at the median of all."""

MOST = 0.05
"""Largest fraction of the samples that can be spikes; more of them are no glitches but the signal."""


def spikes(residual: Array, valid: Mask, part: int = PART) -> Mask:
    """(N,) bool: the samples of a residual that are spikes.

    Parameters
    ----------
    residual
        (N,) in any unit; what a model leaves of an output, or a slowly varying record itself.
    valid
        (N,) bool: False where there is no sample; such samples are never spikes, and neighbours on either
        side of them count as neighbours.
    part
        Samples that are looked at together: the memory that a long record takes.

    A spike stands off the medians of the samples before and of those after it, to the same side: a step does
    not. It is at most ``WIDEST_SPIKE`` samples wide and ``FAR`` beyond the usual scatter of the whole record and of
    its own stretch of it. Where more than ``MOST`` of the samples would be spikes, none is.
    """
    n = len(residual)
    found = np.zeros(n, dtype=np.bool_)
    if n > 2 * part:
        for rows, inner in parts(n, part):
            found[rows][inner] = spikes(residual[rows], valid[rows], n)[inner]
        return found
    there = valid & np.isfinite(residual)
    e = np.asarray(residual if there.all() else residual[there])
    if len(e) < 8 * SIDE:
        return found
    distance, scatter = _aside(e)
    if np.count_nonzero(scatter >= np.max(distance) / FAR) > (1 - USUAL) * len(e) + 2:
        return found  # the quantile is so large that none is far, and need not be sought
    usual = _in_blocks(scatter, USUAL)
    if len(usual) > 1 and 0 < len(e) % BLOCK < BLOCK // 4:
        usual[-1] = usual[-2]  # too short to speak for itself
    usual = ndimage.maximum_filter1d(usual, 3, mode="nearest")
    everywhere = np.quantile(scatter, USUAL)
    limit = FAR * np.maximum(np.repeat(usual, BLOCK)[: len(e)], everywhere)
    far = distance > limit
    for run in runs(far):
        if run.stop - run.start > WIDEST_SPIKE:
            far[run] = False
    if everywhere == 0 or not far.any() or np.mean(far) > MOST:
        return found
    found[there] = far
    return found


def _aside(e: Array) -> tuple[Array, Array]:
    """(N,), (N,): by how much each sample of a series stands off both of its sides, to the same side (a step does not), and how
    far it is from their mean.

    The sides are the medians of the five (``SIDE``) samples before it and after it; beyond its ends the series is mirrored.
    """
    reach = SIDE // 2 + 1
    z = np.pad(np.pad(e, reach, mode="reflect"), SIDE // 2, mode="reflect")
    distance, scatter = np.empty(len(e)), np.empty(len(e))
    for start in range(0, len(e), CACHE):
        own = slice(start, min(start + CACHE, len(e)))
        median = _medians(z[start : own.stop + 2 * SIDE])
        before, after, x = median[: -2 * reach], median[2 * reach :], e[own]
        above, below = x - np.maximum(before, after), np.minimum(before, after) - x
        far = np.maximum(0.0, np.maximum(above, below))
        far[np.abs(after - before) > STEP * far] = 0.0  # a step
        distance[own] = far
        np.abs(x - (before + after) / 2, out=scatter[own])
    return distance, scatter


def _medians(z: Array) -> Array:
    """(N - 4,): medians of five neighbours."""
    low, high = np.minimum(z[:-1], z[1:]), np.maximum(z[:-1], z[1:])
    # the median is that of these two and the middle one
    f, g = np.maximum(low[:-3], low[3:]), np.minimum(high[:-3], high[3:])
    return np.asarray(np.maximum(np.minimum(f, g), np.minimum(z[2:-2], np.maximum(f, g))))


def _in_blocks(x: Array, q: float) -> Array:
    """The quantile of every ``BLOCK`` samples; of what is left over at the end, too."""
    whole = len(x) // BLOCK * BLOCK
    found = np.quantile(x[:whole].reshape(-1, BLOCK), q, axis=1)
    return np.asarray(found if whole == len(x) else np.append(found, np.quantile(x[whole:], q)))


def glitches(x: Array, valid: Mask, part: int = PART) -> tuple[Mask, Array]:
    """Spikes of a smooth record (N,), and the record with them interpolated.

    A glitch is off the prediction by its neighbours (a polynomial of the fifth degree through three samples on
    either side) by ``GLITCH`` times the usual error of that, and by more than twice the range of everything
    within a dozen samples. The largest go first, since they spoil the prediction of the others.
    """
    n = len(x)
    found = np.zeros(n, dtype=np.bool_)
    if n > 2 * part:
        whole = x
        for rows, inner in parts(n, part):
            mask, mended = glitches(x[rows], valid[rows], n)
            if mask[inner].any():
                whole = x.copy() if whole is x else whole
                whole[rows][inner] = mended[inner]
                found[rows][inner] = mask[inner]
        return found, whole
    there = valid & np.isfinite(x)
    y = np.asarray(x if there.all() else x[there])
    if len(y) < 8 * SIDE:
        return found, x
    off, y = _among(y)
    if not off.any() or np.mean(off) > MOST:
        return found, x
    found[there] = off
    mended = np.array(x)
    mended[there] = y
    return found, mended


def _among(x: Array) -> tuple[Mask, Array]:
    """Glitches of a series without gaps (N,), and the series with them interpolated."""
    off = np.zeros(len(x), dtype=np.bool_)
    y, size = x, _distance(x)
    for _ in range(12):
        at = _off(size)
        if len(at):
            at = at[(size[at] > 2 * _spread(x, at)) & (size[at] >= np.max(_about(size, at, 3), axis=1))]
        if not len(at):
            break
        y = np.array(x) if y is x else y
        off[at] = True
        good = np.flatnonzero(~off)
        mended = np.flatnonzero(off)
        y[mended] = np.interp(mended, good, y[good])
        near = np.unique(np.clip(mended[:, None] + np.arange(-3, 4), 0, len(x) - 1))
        size[near] = _distances(y, near)
    if y is x:
        return off, x
    # what was only spoiled by a glitch beside it stays
    at = np.flatnonzero(off)
    off[at] = np.abs(x[at] - y[at]) > 2 * _spread(x, at)
    y[at] = np.where(off[at], y[at], x[at])
    return off, y


def _distance(x: Array) -> Array:
    """(N,): how far each sample is off the prediction by its neighbours, the series mirrored beyond its ends.

    That is a twentieth of the sixth difference.
    """
    size = np.empty(len(x))
    for start in range(0, len(x) - 6, CACHE):
        some = np.diff(x[start : start + CACHE + 6], 6)
        some /= 20.0
        np.abs(some, out=size[start + 3 : start + 3 + len(some)])
    ends = np.r_[0:3, len(x) - 3 : len(x)]
    size[ends] = _distances(x, ends)
    return size


def _distances(x: Array, at: NDArray[np.intp]) -> Array:
    """(m,): the same of some of the samples, to the bit."""
    places = np.abs(at[:, None] + np.arange(-3, 4))
    last = len(x) - 1
    return np.asarray(np.abs(np.diff(x[last - np.abs(last - places)], 6)[:, 0] / 20.0))


def _off(size: Array) -> NDArray[np.intp]:
    """Where distances from the prediction are far beyond the usual ones, everywhere and nearby.

    The median of all is not sought where counting tells on which side of it they are.
    """
    limit, n = GLITCH / MEDIAN_OF_NORMAL, len(size)
    low = np.median(size[::SPARSE]) / 2  # not above the median of all, or that itself
    low = low if 2 * np.count_nonzero(size >= low) > n else np.median(size)
    at = np.flatnonzero(size > limit * low)
    if not len(at) or 2 * np.count_nonzero(size >= np.max(size[at]) / limit) > n:
        return at[:0]  # the median is so large that none is
    at = at[size[at] > limit * _usual(size, at)]
    if len(at) and 2 * np.count_nonzero(limit * size >= np.min(size[at])) >= n:
        at = at[size[at] > limit * np.median(size)]
    return at


def _usual(x: Array, at: NDArray[np.intp]) -> Array:
    """(m,): the largest median of the blocks in which and beside which some samples are.

    Medians are most of the work on a long record, and few blocks hold a sample that may be a glitch.
    """
    last = (len(x) - 1) // BLOCK
    blocks = np.unique(np.clip(at[:, None] // BLOCK + np.arange(-1, 2), 0, last))
    medians = np.zeros(last + 1)
    whole = blocks[(blocks + 1) * BLOCK <= len(x)]
    medians[whole] = np.quantile(x[: len(x) // BLOCK * BLOCK].reshape(-1, BLOCK)[whole], 0.5, axis=1)
    if len(blocks) > len(whole):
        medians[last] = np.quantile(x[last * BLOCK :], 0.5)
    return np.asarray(ndimage.maximum_filter1d(medians, 3, mode="nearest")[at // BLOCK])


def _about(x: Array, at: NDArray[np.intp], side: int) -> Array:
    """(m, 2 side + 1): a series about some of its samples; beyond its ends it stays what it is there."""
    return np.asarray(x[np.clip(at[:, None] + np.arange(-side, side + 1), 0, len(x) - 1)])


def _spread(x: Array, at: NDArray[np.intp]) -> Array:
    """(m,): from the third to the 23rd of the 25 samples about some samples, by size."""
    ordered = np.sort(_about(x, at, 12), axis=1)
    return np.asarray(ordered[:, 22] - ordered[:, 2])


def parts(n: int, part: int = PART) -> Iterator[tuple[slice, slice]]:
    """Parts of a long record: rows with some of the neighbours, and the part proper within them."""
    part = n if n <= 2 * part else part
    for start in range(0, n, part):
        first, last = max(0, start - BLOCK), min(n, start + part + BLOCK)
        yield slice(first, last), slice(start - first, min(n, start + part) - first)


def note_of(name: str, mask: Mask, time: Array, done: str) -> str:
    """A note: how many spikes, where, what was done with them."""
    places = np.flatnonzero(mask)
    instants = ", ".join(f"{time[k]:.10g}" for k in places[:3])
    more = ", ..." if len(places) > 3 else ""
    count = f"{len(places)} sample" + ("s stand" if len(places) > 1 else " stands")
    return (
        f"{name}: {count} far off the neighbours (spikes, {100 * np.mean(mask):.2g} %; t = {instants}{more} s);"
        f" {done}"
    )
