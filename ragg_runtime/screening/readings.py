"""Readings that are none: values that a column repeats, or that are far beyond everything about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy import ndimage
from scipy.ndimage import binary_dilation

from ragg_runtime.base.errors import count
from ragg_runtime.estimation.scores import STD_OF_MEDIAN
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
from ragg_runtime.signals.derivative import REACH, bridge_gaps, find_short_runs, runs
from ragg_runtime.signals.fir import find_step

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

MOTION = (*SPECIFIC_FORCE, *ANGULAR_RATE, *ANGULAR_ACCELERATION)

SIDE = 5  # samples before and after that a sample is compared with
BLOCK = 256  # samples over which the usual scatter is taken: it changes with the motion
# distance from both sides, over the 95 % quantile of distances from their mean (9 sigma if Gaussian)
FAR = 4.4
# distance of a sample of motion from the prediction by its neighbours, in robust standard deviations, from which it is off
GLITCH = 12.0
STEP = 0.3  # share of a sample's distance by which the sides may differ: more is a step, not a spike
USUAL = 0.95  # quantile of the distances that tells the usual scatter: spikes are fewer than the rest
# step from sample to sample, over the standard deviation, up to which a channel is slow: what varies faster may well have peaks
SLOW = 0.1
MOST = 0.05  # largest fraction of the samples that can be spikes; more of them are no glitches but the signal


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
    spikes = np.zeros(len(residual), dtype=np.bool_)
    present = valid & np.isfinite(residual)
    e = residual[present]
    if len(e) < 8 * SIDE:
        return spikes
    reach = SIDE // 2 + 1
    median = ndimage.median_filter(np.pad(e, reach, mode="reflect"), SIDE, mode="mirror")
    before, after = median[: -2 * reach], median[2 * reach :]
    distance = np.maximum(0.0, np.maximum(e - np.maximum(before, after), np.minimum(before, after) - e))
    distance[np.abs(after - before) > STEP * distance] = 0.0  # a step
    scatter = np.abs(e - (before + after) / 2)
    everywhere = np.quantile(scatter, USUAL)
    far = distance > FAR * np.maximum(_find_block_quantiles(scatter, USUAL), everywhere)
    far = find_short_runs(far, WIDEST_SPIKE)
    if everywhere > 0 and np.mean(far) <= MOST:
        spikes[present] = far
    return spikes


def _find_block_quantiles(x: Array, q: float) -> Array:
    """(N,): the largest quantile of each sample's own block and its neighbours."""
    size = min(BLOCK, len(x))
    whole = len(x) // size  # what is left over is too short to speak for itself
    usual = np.quantile(x[: whole * size].reshape(whole, size), q, axis=1)
    usual = ndimage.maximum_filter1d(usual, 3, mode="nearest")
    return np.asarray(usual[np.minimum(np.arange(len(x)) // size, whole - 1)])


def leave_out_glitches(flight: Flight, suspects: Mask | None = None) -> Flight:
    """The flight with spikes of its motion interpolated, their samples marked as not valid, and flags of them.

    Of ``suspects`` (N,), samples at which a model fails: columns of motion that are the reason.
    """
    columns, valid = {}, np.array(flight.valid)
    flags: dict[str, Flag] = {}
    off = np.zeros_like(valid)  # samples that lack a rate
    for name, x in flight.channels.items():
        if name in MOTION:
            mask, mended = find_glitches(x, flight.valid, suspects)
        elif suspects is not None:
            continue
        elif is_disc_angle(name):
            mask, mended = find_lost_angles(x, flight.valid)
        elif name in AUXILIARY or name not in SI_UNITS:
            mask, mended = find_spikes_of_slow(x)
        else:
            continue  # a gradient
        if mask.any():
            columns[name] = mended
            flags[name] = Flag((name,), describe_spikes(name, mask, flight.time))
            valid &= ~mask | (name not in MOTION and not is_disc_angle(name))
            off |= mask & (name in ANGULAR_RATE)
    if not flags:
        return flight
    if ANGULAR_ACCELERATION[0] not in flight.written and {*flags} & {*ANGULAR_RATE}:
        flags = {n: f for n, f in flags.items() if n not in ANGULAR_ACCELERATION}
    return change_columns(flight, columns, valid, off).flagged(list(flags.values()))


def change_columns(
    flight: Flight, columns: Mapping[str, Array], valid: Mask | None = None, lost: Mask | None = None
) -> Flight:
    """The flight with other columns, and other valid samples (N,); of other rates, some of them ``lost`` (N,), the acceleration follows."""
    changed = replace(
        flight,
        outputs={n: columns.get(n, x) for n, x in flight.outputs.items()},
        channels={n: columns.get(n, x) for n, x in flight.channels.items()},
        valid=flight.valid if valid is None else valid,
    )
    return derive_acceleration(changed, lost) if {*columns} & {*ANGULAR_RATE} else changed


def find_glitches(x: Array, valid: Mask, suspects: Mask | None = None) -> tuple[Mask, Array]:
    """Spikes of a smooth record (N,), which is interpolated where it lacks something, and the record with them interpolated.

    A glitch is off the prediction by its neighbours (a polynomial of the fifth degree through three samples on
    either side) by ``GLITCH`` times the usual error of that, and by more than twice the range of everything
    within a dozen samples, or is one of ``suspects`` (N,), the only ones then. The largest go first, since they distort the
    prediction of the others.
    """
    glitches, present = np.zeros(len(x), dtype=np.bool_), np.isfinite(x)
    if np.sum(valid & present) < 8 * SIDE:
        return glitches, x
    # also in samples that are not used, since filters and derivatives of the record reach into them
    glitches[present], mended = _separate_glitches(
        x[present], None if suspects is None else suspects[present]
    )
    if not glitches.any() or np.mean(glitches[valid]) > MOST:
        return np.zeros_like(glitches), x
    whole = np.array(x)
    whole[present] = mended
    return glitches, whole


def find_spikes_of_slow(x: Array) -> tuple[Mask, Array]:
    """Spikes of an auxiliary channel (N,) that is slow without them, and the channel with them interpolated, as where it has no value."""
    present = np.isfinite(x)
    spikes = find_spikes(x, present)
    mended = bridge_gaps(x, present & ~spikes)
    if np.std(np.diff(mended)) > SLOW * np.std(mended):
        return np.zeros_like(spikes), x
    at = np.flatnonzero(spikes)
    spikes[at] = np.abs(x[at] - mended[at]) > 2 * _spread(mended, at)
    return spikes, np.where(spikes, mended, x)


def find_lost_angles(angle: Array, valid: Mask) -> tuple[Mask, Array]:
    """The same of the angle of a disc (N,), rad: what is off an even rotation, whole turns apart."""
    pairs = valid[1:] & valid[:-1]
    if not pairs.any():
        return np.zeros_like(valid), angle
    line = float(np.median(_wrap(np.diff(angle))[pairs])) * np.arange(len(angle))
    line += np.angle(np.mean(np.exp(1j * (angle - line)[valid])))
    mask, mended = find_glitches(_wrap(angle - line), valid)
    return mask, np.where(mask, mended + line, angle)


def _wrap(angle: Array) -> Array:
    return np.asarray(np.angle(np.exp(1j * angle)))


def _separate_glitches(x: Array, suspects: Mask | None) -> tuple[Mask, Array]:
    """Glitches of a series without gaps (N,), and the series with them interpolated."""
    # plain ones first, which may be neighbours: the prediction by such would be far off beside them
    off = find_spikes(x, np.full(len(x), suspects is None))
    y = bridge_gaps(x, ~off, smooth=True)
    for _ in range(12):
        size = np.abs(np.diff(np.pad(y, 3, mode="reflect"), 6)) / 20.0  # off the prediction
        limit = GLITCH * STD_OF_MEDIAN * float(np.median(size))
        at = np.flatnonzero(size > limit)
        if len(at):
            at = at[size[at] > GLITCH * STD_OF_MEDIAN * _find_block_quantiles(size, 0.5)[at]]
            told = size[at] > 2 * _spread(y, at) if suspects is None else suspects[at]
            at = at[told & (size[at] >= np.max(_surround(size, at, 3), axis=1))]
        if not len(at):
            break
        off[at] = True
        y = bridge_gaps(x, ~off, smooth=True)
    return off, y


def _surround(x: Array, at: NDArray[np.intp], side: int) -> Array:
    """(m, 2 side + 1): a series about some of its samples; beyond its ends it stays what it is there."""
    return np.asarray(x[np.clip(at[:, None] + np.arange(-side, side + 1), 0, len(x) - 1)])


def _spread(x: Array, at: NDArray[np.intp]) -> Array:
    """(m,): from the third to the 23rd of the 25 samples about some samples, by size."""
    ordered = np.sort(_surround(x, at, 12), axis=1)
    return np.asarray(ordered[:, 22] - ordered[:, 2])


def describe_spikes(name: str, mask: Mask, time: Array) -> str:
    """How many spikes, where, what was done with them."""
    places = np.flatnonzero(mask)
    instants = ", ".join(f"{t:.10g}" for t in time[places[:3]]) + ", ..." * (len(places) > 3)
    spikes = "samples are spikes" if len(places) > 1 else "sample is a spike"
    return f"{name}: {len(places)} {spikes} ({100 * np.mean(mask):.2g} %; t = {instants} s), not used"


# share of equal neighbours from which a column is held at a lower rate, if its values are not just coarse
HELD = 1 / 3
# steps of its resolution by which a column moves, in the median, from which repetition is not the resolution's doing
COARSE = 8.0
FEWEST = 8  # recorded values that are needed to see how they come
# share of the values of a column joined by lines that must follow each other at the same number of samples
REGULAR = 0.99

STRAIGHT = 1e-3
"""Second difference, over the usual one, below which three samples lie on one line: digits that were written make
less, and of recorded values one in a thousand bends so little."""

# pairs of neighbours on either side, at least, that tell how often a column repeats a value there
BESIDE = 32

SUDDEN = 5.0
"""Times the usual move of a column by which it leaps to an end of its range and back in a drop-out. In saturation it moves there: of
1,374 clipped series, white to smooth, none did so by more than 4.8 into and out of a run."""

# pairs of neighbours in whose median move the resolution of a column is seen: it stands still in parts
LOCAL = 64
# number of such runs to be expected in the whole record below which one is no chance; of zeros, which recorders write
RARE, RARE_ZEROS = 1e-3, 0.1


def leave_out_repeated(flight: Flight) -> Flight:
    """The flight without repeated values: outputs as if not recorded, samples of motion not valid, both flagged.

    Motion is interpolated between what was recorded, and an angular acceleration that was derived is derived anew.
    """
    flight = _take_recorded_rate(flight)
    columns, valid, full = {**flight.channels, **flight.outputs}, np.array(flight.valid), _find_full(flight)
    lacking = np.zeros_like(valid)  # samples that lack a rate
    repeated: list[tuple[str, _Repeated]] = []
    motion = [n for n in MOTION if n in columns and n in (flight.written or columns)]
    for name in (*flight.outputs, *filter(is_disc_angle, flight.channels), *motion):
        x, turning = np.array(columns[name]), is_disc_angle(name)
        present = np.isfinite(x) & full
        r = _find_repeated(x, present, turning)
        if r is None:
            continue
        repeated.append((name, r))
        lacking |= r.left_out & (name in ANGULAR_RATE and not r.every)
        if name in flight.outputs:
            columns[name] = np.where(r.left_out, np.nan, x)
            continue
        columns[name] = bridge_gaps(x, present & ~r.left_out, smooth=r.every > 0, turning=turning)
        if not r.every or not turning:  # a disc turns smoothly between two angles
            valid &= ~r.left_out
    slower = {n for n, r in repeated if r.every}
    for sensor in (SPECIFIC_FORCE, ANGULAR_RATE):
        names = [n for n in sensor if n in columns and n not in slower]
        lost = _find_lost_packets([columns[n] for n in names], valid)
        if lost.any():
            repeated += [(n, _Repeated("stuck", lost)) for n in names]
            columns |= {n: bridge_gaps(columns[n], valid & ~lost, smooth=True) for n in names}
            valid &= ~lost
            lacking |= lost & (sensor is ANGULAR_RATE)
    if not repeated:
        return flight
    changed = {n: columns[n] for n, _ in repeated}
    return change_columns(flight, changed, valid, lacking).flagged(
        _make_flags([(n, r) for n, r in repeated if np.any(r.left_out & flight.valid)], flight)
    )


def _find_full(flight: Flight) -> Mask:
    """(N,): samples with all columns; next to an end or a gap too, where a derivative is not relied upon."""
    if flight.lacking is None or ANGULAR_ACCELERATION[0] in flight.written:
        return flight.valid
    return flight.valid | (
        binary_dilation(flight.lacking, iterations=REACH, border_value=1) & ~flight.lacking
    )


def _take_recorded_rate(flight: Flight) -> Flight:
    """The flight at the lower rate at which its angular rates are recorded, if their derivative follows from them.

    Between rates that are held it is known nowhere, and of every other sample no spectrum is: at 8 Hz of 16 Hz three of seven
    effect-free flights had a false ``imu-filter``.
    """
    names = [n for n in ANGULAR_RATE if n in flight.written]
    if not names or ANGULAR_ACCELERATION[0] in flight.written:
        return flight
    full = _find_full(flight)
    # a rate is copied, too, where something else lacks
    there = full if flight.lacking is None else ~flight.lacking
    slower = [r for n in names if (r := _find_repeated(flight.channels[n], there, False)) and r.every]
    kept = np.flatnonzero(full & ~np.any([r.left_out for r in slower], axis=0))
    spacing = int(max((r.every for r in slower), default=0))
    if not slower or not len(kept) or np.any((kept - kept[0]) % spacing):
        return flight
    text = f"the motion is recorded every {spacing / flight.rate:.4g} s and {slower[0].how} in between; the record is used at that rate"
    part = flight.part(slice(int(kept[0]) % spacing, None, spacing))
    return derive_acceleration(replace(part, valid=_find_full(part))).flagged([Flag(tuple(names), text)])


@dataclass(frozen=True)
class _Repeated:
    """Samples (N,) that repeat others: ``repeated`` or ``joined by straight lines``, recorded ``every`` so many samples, or in places
    ``stuck`` or ``interpolated``.
    """

    how: str
    left_out: Mask
    every: float = 0.0


def _find_repeated(x: Array, present: Mask, turning: bool) -> _Repeated | None:
    """What a column (N,), or the angle of a ``turning`` disc, repeats; ``None``: no more than its resolution and noise make."""
    pairs = present[1:] & present[:-1]
    if np.sum(present) < FEWEST or not pairs.any():
        return None
    x = np.where(present, x, 0.0)
    equal = pairs & (x[1:] == x[:-1])
    moves = np.abs(np.diff(x))[pairs & ~equal]
    if len(moves) < FEWEST - 1:
        return None  # it does not change at all
    step = find_step(x[present])
    coarse = step is not None and np.median(moves) < COARSE * step and not turning
    held = np.sum(equal) >= HELD * np.sum(pairs) and not coarse
    if held and max(r.stop + 1 - r.start for r in runs(equal)) < HELD * len(x):
        kept = present & ~np.r_[False, equal]
        return _Repeated("repeated", present & ~kept, float(np.median(np.diff(np.flatnonzero(kept)))))
    bend = _find_bends(x, present, 2)
    if not turning and (joined := _find_joined(present, bend)) is not None:
        return joined  # the angle of a disc is a line
    stuck = np.zeros_like(present)
    stuck[present] = _find_stuck(x[present], step or 0.0, turning)  # a missing sample ends no run
    filled = stuck
    if not (turning or coarse):
        fourth = _find_bends(x, present, 4)
        filled = stuck | _find_curves(x, bend, step or 0.0, 1) | _find_curves(x, fourth, step or 0.0, 3)
    repeated = _Repeated("stuck" if np.array_equal(filled, stuck) else "interpolated", filled)
    return repeated if repeated.left_out.any() else None


def _find_lost_packets(axes: Sequence[Array], present: Mask) -> Mask:
    """(N,): samples at which all axes of a sensor repeat their values, or are zero: more than chance makes, each axis by itself."""
    lost = np.zeros(len(present), dtype=np.bool_)
    changing = [x for x in axes if np.any(x[present] != x[present][0])] if present.any() else []
    if len(changing) < 2:
        return lost
    before = present & np.r_[False, present[:-1]]
    repeats = [before & np.r_[False, x[1:] == x[:-1]] for x in changing]
    for marks in (np.array(repeats), np.array([present & (x == 0.0) for x in changing])):
        together = np.all(marks, axis=0)
        alone = (np.sum(marks & ~together, axis=1) + 1) / (len(present) + 2)
        if len(present) * np.prod(alone) < RARE_ZEROS and np.mean(together) < HELD:
            lost |= together
    return lost


def _find_joined(present: Mask, bend: Array) -> _Repeated | None:
    """Values recorded every so many samples, and joined by straight lines: by the second differences (N - 2,), NaN at gaps."""
    recorded = np.flatnonzero(bend > STRAIGHT * np.sqrt(np.mean(np.nan_to_num(bend) ** 2))) + 1
    spacing = int(np.median(np.diff(recorded))) if len(recorded) >= FEWEST else 1
    first = recorded[len(recorded) // 2] if spacing > 1 else 0
    kept = np.arange(len(present)) % spacing == first % spacing
    if spacing < 2 or np.mean(kept[recorded]) < REGULAR:
        return None
    return _Repeated("joined by straight lines", present & ~kept, float(spacing))


def _find_stuck(x: Array, step: float, turning: bool) -> Mask:
    """(N,): samples in runs of equal values of a column, (N,), that are too long for how often it repeats a value elsewhere.

    The chance that two neighbours are equal is counted in as many pairs before and after a run as it has; or it is the resolution
    over the usual move there, whichever is smaller, as few pairs cannot tell how small a chance is. Runs that a column enters
    and leaves by a ``step`` or two of its resolution are where it turns; those at an end of its range are saturation, an
    effect of its own, unless the column leaps there.
    """
    stuck, equal = np.zeros(len(x), dtype=np.bool_), x[1:] == x[:-1]
    equals = np.array([(r.start, r.stop + 1) for r in runs(equal)], dtype=np.intp).reshape(-1, 2)
    low, high = np.min(x), np.max(x)
    moves = np.abs(np.diff(x, prepend=x[:1], append=x[-1:]))
    first, last = equals[:, 0], equals[:, 1] - 1
    inside = (x[first] != low) & (x[first] != high)
    sudden = np.minimum(moves[first], moves[last + 1]) > SUDDEN * np.median(moves[1:-1][~equal])
    finest = max(step, float(np.spacing(np.max(np.abs(x)))))
    moving = pd.Series(np.where(equal, np.nan, moves[1:-1]))
    usual = moving.groupby(np.arange(len(moving)) // LOCAL).transform("median").fillna(0.0).to_numpy()
    by_step = finest / np.maximum(usual, finest)
    kept = inside | sudden
    first, last = first[kept], last[kept]
    before = np.r_[0, np.cumsum(equal)]
    reach = np.maximum(BESIDE, last - first)
    left, right = np.maximum(first - reach, 0), np.minimum(last + reach, len(equal))
    same = before[first] - before[left] + before[right] - before[last]
    chance = (same + 1) / (first - left + right - last + 2)
    expected = len(x) * np.minimum(chance, by_step[first]) ** (last - first)
    expected[np.maximum(moves[first], moves[last + 1]) <= 2.5 * step] = np.inf
    for k in np.flatnonzero(expected < np.where(x[first] == 0.0, RARE_ZEROS, RARE)):
        reading = x[first[k]] != 0.0 and last[k] - first[k] < 3  # of which the others are copies
        stuck[first[k] + reading : last[k] + 1] = True
    if not turning and len(x) * float(np.median(by_step)) < RARE:  # it hardly ever meets a value again
        stuck |= _find_lost(x, stuck)
    return stuck


def _find_bends(x: Array, present: Mask, order: int) -> Array:
    """(N - order,): sizes of the differences of an order, NaN where a sample lacks."""
    whole = np.convolve(present, np.ones(order + 1), "valid") > order
    return np.where(whole, np.abs(np.diff(x, order)), np.nan)


def _find_curves(x: Array, bend: Array, step: float, degree: int) -> Mask:
    """(N,): samples on a line between others, or on a cubic as splines have, in a column that bends far more: gaps that were filled.

    ``bend`` are its differences of the next ``degree``, which such curves do not have.
    """
    filled = np.zeros(len(x), dtype=np.bool_)
    resolution = 2**degree * step  # what rounding makes of them at most
    rough = bend[bend > resolution]
    finest = max(STRAIGHT * float(np.median(rough)) if len(rough) else 0.0, resolution)
    if np.mean(bend <= finest) > HELD:  # a table's ramps, or what is read seldom and unevenly: made of lines
        return filled
    # where a curve without noise bends the other way one sample is on a line, in single precision two by chance
    for run in runs(bend <= finest, degree + 2):
        first, last = run.start, run.stop + degree
        near = bend[max(first - LOCAL, 0) : last + LOCAL]
        usual = float(np.median(near[near > finest])) if np.any(near > finest) else np.inf
        along = np.linspace(-1.0, 1.0, last - first + 1)
        off = np.abs(x[first : last + 1] - np.polyval(np.polyfit(along, x[first : last + 1], degree), along))
        if np.max(off) <= finest < np.ptp(x[first : last + 1]) / COARSE:
            # fourth differences of a slow column are those of its digits: as small as any thereabouts
            least = np.min(near[near > finest], initial=np.inf)
            digits = float(np.spacing(8 * np.max(np.abs(x))) if degree == 1 else least)
            bent = max(float(np.max(bend[run])), resolution, digits)
            # it ends in a kink, an inflection of smooth motion does not
            kink = np.max(np.nan_to_num(bend[[max(first - 1, 0), min(run.stop, len(bend) - 1)]], nan=np.inf))
            rare = len(x) * (bent / usual) ** (run.stop - run.start) < RARE
            filled[first + 1 : last] |= rare and kink > np.sqrt(bent * usual)
    return filled


def _find_lost(x: Array, stuck: Mask) -> Mask:
    """(N,): single samples of values that come again and again, zero among them: readings that did not arrive."""
    lost = np.zeros(len(x), dtype=np.bool_)
    values, counts = np.unique(x[~stuck], return_counts=True)
    often = (counts >= FEWEST / 2) & (counts >= 4 * np.median(counts))
    again = values[often & (values != np.min(x)) & (values != np.max(x))]
    for value in {0.0, *again} if len(again) <= 3 else ():
        alike = find_short_runs(x == value, WIDEST_SPIKE)
        lost |= alike & (len(runs(alike)) > 1)
    return lost


def _make_flags(repeated: Sequence[tuple[str, _Repeated]], flight: Flight) -> list[Flag]:
    """One flag for all columns with the same text."""
    derived = ANGULAR_ACCELERATION[0] not in flight.written
    groups: dict[str, list[str]] = {}
    lacks: set[str] = set()
    for name, r in repeated:
        text = _describe(r, flight)
        groups.setdefault(text, []).append(name)
        lacks |= {text} if r.every and name in ANGULAR_RATE and derived else set()
    more = "; the angular acceleration, which is derived from it, is not known so"
    return [
        Flag(tuple(names), f"{', '.join(names)}: {text}{more * (text in lacks)}", open=text in lacks)
        for text, names in groups.items()
    ]


def _describe(r: _Repeated, flight: Flight) -> str:
    if r.every:
        return f"recorded every {r.every / flight.rate:.4g} s and {r.how} in between; only recorded values are used"
    samples, places = np.flatnonzero(r.left_out), runs(r.left_out)
    filled = r.how == "interpolated"
    if max(x.stop - x.start for x in places) <= WIDEST_SPIKE:
        where = ", ".join(f"{t:.6g}" for t in flight.time[samples[:3]]) + " ..." * (len(samples) > 3)
        lost = f"{'interpolated' if filled else 'repeated'}, or zero, at {count(len(samples), 'sample')} (t = {where} s)"
        return f"{lost}: readings that did not arrive? not used"
    segments = (
        f"{x.stop - x.start} {'equal ' * (not filled)}samples from {flight.time[x.start]:.5g} s"
        for x in places[:3]
    )
    more = f" and {len(places) - 3} times more" if len(places) > 3 else ""
    return f"the value is {r.how}: {', '.join(segments)}{more}, unlike noise; {len(samples)} samples not used"
