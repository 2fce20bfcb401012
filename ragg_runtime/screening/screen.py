"""A flight before it is compared with a model: refuse what cannot be, leave out what is no measurement, flag what is odd."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.base.progress import one_thread, split_range
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.io.assemble import FEWEST_LEVELS, derive_acceleration
from ragg_runtime.io.record import (
    ANGULAR_RATE,
    DEMODULATED,
    SPECIFIC_FORCE,
    Flag,
)
from ragg_runtime.io.sampling import (
    JITTER_NOTED,
    WAS_SET,
    ClockStep,
    find_clock_steps,
    fit_clock_put_right,
    fit_even_clock,
)
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import EVEN, find_recorded, find_start, list_recorded_channels
from ragg_runtime.screening.linear_fit import (
    INDEPENDENT,
    LinearFit,
    Sampler,
    compute_residual,
    find_inliers,
    make_sampler,
)
from ragg_runtime.screening.mistakes import Finding, find_mistake
from ragg_runtime.screening.motion_noise import smooth_noisy_motion
from ragg_runtime.screening.readings import (
    describe_spikes,
    find_spikes,
    leave_out_glitches,
    leave_out_repeated,
)

Array = NDArray[np.float64]

FEWEST = 64  # samples from which a clock is looked at: with fewer the model fits any

# g: no carrier keeps this up for half of a flight. A larger force of a wrong unit goes unnoticed else: an output of differences asks for
# less and less unequal accelerometers (specific force 100 to 1e4 times too large left 10 Eo, every parameter at its sheet)
LARGEST_FORCE = 10.0

MOTION = (*SPECIFIC_FORCE, *ANGULAR_RATE)

# the flag of a record in which nothing moves
AT_REST = "the motion does not change: a record at rest determines little of an instrument, and does not suffice to find an effect"


def require_comparable(model: Model, instrument: Instrument, flight: Flight) -> None:
    """UserError if the flight cannot be compared with this model at all."""
    where = flight.path or flight.name
    for e in model.effects:
        if missing := e.missing(list_recorded_channels(flight, instrument.layout)):
            raise UserError(
                f"the effect {e.id} of the model needs a channel that the flight lacks",
                where=where,
                found=f"no {', '.join(missing)}",
                expected="a column of that name with its unit",
                remedy=f"record it, or take the effect out: ragg remove MODEL_DIR {e.id}",
            )
    _require_force(where, flight, instrument.g0)
    f = max(abs(d.spin_frequency) for d in instrument.layout.discs)
    check = "check the unit of time (s, ms, min) and spin_frequency"
    if 0 < flight.duration * f < 1:
        raise UserError(
            "the flight is shorter than one revolution of the disc",
            where=where,
            found=f"{len(flight)} samples in {flight.duration:.6g} s",
            expected=f"more than {1 / f:.6g} s (spin_frequency {f:.6g} Hz), usually half an hour",
            remedy=f"give a longer record; {check}",
        )
    _require_rate("the flight", where, flight.rate, f, check)
    for name in [n for n in flight.outputs if n in instrument.layout.columns]:
        usable = np.flatnonzero(flight.valid & np.isfinite(flight.outputs[name]))
        place = at(where, f"column {name!r}")
        if name not in DEMODULATED and len(usable) > 1:  # perhaps recorded more seldom than the motion
            rate = flight.rate / float(np.median(np.diff(usable)))
            remedy = "or demodulated (inline and cross) before it is thinned out"
            _require_rate("the output", place, rate, f, remedy)
        still = _find_one_value(flight.outputs[name][usable])
        if still is not None:
            raise UserError(
                "the output does not change",
                where=place,
                found=f"{still:.6g} V in all {len(usable)} samples",
                expected="the voltage of a turning disc",
                remedy="a stuck or disconnected recorder? check the column",
            )


def _require_force(where: Path | str, flight: Flight, g0: float) -> None:
    """UserError if the specific force is larger than any flight's."""
    a = np.stack([flight.channels[n] for n in SPECIFIC_FORCE])[:, flight.valid]
    usual = float(np.median(np.linalg.norm(a, axis=0))) / g0 if a.size else 0.0
    if usual > LARGEST_FORCE:
        raise UserError(
            "the specific force is larger than any flight's",
            where=at(where, "columns a_x, a_y, a_z"),
            found=f"{usual:.3g} g in half of the samples",
            expected=f"at most {LARGEST_FORCE:g} g",
            remedy="check their unit: cm/s^2 (Gal), mg or counts of a converter? The unit of a column can be corrected in a mapping",
        )


def _require_rate(what: str, where: Path | str, rate: float, f: float, remedy: str) -> None:
    """UserError if a flight or its output has too few samples, Hz, for a disc at ``f``, Hz."""
    if f > 0.0 and rate <= 4 * f:
        raise UserError(
            f"{what} is sampled too slowly for the disc",
            where=where,
            found=f"{rate:.6g} Hz",
            expected=f"more than {4 * f:.6g} Hz: the gradient appears at twice the spin rate of {f:.6g} Hz",
            remedy=f"record it at its full rate; {remedy}",
        )


def list_remarks(instrument: Instrument, flight: Flight) -> list[Flag]:
    """Columns that are constant or nearly so, and from where the disc angle counts."""
    notes = _note_angle_origin(instrument, flight)
    return [*_flag_still(flight), *_flag_coarse(flight), *(Flag((), t) for t in notes)]


def _flag_still(flight: Flight) -> list[Flag]:
    """Motion columns that hold one value throughout: nothing is claimed of an output whose motion is not known."""
    moving = {n: flight.channels[n][flight.valid] for n in MOTION if n in flight.channels}
    still = [n for n, x in moving.items() if _find_one_value(x) is not None]
    text = f"{', '.join(still)} {'does' if len(still) == 1 else 'do'} not change at all: a stuck sensor?"
    text = AT_REST if len(still) == len(moving) else text
    return [Flag(tuple(still), text, open=True, kind="still")] if still else []


def _flag_coarse(flight: Flight) -> list[Flag]:
    """Thermometers that read two or three values: what follows them is hardly told from what is slow by itself."""
    warm = {n: np.unique(x[flight.valid]) for n, x in flight.channels.items() if flight.units.get(n) == "K"}
    words = "is recorded in so few values that an effect of it may look like a drift, a step or an error of the spin rate"
    return [Flag((n,), f"{n} {words}", kind="coarse") for n, x in warm.items() if 1 < len(x) < FEWEST_LEVELS]


def _find_one_value(x: Array) -> float | None:
    """The one value that a column holds; ``None`` if it changes, or holds none."""
    return float(x[0]) if len(x) and not np.any(x != x[0]) else None


def _note_angle_origin(instrument: Instrument, flight: Flight) -> list[str]:
    """From where the angle of a disc without an encoder counts, where that is not the first sample of a file that begins at 0."""
    turning = [d for d in instrument.layout.discs if d.spin_frequency != 0.0]
    if all(d.angle_column in flight.channels for d in turning):
        return []
    first, start = float(flight.time[0]), find_start(flight, instrument)
    if instrument.angle_origin is None and flight.instants:
        return [
            "time is given as instants: the disc angle counts from the first sample (a column spin_angle, or angle_origin"
            " under [model] of model.toml, overrides this)"
        ]
    if start != 0.0:
        side = "before" if start > 0 else "after"
        return [f"the disc angle counts from t = 0, {abs(start):.6g} s {side} the first sample"]
    return [] if first == 0.0 else [f"the disc angle counts from the first sample (t = {first:.6g} s)"]


Mask = NDArray[np.bool_]

# factor by which the residual falls once a mistake is undone, from which going on is senseless
SENSELESS = 20.0
# factor from which the residual is reported as smaller; below it the parameters' nearness to the sheet decided for the mistake
HALVED = 2.0
# gain in log evidence from which a clock was set and sampling did not pause (docs/contributors/decisions.md)
CLOCK = INDEPENDENT * float(np.log(1.3))
CHUNK = 1 << 16  # rows of a whole flight that are looked at at a time


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
    require_comparable(model, instrument, flight)
    flight = leave_out_glitches(flight).flagged(list_remarks(instrument, flight))
    layout = instrument.layout
    places = [k for k in range(len(layout.outputs)) if find_recorded(flight, layout, k)]
    s = make_sampler(model, instrument, flight, places[0])
    if not s.usable.any():
        return flight
    s = s.with_flight(_correct_clock(s))
    finding = find_mistake(s)
    if finding is not None:
        if _is_senseless(finding, instrument):
            raise _refuse(s.flight, finding)
        s = s.with_flight(s.flight.flagged([_make_flag(finding)]))
    # noise is measured without spikes, and small ones are seen where it is smoothed
    flight = _leave_out_spikes(s, places)
    smoothed = smooth_noisy_motion(s.with_flight(flight))
    if smoothed is not flight:
        flight = _leave_out_spikes(s.with_flight(smoothed), places)
    return flight.flagged(
        [f for k in places for f in _flag_saturated(make_sampler(model, instrument, flight, k))]
    )


def _is_senseless(f: Finding, instrument: Instrument) -> bool:
    """Whether going on with a record makes no sense: a mistake explains it, and nothing else does."""
    if f.best.kind in ("losses", "part") or (f.best.kind == "origin" and instrument.angle_origin is None):
        return True  # its times are wrong throughout, or it is of two kinds; nobody has answered yet
    if f.best.kind in ("sheet", "shift", "origin"):
        return False
    return f.factor > SENSELESS


def _refuse(flight: Flight, f: Finding) -> UserError:
    unexplained = f"the model leaves {100 * f.before.share:.3g} % of the output unexplained; undone, {_describe_gain(f)}"
    odd = "".join(f"; {x.reason}" for x in flight.flags)
    return UserError(
        f"the record does not fit the instrument; the likely mistake: {f.what}",
        where=flight.path or flight.name,
        found=f"{unexplained}{odd}",
        expected="units, signs, axes and spin rate as the header and model.toml say",
        remedy=f.best.remedy,
    )


def _make_flag(f: Finding) -> Flag:
    if f.best.kind == "sheet":
        return Flag((), f"{f.best.what}; with a wider sheet {_describe_gain(f)}; {f.best.remedy}")
    reason = f"likely mistake: {f.what}; undone, {_describe_gain(f)}; {f.best.remedy}"
    return Flag((), reason, open=True, effects=f.best.effects)


def _describe_gain(f: Finding) -> str:
    """What undoing a mistake brings."""
    if f.factor > HALVED:
        return f"the unexplained part is {f.factor:.3g} times smaller"
    if f.best.calming:
        return "the parameters stay closer to the test sheet"
    return f"{100 * (f.best.fitted.kept - f.before.kept):.2g} % more of the samples are explained"


# --- the clock -----------------------------------------------------------------------------------------


def _correct_clock(s: Sampler) -> Flight:
    """The flight by the clock that explains it: its own, or an even one where stamps jitter, or were set on the way."""
    x = s.flight
    if s.recorded.demodulated or len(x) < FEWEST:
        return x
    first, step, set_by = fit_even_clock(x.time, x.present)
    instants = first + step * np.arange(len(x)) + set_by
    worst = float(np.max(np.abs(x.time - instants)[x.present])) / step
    steps = find_clock_steps(x.time, x.present)
    if worst <= EVEN and not steps:
        return x
    if any(not c.until for c in steps):  # answered below
        x = replace(x, notes=tuple(n for n in x.notes if not n.endswith(WAS_SET)))
    recorded = s.fit()
    even = s.with_flight(replace(x, time=instants, began=(x.began or 0.0) + float(instants[0] - x.time[0])))
    clocks = [(c, _count_times(x, c, first, step)) for c in ([steps, *([c] for c in steps)] if steps else [])]
    if len(steps) > 1:
        clocks.append((steps, _count_times(x, steps, *fit_clock_put_right(x.time, steps))))
    gains = [recorded.misfit - s.with_flight(flight).fit().misfit for _, flight in clocks]
    gain = max(gains, default=0.0)
    if INDEPENDENT * gain > CLOCK:
        jumps, flight = clocks[gains.index(gain)]
        where = ", ".join(str(c) for c in jumps[:3])
        text = (
            f"the time stamps jump {where} (was the clock adjusted?), but sampling continued: times are taken from the sample"
            f" count ({np.exp(gain):.3g} times less remains unexplained)"
        )
        return derive_acceleration(flight).flagged([Flag(("time",), text)])
    undecided = "; whether the clock was set instead is hidden by what the model leaves unexplained"
    undecided = undecided if abs(INDEPENDENT * gain) < CLOCK else ""
    pauses = (
        f"the time stamps jump {c}, not a whole number of samples: treated as a pause{undecided}"
        for c in steps
        if c.part and not c.until
    )
    x = x.flagged([Flag(("time",), text) for text in pauses])
    if worst <= EVEN or not _is_even(s, even, recorded):
        return x
    text = (
        f"the time stamps jitter by up to {worst:.2g} of a step, but the output was sampled evenly: they are"
        " replaced by an even grid"
    )
    flags = [Flag(("time",), text)] * (worst > JITTER_NOTED)
    return derive_acceleration(replace(x, time=even.flight.time, began=even.flight.began)).flagged(flags)


def _is_even(s: Sampler, even: Sampler, fitted: LinearFit) -> bool:
    """Whether the output was sampled evenly, and not at the instants of the stamps.

    What the fitted model predicts at the stamps differs from what it predicts at even instants by the jitter times
    the output's slope. The part of that which is in the output is 1 or 0; it is fitted to second differences, from which slow
    errors of the model are gone.
    """
    by_stamps, by_count = (_compute_residual(t, fitted) for t in (s, even))
    three = s.usable[2:] & s.usable[1:-1] & s.usable[:-2]
    d, e = (np.diff(y, 2)[:, three] for y in (by_count - by_stamps, by_count))
    kept = find_inliers(np.abs(e))  # spikes say nothing
    return bool(np.sum((d * e)[kept]) < 0.5 * np.sum((d * d)[kept]))


def _count_times(x: Flight, steps: Sequence[ClockStep], first: float, step: float) -> Flight:
    """The flight with times by the sample count; rows that are missing where the clock was set are no gap."""
    kept = np.ones(len(x), dtype=np.bool_)
    for c in steps:
        before = np.flatnonzero(x.present[: c.row])
        kept[before[-1] + 1 : c.row] = False
    x = x.part(kept)
    # a first sample that came late does not delay the disc
    began = (x.began or 0.0) + first - float(x.time[0])
    return replace(x, time=np.asarray(first + step * np.arange(len(x))), began=began)


# --- the output ----------------------------------------------------------------------------------------


def _leave_out_spikes(s: Sampler, places: Sequence[int]) -> Flight:
    """The flight without the spikes of its outputs, found in what the fitted model leaves, and those of the motion that made them."""
    x = s.flight
    for place in places:
        s = make_sampler(s.model, s.instrument, x, place)
        if s.recorded.demodulated or not s.usable.any():  # a demodulator has smeared them
            continue
        spikes = [find_spikes(residual, s.usable) for residual in _compute_residual(s, s.fit())]
        x = leave_out_glitches(x, np.any(spikes, axis=0))
        own = {c: k & x.valid for c, k in zip(s.columns, spikes, strict=True) if np.any(k & x.valid)}
        flags = [Flag((c,), describe_spikes(c, k, x.time)) for c, k in own.items()]
        x = replace(x, valid=x.valid & ~np.any(spikes, axis=0)).flagged(flags)
    return x


def _flag_saturated(s: Sampler) -> list[Flag]:
    """A flag of the samples of an output that are at its extreme value."""
    name = s.output.name
    if s.columns != (name,):
        return []
    output = np.where(s.flight.valid, s.flight.outputs[name], np.nan)
    clipped = int(np.sum(np.isfinite(output) & ~s.usable))
    text = f"{name}: {clipped} samples are at the extreme value of {np.nanmax(np.abs(output)):.6g} V: saturated, not used"
    return [Flag((name,), text)] if clipped else []


def _compute_residual(s: Sampler, fitted: LinearFit) -> Array:
    """(columns, N) Eo: what a fitted model leaves of the output."""
    parts = split_range(len(s.flight), CHUNK)
    return np.hstack([compute_residual(s.take(np.arange(k.start, k.stop)), fitted) for k in parts])
