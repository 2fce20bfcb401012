"""Jittering instants: did the sampling jitter, or only the clock that stamped it? The output knows."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.flight import Flight
from ragg_runtime.flight.angular_acceleration import planned
from ragg_runtime.flight.record import ANGULAR_ACCELERATION, ANGULAR_RATE
from ragg_runtime.flight.sampling import JITTER_NOTED
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import disc_angle
from ragg_runtime.plausibility.quick_fit import explain
from ragg_runtime.plausibility.subsample import CHUNK, Picker

BETTER = 1.1
"""Factor by which the model's residual must fall for jittering instants to be taken otherwise than they stand."""

CONVINCING = 5.0
"""The same for the origin of a disc angle where nothing jitters."""

LEAST = 64
"""Samples of a record from which its clock is looked at: with fewer the model fits any."""


def steadied(model: Model, instrument: Instrument, p: Picker) -> tuple[Flight, str] | None:
    """The flight with the clock that explains it best, and a note; ``None`` if its instants are right.

    Its own instants, or a steady clock through them; and, without an encoder, the disc's angle 0 at the first
    instant, at the steady clock's first tick (a first sample that came late does not delay the disc), or at
    t = 0 of the file's time.
    """
    x = p.flight
    if p.recorded.demodulated or len(x) < LEAST:
        return None
    first, step = p.even
    worst = 0.0
    for a in range(0, len(x), CHUNK):
        k = np.flatnonzero(x.valid[a : a + CHUNK]) + a
        worst = max(worst, float(np.max(np.abs(x.time[k] - (first + step * k)), initial=0.0)) / step)
    jitters = worst > JITTER_NOTED
    discs = instrument.layout.discs
    # without an angle to find: recorded, standing still, or those of several discs
    encoder = p.disc.angle_column in x.channels or len(discs) > 1 or p.disc.spin_frequency == 0.0
    start = float(x.time[0])
    if not jitters and (encoder or start == 0.0):
        return None
    rows = p.rows()
    own = explain(model, instrument, p.pick(rows)).rms
    tried: list[tuple[float, bool, float]] = []  # residual, even instants, where the disc's angle is 0
    if jitters:
        tried.append((explain(model, instrument, p.pick(rows, even=True)).rms, True, first))
    f = p.disc.spin_frequency
    for origin in () if encoder else (first, 0.0) if jitters else (0.0,):
        late = float(disc_angle(np.array([start]), f)[0] - disc_angle(np.array([origin]), f)[0])
        tried.append((explain(model, instrument, p.pick(rows, phase=late)).rms, False, origin))
    left, evenly, origin = min(tried)
    if left * (BETTER if jitters else CONVINCING) > own:
        return None
    if evenly:
        note = (
            f"the instants in the file scatter by up to {worst:.2g} of a step, but the output was sampled"
            f" evenly: the times are replaced by even ones ({own / left:.3g} times less is left unexplained)"
        )
        even = np.asarray(first + step * np.arange(len(x)), dtype=np.float64)
        return dataclasses.replace(x, time=even, channels={**x.channels, **_rederived(x, step)}), note
    angle = disc_angle(x.time, f) - disc_angle(np.array([origin]), f)[0]
    note = (
        f"the disc stood at angle 0 at t = {origin:.6g} s, not at the first sample (t = {start:.6g} s):"
        f" its angle is counted from there ({own / left:.3g} times less is left unexplained)"
    )
    return dataclasses.replace(x, channels={**x.channels, "spin_angle": np.unwrap(angle)}), note


def _rederived(x: Flight, step: float) -> dict[str, NDArray[np.float64]]:
    """The angular acceleration on the even grid, if it was derived from the rate."""
    if not x.written or ANGULAR_ACCELERATION[0] in x.written:
        return {}
    pairs = zip(ANGULAR_RATE, ANGULAR_ACCELERATION, strict=True)
    found = planned([x.channels[n] for n in ANGULAR_RATE], 1 / step)
    return {change: found.of(x.channels[rate], 1 / step)[0] for rate, change in pairs}
