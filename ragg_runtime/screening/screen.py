"""A flight before it is compared with a model: refuse what cannot be, leave out what is no measurement, flag what is odd."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.progress import one_thread, split_range
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.io.assemble import derive_acceleration
from ragg_runtime.io.record import Flag
from ragg_runtime.io.sampling import JITTER_NOTED, ClockStep, find_clock_steps, fit_even_clock
from ragg_runtime.model.model import Model, scale_factor
from ragg_runtime.model.record import EVEN, find_recorded
from ragg_runtime.screening import checks
from ragg_runtime.screening.linear_fit import INDEPENDENT, find_inliers, fit_rows
from ragg_runtime.screening.mistakes import Finding, find_mistake
from ragg_runtime.screening.motion_noise import smooth_noisy_motion
from ragg_runtime.screening.repeated import leave_out_repeated
from ragg_runtime.screening.sampler import Sampler, make_sampler
from ragg_runtime.screening.spikes import describe_spikes, find_spikes, leave_out_glitches

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

SENSELESS = 20.0
"""Factor by which the residual falls once a mistake is undone, from which going on is senseless."""

HALVED = 2.0
"""Factor from which what the model leaves is told as smaller; below, the parameters' nearness to the sheet spoke for the mistake."""

CLOCK = INDEPENDENT * float(np.log(1.3))
"""Gain in log evidence from which a clock was set and sampling did not pause (docs/contributors/decisions.md)."""

LEAST = 64
"""Samples of a record from which its clock is looked at: with fewer the model fits any."""

CHUNK = 1 << 16
"""Rows of a whole flight that are looked at at a time."""


@one_thread
def screen(model: Model, instrument: Instrument, flight: Flight) -> Flight:
    """The flight with what is no measurement left out, the noise of its motion, and flags of what is odd.

    Parameters
    ----------
    model, instrument
        What it will be compared with.
    flight
        As it was read.

    Raises
    ------
    UserError
        If the flight cannot be compared with the model: it is too short, too slow, has no such channel, or holds
        a mistake of units, signs, axes, order or clock, which the message names.
    """
    flight = leave_out_repeated(flight)
    checks.require_comparable(model, instrument, flight)
    flight = leave_out_glitches(flight).flagged(checks.list_remarks(instrument, flight))
    layout = instrument.layout
    places = [k for k in range(len(layout.outputs)) if find_recorded(flight, layout, k)]
    s = make_sampler(model, instrument, flight, places[0])
    if not s.usable.any():
        return flight
    s = s.with_flight(_with_right_clock(s))
    finding = find_mistake(s)
    if finding is not None:
        if _is_senseless(finding, instrument):
            raise _refuse(s.flight, finding)
        s = s.with_flight(s.flight.flagged([_remark(finding)]))
    flight = smooth_noisy_motion(s)
    for place in places:
        flight = _without_output_spikes(make_sampler(model, instrument, flight, place))
    return flight


def _is_senseless(f: Finding, instrument: Instrument) -> bool:
    """Whether going on with a record makes no sense: a mistake explains it, and nothing else does."""
    if f.best.kind == "losses" or (f.best.kind == "origin" and instrument.angle_origin is None):
        return True  # its times are wrong throughout; nobody has answered yet
    if f.best.kind in ("sheet", "shift", "origin"):
        return False
    return f.factor > SENSELESS


def _refuse(flight: Flight, f: Finding) -> UserError:
    left = f"the model leaves {100 * f.before.share:.3g} % of the output unexplained"
    odd = "".join(f"; {x.reason}" for x in flight.flags)
    return UserError(
        f"the record does not fit the instrument; the likely mistake: {f.what}",
        where=flight.path or flight.name,
        found=f"{left}, {f.factor:.3g} times more than with the mistake undone{odd}",
        expected="units, signs, axes and spin rate as the header and model.toml say",
        remedy=f.best.remedy,
    )


def _remark(f: Finding) -> Flag:
    gain = "the parameters stay closer to the test sheet"
    if f.factor > HALVED:
        gain = f"the unexplained part is {f.factor:.3g} times smaller"
    elif not f.best.calming:
        gain = f"{100 * (f.best.fitted.kept - f.before.kept):.2g} % more of the samples are explained"
    if f.best.kind == "sheet":
        return Flag((), f"{f.best.what}; with a wider sheet {gain}; {f.best.remedy}")
    reason = f"likely mistake: {f.what}; undone, {gain}; {f.best.remedy}"
    return Flag((), reason, open=True, effects=f.best.effects)


# --- the clock -----------------------------------------------------------------------------------------


def _with_right_clock(s: Sampler) -> Flight:
    """The flight by the clock that explains it: its own, or an even one where stamps jitter, or were set on the way."""
    x = s.flight
    if s.recorded.demodulated or len(x) < LEAST:
        return x
    first, step, set_by = fit_even_clock(x.time, x.present)
    instants = first + step * np.arange(len(x)) + set_by
    worst = float(np.max(np.abs(x.time - instants)[x.present])) / step
    steps = find_clock_steps(x.time, x.present)
    if worst <= EVEN and not steps:
        return x
    own = fit_rows(s.take())
    even = s.with_flight(replace(x, time=instants, began=(x.began or 0.0) + float(instants[0] - x.time[0])))
    # times by the count are even: what that is worth where stamps jitter says nothing about a clock
    least = min(own.misfit, fit_rows(even.take()).misfit) if steps and worst > EVEN else own.misfit
    several = [steps, *([c] for c in steps if len(steps) > 1)] if steps else []
    gain, k = max(
        (
            (least - fit_rows(s.with_flight(_by_count(x, some)).take()).misfit, -k)
            for k, some in enumerate(several)
        ),
        default=(0.0, 0),
    )
    if INDEPENDENT * gain > CLOCK:
        where = ", ".join(str(c) for c in several[-k][:3])
        text = (
            f"the time stamps jump {where} (was the clock adjusted?), but sampling continued: times are taken from the sample"
            f" count ({np.exp(gain):.3g} times less remains unexplained)"
        )
        return derive_acceleration(_by_count(x, several[-k])).flagged([Flag(("time",), text)])
    undecided = "; whether the clock was set instead is hidden by what the model leaves unexplained"
    undecided = undecided if abs(INDEPENDENT * gain) < CLOCK else ""
    pauses = (
        f"the time stamps jump {c}, not a whole number of samples: treated as a pause{undecided}"
        for c in steps
        if c.part and not c.until
    )
    x = x.flagged([Flag(("time",), text) for text in pauses])
    if worst <= EVEN or not _is_even(s, even, own.p):
        return x
    text = (
        f"the time stamps jitter by up to {worst:.2g} of a step, but the output was sampled evenly: they are"
        " replaced by an even grid"
    )
    noted = [Flag(("time",), text)] * (worst > JITTER_NOTED)
    return derive_acceleration(replace(x, time=even.flight.time, began=even.flight.began)).flagged(noted)


def _is_even(s: Sampler, even: Sampler, p: Array) -> bool:
    """Whether the output was sampled evenly, and not at the instants of the stamps.

    What the model with parameters ``p`` predicts at the stamps differs from what it predicts at even instants by the jitter times
    the output's slope. The part of that which is in the output is 1 or 0; it is fitted to second differences, from which slow
    errors of the model are gone.
    """
    by_stamps, by_count = (_residual(t, p) for t in (s, even))
    three = s.usable[2:] & s.usable[1:-1] & s.usable[:-2]
    d, e = (np.diff(y, 2)[:, three] for y in (by_count - by_stamps, by_count))
    kept = find_inliers(np.abs(e))  # spikes say nothing
    return bool(np.sum((d * e)[kept]) < 0.5 * np.sum((d * d)[kept]))


def _by_count(x: Flight, steps: Sequence[ClockStep]) -> Flight:
    """The flight with times by the sample count; rows that are missing where the clock was set are no gap."""
    first, step, _ = fit_even_clock(x.time, x.present)
    kept = np.ones(len(x), dtype=np.bool_)
    for c in steps:
        before = np.flatnonzero(x.present[: c.row])
        kept[before[-1] + 1 : c.row] = False
    x = x.part(kept)
    # a first sample that came late does not delay the disc
    began = (x.began or 0.0) + first - float(x.time[0])
    return replace(x, time=np.asarray(first + step * np.arange(len(x))), began=began)


# --- the output ----------------------------------------------------------------------------------------


def _without_output_spikes(s: Sampler) -> Flight:
    """The flight without the spikes of an output, found in what the fitted model leaves; saturated samples are said."""
    x, name, flags = s.flight, s.output.name, []
    there = x.valid & np.isfinite(x.outputs[s.columns[0]])
    clipped = int(np.count_nonzero(there & ~s.usable))
    if clipped and s.columns == (name,):
        top = float(np.max(np.abs(x.outputs[name][there])))
        text = f"{name}: {clipped} samples are at the extreme value of {top:.6g} V: saturated, not used"
        flags.append(Flag((name,), text))
    valid = np.array(x.valid)
    if not s.recorded.demodulated and s.usable.any():  # a demodulator has smeared them
        for column, left in zip(s.columns, _residual(s, fit_rows(s.take()).p), strict=True):
            found = find_spikes(left, s.usable)
            valid &= ~found
            flags += [Flag((column,), describe_spikes(column, found, x.time))] if found.any() else []
    return replace(x, valid=valid).flagged(flags)


def _residual(s: Sampler, p: Array) -> Array:
    """(columns, N) Eo: what a model with these parameters leaves of the output."""
    size = len(s.flight)
    left = np.empty((len(s.columns), size))
    for part in split_range(size, CHUNK):
        rows = s.take(np.arange(part.start, part.stop))
        at = (rows.time, rows.inputs, p, rows.phi)
        if s.recorded.separate:
            predicted = s.model.chain.voltages(*at, s.output.members)
        else:
            predicted = s.model.chain.output(*at, which=s.place)[None]
        left[:, part] = rows.data - predicted
    return left / scale_factor(s.model, p, s.place)
