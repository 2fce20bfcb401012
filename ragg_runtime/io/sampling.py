"""The time axis of a flight: uniform rate, jitter, and the places of samples that the file lacks."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.io.record import Array

JITTER_NOTED = 1e-3
"""Deviation from uniform sampling, in steps, that is worth a note."""

JITTER_FOLLOWED = 1e-7
"""The same from which derivatives are made by way of even instants: the last digits of a time of a day."""

JITTER_REFUSED = 0.25
"""Error of one step, in steps, from which the samples have to follow a steady clock instead."""

JITTER_TRACKED = 0.48
"""Deviation from a steady clock, in steps, from which a record is not uniformly sampled any more."""

_MOST_MISSING = 0.9  # of all samples; beyond it the gaps are not gaps but the file is a collection of pieces

NO_GAPS = 0.05
"""Relative difference of the mean from the median step below which a record has no gaps to speak of: its mean step is exact."""

STEADY_FROM = 512
"""Instants from which a line through them is a better clock than the mean step of a record without gaps."""


@dataclass(frozen=True)
class Grid:
    """Where the file's samples stand on the uniform grid.

    ``index`` (n,): places of the file's samples, increasing from 0. ``time`` (N,) s: the whole grid, the file's own
    instants where it has a sample. ``step``: s. ``jitters``: whether instants leave the grid by more than
    ``JITTER_FOLLOWED``.
    """

    index: NDArray[np.int64]
    time: Array
    step: float
    notes: tuple[str, ...]
    jitters: bool = False


@np.errstate(over="ignore", invalid="ignore")  # absurd times: what comes of them is refused
def uniform(time: Array, path: Path | str | None) -> Grid:
    """The grid of a record's instants (n,), s; UserError where they make none."""
    where = at(path, "column 'time'")
    steps = _steps(time, path, where)
    step = _step(steps)
    if not (time[-1] - time[0]) / step < 2.0**53:
        raise UserError(
            "the record is not uniformly sampled",
            where=where,
            found=f"steps of {step:.6g} s in a record of {time[-1] - time[0]:.6g} s",
            remedy="resample the record to a constant rate",
        )
    # A gap of more samples than memory holds is refused below, whatever their number.
    jumps = np.rint(np.minimum(steps / step, 2.0**31)).astype(np.int64)
    deviation = np.abs(steps - jumps * step) / step
    tracked = None
    if np.any(jumps < 1) or np.any(deviation > JITTER_REFUSED):
        tracked = _tracked(time, step)
        if tracked is not None:
            jumps, deviation = np.diff(tracked[0]), tracked[1]
    if np.any(jumps < 1) or (np.any(deviation[jumps == 1] > JITTER_REFUSED) and tracked is None):
        row = int(np.argmax(np.where(jumps <= 1, deviation, 0.0)))
        raise UserError(
            "the record is not uniformly sampled",
            where=where,
            found=f"a step of {steps[row]:.6g} s after row {row + 1} (t = {time[row]:.10g} s)",
            expected=f"steps of {step:.6g} s",
            remedy="resample the record to a constant rate",
        )
    index = np.concatenate([[0], np.cumsum(jumps)])
    count = int(index[-1]) + 1
    if count > len(time) / (1 - _MOST_MISSING):
        raise UserError(
            "more than nine samples in ten are missing",
            where=where,
            found=f"{len(time)} samples in {time[-1] - time[0]:.6g} s, with steps of {step:.6g} s",
            remedy="split the record at its gaps into one file each",
        )
    whole = time if count == len(time) else np.interp(np.arange(count), index, time)
    jitters = bool(np.max(deviation) > JITTER_FOLLOWED)
    return Grid(
        index=index,
        time=whole,
        step=step,
        notes=tuple(_notes(time, steps, jumps, deviation, step)),
        jitters=jitters,
    )


def _steps(time: Array, path: Path | str | None, where: str) -> Array:
    """(n - 1,) s: from each instant to the next, all above zero."""
    if len(time) < 2:
        raise UserError(
            "too few samples",
            where=path,
            found=f"{len(time)} row{'s' * (len(time) != 1)}",
            expected="at least 2, usually thousands",
        )
    if not np.all(np.isfinite(time)):
        row = int(np.flatnonzero(~np.isfinite(time))[0])
        raise UserError(
            "the time is missing",
            where=where,
            found=f"row {row + 1}: {time[row]}",
            expected="a number in every row",
            remedy="remove rows without a time",
        )
    steps = np.diff(time)
    if np.any(steps <= 0):
        raise _not_increasing(time, steps, where)
    return steps


def _tracked(time: Array, step: float) -> tuple[NDArray[np.int64], Array] | None:
    """Places of samples that jitter by less than half a step about a steady clock, and by how much (n - 1,); ``None``:
    they do not.
    """
    size = 128
    whole = (time[-1] - time[0]) / (len(time) - 1)
    steady = bool(abs(whole / step - 1) < NO_GAPS)
    if steady:  # no gaps: the mean step is exact, the median of jittering ones is not
        step = float(whole)
    phase = np.mod((time[:size] - time[0]) / step, 1.0)
    lags = np.arange(64) / 64
    worst = [float(np.max(np.abs((phase - lag + 0.5) % 1.0 - 0.5))) for lag in lags]
    first = float(time[0] + step * (lags[int(np.argmin(worst))]))
    while True:
        t = time[:size]
        k = np.rint((t - first) / step)
        if np.any(np.diff(k) < 1):
            return None
        if len(t) >= STEADY_FROM or size >= len(time) or not steady:
            step, first = (float(c) for c in np.polyfit(k, t, 1))
        if size >= len(time):
            break
        size += size // 2
    k = np.rint((time - first) / step)
    off = np.abs(time - first - k * step) / step
    if not np.max(np.abs(k)) < 2.0**53 or np.any(np.diff(k) < 1) or np.max(off) > JITTER_TRACKED:
        return None
    return (k - k[0]).astype(np.int64), off[1:]


def _step(steps: Array) -> float:
    """The mean of those steps that are about the median: the rounding of printed times averages out."""
    middle = (len(steps) - 1) // 2
    median = float(np.partition(steps, middle)[middle])  # one of the steps, never between two of them
    return float(np.mean(steps[np.abs(steps - median) < 0.5 * median]))


def _notes(time: Array, steps: Array, jumps: NDArray[np.int64], deviation: Array, step: float) -> list[str]:
    notes = []
    gaps = np.flatnonzero(jumps > 1)
    if len(gaps):
        missing = int(np.sum(jumps[gaps] - 1))
        longest = gaps[np.argmax(steps[gaps])]
        notes.append(
            f"{len(gaps)} gap{'s' * (len(gaps) > 1)}: {missing} of {len(time) + missing} samples missing, "
            f"the longest stretch {steps[longest]:.6g} s from t = {time[longest]:.10g} s; "
            "they are filled in and not used"
        )
    worst = int(np.argmax(deviation))
    if deviation[worst] > JITTER_NOTED:
        notes.append(
            f"sampling jitters by up to {deviation[worst]:.2g} of the step of {step:.6g} s "
            f"(after t = {time[worst]:.10g} s); every sample counts at its own instant, derivatives and "
            "spectra are made on the even grid"
        )
    return notes


def _not_increasing(time: Array, steps: Array, where: str) -> UserError:
    if np.all(steps == 0):
        return UserError(
            "the time stands still",
            where=where,
            found=f"{time[0]:.10g} s in every row",
            expected="increasing time",
            remedy="check the clock or the format in which the time was written",
        )
    if np.all(steps < 0):
        return UserError(
            "the time runs backwards",
            where=where,
            found=f"{time[0]:.10g} s first, {time[-1]:.10g} s last",
            expected="increasing time",
            remedy="sort the rows by time",
        )
    row = int(np.flatnonzero(steps <= 0)[0])
    count = int(np.sum(steps <= 0))
    return UserError(
        "an instant appears twice" if steps[row] == 0 else "the time runs back",
        where=where,
        found=f"row {row + 1}: {time[row]:.10g} s, row {row + 2}: {time[row + 1]:.10g} s"
        + (f" (and {count - 1} more such places)" if count > 1 else ""),
        expected="increasing time",
        remedy="remove doubled rows or sort the rows by time; two records need two files",
    )
