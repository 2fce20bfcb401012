"""Examine a flight before it is held against a model: refuse, mend, or remark."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import one_thread
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.io.angular_acceleration import planned
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, SPECIFIC_FORCE
from ragg_runtime.io.sampling import JITTER_NOTED
from ragg_runtime.model.evaluate import scale_factor
from ragg_runtime.model.evaluator import Evaluator
from ragg_runtime.model.model import MANY, Model
from ragg_runtime.model.record import start_of
from ragg_runtime.model.recorded import recorded
from ragg_runtime.screening import checks
from ragg_runtime.screening.filled_in import without_filling
from ragg_runtime.screening.identify import LikelyMistake, derived_rates, likely_mistake
from ragg_runtime.screening.quick_fit import explain
from ragg_runtime.screening.resolution import resolution_of
from ragg_runtime.screening.spikes import glitches, note_of, parts, spikes
from ragg_runtime.screening.subsample import CHUNK, Picker, picker

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

SENSELESS = 20.0
"""Factor by which the residual falls once a mistake is undone, from which going on is senseless."""

HALVED = 2.0
"""Factor from which what the model leaves is told as smaller; below, the parameters' nearness to the sheet spoke for the mistake."""


@one_thread
def examined(model: Model, instrument: Instrument, flight: Flight) -> Flight:
    """The flight with its spikes marked as missing, and with what was done or looks odd in its notes.

    Raises
    ------
    UserError
        If the flight cannot be held against the model: it is too short, too slow, lacks a channel, or holds
        a mistake of units, signs, axes, order or spin rate, which the message names.
    """
    flight, notes = without_filling(dataclasses.replace(flight, resolution=resolution_of(flight)))
    checks.require(model, instrument, flight)
    flight = _without_motion_spikes(flight)
    notes += checks.remarks(instrument, flight)
    notes += _angle_notes(instrument, flight)
    places = [k for k in range(len(instrument.layout.outputs)) if recorded(flight, instrument.layout, k)]
    p = picker(flight, instrument, tuple(model.chain.INPUTS), places[0])
    if not p.usable.any():
        return dataclasses.replace(flight, notes=(*flight.notes, *notes))
    clock = steadied(model, instrument, p)
    if clock is not None:
        flight, note = clock
        notes.append(note)
        p = picker(flight, instrument, tuple(model.chain.INPUTS), places[0])
    notes += _saturated(p)
    found = likely_mistake(model, instrument, p)
    if found is not None:
        asked = found.origin and instrument.angle_origin is None  # nobody has answered yet
        if asked or (found.factor > SENSELESS and not (found.timing or found.origin)):
            raise _refused(flight, found, notes)
        notes.append(_remark(found))
    valid, said = _output_spikes(model, instrument, p)
    for place in places[1:]:
        further = picker(flight, instrument, tuple(model.chain.INPUTS), place)
        notes += _saturated(further)
        mask, more = _output_spikes(model, instrument, further)
        valid, said = valid & mask, [*said, *more]
    return dataclasses.replace(flight, valid=valid, notes=(*flight.notes, *notes, *said))


def _refused(flight: Flight, found: LikelyMistake, notes: list[str]) -> UserError:
    also = f" (or: {'; or: '.join(found.others)})" if found.others else ""
    odd = f"; {'; '.join(notes)}" if notes else ""
    return UserError(
        f"the record does not fit the instrument; the likely mistake: {found.what}{also}",
        where=flight.path or flight.name,
        found=f"{_left(found.before.share)}, {found.factor:.3g} times more than with the mistake undone{odd}",
        expected="units, signs, axes and spin rate as the header and model.toml say",
        remedy=found.remedy,
    )


def _left(share: float) -> str:
    if share < 1:
        return f"the model leaves {100 * share:.2g} % of the output unexplained"
    return f"the model misses the output by {share:.2g} times its size"


def _angle_notes(instrument: Instrument, flight: Flight) -> list[str]:
    """From where the angle of a disc without an encoder counts, where that is not the first sample of a file that begins at 0."""
    turning = [d for d in instrument.layout.discs if d.spin_frequency != 0.0]
    if all(d.angle_column in flight.channels for d in turning):
        return []
    first, start = float(flight.time[0]), start_of(flight, instrument)
    if instrument.angle_origin is None and flight.instants:
        return [
            "the stamps are instants: the disc angle counts from the first sample (a column spin_angle, or angle_origin"
            " under [model] of model.toml, says otherwise)"
        ]
    if start != 0.0:
        side = "before" if start > 0 else "after"
        return [f"the disc angle counts from t = 0, {abs(start):.6g} s {side} the first sample"]
    return [] if first == 0.0 else [f"the disc angle counts from the first sample (t = {first:.6g} s)"]


def _remark(found: LikelyMistake) -> str:
    also = f" (or: {'; or: '.join(found.others)})" if found.others else ""
    gain = (
        f"undone, the model leaves {found.factor:.3g} times less of the output"
        if found.factor > HALVED
        else "undone, the parameters stay closer to the test sheet"
    )
    return f"likely mistake: {found.what}{also}; {gain}; {found.remedy}"


def _saturated(p: Picker) -> list[str]:
    if p.output.name not in p.flight.outputs:
        return []
    G = p.flight.outputs[p.output.name]
    clipped = np.count_nonzero(p.flight.valid & np.isfinite(G) & ~p.usable)
    if not clipped or p.recorded.separate:
        return []
    top = float(np.max(np.abs(G[p.flight.valid & np.isfinite(G)])))
    return [
        f"{p.output.name}: {clipped} samples stand at the extreme value of {top:.6g} V: saturated, not used"
    ]


def _without_motion_spikes(flight: Flight) -> Flight:
    """Spikes of the motion record interpolated, and their samples marked as missing."""
    channels, valid = dict(flight.channels), flight.valid.copy()
    notes: dict[str, str] = {}

    names = [n for n in (*SPECIFIC_FORCE, *ANGULAR_RATE, *ANGULAR_ACCELERATION) if n in channels]
    for name in names:
        mask, x = glitches(flight.channels[name], flight.valid)
        if not mask.any():
            continue
        channels[name] = x
        valid &= ~mask
        notes[name] = note_of(name, mask, flight.time, "not used")
    if not notes:
        return flight
    rates = [n for n in notes if n in ANGULAR_RATE]
    if rates and derived_rates(flight):
        derivative = planned([channels[n] for n in ANGULAR_RATE], flight.rate)
        for rate in rates:
            change = ANGULAR_ACCELERATION[ANGULAR_RATE.index(rate)]
            channels[change] = derivative.of(channels[rate], flight.rate)[0]
        notes = {n: text for n, text in notes.items() if n not in ANGULAR_ACCELERATION}
    return dataclasses.replace(flight, channels=channels, valid=valid, notes=(*flight.notes, *notes.values()))


def _output_spikes(model: Model, instrument: Instrument, p: Picker) -> tuple[Mask, list[str]]:
    """Valid samples without the output's spikes, found in what the fitted model leaves."""
    valid = p.flight.valid.copy()
    if p.recorded.demodulated:
        return valid, []  # a demodulator has smeared them
    fitted = explain(model, instrument, p.pick(p.rows())).p
    needed = {*model.chain.INPUTS, p.disc.angle_column}
    channels = {c: x for c, x in p.flight.channels.items() if c in needed}
    q = dataclasses.replace(p, flight=dataclasses.replace(p.flight, channels=channels))
    evaluator = model.compiled("auto" if len(p.flight) >= MANY else "numpy")
    found = np.zeros((len(p.columns), len(p.flight)), dtype=np.bool_)
    for rows, inner in parts(len(p.flight)):
        for mask, e in zip(found, _left_over(model, evaluator, q, fitted, rows), strict=True):
            mask[rows][inner] = spikes(e, p.usable[rows], len(e))[inner]
    notes = []
    for name, mask in zip(p.columns, found, strict=True):
        if mask.any():
            valid &= ~mask
            notes.append(note_of(name, mask, p.flight.time, "not used"))
    return valid, notes


def _left_over(model: Model, evaluator: Evaluator, p: Picker, fitted: Array, rows: slice) -> Array:
    """(columns, n) Eo: what a model with these parameters leaves of some neighbouring samples of the output."""
    left = np.empty((len(p.columns), rows.stop - rows.start))
    for start in range(rows.start, rows.stop, CHUNK):
        stop = min(rows.stop, start + CHUNK)
        some = p.pick(np.arange(start, stop))
        x = some.inputs(model.chain)
        if p.recorded.separate:
            says = evaluator.voltages(some.time, x, fitted, some.phi, p.output.members)
        else:
            says = evaluator.output(some.time, x, fitted, some.phi, which=p.place)[None]
        np.subtract(some.data, says, out=left[:, start - rows.start : stop - rows.start])
    left /= scale_factor(model, fitted, p.place)
    return left


BETTER = 1.1
"""Factor by which the model's residual must fall for jittering instants to be taken otherwise than they stand."""

LEAST = 64
"""Samples of a record from which its clock is looked at: with fewer the model fits any."""


def steadied(model: Model, instrument: Instrument, p: Picker) -> tuple[Flight, str] | None:
    """The flight with the clock that explains it best, and a note; ``None`` if its instants are right.

    Its own instants, or a steady clock through them.
    """
    x = p.flight
    if p.recorded.demodulated or len(x) < LEAST:
        return None
    first, step = p.even
    worst = 0.0
    for a in range(0, len(x), CHUNK):
        k = np.flatnonzero(x.valid[a : a + CHUNK]) + a
        worst = max(worst, float(np.max(np.abs(x.time[k] - (first + step * k)), initial=0.0)) / step)
    if worst <= JITTER_NOTED:
        return None
    rows = p.rows()
    own = explain(model, instrument, p.pick(rows)).rms
    left = explain(model, instrument, p.pick(rows, even=True)).rms
    if left * BETTER > own:
        return None
    note = (
        f"the instants in the file scatter by up to {worst:.2g} of a step, but the output was sampled"
        f" evenly: the times are replaced by even ones ({own / left:.3g} times less is left unexplained)"
    )
    even = np.asarray(first + step * np.arange(len(x)), dtype=np.float64)
    began = (
        (x.began or 0.0) + first - float(x.time[0])
    )  # a first sample that came late does not delay the disc
    channels = {**x.channels, **_rederived(x, step)}
    return dataclasses.replace(x, time=even, began=began, channels=channels), note


def _rederived(x: Flight, step: float) -> dict[str, NDArray[np.float64]]:
    """The angular acceleration on the even grid, if it was derived from the rate."""
    if not x.written or ANGULAR_ACCELERATION[0] in x.written:
        return {}
    pairs = zip(ANGULAR_RATE, ANGULAR_ACCELERATION, strict=True)
    found = planned([x.channels[n] for n in ANGULAR_RATE], 1 / step)
    return {change: found.of(x.channels[rate], 1 / step)[0] for rate, change in pairs}
