"""Values that a column repeats though its sensor does not: held or joined by lines at a lower rate, stuck, zero in a drop-out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, minimum_filter1d

from ragg_runtime.base.errors import count
from ragg_runtime.io import Flight
from ragg_runtime.io.assemble import derive_acceleration
from ragg_runtime.io.record import (
    ANGULAR_ACCELERATION,
    ANGULAR_RATE,
    SPECIFIC_FORCE,
    WIDEST_SPIKE,
    Flag,
    is_disc_angle,
)
from ragg_runtime.screening.spikes import MOTION
from ragg_runtime.signals.derivative import REACH, bridge_gaps, runs
from ragg_runtime.signals.resolution import find_step

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

HELD = 1 / 3
"""Share of equal neighbours from which a column is held at a lower rate, if its values are not just coarse."""

COARSE = 8.0
"""Steps of its resolution by which a column moves, in the median, from which repetition is not the resolution's doing."""

FEWEST = 8
"""Recorded values that are needed to see how they come."""

REGULAR = 0.99
"""Share of the values of a column joined by lines that must follow each other at the same number of samples."""

STRAIGHT = 1e-3
"""Second difference, over the root mean square of all, below which three samples lie on one line: digits that were written make
less, and of recorded values one in a thousand bends so little."""

BESIDE = 32
"""Pairs of neighbours on either side, at least, that tell how often a column repeats a value there."""

SUDDEN = 5.0
"""Times the usual move of a column by which it leaps to an end of its range and back in a drop-out. In saturation it moves there: of
1,374 clipped series, white to smooth, none did so by more than 4.8 into and out of a run."""

LOCAL = 64
"""Pairs of neighbours in whose median move the resolution of a column is seen: it stands still in parts."""

RARE, RARE_ZEROS = 1e-3, 0.1
"""Number of such runs to be expected in the whole record below which one is no chance; of zeros, which recorders write."""


def leave_out_repeated(flight: Flight) -> Flight:
    """The flight without repeated values: outputs as if not recorded, samples of motion not valid, both flagged.

    Motion is interpolated between what was recorded, and an angular acceleration that was derived is derived anew.
    """
    flight = _take_recorded_rate(flight)
    columns, valid, known = {**flight.channels, **flight.outputs}, np.array(flight.valid), _find_known(flight)
    found: list[tuple[str, _Repeated]] = []
    motion = [n for n in MOTION if n in columns and n in (flight.written or columns)]
    for name in (*flight.outputs, *filter(is_disc_angle, flight.channels), *motion):
        x, turning = np.array(columns[name]), is_disc_angle(name)
        there = np.isfinite(x) & known
        r = _repeated(x, there, turning)
        if r is None:
            continue
        found.append((name, r))
        if name in flight.outputs:
            columns[name] = np.where(r.left_out, np.nan, x)
            continue
        columns[name] = bridge_gaps(x, there & ~r.left_out, smooth=r.how != "stuck", turning=turning)
        if r.how == "stuck" or not turning:  # a disc turns smoothly between two angles
            valid &= ~r.left_out
    slower = {n for n, r in found if r.how != "stuck"}
    for sensor in (SPECIFIC_FORCE, ANGULAR_RATE):
        names = [n for n in sensor if n in columns and n not in slower]
        lost = _find_lost_packets([columns[n] for n in names], valid)
        if lost.any():
            found += [(n, _Repeated("stuck", lost)) for n in names]
            columns |= {n: bridge_gaps(columns[n], valid & ~lost, smooth=True) for n in names}
            valid &= ~lost
    if not found:
        return flight
    changed = replace(
        flight,
        outputs={n: columns[n] for n in flight.outputs},
        channels={n: columns[n] for n in flight.channels},
        valid=valid,
    )
    rates = [r for n, r in found if n in ANGULAR_RATE]
    if rates:
        lost = np.any([np.zeros_like(valid), *(r.left_out for r in rates if r.how == "stuck")], axis=0)
        changed = derive_acceleration(changed, lost)
    return changed.flagged(_flags(found, flight))


def _find_known(flight: Flight) -> Mask:
    """(N,): samples with all columns; next to an end or a gap too, where a derivative is not relied upon."""
    if flight.lacking is None:
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
    known = _find_known(flight)
    slower = [r for n in names if (r := _repeated(flight.channels[n], known, False)) and r.every]
    kept = np.flatnonzero(known & ~np.any([r.left_out for r in slower], axis=0))
    every = int(max((r.every for r in slower), default=0))
    if not slower or not len(kept) or np.any((kept - kept[0]) % every):
        return flight
    text = f"the motion is recorded every {every / flight.rate:.4g} s and {slower[0].how} in between; the record is used at that rate"
    taken = flight.part(slice(int(kept[0]) % every, None, every))
    return derive_acceleration(replace(taken, valid=_find_known(taken))).flagged([Flag(tuple(names), text)])


@dataclass(frozen=True)
class _Repeated:
    """Samples (N,) that repeat others: ``repeated`` or ``joined by straight lines``, recorded ``every`` so many samples, or ``stuck``."""

    how: str
    left_out: Mask
    every: float = 0.0


def _repeated(x: Array, there: Mask, turning: bool) -> _Repeated | None:
    """What a column (N,), or the angle of a ``turning`` disc, repeats; ``None``: no more than its resolution and noise make."""
    pairs = there[1:] & there[:-1]
    if np.sum(there) < FEWEST or not pairs.any():
        return None
    x = np.where(there, x, 0.0)
    equal = pairs & (x[1:] == x[:-1])
    moves = np.abs(np.diff(x))[pairs & ~equal]
    if len(moves) < FEWEST - 1:
        return None  # it does not change at all
    step = find_step(x[there]) if equal.any() else None
    coarse = step is not None and np.median(moves) < COARSE * step and not turning
    held = np.sum(equal) >= HELD * np.sum(pairs) and not coarse
    if held and max(r.stop + 1 - r.start for r in runs(equal)) < HELD * len(x):
        kept = there & ~np.r_[False, equal]
        return _Repeated("repeated", there & ~kept, float(np.median(np.diff(np.flatnonzero(kept)))))
    joined = None if turning else _joined(x, there)  # the angle of a disc is a line
    if joined is not None:
        return joined
    stuck = _stuck(x, there, equal, 0.0 if step is None else step, turning)
    return _Repeated("stuck", stuck) if stuck.any() else None


def _find_lost_packets(axes: Sequence[Array], there: Mask) -> Mask:
    """(N,): samples at which all axes of a sensor repeat their values, or are zero: more than chance makes, each axis by itself."""
    lost = np.zeros(len(there), dtype=np.bool_)
    changing = [x for x in axes if np.any(x[there] != x[there][0])] if there.any() else []
    if len(changing) < 2:
        return lost
    before = there & np.r_[False, there[:-1]]
    repeats = [before & np.r_[False, x[1:] == x[:-1]] for x in changing]
    for marks in (np.array(repeats), np.array([there & (x == 0.0) for x in changing])):
        together = np.all(marks, axis=0)
        alone = (np.sum(marks & ~together, axis=1) + 1) / (len(there) + 2)
        if len(there) * np.prod(alone) < RARE_ZEROS and np.mean(together) < HELD:
            lost |= together
    return lost


def _joined(x: Array, there: Mask) -> _Repeated | None:
    """Values recorded every so many samples, and joined by straight lines."""
    pairs = there[1:] & there[:-1]
    threes = pairs[1:] & pairs[:-1]
    bend = np.where(threes, np.abs(np.diff(x, 2)), 0.0)
    sharp = bend > STRAIGHT * float(np.sqrt(np.mean(bend**2)))
    if not 0 < 3 * np.sum(sharp) <= 2 * np.sum(threes):
        return None
    recorded = np.flatnonzero(sharp) + 1
    every = int(np.median(np.diff(recorded))) if len(recorded) >= FEWEST else 1
    first = recorded[len(recorded) // 2]
    if every < 2 or np.mean(recorded % every == first % every) < REGULAR:
        return None
    kept = np.arange(len(x)) % every == first % every
    return _Repeated("joined by straight lines", there & ~kept, float(every))


def _stuck(x: Array, there: Mask, equal: Mask, step: float, turning: bool) -> Mask:
    """(N,): samples in runs of equal values that are too long for how often the column repeats a value elsewhere.

    The chance that two neighbours are equal is counted in the pairs before and after a run, as many as it has; or it is the resolution
    over the usual move thereabouts, whichever makes a run less likely, as few pairs cannot tell how small a chance is. Runs that a
    column enters and leaves by a ``step`` or two of its resolution are where it turns; those at an end of its range are saturation, an
    effect of its own, unless the column leaps there.
    """
    found = np.zeros(len(x), dtype=np.bool_)
    equals = np.array([(r.start, r.stop + 1) for r in runs(equal)], dtype=np.intp).reshape(-1, 2)
    low, high = np.min(x[there]), np.max(x[there])
    moves = np.abs(np.diff(x, prepend=x[:1], append=x[-1:]))
    first, last = equals[:, 0], equals[:, 1] - 1
    inside = (x[first] != low) & (x[first] != high)
    sudden = np.minimum(moves[first], moves[last + 1]) > SUDDEN * np.median(moves[1:-1][~equal])
    finest = max(step, float(np.spacing(np.max(np.abs(x[there])))))
    by_step = np.minimum(finest / np.maximum(_find_usual_moves(np.abs(np.diff(x)), there), finest), 1.0)
    kept = inside | sudden
    first, last = first[kept], last[kept]
    long = np.zeros(len(equal), dtype=np.bool_)
    for a, b in zip(first, last, strict=True):
        long[a:b] |= b - a + 1 >= BESIDE  # a run next to another is no evidence about the column
    before = np.r_[0, np.cumsum(equal & ~long)]
    reach = np.maximum(BESIDE, last - first)
    left, right = np.maximum(first - reach, 0), np.minimum(last + reach, len(equal))
    same = before[first] - before[left] + before[right] - before[last]
    chance = (same + 1) / (first - left + right - last + 2)
    chance = np.where(last - first < 3, 1.0, chance)  # too few to count by
    expected = len(x) * np.minimum(chance, by_step[first]) ** (last - first)
    expected[np.maximum(moves[first], moves[last + 1]) <= 2.5 * step] = np.inf
    for k in np.flatnonzero(expected < np.where(x[first] == 0.0, RARE_ZEROS, RARE)):
        reading = x[first[k]] != 0.0 and last[k] - first[k] < 3  # of which the others are copies
        found[first[k] + reading : last[k] + 1] = True
    if not turning and len(x) * float(np.median(by_step)) < RARE:  # it hardly ever meets a value again
        found |= _find_lost(x, there, found)
    return found


def _find_lost(x: Array, there: Mask, stuck: Mask) -> Mask:
    """(N,): single samples of values that come again and again, zero among them: readings that did not arrive."""
    found = np.zeros(len(x), dtype=np.bool_)
    values, counts = np.unique(x[there & ~stuck], return_counts=True)
    often = (counts >= FEWEST / 2) & (counts >= 4 * np.median(counts))
    again = values[often & (values != np.min(x[there])) & (values != np.max(x[there]))]
    for value in {0.0, *again} if len(again) <= 3 else ():
        alike = [r for r in runs(there & (x == value)) if r.stop - r.start <= WIDEST_SPIKE]
        for r in alike if len(alike) > 1 else ():
            found[r] = True
    return found


def _find_usual_moves(moves: Array, there: Mask) -> Array:
    """(N,): the least median of moves from sample to sample, (N - 1,), in a sample's own block and the two beside it."""
    size = min(LOCAL, len(moves))
    pairs = there[1:] & there[:-1]
    blocks = np.array_split(np.where(pairs, moves, np.nan), len(moves) // size)
    usual = np.array([np.median(b[np.isfinite(b)]) if np.isfinite(b).any() else 0.0 for b in blocks])
    usual = minimum_filter1d(usual, 3, mode="nearest")
    return np.repeat(usual, [len(b) for b in blocks])[np.r_[0 : len(moves), len(moves) - 1]]


def _flags(found: Sequence[tuple[str, _Repeated]], flight: Flight) -> list[Flag]:
    """One flag for all columns of which the same is to be said."""
    derived = ANGULAR_ACCELERATION[0] not in flight.written
    groups: dict[str, list[str]] = {}
    lacks: set[str] = set()
    for name, r in found:
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
    at, places = np.flatnonzero(r.left_out), runs(r.left_out)
    if max(x.stop - x.start for x in places) <= WIDEST_SPIKE:
        where = ", ".join(f"{t:.6g}" for t in flight.time[at[:3]]) + " ..." * (len(at) > 3)
        lost = f"repeated, or zero, at {count(len(at), 'sample')} (t = {where} s)"
        return f"{lost}: readings that did not arrive? not used"
    some = (f"{x.stop - x.start} equal samples from {flight.time[x.start]:.5g} s" for x in places[:3])
    more = f" and {len(places) - 3} times more" if len(places) > 3 else ""
    return f"the value is stuck: {', '.join(some)}{more}, unlike noise; {len(at)} samples not used"
