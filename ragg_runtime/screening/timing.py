"""Mistakes of timing, searched for: spin rate, disc angle at the start, motion and output apart in time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import fft, optimize

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import disc_angle, start_of
from ragg_runtime.screening.quick_fit import Explained, explain, explain_all
from ragg_runtime.screening.subsample import Picker
from ragg_runtime.signals.demodulate import demodulable, low_pass

Array = NDArray[np.float64]

LATEST = 1e4
"""Start of a record after angle 0 of its disc, s, up to which the spin rate is looked for: the grid is the finer."""

FARTHEST = 60.0
"""Longest shift of the motion record that is looked for, s."""

SPIN_RANGE = 0.05
"""Relative error of the spin rate that is looked for."""

LONGEST = 1 << 18
"""Samples of which a shift is estimated."""

LEAST_PHASE = np.deg2rad(5.0)
"""Angle at the start from which it is a mistake; smaller ones are a matter of calibration (spin-phase-offset)."""


TELLING_PHASE = 3e-5
"""Angle, rad, that an error of the spin rate may add up to over a record and stay unseen: of a gradient of 3000 Eo that is
0.1 Eo. Further digits of a rate are noise of the search."""


def _in_digits(f: float, f0: float, duration: float) -> str:
    """A spin rate, Hz, with the fewest digits that this record does not tell from it, and that tell it from the model's ``f0``."""
    near = min(TELLING_PHASE / (2 * np.pi * duration), abs(f - f0) / 10)
    texts = (f"{f:.{n}g}" for n in range(3, 18))  # seventeen are the number itself
    return next(x for x in texts if abs(float(x) - f) <= near)


@dataclass(frozen=True)
class Found:
    """A mistake of timing undone as well as can be: what is likely, what to do, what is left then."""

    what: str
    remedy: str
    left: Explained
    shift: bool = False
    plainness: int = 3
    origin: bool = False


def searches(model: Model, instrument: Instrument, p: Picker) -> list[Found]:
    """The best of each kind of mistake."""
    found = _shift(model, instrument, p)
    if p.disc.spin_frequency == 0.0:
        return found
    if not p.recorded.demodulated:  # a demodulator at the wrong rate lets nothing through
        found += _spin(model, instrument, p)
    if p.disc.angle_column not in p.flight.channels or p.recorded.demodulated:
        found += _phase(model, instrument, p)
    if p.disc.angle_column not in p.flight.channels:
        found += _origin(model, instrument, p)
    return found


def _origin(model: Model, instrument: Instrument, p: Picker) -> list[Found]:
    """The disc angle counted from the first sample in the place of t = 0, or the other way round."""
    x, f = p.flight, p.disc.spin_frequency
    here = start_of(x, instrument)
    origin = "zero" if here == float(x.time[0]) - (x.began or 0.0) else "first-sample"
    there = start_of(x, replace(instrument, angle_origin=origin))
    at_first = [float(disc_angle(np.zeros(1), f, s)[0]) for s in (here, there)]
    if abs(np.angle(np.exp(1j * (at_first[1] - at_first[0])))) < LEAST_PHASE:
        return []
    told = {"zero": "at t = 0", "first-sample": f"at the first sample (t = {x.time[0]:.6g} s)"}
    taken = told["zero" if origin == "first-sample" else "first-sample"]
    return [
        Found(
            f"the disc stood at angle 0 {told[origin]}, not {taken}",
            f'write angle_origin = "{origin}" under [model] of model.toml if that is so, else angle_origin = '
            f'"{"zero" if origin == "first-sample" else "first-sample"}"; or record spin_angle',
            explain(model, instrument, p.pick(p.rows(), phase=at_first[1] - at_first[0])),
            plainness=0,
            origin=True,
        )
    ]


def _spin(model: Model, instrument: Instrument, p: Picker) -> list[Found]:
    """The spin rate at which the model explains most, coarse to fine: half a turn of error at each step."""
    f0 = p.disc.spin_frequency
    encoder = p.disc.angle_column in p.flight.channels
    x = p.flight
    late = 0.0 if encoder else abs(start_of(x, instrument))
    if late > LATEST:
        return []
    best, width = f0, SPIN_RANGE * f0
    span = min(x.duration, 0.5 / width * 2)

    def left(rates: Sequence[float], last: int) -> list[float]:
        rows = p.rows(0, last, 600)
        each = explain_all(model, instrument, (p.pick(rows, spin_frequency=f) for f in rates))
        return [x.share for x in each]

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
            lambda f: np.log(left([float(f)], len(x))[0]),
            bounds=(best - step, best + step),
            method="bounded",
            options={"xatol": 1e-9 * f0},
        ).x
    )
    turned = explain(model, instrument, p.pick(p.rows(), spin_frequency=best))
    backwards = explain(model, instrument, p.pick(p.rows(), backwards=True))
    percent, shown = 100 * (best / f0 - 1), _in_digits(best, f0, x.duration)
    return [
        Found(
            f"the spin rate is {shown} Hz, not the model's {f0:.9g} Hz ({percent:+.2g} %)"
            if not encoder
            else f"the spin rate is {shown} Hz, from angle 0 at the first sample; spin_angle says otherwise",
            f'write spin_frequency = "{shown} Hz" in model.toml, or record spin_angle',
            turned,
        ),
        Found(
            "the disc turns the other way",
            "reverse the sign of spin_angle, or turn the axes of the record (y and z reversed)",
            backwards,
            plainness=1,
        ),
    ]


def _phase(model: Model, instrument: Instrument, p: Picker) -> list[Found]:
    rows = p.rows(most=600)

    def left(phases: Array) -> list[float]:
        each = explain_all(model, instrument, (p.pick(rows, phase=float(x)) for x in phases))
        return [x.share for x in each]

    best = _refined(left, np.deg2rad(np.arange(0.0, 360.0, 10.0)), np.deg2rad(10.0))
    best = float((best + np.pi) % (2 * np.pi) - np.pi)
    if abs(best) < LEAST_PHASE:
        return []
    final = explain(model, instrument, p.pick(p.rows(), phase=best))
    taken = float(disc_angle(np.zeros(1), p.disc.spin_frequency, start_of(p.flight, instrument))[0])

    def at_first(angle: float) -> float:
        return float(np.rad2deg((angle + np.pi) % (2 * np.pi) - np.pi))

    return [
        Found(
            f"the disc stood at {at_first(taken + best):.4g} degrees at the first sample, not at {at_first(taken):.4g}"
            " (a file cut out of a longer one?)",
            "record spin_angle, or let time count from an instant of angle 0",
            final,
        )
    ]


def _refined(left: Callable[[Array], list[float]], grid: Array, step: float) -> float:
    best = float(grid[int(np.argmin(left(grid)))])
    for _ in range(4):
        step /= 4
        near = np.asarray(best + step * np.arange(-3, 4), dtype=np.float64)  # the fourth either way is known
        best = float(near[int(np.argmin(left(near)))])
    return best


def _shift(model: Model, instrument: Instrument, p: Picker) -> list[Found]:
    """Motion and output apart: candidates from the cross-correlation, judged by what the model explains."""
    found = []
    rows = p.rows(most=400)
    tried: dict[int, tuple[Explained, Explained]] = {}
    waiting = [k for k in _lags(instrument, p) if k != 0]
    while waiting:
        moved = explain_all(model, instrument, (p.pick(rows, shift=k) for k in waiting))
        other = explain_all(model, instrument, (p.pick(rows, output_shift=-k) for k in waiting))
        tried |= dict(zip(waiting, zip(moved, other, strict=True), strict=True))
        best = [min(tried, key=lambda k: tried[k][way].share) for way in (0, 1)]
        near = {k + d or d for k in best for d in (-1, 1)}  # beyond 0, which is the record as it stands
        waiting = sorted(near - set(tried))
    if not tried:
        return []
    for way, k in enumerate(best):
        seconds = abs(k) / p.flight.rate
        apart = f"{seconds:.6g} s ({abs(k)} sample{'s' * (abs(k) > 1)})"
        if way == 0:
            what = f"the motion record is {apart} {'late' if k > 0 else 'early'} against the output"
            remedy = f"shift the motion columns by {seconds:.6g} s"
            left = explain(model, instrument, p.pick(p.rows(), shift=k))
        else:
            what = f"the output is {apart} {'early' if k > 0 else 'late'} against motion and disc angle"
            remedy = f"shift the output column by {seconds:.6g} s"
            left = explain(model, instrument, p.pick(p.rows(), output_shift=-k))
        found.append(Found(what, remedy, left, True))
    return found


def _lags(instrument: Instrument, p: Picker) -> Sequence[int]:
    """Samples by which the motion may be late: where the demodulated output resembles a_x + i a_y most."""
    x = p.flight
    f = abs(p.disc.spin_frequency)
    if p.recorded.demodulated or not demodulable(x.rate) or (f > 0 and x.duration < 3 / f):
        return ()
    n = min(len(x), LONGEST)
    whole = p.pick(np.arange(n))
    data = whole.data if len(whole.data) == 1 else (whole.data[0] - whole.data[1])[None]
    usable = p.usable[:n]
    carried = np.where(usable, data[0], 0.0) * np.exp(1j * whole.phi)
    taps = low_pass(x.rate)
    narrow = fft.next_fast_len(n + len(taps))
    response = fft.fft(taps, narrow)
    size = fft.next_fast_len(2 * n)

    def prepared(z: NDArray[np.complex128]) -> NDArray[np.complex128]:
        low = fft.ifft(fft.fft(z, narrow) * response)[len(taps) // 2 :][:n]
        low = np.diff(low)  # slow drifts resemble each other at any lag
        return np.asarray(fft.fft(low - np.mean(low), size))

    motion = prepared(np.asarray(whole.channels["a_x"] + 1j * whole.channels["a_y"]))
    output = prepared(np.asarray(carried))
    reach = min(n // 4, int(FARTHEST * x.rate))
    found: list[int] = []
    for spectrum in (motion, None):
        other = motion if spectrum is not None else np.conj(np.roll(motion[::-1], 1))
        like = np.abs(fft.ifft(other * np.conj(output)))
        like = np.concatenate([like[-reach:], like[: reach + 1]])
        top = int(np.argmax(like)) - reach
        found += [k for k in range(top - 2, top + 3) if k not in found]
    return found
