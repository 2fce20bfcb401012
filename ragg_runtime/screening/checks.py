"""Checks of a record without a model: too short, too slow, constant, or columns that contradict each other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, count
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import Disc
from ragg_runtime.io import Flight
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, DEMODULATED, SPECIFIC_FORCE, Flag
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import find_start, list_recorded_channels
from ragg_runtime.signals.derivative import differentiate

Array = NDArray[np.float64]

UNLIKE = 0.44
"""Share of an angular acceleration that the derivatives of the rates may leave for it to be compared with them (a correlation of
0.9)."""

SAME_SIZE = 2.0
"""Factor within which an angular acceleration has the size of its rate's derivative: smoothing and noise stay below it."""

NEAR = 1.25
"""Factor within which a ratio of the two is one that a mistake of units makes."""

FEWEST = 64
"""Samples from which two series can be compared."""

LEAP, SIDE, SMOOTH = 0.8, 4, 0.05
"""Share of its range by which a column leaps where its numbers overflow; samples on either side in which it moves on by more than two
usual steps (a platform that is set from one attitude to another rests there); share of the range of a usual step, at most."""

SAME_SPIN = 2e-3
"""Relative distance of the encoder's rate from the model's spin rate that a disc's own slowness may have."""

IN_DEGREES = 1e-2
"""The same, of a rate that degrees taken for radians would make."""

CLEAR = 0.25
"""Part of a step by which an encoder may be off whole numbers of them where it counts rows that were lost."""

AT_REST = "the motion does not change: a record at rest determines little of an instrument, and does not suffice to find an effect"
"""What is said of a record in which nothing moves."""

_DEGREE = np.pi / 180
_FACTORS = (
    (3600.0, "deg/h for deg/s"),
    (1 / 3600.0, "deg/s for deg/h"),
    (1 / _DEGREE, "degrees for radians"),
    (_DEGREE, "radians for degrees"),
    (3600.0 / _DEGREE, "deg/h for rad/s"),
    (_DEGREE / 3600.0, "rad/s for deg/h"),
)


def require_comparable(model: Model, instrument: Instrument, flight: Flight) -> None:
    """UserError if the flight cannot be compared with this model at all."""
    where = flight.path or flight.name
    for e in model.effects:
        missing = e.missing(list_recorded_channels(flight, instrument.layout))
        if missing:
            raise UserError(
                f"the effect {e.id} of the model needs a channel that the flight lacks",
                where=where,
                found=f"no {', '.join(missing)}",
                expected="a column of that name with its unit",
                remedy=f"record it, or take the effect out: ragg remove MODEL_DIR {e.id}",
            )
    f = max(abs(d.spin_frequency) for d in instrument.layout.discs)
    if 0 < flight.duration * f < 1:
        raise UserError(
            "the flight is shorter than one revolution of the disc",
            where=where,
            found=f"{len(flight)} samples in {flight.duration:.6g} s",
            expected=f"more than {1 / f:.6g} s (spin_frequency {f:.6g} Hz), usually half an hour",
            remedy="give a longer record; check the unit of time (s, ms, min) and spin_frequency",
        )
    _require_rate("flight", where, flight.rate, f"{flight.rate:.6g} Hz", f)
    for name in [n for n in flight.outputs if n in instrument.layout.columns]:
        usable = np.flatnonzero(flight.valid & np.isfinite(flight.outputs[name]))
        place = at(where, f"column {name!r}")
        if name not in DEMODULATED and len(usable) > 1:  # perhaps recorded more seldom than the motion
            rate = flight.rate / float(np.median(np.diff(usable)))
            _require_rate("output", place, rate, f"{rate:.6g} Hz, beside motion at {flight.rate:.6g} Hz", f)
        still = _find_one_value(flight.outputs[name][usable])
        if still is not None:
            raise UserError(
                "the output does not change",
                where=place,
                found=f"{still:.6g} V in all {len(usable)} samples",
                expected="the voltage of a turning disc",
                remedy="a stuck or disconnected recorder? check the column",
            )


def _require_rate(what: str, where: Path | str, rate: float, found: str, f: float) -> None:
    """UserError if a flight or its output has too few samples, Hz, for a disc at ``f``, Hz."""
    if f > 0.0 and rate <= 4 * f:
        further = "; check the unit of time (s, ms, min) and spin_frequency"
        if what == "output":
            further = ", or demodulated (inline and cross) before it is thinned out"
        raise UserError(
            f"the {what} is sampled too slowly for the disc",
            where=where,
            found=found,
            expected=f"more than {4 * f:.6g} Hz: the gradient appears at twice the spin rate of {f:.6g} Hz",
            remedy=f"record it at its full rate{further}",
        )


def list_remarks(instrument: Instrument, flight: Flight) -> list[Flag]:
    """Columns that are constant or contradict each other, with the likely mistake."""
    encoders = (x for d in instrument.layout.discs for x in _encoder(d, flight))
    noted = (*_rates(flight), *encoders, *_angle_origin(instrument, flight))
    return [*_still(flight), *_overflown(flight), *(Flag((), text) for text in noted)]


def _still(flight: Flight) -> list[Flag]:
    """Motion columns that hold one value throughout: nothing is claimed of an output whose motion is not known."""
    names = [n for n in (*SPECIFIC_FORCE, *ANGULAR_RATE) if n in flight.channels]
    still = [n for n in names if _find_one_value(flight.channels[n][flight.valid]) is not None]
    if not still:
        return []
    text = AT_REST
    if len(still) < len(names):
        text = f"{', '.join(still)} {'does' if len(still) == 1 else 'do'} not change at all: a stuck sensor?"
    return [Flag(tuple(still), text, open=True, kind="still")]


def _overflown(flight: Flight) -> list[Flag]:
    """Columns that leap from one end of their range to the other and move on there, as whole numbers do that overflow."""
    found, columns = [], {**flight.channels, **flight.outputs}
    for name in (n for n in (*SPECIFIC_FORCE, *ANGULAR_RATE, *flight.outputs) if n in columns):
        x, valid = columns[name], flight.valid
        pairs = valid[1:] & valid[:-1]  # over a gap it moves on unseen
        steps = np.where(pairs, np.diff(x), 0.0)
        usual, span = (
            (float(np.median(np.abs(steps[pairs]))), float(np.ptp(x[valid]))) if pairs.any() else (0.0, 0.0)
        )
        leaps = np.flatnonzero(np.abs(steps) > LEAP * span)
        leaps = leaps[(leaps >= SIDE) & (leaps < len(steps) - SIDE)]
        if not len(leaps) or usual > SMOOTH * span:
            continue
        on = -np.sign(steps[leaps])  # the way in which it moves, before and after
        moves = np.r_[on * (x[leaps] - x[leaps - SIDE]), on * (x[leaps + 1 + SIDE] - x[leaps + 1])]
        moves = moves[moves < LEAP * span]  # not over another leap
        if len(moves) and np.median(moves) > 2 * usual and np.min(moves) > -2 * usual:
            text = (
                f"{name} leaps from one end of its range to the other and moves on there, {count(len(leaps), 'time')}, first"
                f" at t = {flight.time[leaps[0] + 1]:.6g} s: did the numbers of a converter overflow?"
            )
            found.append(Flag((name,), text, open=True))
    return found


def _find_one_value(x: Array) -> float | None:
    """The one value that a column holds; ``None`` if it changes, or holds none."""
    return float(x[0]) if len(x) and not np.any(x != x[0]) else None


def _angle_origin(instrument: Instrument, flight: Flight) -> list[str]:
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


def _rates(flight: Flight) -> list[str]:
    """The recorded angular acceleration against the derivative of the recorded rate."""
    valid = flight.valid
    if not all(n in flight.channels for n in ANGULAR_ACCELERATION):
        return []
    G = np.array([flight.channels[n] for n in ANGULAR_ACCELERATION])
    W = np.array([differentiate(flight.channels[n], flight.rate, valid) for n in ANGULAR_RATE])
    there = valid & np.isfinite(G).all(axis=0) & np.isfinite(W).all(axis=0)
    if np.sum(there) < FEWEST:
        return []
    G, W = (x[:, there] - np.mean(x[:, there], axis=1, keepdims=True) for x in (G, W))
    B = np.linalg.lstsq(W.T, G.T, rcond=None)[0].T
    found = []
    for k, (rate, change) in enumerate(zip(ANGULAR_RATE, ANGULAR_ACCELERATION, strict=True)):
        best = int(np.argmax(np.abs(B[k]) * np.std(W, axis=1)))
        factor = float(B[k, best])
        if np.std(G[k] - B[k] @ W) > UNLIKE * np.std(G[k]) or factor == 0.0:
            continue
        if best != k:
            found.append(
                f"{change} is the derivative of {ANGULAR_RATE[best]}, not of {rate}: axes exchanged?"
            )
        elif 1 / SAME_SIZE < -factor < SAME_SIZE:
            found.append(f"{change} is minus the derivative of {rate}: the sign of one of them is reversed")
        elif not 1 / SAME_SIZE < factor < SAME_SIZE:
            near = [text for x, text in _FACTORS if 1 / NEAR < factor / x < NEAR]
            meant = f": {near[0]}?" if near else ": check the units of both"
            found.append(f"{change} is {factor:.4g} times the derivative of {rate}{meant}")
    return found


def _find_lost_rows(column: str, angle: Array, time: Array) -> list[str]:
    """Missing rows where the stamps go on evenly, as those made of row numbers do: the disc turned on meanwhile."""
    turned, passed = np.diff(angle), np.diff(time)
    pace = float(np.median(turned / passed))
    step = float(np.median(passed))
    lost = np.rint((turned / pace - passed) / step)
    clear = np.abs(turned / pace - passed - lost * step) < CLEAR * step
    rows, places = int(np.sum(lost)), int(np.sum(lost > 0))
    if not places or not clear.all() or np.any(lost < 0):
        return []
    one = f"{count(rows, 'row')} {'are' if rows > 1 else 'is'} missing"
    at = f"at t = {time[np.flatnonzero(lost)[0]]:.5g} s" + f" and {places - 1} other places" * (places > 1)
    return [f"{one} by {column}, {at}: are the stamps made of row numbers?"]


def _encoder(disc: Disc, flight: Flight) -> list[str]:
    """The encoder's rate against the model's spin rate."""
    column, f = disc.angle_column, disc.spin_frequency
    if column not in flight.channels or f == 0.0:
        return []
    angle, time = np.unwrap(flight.channels[column]), flight.time
    rate = float(np.median(np.diff(angle) / np.diff(time))) / (2 * np.pi)
    if abs(rate - f) < SAME_SPIN * abs(f):
        return _find_lost_rows(column, angle[flight.valid], time[flight.valid])
    if abs(rate + f) < SAME_SPIN * abs(f):
        return [f"{column} runs backwards, at {rate:.6g} Hz: the sign of the encoder is reversed?"]
    nyquist = flight.rate / 2
    if any(
        abs((x - rate + nyquist) % (2 * nyquist) - nyquist) < IN_DEGREES * abs(f)
        for x in (f / _DEGREE, f * _DEGREE)
    ):
        return [f"{column} turns at {rate:.6g} Hz, the model's disc at {f:.6g} Hz: degrees for radians?"]
    percent = 100 * (rate / f - 1)
    return [
        f"{column} turns at {rate:.6g} Hz, {percent:+.2g} % off the model's spin_frequency of {f:.6g} Hz:"
        " the angle is used; is spin_frequency right?"
    ]
