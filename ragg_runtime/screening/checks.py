"""Checks of a record without a model: too short, too slow, constant, or columns that contradict each other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, at, count
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import Disc
from ragg_runtime.io import Flight
from ragg_runtime.io.assemble import FEWEST_LEVELS
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

FEWEST = 64
"""Samples from which two series can be compared."""

LEAP, SIDE, SMOOTH = 0.8, 4, 0.05
"""Share of its range by which a column leaps where its numbers overflow; samples on either side in which it moves on by more than two
usual steps (a platform that is set from one attitude to another rests there); share of the range of a usual step, at most."""

SAME_SPIN = 2e-3
"""Relative distance of the encoder's rate from the model's spin rate that a disc's own slowness may have."""

MOTION = (*SPECIFIC_FORCE, *ANGULAR_RATE)

AT_REST = "the motion does not change: a record at rest determines little of an instrument, and does not suffice to find an effect"
"""What is said of a record in which nothing moves."""


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
    """Columns that are constant or contradict each other, with the likely mistake."""
    encoders = (x for d in instrument.layout.discs for x in _encoder(d, flight))
    noted = (*_rates(flight), *encoders, *_angle_origin(instrument, flight))
    return [*_still(flight), *_coarse(flight), *_overflown(flight), *(Flag((), text) for text in noted)]


def _still(flight: Flight) -> list[Flag]:
    """Motion columns that hold one value throughout: nothing is claimed of an output whose motion is not known."""
    moving = {n: flight.channels[n][flight.valid] for n in MOTION if n in flight.channels}
    still = [n for n, x in moving.items() if _find_one_value(x) is not None]
    text = f"{', '.join(still)} {'does' if len(still) == 1 else 'do'} not change at all: a stuck sensor?"
    text = AT_REST if len(still) == len(moving) else text
    return [Flag(tuple(still), text, open=True, kind="still")] if still else []


def _coarse(flight: Flight) -> list[Flag]:
    """Thermometers that read two or three values: what follows them is hardly told from what is slow by itself."""
    warm = {n: np.unique(x[flight.valid]) for n, x in flight.channels.items() if flight.units.get(n) == "K"}
    words = "is recorded in so few values that an effect of it may look like a drift, a step or an error of the spin rate"
    return [Flag((n,), f"{n} {words}", kind="coarse") for n, x in warm.items() if 1 < len(x) < FEWEST_LEVELS]


def _overflown(flight: Flight) -> list[Flag]:
    """Columns that leap from one end of their range to the other and move on there, as whole numbers do that overflow."""
    found, columns = [], {**flight.channels, **flight.outputs}
    pairs = flight.valid[1:] & flight.valid[:-1]  # over a gap it moves on unseen
    for name in (n for n in (*MOTION, *flight.outputs) if n in columns and pairs.any()):
        x = columns[name]
        steps = np.where(pairs, np.diff(x), 0.0)
        usual, span = float(np.median(np.abs(steps[pairs]))), float(np.ptp(x[flight.valid]))
        leaps = np.flatnonzero(np.abs(steps) > LEAP * span)
        leaps = leaps[(leaps >= SIDE) & (leaps < len(steps) - SIDE)]
        on = -np.sign(steps[leaps])  # the way in which it moves, before and after
        moves = np.r_[on * (x[leaps] - x[leaps - SIDE]), on * (x[leaps + 1 + SIDE] - x[leaps + 1])]
        moves = moves[moves < LEAP * span]  # not over another leap
        if usual > SMOOTH * span or not len(moves):
            continue
        if np.median(moves) > 2 * usual and np.min(moves) > -2 * usual:
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
    if not all(n in flight.channels for n in ANGULAR_ACCELERATION):
        return []
    G = np.array([flight.channels[n] for n in ANGULAR_ACCELERATION])
    W = np.array([differentiate(flight.channels[n], flight.rate, flight.valid) for n in ANGULAR_RATE])
    there = flight.valid & np.isfinite([*G, *W]).all(axis=0)
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
        if best != k or not 1 / SAME_SIZE < factor < SAME_SIZE:
            own = f", not that of {rate}" if best != k else ""
            found.append(
                f"{change} is {factor:.3g} times the derivative of {ANGULAR_RATE[best]}{own}: check axes, signs and units of both"
            )
    return found


def _encoder(disc: Disc, flight: Flight) -> list[str]:
    """The encoder's rate against the model's spin rate."""
    column, f = disc.angle_column, disc.spin_frequency
    if column not in flight.channels or f == 0.0:
        return []
    turned = np.diff(np.unwrap(flight.channels[column]))
    rate = float(np.median(turned / np.diff(flight.time))) / (2 * np.pi)
    if abs(rate - f) < SAME_SPIN * abs(f):
        return []
    return [
        f"{column} turns at {rate:.6g} Hz, the model's disc at {f:.6g} Hz: the angle is used; check its sign, its unit (degrees for"
        " radians?) and spin_frequency"
    ]
