"""Mistakes of timing: spin rate, disc angle at the start, rows that were lost, motion and output apart in time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft, optimize

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io.sampling import find_clock_steps
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import disc_angle, start_of
from ragg_runtime.screening.linear_fit import Hypothesis, explain, explain_all
from ragg_runtime.screening.sampler import Index, Rows, Sampler
from ragg_runtime.signals.demodulate import demodulable, low_pass

Array = NDArray[np.float64]

FARTHEST = 60.0
"""Longest shift of the motion record that is looked for, s."""

SPIN_RANGE = 0.05
"""Relative error of the spin rate that is looked for."""

LATEST = 1e4
"""Start of a record after angle 0 of its disc, s, up to which the spin rate is looked for: the grid is the finer."""

MOST_SHIFTS = 64
"""Shifts that are tried: about the tops of a cross-correlation, and on from there while less is left."""

LONGEST = 1 << 18
"""Samples of which a shift is estimated."""

LEAST_PHASE = np.deg2rad(5.0)
"""Angle at the start from which it is a mistake; smaller ones are a matter of calibration (spin-phase-offset)."""

LEAST_STEP = np.deg2rad(1.0)
"""Jump of the disc angle from which rows are said to be lost."""

INSTANTS = 16
"""Instants at which a jump of the disc angle is tried first; the best is then refined."""

TELLING_PHASE = 3e-5
"""Angle, rad, that an error of the spin rate may add up to over a record and stay unseen: of a gradient of 3000 Eo that is
0.1 Eo. Further digits of a rate are noise of the search."""

COST = 8.0
"""Minus the logarithm of the probability of a mistake of timing: of one kind in ten, and of one value in some hundreds."""


def hypotheses(model: Model, instrument: Instrument, s: Sampler) -> list[Hypothesis]:
    """The best of each kind of mistake."""
    found = _shifts(model, instrument, s)
    if s.disc.spin_frequency == 0.0:
        return found
    if not s.recorded.demodulated:  # a demodulator at the wrong rate lets nothing through
        found += _spin(model, instrument, s)
    if not s.has_encoder or s.recorded.demodulated:
        found += _phase(model, instrument, s)
    if not s.has_encoder:
        found += _origin(model, instrument, s)
        found += [] if s.recorded.demodulated else _jump(model, instrument, s)
    return found


def _misfits(model: Model, instrument: Instrument, many: Sequence[Rows]) -> list[float]:
    return [e.misfit for e in explain_all(model, instrument, many)]


def _spin(model: Model, instrument: Instrument, s: Sampler) -> list[Hypothesis]:
    """The spin rate at which the model explains most, coarse to fine: half a turn of error at each step."""
    f0, x = s.disc.spin_frequency, s.flight
    turned = explain(model, instrument, s.take(s.rows(), backwards=True))
    backwards = Hypothesis(
        "the disc turns the other way",
        "reverse the sign of spin_angle, or turn the axes of the record (y and z reversed)",
        turned,
        COST - 1.0,
        calming=False,
    )
    late = 0.0 if s.has_encoder else abs(start_of(x, instrument))
    if late > LATEST:
        return [backwards]
    best, width = f0, SPIN_RANGE * abs(f0)
    span = min(x.duration, 1.0 / width)

    def left(rates: Sequence[float], last: int) -> list[float]:
        rows = s.rows(0, last, 600)
        return _misfits(model, instrument, [s.take(rows, spin_frequency=f) for f in rates])

    while True:
        last = max(2, min(len(x), int(span * x.rate)))
        step = 0.1 / (late + last / x.rate)
        grid = best + step * np.arange(-np.ceil(width / step), np.ceil(width / step) + 1)
        best = float(grid[int(np.argmin(left(grid.tolist(), last)))])
        if last == len(x):
            break
        width, span = 2 * step, span * 4
    best = float(
        optimize.minimize_scalar(
            lambda f: left([float(f)], len(x))[0],
            bounds=(best - step, best + step),
            method="bounded",
            options={"xatol": 1e-9 * abs(f0)},
        ).x
    )
    shown, remedy = in_digits(best, x.duration), "record spin_angle"
    what = f"the spin rate is {shown} Hz, not the model's {f0:.9g} Hz ({100 * (best / f0 - 1):+.2g} %)"
    if s.has_encoder:
        what = f"{s.disc.angle_column} is not the angle of the disc, which turns at {shown} Hz from angle 0 at the first sample"
        remedy = f"check the encoder and its zero, or leave {s.disc.angle_column} out"
    if float(shown) != float(in_digits(f0, x.duration)):
        remedy = f'write spin_frequency = "{shown} Hz" in model.toml, or {remedy}'
    elif not s.has_encoder:
        return [backwards]
    fitted = explain(model, instrument, s.take(s.rows(), spin_frequency=best))
    return [Hypothesis(what, remedy, fitted, COST, effects=("spin-rate-offset",), calming=False), backwards]


def in_digits(f: float, duration: float) -> str:
    """A spin rate, Hz, with the fewest digits that this record does not tell from it."""
    near = TELLING_PHASE / (2 * np.pi * duration)
    texts = (f"{f:.{n}g}" for n in range(3, 18))  # seventeen are the number itself
    return next(x for x in texts if abs(float(x) - f) <= near)


def _origin(model: Model, instrument: Instrument, s: Sampler) -> list[Hypothesis]:
    """The disc angle counted from the first sample in the place of t = 0, or the other way round."""
    x, f = s.flight, s.disc.spin_frequency
    here = start_of(x, instrument)
    origin = "zero" if here == float(x.time[0]) - (x.began or 0.0) else "first-sample"
    there = start_of(x, replace(instrument, angle_origin=origin))
    at_first = [float(disc_angle(np.zeros(1), f, t)[0]) for t in (here, there)]
    if abs(_wrapped(at_first[1] - at_first[0])) < LEAST_PHASE:
        return []
    other = "zero" if origin == "first-sample" else "first-sample"
    words = {"zero": "at t = 0", "first-sample": f"at the first sample (t = {x.time[0]:.6g} s)"}
    return [
        Hypothesis(
            f"the disc stood at angle 0 {words[origin]}, not {words[other]}",
            f'write angle_origin = "{origin}" under [model] of model.toml if that is so, else'
            f' angle_origin = "{other}"; or record spin_angle',
            explain(model, instrument, s.take(s.rows(), phase=at_first[1] - at_first[0])),
            COST / 4,
            kind="origin",
        )
    ]


def _phase(model: Model, instrument: Instrument, s: Sampler) -> list[Hypothesis]:
    rows = s.rows(most=600)

    def left(phases: Array) -> list[float]:
        return _misfits(model, instrument, [s.take(rows, phase=float(a)) for a in phases])

    best = _wrapped(_refined(left, np.deg2rad(np.arange(0.0, 360.0, 10.0)), np.deg2rad(10.0)))
    if abs(best) < LEAST_PHASE:
        return []
    taken = float(disc_angle(np.zeros(1), s.disc.spin_frequency, start_of(s.flight, instrument))[0])
    true, believed = (np.rad2deg(_wrapped(a)) for a in (taken + best, taken))
    return [
        Hypothesis(
            f"the disc stood at {true:.4g} degrees at the first sample, not at {believed:.4g}"
            " (a file cut out of a longer one?)",
            "record spin_angle, or let time count from an instant of angle 0",
            explain(model, instrument, s.take(s.rows(), phase=best)),
            COST,
            effects=("spin-phase-offset",),
            calming=False,
        )
    ]


def _wrapped(angle: float) -> float:
    return float((angle + np.pi) % (2 * np.pi) - np.pi)


def _refined(left: Callable[[Array], list[float]], grid: Array, step: float) -> float:
    """Where least is left: of a grid, then four times as finely about the best, four times."""
    best = float(grid[int(np.argmin(left(grid)))])
    for _ in range(4):
        step /= 4
        near = np.asarray(best + step * np.arange(-3, 4), dtype=np.float64)  # the fourth either way is known
        best = float(near[int(np.argmin(left(near)))])
    return best


def _jump(model: Model, instrument: Instrument, s: Sampler) -> list[Hypothesis]:
    """The disc angle jumps on the way: rows were lost, or the clock was set, while disc and sampling went on."""
    n = len(s.flight)
    rows, spacing = s.rows(most=400), n / (INSTANTS + 1)

    def best_of(rows: Index, instants: ArrayLike, jumps: ArrayLike) -> tuple[float, float]:
        pairs = [(float(k), float(a)) for k in np.atleast_1d(instants) for a in np.atleast_1d(jumps)]
        many = [s.take(rows, phase=np.where(rows >= k, a, 0.0)) for k, a in pairs]
        return pairs[int(np.argmin(_misfits(model, instrument, many)))]

    everywhere = spacing * np.arange(1, INSTANTS + 1)
    small = np.array([2.0, 4.0, 8.0, 15.0])
    at, jump = best_of(rows, everywhere, np.deg2rad([*-small, *small, *np.arange(30.0, 360.0, 30.0)]))
    for _ in range(2):  # where the jump is wrong the instant is not told, and the other way round
        for step in np.deg2rad([8.0, 2.0, 0.5, 0.125]):
            _, jump = best_of(rows, at, jump + step * np.arange(-3, 4))
        at, _ = best_of(rows, everywhere, jump)
        for step in spacing / 2.0 ** np.arange(1, 10):
            at, _ = best_of(rows, at + step * np.array([-1.0, 0.0, 1.0]), jump)
    if abs(_wrapped(jump)) < LEAST_STEP:
        return []
    beside = s.rows(max(0, int(at - n / 100)), int(at + n / 100) + 1, 64)
    at, _ = best_of(np.union1d(rows, beside), beside, jump)
    rows = s.rows()
    fitted = explain(model, instrument, s.take(rows, phase=np.where(rows >= at, jump, 0.0)))
    what, remedy = _jump_in_words(s, int(at), jump)
    return [Hypothesis(what, remedy, fitted, COST + float(np.log(n / 10.0)), calming=False)]


def _jump_in_words(s: Sampler, at: int, jump: float) -> tuple[str, str]:
    x, turn = s.flight, 1.0 / abs(s.disc.spin_frequency)
    lost = float(np.mod(np.sign(s.disc.spin_frequency) * jump, 2 * np.pi)) / (2 * np.pi) * turn
    near = [c for c in find_clock_steps(x.time, x.present) if abs(c.row - at) < 64]
    gaps = [c for c in near if abs((c.size + lost + turn / 2) % turn - turn / 2) < 2 / x.rate]
    if gaps:
        return (
            f"the stamps step by {gaps[0].size:.4g} s at t = {gaps[0].time:.6g} s, while sampling went on: was the clock set?",
            f"give the times by the sample count: time = row / {x.rate:.6g} Hz",
        )
    rows, repeated = round(lost * x.rate), round((turn - lost) * x.rate)
    count = min(rows, repeated)
    some = f"{count} row{'s are' if count != 1 else ' is'} "
    some += f"missing ({lost:.4g} s)" if rows <= repeated else "doubled"
    return (
        f"some rows were lost at t = {x.time[at]:.5g} s: {some} there, or whole turns of the disc ({turn:.4g} s) more",
        "let time be that of the recorder, not of the row number; or split the record there, or record spin_angle",
    )


def _shifts(model: Model, instrument: Instrument, s: Sampler) -> list[Hypothesis]:
    """Motion, specific force alone, and output apart in time: candidates from a cross-correlation, judged by the model."""
    rows, rate = s.rows(most=400), s.flight.rate
    waiting = [k for k in _lags(instrument, s) if k != 0]
    kinds: list[Callable[[Sampler, Index, int], Rows]] = [
        lambda s, r, k: s.take(r, motion_later=k),
        lambda s, r, k: s.take(r, motion_later=k, of=("a",)),
        lambda s, r, k: s.take(r, output_later=-k),
    ]
    tried: dict[int, list[float]] = {}
    while waiting and len(tried) < MOST_SHIFTS:
        each = [_misfits(model, instrument, [kind(s, rows, k) for k in waiting]) for kind in kinds]
        tried |= {k: list(misfits) for k, *misfits in zip(waiting, *each, strict=True)}
        best = [min(tried, key=lambda k: tried[k][way]) for way in range(len(kinds))]
        near = {k + d or d for k in best for d in (-1, 1)}  # beyond 0, which is the record as it stands
        waiting = sorted(near - set(tried))
    if not tried:
        return []
    found = []
    for kind, k, name in zip(
        kinds, best, ("the motion record is", "a_x, a_y, a_z are", "the output is"), strict=True
    ):
        by = f"{abs(k) / rate:.6g} s"
        late = (k > 0) == (name != "the output is")
        against = "motion and disc angle" if name == "the output is" else "the output"
        which = {"the motion record is": "motion columns", "the output is": "output column"}.get(
            name, "columns"
        )
        found.append(
            Hypothesis(
                f"{name} {by} ({abs(k)} sample{'s' * (abs(k) > 1)}) {'late' if late else 'early'} against {against}",
                f"shift the {which} by {by}",
                explain(model, instrument, kind(s, s.rows(), k)),
                COST + (1.0 if which == "columns" else 0.0),
                kind="shift",
                calming=False,
                effects=() if which == "columns" else ("time-offset",),
            )
        )
    return found


def _lags(instrument: Instrument, s: Sampler) -> Sequence[int]:
    """Samples by which the motion may be late: where the demodulated output resembles a_x + i a_y most."""
    x, f = s.flight, abs(s.disc.spin_frequency)
    if s.recorded.demodulated or not demodulable(x.rate) or (f > 0 and x.duration < 3 / f):
        return ()
    n = min(len(x), LONGEST)
    whole = s.take(np.arange(n))
    data = whole.data[0] if len(whole.data) == 1 else whole.data[0] - whole.data[1]
    carried = np.where(s.usable[:n], data, 0.0) * np.exp(1j * whole.phi)
    taps = low_pass(x.rate)
    narrow = fft.next_fast_len(n + len(taps))
    response = fft.fft(taps, narrow)
    size = fft.next_fast_len(2 * n)

    def prepared(z: NDArray[np.complex128]) -> NDArray[np.complex128]:
        low = fft.ifft(fft.fft(z, narrow) * response)[len(taps) // 2 :][:n]
        low = np.diff(low)  # slow drifts resemble each other at any lag
        return np.asarray(fft.fft(low - np.mean(low), size))

    motion = prepared(np.asarray(whole.channels["a_x"] + 1j * whole.channels["a_y"]))
    output = np.conj(prepared(np.asarray(carried)))
    reach = min(n // 4, int(FARTHEST * x.rate))
    found: list[int] = []
    for other in (motion, np.conj(np.roll(motion[::-1], 1))):
        like = np.abs(fft.ifft(other * output))
        top = int(np.argmax(np.concatenate([like[-reach:], like[: reach + 1]]))) - reach
        found += [k for k in range(top - 2, top + 3) if k not in found]
    return found
