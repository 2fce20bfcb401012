"""Mistakes of timing: spin rate, disc angle at the start, rows that were lost, motion and output apart in time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.base.errors import count
from ragg_runtime.io import Flight
from ragg_runtime.model.record import SPIN, disc_angle, find_start
from ragg_runtime.screening.linear_fit import (
    Hypothesis,
    Index,
    Sampler,
    find_least,
    fit_robustly,
    fit_rows,
    linearise,
)
from ragg_runtime.signals.demodulators import is_demodulable, low_pass
from ragg_runtime.signals.derivative import runs
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]

FARTHEST = 60.0  # longest shift of the motion record that is looked for, s
SPIN_RANGE = 0.05  # relative error of the spin rate that is looked for
# start of a record after angle 0 of its disc, s, up to which the spin rate is looked for: the grid is the finer
LATEST = 1e4

LOSS_ROWS, MOST_LAGS, SWITCH, MOST_JUMPS = 800, 64, 30.0, 4
"""Rows on which places are looked for where rows are missing; numbers of rows that are tried at first; what a change of it costs, from
a third to three times of which finds the same (docs/contributors/decisions.md); most places that are listed."""

# shifts that are tried: about the tops of a cross-correlation, and on from there while less is left
MOST_SHIFTS = 64
LONGEST = 1 << 18  # samples of which a shift is estimated
ORIGINS = ("zero", "first-sample")  # angle_origin of model.toml
# angle at the start from which it is a mistake; smaller ones are a matter of calibration (spin-phase-offset)
LEAST_PHASE = np.deg2rad(5.0)
# fits of the model in turn with the search for which rows are of which record; most that may be of another
ROUNDS, MOST_OTHER = 3, 0.5

TELLING_PHASE = 3e-5
"""Angle, rad, that an error of the spin rate may add up to over a record and stay unseen: of a gradient of 3000 Eo that is
0.1 Eo. Further digits of a rate are noise of the search."""

PART_ROWS, LARGE, SMALL = 400, 0.2, 0.02
"""Rows by which a part of another record is looked for, and shares of the output that the model leaves of it at least, and of the rest at
most: effects, a step of the gain too, leave a hundredth."""

COST = 3.0  # what orders a mistake of timing after one of columns that explains as much


def propose_times(s: Sampler) -> list[Hypothesis]:
    """The best of each kind of mistake."""
    turning, whole = s.disc.spin_frequency != 0.0, not s.recorded.demodulated
    hypotheses = _propose_shifts(s) if whole else []
    if turning and whole:  # a demodulator at the wrong rate lets nothing through
        hypotheses += _propose_spin(s)
    if turning and not (s.has_encoder and whole):
        hypotheses += _propose_phase(s)
    if turning and whole and not s.has_encoder:
        hypotheses += _propose_losses(s)
    return hypotheses


def _propose_spin(s: Sampler) -> list[Hypothesis]:
    """The spin rate at which the model explains most, coarse to fine: half a turn of error at each step."""
    x, f0 = s.flight, s.disc.spin_frequency
    remedy = "reverse the sign of spin_angle, or turn the axes of the record (y and z reversed)"
    whole = s.take()
    turned = {n: -x for n, x in whole.record.wide.items() if n in (s.disc.angle_column, *SPIN)}
    backwards = Hypothesis("the disc turns the other way", remedy, fit_rows(whole.change(turned)), COST - 1.0)
    late = 0.0 if s.has_encoder else abs(find_start(x, s.instrument))
    if late > LATEST:
        return [backwards]
    best, width, last = f0, SPIN_RANGE * abs(f0), 0
    span = min(x.duration, 1.0 / width)
    while last < len(x):
        last = max(2, min(len(x), int(span * x.rate)))
        step = 0.1 / (late + last / x.rate)
        grid = best + step * np.arange(-np.ceil(width / step), np.ceil(width / step) + 1)
        rows = s.rows(0, last, 600)
        best = float(min(grid, key=lambda f: s.fit(rows, spin_frequency=f).misfit))
        width, span = 2 * step, span * 4
    near = best + step * np.arange(-1, 2)
    best = find_least(lambda f: s.fit(rows, spin_frequency=f).misfit, near, 1e-9 * abs(f0))
    rate, remedy = write_rate(best, x.duration), "record spin_angle"
    what = f"the spin rate is {rate} Hz, not the model's {f0:.9g} Hz ({100 * (best / f0 - 1):+.2g} %)"
    if s.has_encoder:
        column = s.disc.angle_column
        what = f"{column} is not the angle of the disc, which turns at {rate} Hz from angle 0 at the first sample"
        remedy = f"check the encoder, its resolution and its zero, or leave {column} out"
    if float(rate) != float(write_rate(f0, x.duration)):
        remedy = f'write spin_frequency = "{rate} Hz" in model.toml, or {remedy}'
        if not s.has_encoder:
            remedy += "; if times were made from row numbers, rows may be missing: use the recorder's time"
    elif not s.has_encoder:
        return [backwards]
    fitted = s.fit(spin_frequency=best)
    return [Hypothesis(what, remedy, fitted, COST, effects=("spin-rate-offset",)), backwards]


def write_rate(f: float, duration: float) -> str:
    """A spin rate, Hz, with the fewest digits that this record cannot distinguish from it."""
    near = TELLING_PHASE / (2 * np.pi * duration)
    texts = (f"{f:.{n}g}" for n in range(3, 18))  # seventeen are the number itself
    return next(x for x in texts if abs(float(x) - f) <= near)


def _propose_phase(s: Sampler) -> list[Hypothesis]:
    """Another disc angle at the first sample: as counted from there in the place of t = 0, or the other way round; or any."""
    rows, round_about = s.rows(most=600), np.deg2rad(np.arange(0.0, 360.0, 10.0))
    best = _wrap(find_least(lambda a: s.fit(rows, phase=a).misfit, round_about, np.deg2rad(0.05)))
    if abs(best) < LEAST_PHASE:
        return []
    starts = [find_start(s.flight, replace(s.instrument, angle_origin=o)) for o in ORIGINS]
    zero, first = (float(disc_angle(np.zeros(1), s.disc.spin_frequency, x)[0]) for x in starts)
    by_zero = find_start(s.flight, s.instrument) == starts[0]
    start, turn = (zero, first - zero) if by_zero else (first, zero - first)
    if not s.has_encoder and abs(_wrap(best - turn)) < LEAST_PHASE:
        words = ("at t = 0", f"at the first sample (t = {s.flight.time[0]:.6g} s)")
        what = f"the disc was at angle 0 {words[by_zero]}, not {words[not by_zero]}"
        remedy = (
            f'write angle_origin = "{ORIGINS[by_zero]}" under [model] of model.toml if that is so, else'
            f' angle_origin = "{ORIGINS[not by_zero]}"; or record spin_angle'
        )
        return [Hypothesis(what, remedy, s.fit(phase=turn), kind="origin", calming=True)]
    true, believed = (np.rad2deg(_wrap(a)) for a in (start + best, start))
    what = (
        f"the disc was at {true:.4g} degrees at the first sample, not at {believed:.4g}"
        " (a file cut out of a longer one?)"
    )
    remedy = "record spin_angle, or count time from an instant with angle 0"
    return [Hypothesis(what, remedy, s.fit(phase=best), COST, effects=("spin-phase-offset",))]


def _wrap(angle: float) -> float:
    return float((angle + np.pi) % (2 * np.pi) - np.pi)


def _propose_losses(s: Sampler) -> list[Hypothesis]:
    """Rows are missing, or doubled, while the stamps go on evenly: the disc runs ahead of them, or behind, by whole rows."""
    n, turn = len(s.flight), s.flight.rate / abs(s.disc.spin_frequency)
    rows = s.rows(n // 100, n - n // 100, LOSS_ROWS // len(s.columns))  # at an end a loss is a phase
    if len(rows) < 3:
        return []
    angle = 2 * np.pi * s.disc.spin_frequency / s.flight.rate

    def take(lags: Index) -> list[tuple[Array, Array]]:
        return [linearise(s.take(rows, phase=angle * k)) for k in lags]

    lags = np.unique(np.rint(np.arange(MOST_LAGS) * turn / MOST_LAGS).astype(np.intp))
    systems, third = take(lags), slice(len(rows) - len(rows) // 3, None)
    starts = np.full((2, len(rows)), -1)
    starts[0, : len(rows) // 3] = 0
    starts[1, third] = min(range(len(lags)), key=lambda k: _fit_segment(*systems[k], third)[1])
    late = lags[min((_follow(systems, x) for x in starts), key=lambda x: x[1])[0]]
    if len(lags) < turn - 1:  # once more, with all lags beside these
        beside = int(turn / MOST_LAGS) + 1
        lags = np.unique(np.unique(late)[:, None] + np.arange(-beside, beside + 1))
        late = lags[_follow(take(lags), np.searchsorted(lags, late))[0]]
    jumps = np.flatnonzero(np.diff(late)) + 1
    if not len(jumps):
        return []
    what = _describe_losses(s.flight.time[rows[jumps]], np.diff(late)[jumps - 1], turn, s.flight)
    remedy = "use the recorder's time, not the row number; or split the record there, or record spin_angle"
    kind = "losses" if len(jumps) > MOST_JUMPS else "record"
    return [Hypothesis(what, remedy, s.fit(rows, phase=angle * late), COST + 1.0, kind)]


def _describe_losses(instants: Array, steps: Index, turn: float, x: Flight) -> str:
    """In words: from which instants on, s, the disc is ahead by how many rows more, whole turns of so many rows not counted."""
    if len(steps) > MOST_JUMPS:
        lost = int(np.sum(steps - turn * np.rint(steps / turn)))
        words = f"{'missing' if lost > 0 else 'doubled'} (about {abs(lost)} of {len(x)})"
        return f"rows are {words} all along the record, while its stamps go on evenly"
    places = []
    for at, lost in zip(instants, np.rint(np.mod(steps, turn)).astype(int), strict=True):
        words = f"{lost} row{'s are' if lost != 1 else ' is'} missing there ({lost / x.rate:.4g} s)"
        places.append(f"at t = {at:.5g} s: {words}, or {round(turn - lost)} are duplicated")
    return f"rows are missing {', '.join(places)}; or whole turns of the disc ({turn / x.rate:.4g} s) more"


def propose_parts(s: Sampler) -> list[Hypothesis]:
    """Another record lies between two instants: the model leaves more of it than effects would, and explains the rest without it."""
    rows, n = s.rows(most=PART_ROWS), len(s.flight)
    sample = s.take(rows)
    X, y = linearise(sample)
    size = fit_rows(sample).size
    starts = np.full((3, len(rows)), -1)
    for start, third in zip(starts, np.array_split(np.arange(len(rows)), 3), strict=True):
        start[third] = 0  # one of them is of one record, at least
    other = min((_follow([(X, y)], x, SMALL * LARGE * size**2) for x in starts), key=lambda x: x[1])[0] == 1
    found = runs(other)
    if len(found) != 1 or np.mean(other) > MOST_OTHER:
        return []
    edges = np.r_[0, (rows[1:] + rows[:-1]) // 2, n]
    first, last = int(edges[found[0].start]), int(edges[found[0].stop])
    rest, theta = s.fit(rows[~other]), _fit_segment(X, y, ~other)[0]
    residual = (y - np.tensordot(theta, X, 1))[:, other]
    if float(np.sqrt(np.mean(residual**2))) < LARGE * size or rest.share > SMALL:
        return []
    begins, ends = (f"t = {s.flight.time[min(k, n - 1)]:.4g} s" for k in (first, last))
    what = (
        f"the model explains the record, but not what lies between {begins} and {ends} (another instrument, range, sign, axis or"
        " wiring there?)"
    )
    remedy = "cut the record there, and diagnose its parts by themselves"
    fitted = replace(rest, rms=rest.size * rest.share ** (1.0 - (last - first) / n))
    return [Hypothesis(what, remedy, fitted, COST + 1.0, effects=("gain-step",))]


def _follow(
    systems: Sequence[tuple[Array, Array]], path: Index, other: float | None = None
) -> tuple[Index, float]:
    """Which of some systems, columns (n, m, N) and data (m, N), the rows belong to, (N,), and what that costs.

    The coefficients, which all systems share, are fitted to the rows as far as they are known (``path``; -1: not known), and the path of
    least cost is found, in turn. ``other``: Eo^2, what is left of a row that belongs to none; these are the last state.
    """
    every, total = np.stack([X for X, _ in systems]), np.inf
    data = np.stack([y for _, y in systems])
    for _ in range(ROUNDS):
        known = np.flatnonzero((path >= 0) & (path < len(systems)))
        if not len(known):
            break
        X, y = (np.moveaxis(z[path[known], ..., known], 0, -1) for z in (every, data))
        theta, rms = _fit_segment(X, y, slice(None))
        squares = np.mean((data - np.einsum("n,knmr->kmr", theta, every)) ** 2, axis=1)
        costs = np.log(rms**2 + np.vstack([squares, *([] if other is None else [np.full(len(path), other)])]))
        path = find_path(costs, SWITCH)
        total = float(np.sum(costs[path, np.arange(len(path))])) + SWITCH * np.count_nonzero(np.diff(path))
    return path, total


def _fit_segment(X: Array, y: Array, some: slice | Array) -> tuple[Array, float]:
    """Coefficients (n,) of columns (n, m, N) by some of their rows, and the size of what they leave there, Eo."""
    columns, data = X[:, :, some].reshape(len(X), -1), y[:, some].reshape(-1)
    theta, kept, _ = fit_robustly(columns, data)
    return theta, max(float(np.sqrt(np.mean((data - theta @ columns)[kept] ** 2))), 1e-12)


Options = Callable[[Any], dict[str, Any]]
"""Those of :meth:`Sampler.take` for rows as if something were not so many samples late."""

_LATE: Sequence[tuple[str, str, bool, Options]] = (
    ("the motion record is", "motion columns", True, lambda k: {"motion_later": k}),
    ("a_x, a_y, a_z are", "columns", True, lambda k: {"motion_later": k, "of": ("a",)}),
    ("the output is", "output column", False, lambda k: {"output_later": -k}),
)
"""What may be late, what is then to be shifted, whether it is motion, and how it is taken."""


def _propose_shifts(s: Sampler) -> list[Hypothesis]:
    """Motion, specific force alone, and output apart in time: candidates from a cross-correlation, judged by the model."""
    rows, rate = s.rows(most=400), s.flight.rate
    lags = [k for k in _list_lags(s) if k != 0]
    shifts = []
    for words, columns, motion, options in _LATE if lags else ():
        k = _find_lag(s, rows, lags, options)
        late = f"{abs(k) / rate:.6g} s ({count(abs(k), 'sample')}) {'late' if (k > 0) == motion else 'early'}"
        what = f"{words} {late} against {'the output' if motion else 'motion and disc angle'}"
        remedy = f"shift the {columns} by {abs(k) / rate:.6g} s"
        effects, cost = ((), COST + 1.0) if columns == "columns" else (("time-offset",), COST)
        shifts.append(Hypothesis(what, remedy, s.fit(**options(k)), cost, "shift", effects))
    return shifts


def _find_lag(s: Sampler, rows: Index, lags: Sequence[int], options: Options) -> int:
    """The lag with which the model leaves least of some rows: the best of ``lags``, or of those beside it as long as they leave less."""
    misfits: dict[int, float] = {}
    untried = [*lags]
    while untried and len(misfits) < MOST_SHIFTS:
        misfits |= {k: s.fit(rows, **options(k)).misfit for k in untried}
        best = min(misfits, key=lambda k: misfits[k])
        untried = [k for d in (-1, 1) if (k := best + d or d) not in misfits]  # over 0, the record as it is
    return best


def find_path(costs: Array, switch: float) -> Index:
    """(N,): the path of least cost through K states of costs (K, N), each change at a cost (A. Viterbi, IEEE Trans. Inf. Theory 13,
    1967, 260).
    """
    total, came = costs[:, 0], np.zeros(costs.T.shape, dtype=np.intp)
    for k in range(1, costs.shape[1]):
        least = int(np.argmin(total))
        stays = total <= total[least] + switch
        came[k] = np.where(stays, np.arange(len(total)), least)
        total = np.where(stays, total, total[least] + switch) + costs[:, k]
    path = np.full(len(came), int(np.argmin(total)))
    for k in range(len(came) - 1, 0, -1):
        path[k - 1] = came[k, path[k]]
    return path


def _list_lags(s: Sampler) -> Sequence[int]:
    """Samples by which the motion may be late: where the output at the spin rate resembles a_x, or a_y, or a_x + i a_y, or its mirror
    image, most; and two samples beside.
    """
    x, f = s.flight, abs(s.disc.spin_frequency)
    n = min(len(x), LONGEST)
    if not is_demodulable(x.rate) or (f > 0 and n < 3 * x.rate / f):
        return ()
    output, motion = _mix(s, np.arange(n))
    slopes = np.diff(
        convolve(np.stack([output, motion.real + 0j, motion.imag + 0j]), low_pass(x.rate), "same")
    )
    slopes -= np.mean(slopes, axis=1, keepdims=True)  # and slow drifts resemble each other at any lag
    along_x, along_y = (signal.correlate(z, slopes[0], method="fft") for z in slopes[1:])
    likes = (along_x, along_y, along_x + 1j * along_y, along_x - 1j * along_y)
    lags = signal.correlation_lags(n - 1, n - 1)
    near = np.abs(lags) <= min(n // 4, int(FARTHEST * x.rate))
    tops = [int(lags[near][np.argmax(np.abs(like[near]))]) for like in likes]
    return [*dict.fromkeys(k for top in tops for k in range(top - 2, top + 3))]


def _mix(s: Sampler, rows: Index) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """The output at the spin rate, and the specific force in the disc's plane, of neighbouring rows of a record, (n,) each."""
    whole = s.take(rows)
    data = whole.data[0] if len(whole.data) == 1 else whole.data[0] - whole.data[1]
    output = np.where(s.usable[rows], data, 0.0) * np.exp(1j * whole.record.phi)
    return np.asarray(output), np.asarray(whole.record.wide["a_x"] + 1j * whole.record.wide["a_y"])
