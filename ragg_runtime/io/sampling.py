"""The time axis of a flight: uniform rate, jitter, and the positions of missing samples."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, count
from ragg_runtime.io.record import Array
from ragg_runtime.signals.derivative import runs

JITTER_NOTED = 1e-3  # deviation from uniform sampling, in steps, that is worth a note
# error of one step, in steps, from which the samples have to follow a steady clock instead
JITTER_REFUSED = 0.25
# deviation from a steady clock, in steps, from which a record is not uniformly sampled any more
JITTER_TRACKED = 0.48
MOSTLY_GAPS = 1.5
"""Samples of the grid over those of the file from which gaps that recur are those of a buffer; a recorder that pauses loses few."""

_MOST_MISSING = 0.9  # of all samples; beyond it the gaps are not gaps but the file is a collection of pieces

# leaps of the stamps in a record that are named one by one, where they last longer than the record
FEW_LEAPS = 3
# relative difference of the mean from the median step below which a record may have no gaps: its mean step is then exact
NO_GAPS = 0.05

# instants from which a line through them is a better clock than the mean step of a record without gaps
STEADY_FROM = 512
# stamps on either side of a place that tell whether a clock was set there, and not one stamp delayed
BESIDE = 16
# part of a step by which a clock must have been set for it to be said: an angle of 0.5 mrad at 0.25 Hz and 16 Hz
SET = 5e-3

COUNTERS: Mapping[float, str] = MappingProxyType(
    {86400.0: "midnight", 604800.0: "the end of the week"}
    | {
        2.0**bits * second: f"2^{bits} {unit}"
        for bits in (16, 24, 31, 32)
        for unit, second in (("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9))
    }
)
"""Periods, s, after which time begins anew: seconds of the day or of the GPS week, and counters (millis() and micros() of
microcontrollers have 32 bits)."""

# part of such a period within which the stamps about its end lie, where some are missing there
NEAR_END = 0.01

SLEW_PARTS, SLEWED = 64, 8.0
"""Parts of a record whose clock rates are compared, and times their usual difference from the median by which a clock was slewed: NTP
does so by 500 ppm until it is right."""

MOST_SET = 20  # places at which a clock may have been set in a record; more of them are jitter
# share of rows with the stamp of the row before from which the stamps are too coarse, and not rows doubled
SHARED = 0.2
_COUNT_ROWS = 'count the rows: rate = "{rate} Hz" under [time] of a mapping'
_BY_COUNT = f"if sampling continued, {_COUNT_ROWS}; else split the record there"
WAS_SET = "was the clock adjusted?"


@dataclass(frozen=True)
class ClockStep:
    """A place where the stamps move on by more than the samples."""

    row: int  # before which they do
    time: float  # s
    size: float  # s
    part: float  # of it, s, that is no whole number of steps; 0 where samples may just be missing
    until: int = 0  # the row up to which the clock was slewed; 0: it was set at once
    ends: float = 0.0  # the time there, s

    def __str__(self) -> str:
        until = f" to {self.ends:.10g}" if self.until else ""
        return f"by {self.size:.4g} s {'from' if until else 'at'} t = {self.time:.10g}{until} s"


@dataclass(frozen=True)
class Grid:
    """The positions of the file's samples on the uniform grid."""

    index: NDArray[np.int64]  # (n,): places of the file's samples, increasing from 0
    time: Array  # (N,) s: the whole grid, the file's own instants where it has a sample
    step: float  # s
    notes: tuple[str, ...]

    @property
    def gaps(self) -> list[dict[str, float]]:
        """Last instant before (``from_s``) and first after each gap (``to_s``), and the ``samples`` missing between them."""
        here, jumps = self.time[self.index], np.diff(self.index)
        return [
            {"from_s": float(here[k]), "to_s": float(here[k + 1]), "samples": int(jumps[k]) - 1}
            for k in np.flatnonzero(jumps > 1).tolist()
        ]


@np.errstate(over="ignore", invalid="ignore")  # absurd times: what comes of them is refused
def make_grid(time: Array, path: Path | str | None) -> Grid:
    """The grid of a record's instants (n,), s; UserError where they make none."""
    where = at(path, "column 'time'")
    time, notes = _unroll(time)
    _require_increasing(time, path, where)
    steps = np.diff(time)
    step, span = _find_typical_step(steps), float(time[-1] - time[0])
    # A gap of more samples than memory holds is refused below.
    jumps = np.rint(np.minimum(steps / step, 2.0**31)).astype(np.int64)
    off = np.abs(steps - jumps * step) / step
    uneven = bool(np.any(jumps < 1) or np.any(off > JITTER_REFUSED))
    if uneven and (tracked := _follow_clock(time, step)) is not None:
        jumps, off = tracked
    elif uneven and (np.any(jumps < 1) or np.any(off[jumps == 1] > JITTER_REFUSED)):
        raise _refuse_uneven(time, steps, step, np.where(jumps <= 1, off, 0.0), where)
    index = np.concatenate([[0], np.cumsum(jumps)])
    size = int(index[-1]) + 1
    if (rate := _find_even_rate(time, jumps)) is not None:
        raise UserError(
            "the time stamps are too coarse for the sampling rate",
            where=where,
            found=f"gaps as regular as if stamps of {rate:.6g} Hz were rounded, or read from a buffer for several samples at once",
            expected="stamps to half a step, or all rows",
            remedy=_BY_COUNT.format(rate=f"{rate:.6g}"),
        )
    if size > len(time) / (1 - _MOST_MISSING) or not span / step < 2.0**53:
        what = "more than nine samples in ten are missing"
        remedy = "split the record at its gaps into one file each"
        leaps = np.flatnonzero(jumps > 1)
        if len(leaps) <= FEW_LEAPS:  # a clock that was set, to summer time or to another day
            what = _ask_about(f"by {steps[k]:.6g} s at t = {time[k]:.10g} s" for k in leaps)
            remedy = _BY_COUNT.format(rate=f"{1 / step:.6g}")
        found = f"{len(time)} samples in {span:.6g} s, with steps of {step:.6g} s"
        raise UserError(what, where=where, found=found, remedy=remedy)
    rounded = _unround(time, index, 1.0 if size == len(time) else 0.5)
    if rounded is None:
        whole = time if size == len(time) else np.interp(np.arange(size), index, time)
        odd = _describe_jitter(time, jumps, off, step)
    else:
        unit, first, step = rounded
        whole = np.asarray(first + step * np.arange(size), dtype=np.float64)
        note = f"the time stamps are rounded to {unit:g} s; they are replaced by an even grid of {1 / step:.6g} Hz"
        odd = [note] if unit > JITTER_NOTED * step else []
    return Grid(index, whole, step, (*notes, *_describe_gaps(time, jumps, step), *odd))


def _unroll(time: Array) -> tuple[Array, list[str]]:
    """Seconds of the day or of the GPS week, or a counter of a recorder, that go on over their end, and a note of it."""
    steps = np.diff(time, prepend=time[:1])
    falls = steps[steps < 0]
    if not len(falls) or len(falls) == len(time) - 1:
        return time, []
    step, fell = _find_typical_step(steps[steps > 0]), np.flatnonzero(steps < 0)
    for period, name in COUNTERS.items():
        low = 0.0 if np.min(time) >= 0 else -period / 2
        beside = max(NEAR_END * period, 2 * step)
        if (
            period > 4 * beside
            and np.min(time) >= low
            and np.max(time) <= low + period
            and np.all(time[fell - 1] > low + period - beside)
            and np.all(time[fell] < low + beside)
        ):
            note = f"time starts anew at {name} ({period:.10g} s) during the record; it is continued"
            return time + period * np.cumsum(steps < 0), [note]
    return time, []


def _find_typical_step(steps: Array) -> float:
    """The mean of those steps that are about the median: the rounding of printed times averages out."""
    middle = (len(steps) - 1) // 2
    median = float(np.partition(steps, middle)[middle])  # one of the steps, never between two of them
    return float(np.mean(steps[np.abs(steps - median) < 0.5 * median]))


def _follow_clock(time: Array, step: float) -> tuple[NDArray[np.int64], Array] | None:
    """Of samples that jitter by less than half a step about a steady clock: samples from one to the next, (n - 1,), and by how
    much each is off; ``None``: they do not.
    """
    whole = float(time[-1] - time[0]) / (len(time) - 1)
    # without gaps the mean step is exact, the median of jittering ones is not; a few per cent of the rows may be missing
    exact = _track_clock(time, whole, STEADY_FROM) if abs(whole / step - 1) < NO_GAPS else None
    return _track_clock(time, step, 0) if exact is None else exact


def _track_clock(time: Array, step: float, exact: int) -> tuple[NDArray[np.int64], Array] | None:
    """The same from a first step, s, which is right for that many samples (``exact``): the clock is fitted to ever more of them."""
    phase = np.mod((time[:128] - time[0]) / step, 1.0)
    lags = np.arange(64) / 64
    worst = np.max(np.abs((phase - lags[:, None] + 0.5) % 1.0 - 0.5), axis=1)
    first = float(time[0] + step * lags[int(np.argmin(worst))])
    grown = 128 * 1.5 ** np.arange(50)
    for size in (*map(int, grown[grown < len(time)]), len(time)):
        k = np.rint((time[:size] - first) / step)
        if np.any(np.diff(k) < 1):
            return None
        if size >= min(exact, len(time)):
            step, first = (float(c) for c in np.polyfit(k, time[:size], 1))
    k = np.rint((time - first) / step)
    off = np.abs(time - first - k * step) / step
    if not np.max(np.abs(k)) < 2.0**53 or np.any(np.diff(k) < 1) or np.max(off) > JITTER_TRACKED:
        return None
    return np.diff(k).astype(np.int64), off[1:]


# --- rounded stamps ------------------------------------------------------------------------------------


def _unround(
    time: Array, index: NDArray[np.int64], coarsest: float = 0.5
) -> tuple[float, float, float] | None:
    """The even clock, of which stamps (n,) at places on the grid (n,) are roundings: their unit, of at most ``coarsest`` steps, first
    instant and step, s; ``None``: there is none. Where they do not determine it, a round rate is taken, and a tick at time 0.
    """
    unit = _find_unit(time)
    if unit is None:
        return None
    first, step = _fit_clock(index, time, unit / 2 / float(index[-1]))
    exact = (x for x in (float(np.rint(first / step) * step), float(time[0])) if abs(x - first) <= unit)
    first = next(exact, first)
    slack = 1e-6 * unit + 4 * float(np.spacing(np.max(np.abs(time))))
    off = time - first - step * index
    most = np.max(np.abs(off))
    if most <= slack or unit > coarsest * step or most > unit + slack or np.ptp(off) > unit + 2 * slack:
        return None
    return unit, first, step


def _find_unit(time: Array) -> float | None:
    """The unit, s, of which all stamps are multiples from the first on: by it their steps differ; ``None``: there is none."""
    steps, noise = np.diff(time), 8 * float(np.spacing(np.max(np.abs(time))))
    apart = np.diff(np.unique(steps))
    if not np.any(apart > noise):
        return None
    unit = float(np.min(apart[apart > noise]))
    places = np.cumsum(np.rint(steps / unit))
    unit = float(time[-1] - time[0]) / float(places[-1])
    slack = max(1e-6 * unit, noise)
    return unit if slack < 0.1 * unit and np.all(np.abs(time[1:] - time[0] - places * unit) < slack) else None


def _find_even_rate(time: Array, jumps: NDArray[np.int64]) -> float | None:
    """Rate, Hz, of even samples whose stamps have gaps because they were rounded, or come in bursts; ``None``: some samples are missing."""
    if np.sum(jumps > 1) < BESIDE or (np.max(jumps) > 2 and np.sum(jumps) < MOSTLY_GAPS * len(jumps)):
        return None
    rows = np.arange(len(time))
    step, first = (float(c) for c in np.polyfit(rows, time, 1))
    late = float(np.ptp(time - first - step * rows))
    regular = late <= min(2 * BESIDE * step, float(np.max(np.diff(time))))
    return 1 / _round_rate(step, late / len(time)) if regular else None


def _round_rate(step: float, error: float) -> float:
    """The step of the roundest rate within ``error``, s, of a step; else the step itself."""
    rates = (float(f"{1 / step:.{digits}g}") for digits in range(1, 10))
    return next((1 / r for r in rates if r > 0.0 and abs(1 / r - step) <= error), step)


# --- a clock that was set ------------------------------------------------------------------------------


def find_clock_steps(time: Array, present: NDArray[np.bool_]) -> list[ClockStep]:
    """Places, in order, where a clock was set while sampling went on, or sampling paused: the stamps move on by another time than the
    samples. More than a few are jitter, and none is reported.

    ``time`` (N,): instants on the grid of a flight, s; ``present`` (N,): samples that the file has, a gap is a place where the stamps
    moved on.
    """
    rows = np.flatnonzero(present)
    if len(rows) < 4 * BESIDE:
        return []
    steps = np.diff(time[rows])
    median = float(np.median(steps))
    apart = np.abs(steps - median)
    step = float(np.mean(steps[apart <= 8 * np.median(apart) + 0.02 * median]))  # of rounded stamps, too
    over = steps / step - 1.0
    off = np.where(np.abs(over) > 0.5, over - np.rint(over), over)  # whole steps are missing samples
    scatter = float(np.median(np.abs(off)))
    phase = np.r_[0.0, np.cumsum(off)]
    places = []
    for k in np.flatnonzero((np.abs(off) > max(SET, 8 * scatter)) | (np.diff(rows) > 1)):
        before, after = phase[max(0, k + 1 - BESIDE) : k + 1], phase[k + 1 : k + 1 + BESIDE]
        moved = float(np.median(after) - np.median(before))
        clear = max(SET, 4 * float(np.median(np.abs(before - np.median(before)))), 4 * scatter)
        lacking = float(np.rint(over[k])) if abs(over[k]) > 0.5 else 0.0
        part = moved if abs(moved) > clear else 0.0
        if part or lacking:
            row = int(rows[k + 1])
            places.append(ClockStep(row, float(time[row]), (part + lacking) * step, part * step))
    if len(places) <= MOST_SET:
        late = step * phase - np.sum([c.part * (rows >= c.row) for c in places], axis=0)
        places += _find_slews(time, rows, late, step)
    return places if len(places) <= MOST_SET else []


def _find_slews(time: Array, rows: NDArray[np.int64], late: Array, step: float) -> list[ClockStep]:
    """Segments in which ``late`` (rows,), s, by how much stamps are late, changes unlike in most, by ``SET`` steps in all."""
    parts = np.array_split(np.arange(len(rows)), SLEW_PARTS)
    if len(parts[-1]) < BESIDE:
        return []
    at, mean = (np.array([np.mean(x[k]) for k in parts]) for x in (rows, late))
    apart = np.diff(at)
    off = np.diff(mean) / apart
    off -= np.median(off)
    slews = []
    for r in runs(np.abs(off) > SLEWED * np.median(np.abs(off))):
        a, b, size = int(at[r.start]), int(at[r.stop]), float(np.sum((off * apart)[r]))
        if abs(size) > SET * step:
            slews.append(ClockStep(a, float(time[a]), size, size, b, float(time[b])))
    return slews


def fit_even_clock(time: Array, present: NDArray[np.bool_]) -> tuple[float, float, Array]:
    """The steady clock by which the samples were taken, whatever their stamps; ``time``, ``present`` as in :func:`find_clock_steps`.

    First instant and interval, s; by how much, s, the clock of each stamp, (N,), had been set, by other than whole intervals.
    """
    rows, steps = np.arange(len(time)), [c for c in find_clock_steps(time, present) if c.part]
    slewed = np.any([(rows >= c.row) & (rows < c.until) for c in steps], axis=0)
    k = np.flatnonzero(present & ~slewed)
    places = [np.ones(len(time)), *((rows >= c.row).astype(np.float64) for c in steps)]
    whole = np.stack([rows, *places], axis=1)
    X, t = whole[k], time[k] - time[0]
    fitted = np.linalg.lstsq(X, t, rcond=None)[0]
    set_by, scatter = whole[:, 2:] @ fitted[2:], float(np.std(t - X @ fitted))
    # A clock is set to a round rate: take it where the instants do not separate it from the fitted one.
    error = 4 * scatter * np.sqrt(np.linalg.pinv(X.T @ X, hermitian=True)[0, 0])
    step = _round_rate(float(fitted[0]), error)
    return float(time[0] + np.mean(t - set_by[k] - step * k)), step, set_by


def fit_clock_put_right(time: Array, steps: Sequence[ClockStep]) -> tuple[float, float]:
    """First instant and interval, s, of even samples whose clock drifts and is put right in steps: just after them it is right."""
    rows = np.array([c.row for c in steps])
    return _fit_clock(rows, time[rows], 0.1 * min(abs(c.size) for c in steps) / float(np.ptp(rows)))


def _fit_clock(rows: NDArray[np.int64], time: Array, error: float) -> tuple[float, float]:
    """First instant and interval, s, of a clock that shows some instants, s, at rows; of the rate the roundest within ``error``, s."""
    step = _round_rate(float(np.polyfit(rows, time, 1)[0]), error)
    return float(np.mean(time - step * rows)), step


# --- in words ------------------------------------------------------------------------------------------


def _describe_gaps(time: Array, jumps: NDArray[np.int64], step: float) -> list[str]:
    if np.all(jumps == 1):
        return []
    missing, longest = int(np.sum(jumps - 1)), int(np.argmax(jumps))
    return [
        f"{count(int(np.sum(jumps > 1)), 'gap')}: {missing} of {len(time) + missing} samples missing, the longest lasts"
        f" {jumps[longest] * step:.6g} s from t = {time[longest]:.10g} s; not used"
    ]


def _describe_jitter(time: Array, jumps: NDArray[np.int64], off: Array, step: float) -> list[str]:
    worst = int(np.argmax(off))
    if off[worst] <= JITTER_NOTED:
        return []
    was_set = [] if np.any(jumps > 1) else find_clock_steps(time, np.ones(len(time), dtype=np.bool_))
    if was_set:
        return [_ask_about(was_set)]
    return [
        f"sampling jitters by up to {off[worst]:.2g} of the step of {step:.6g} s (after t = {time[worst]:.10g} s); "
        "samples are used at their own instants, derivatives and spectra on the even grid"
    ]


def _ask_about(steps: Iterable[object]) -> str:
    """Whether a clock was set, by the first of its steps."""
    return f"the time stamps jump {', '.join(map(str, islice(steps, 3)))}: {WAS_SET}"


def _refuse_uneven(time: Array, steps: Array, step: float, off: Array, where: str) -> UserError:
    row, present = int(np.argmax(off)), np.ones(len(time), dtype=np.bool_)
    rate = 1 / _round_rate(float(time[-1] - time[0]) / (len(time) - 1), float(np.max(steps)) / len(time))
    what = "the record is not uniformly sampled"
    remedy = f"if its stamps alone are late, {_COUNT_ROWS.format(rate=f'{rate:.6g}')}; else resample it to a constant rate"
    if was_set := find_clock_steps(time, present):
        what = _ask_about(was_set)
        step = fit_even_clock(time, present)[1]
        remedy = _BY_COUNT.format(rate=f"{1 / step:.6g}")
    return UserError(
        what,
        where=where,
        found=f"a step of {steps[row]:.6g} s after row {row + 1} (t = {time[row]:.10g} s)",
        expected=f"steps of {step:.6g} s",
        remedy=remedy,
    )


def _require_increasing(time: Array, path: Path | str | None, where: str) -> None:
    """UserError unless every instant is later than the one before."""
    if len(time) < 2:
        rows = count(len(time), "row")
        raise UserError("too few samples", where=path, found=rows, expected="at least 2, usually thousands")
    steps = np.diff(time)
    wrong = np.flatnonzero(~(steps > 0))
    if not len(wrong):
        return
    row = int(wrong[0])
    found = f"row {row + 1}: {time[row]:.10g} s, row {row + 2}: {time[row + 1]:.10g} s"
    found += f" (and {len(wrong) - 1} more such places)" if len(wrong) > 1 else ""
    what, remedy = (
        "the time runs backwards",
        "remove duplicate rows or sort the rows by time; two records need two files; if a clock was set (to winter time?), "
        + _COUNT_ROWS.format(rate="..."),
    )
    in_order = np.diff(np.sort(time))
    swapped = np.min(in_order) > 0.5 * np.median(in_order)
    if np.isnan(time).any():
        what, remedy = "the time is missing", "check the format in which the time was written"
    elif np.mean(steps == 0) > SHARED:
        what = "the time stamps are too coarse for the sampling rate"
        found, remedy = _describe_coarse(time, steps)
    elif steps[row] == 0:
        what = "an instant appears twice"
    elif len(wrong) <= MOST_SET and -steps[row] < 0.5 * float(np.ptp(time)) and not swapped:
        step = _find_typical_step(steps[steps > 0])
        what = f"the time stamps jump back by {step - steps[row]:.4g} s at t = {time[row]:.10g} s: {WAS_SET}"
        remedy = _BY_COUNT.format(rate=f"{1 / step:.6g}")
    raise UserError(what, where=where, found=found, expected="increasing time", remedy=remedy)


def _describe_coarse(time: Array, steps: Array) -> tuple[str, str]:
    """What was found and the remedy where several rows share each stamp: whole seconds, or single precision."""
    edges, single = np.flatnonzero(steps != 0) + 1, time.astype(np.float32)
    spacing = float(np.spacing(np.abs(single).max())) if np.array_equal(single, time) else 0.0
    rows = len(time) / (len(edges) + 1)
    whole = "; they are whole seconds" * np.array_equal(np.rint(time), time)
    rate, how = "...", whole if len(edges) else "; the clock stands still"
    if spacing >= 1e-3:
        how = f"; single precision has steps of {spacing:.3g} s there"
    elif len(edges):
        rate = f"{rows / float(np.median(steps[edges - 1])):.6g}"
    stamps = f"{count(len(edges) + 1, 'different stamp')} in {len(time)} rows, each in about {rows:.4g} rows"
    return stamps + how, _COUNT_ROWS.format(rate=rate) + "; no row is duplicated"
