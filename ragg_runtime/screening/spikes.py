"""Single samples far beyond everything about them: recorder glitches, to be left out like missing ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ragg_runtime.estimation.residual import STD_OF_MEDIAN
from ragg_runtime.io import Flight
from ragg_runtime.io.assemble import derive_acceleration
from ragg_runtime.io.record import (
    ANGULAR_ACCELERATION,
    ANGULAR_RATE,
    AUXILIARY,
    SI_UNITS,
    SPECIFIC_FORCE,
    WIDEST_SPIKE,
    Flag,
    is_disc_angle,
)
from ragg_runtime.signals.derivative import bridge_gaps, runs

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

MOTION = (*SPECIFIC_FORCE, *ANGULAR_RATE, *ANGULAR_ACCELERATION)

SIDE = 5
"""Samples before and after that a sample is compared with."""

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

SLOW = 0.1
"""Step from sample to sample, over the standard deviation, up to which a channel is slow: what varies faster may well have peaks."""

MOST = 0.05
"""Largest fraction of the samples that can be spikes; more of them are no glitches but the signal."""


def find_spikes(residual: Array, valid: Mask) -> Mask:
    """The samples of a residual that are spikes.

    A spike differs from the medians of the samples before and after it, to the same side: a step does
    not. It is at most ``WIDEST_SPIKE`` samples wide and ``FAR`` beyond the usual scatter of the whole record and of
    its own block of it. Where more than ``MOST`` of the samples would be spikes, none is.

    Parameters
    ----------
    residual : (N,) array
        In any unit; what a model leaves of an output, or a slowly varying record itself.
    valid : (N,) array
        False where there is no sample; such samples are never spikes, and neighbours on either
        side of them count as neighbours.

    Returns
    -------
    (N,) array of bool
    """
    found = np.zeros(len(residual), dtype=np.bool_)
    there = valid & np.isfinite(residual)
    e = residual[there]
    if len(e) < 8 * SIDE:
        return found
    reach = SIDE // 2 + 1
    median = ndimage.median_filter(np.pad(e, reach, mode="reflect"), SIDE, mode="mirror")
    before, after = median[: -2 * reach], median[2 * reach :]
    distance = np.maximum(0.0, np.maximum(e - np.maximum(before, after), np.minimum(before, after) - e))
    distance[np.abs(after - before) > STEP * distance] = 0.0  # a step
    scatter = np.abs(e - (before + after) / 2)
    everywhere = np.quantile(scatter, USUAL)
    far = distance > FAR * np.maximum(_in_blocks(scatter, USUAL), everywhere)
    for run in runs(far):
        if run.stop - run.start > WIDEST_SPIKE:
            far[run] = False
    if everywhere > 0 and np.mean(far) <= MOST:
        found[there] = far
    return found


def _in_blocks(x: Array, q: float) -> Array:
    """(N,): the largest quantile of each sample's own block and its neighbours."""
    size = min(BLOCK, len(x))
    whole = len(x) // size  # what is left over is too short to speak for itself
    usual = np.quantile(x[: whole * size].reshape(whole, size), q, axis=1)
    usual = ndimage.maximum_filter1d(usual, 3, mode="nearest")
    return np.asarray(usual[np.minimum(np.arange(len(x)) // size, whole - 1)])


def leave_out_glitches(flight: Flight) -> Flight:
    """The flight with spikes of its motion interpolated, their samples marked as not valid, and flags of them."""
    channels, valid = dict(flight.channels), np.array(flight.valid)
    flags: dict[str, Flag] = {}
    off = np.zeros_like(valid)  # samples that lack a rate
    for name, x in flight.channels.items():
        if is_disc_angle(name):
            mask, channels[name] = find_lost_angles(x, flight.valid)
        elif name in MOTION:
            mask, channels[name] = find_glitches(x, flight.valid)
        elif name in AUXILIARY or name not in SI_UNITS:
            mask, channels[name] = find_spikes_of_slow(x)
        else:
            continue  # a gradient
        if mask.any():
            flags[name] = Flag((name,), describe_spikes(name, mask, flight.time))
            valid &= ~mask | (name not in MOTION and not is_disc_angle(name))
            off |= mask & (name in ANGULAR_RATE)
    if not flags:
        return flight
    changed = replace(flight, channels=channels, valid=valid)
    if ANGULAR_ACCELERATION[0] not in flight.written and {*flags} & {*ANGULAR_RATE}:
        changed = derive_acceleration(changed, off)
        flags = {n: f for n, f in flags.items() if n not in ANGULAR_ACCELERATION}
    return changed.flagged(list(flags.values()))


def find_glitches(x: Array, valid: Mask) -> tuple[Mask, Array]:
    """Spikes of a smooth record (N,), which is interpolated where it lacks something, and the record with them interpolated.

    A glitch is off the prediction by its neighbours (a polynomial of the fifth degree through three samples on
    either side) by ``GLITCH`` times the usual error of that, and by more than twice the range of everything
    within a dozen samples. The largest go first, since they distort the prediction of the others.
    """
    found, there = np.zeros(len(x), dtype=np.bool_), np.isfinite(x)
    if np.sum(valid & there) < 8 * SIDE:
        return found, x
    # also in samples that are not used, since filters and derivatives of the record reach into them
    found[there], mended = _glitches(x[there])
    if not found.any() or np.mean(found[valid]) > MOST:
        return np.zeros_like(found), x
    whole = np.array(x)
    whole[there] = mended
    return found, whole


def find_spikes_of_slow(x: Array) -> tuple[Mask, Array]:
    """Spikes of an auxiliary channel (N,) that is slow without them, and the channel with them interpolated, as where it has no value."""
    there = np.isfinite(x)
    found = find_spikes(x, there)
    mended = bridge_gaps(x, there & ~found)
    if np.std(np.diff(mended)) > SLOW * np.std(mended):
        return np.zeros_like(found), x
    at = np.flatnonzero(found)
    found[at] = np.abs(x[at] - mended[at]) > 2 * _spread(mended, at)
    return found, np.where(found, mended, x)


def find_lost_angles(angle: Array, valid: Mask) -> tuple[Mask, Array]:
    """The same of the angle of a disc (N,), rad: what is off an even turn, which no turn of the whole hides."""
    pairs = valid[1:] & valid[:-1]
    if not pairs.any():
        return np.zeros_like(valid), angle
    line = float(np.median(_wrap(np.diff(angle))[pairs])) * np.arange(len(angle))
    line += np.angle(np.mean(np.exp(1j * (angle - line)[valid])))
    mask, mended = find_glitches(_wrap(angle - line), valid)
    return mask, np.where(mask, mended + line, angle)


def _wrap(angle: Array) -> Array:
    return np.asarray(np.angle(np.exp(1j * angle)))


def _glitches(x: Array) -> tuple[Mask, Array]:
    """Glitches of a series without gaps (N,), and the series with them interpolated."""
    # plain ones first, which may be neighbours: the prediction by such would be far off beside them
    off = find_spikes(x, np.ones(len(x), dtype=np.bool_))
    y = bridge_gaps(x, ~off, smooth=True)
    for _ in range(12):
        size = np.abs(np.diff(np.pad(y, 3, mode="reflect"), 6)) / 20.0  # off the prediction
        limit = GLITCH * STD_OF_MEDIAN * float(np.median(size))
        at = np.flatnonzero(size > limit)
        if len(at):
            at = at[size[at] > GLITCH * STD_OF_MEDIAN * _in_blocks(size, 0.5)[at]]
            at = at[(size[at] > 2 * _spread(y, at)) & (size[at] >= np.max(_about(size, at, 3), axis=1))]
        if not len(at):
            break
        off[at] = True
        y = bridge_gaps(x, ~off, smooth=True)
    # what was only distorted by a neighbouring glitch stays
    at = np.flatnonzero(off)
    off[at] = np.abs(x[at] - y[at]) > 2 * _spread(y, at)
    return off, bridge_gaps(x, ~off, smooth=True)


def _about(x: Array, at: NDArray[np.intp], side: int) -> Array:
    """(m, 2 side + 1): a series about some of its samples; beyond its ends it stays what it is there."""
    return np.asarray(x[np.clip(at[:, None] + np.arange(-side, side + 1), 0, len(x) - 1)])


def _spread(x: Array, at: NDArray[np.intp]) -> Array:
    """(m,): from the third to the 23rd of the 25 samples about some samples, by size."""
    ordered = np.sort(_about(x, at, 12), axis=1)
    return np.asarray(ordered[:, 22] - ordered[:, 2])


def describe_spikes(name: str, mask: Mask, time: Array) -> str:
    """How many spikes, where, what was done with them."""
    places = np.flatnonzero(mask)
    instants = ", ".join(f"{t:.10g}" for t in time[places[:3]]) + ", ..." * (len(places) > 3)
    spikes = "samples are spikes" if len(places) > 1 else "sample is a spike"
    return f"{name}: {len(places)} {spikes} ({100 * np.mean(mask):.2g} %; t = {instants} s), not used"
