from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from derive.effect import Effect, shared
from derive.effects import saturation

Array = NDArray[np.float64]

CHANNELS = ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z")
"""Columns that it is looked for in."""

LATTICE = 5
"""So many times as often as the next smaller value occurs the extreme one, or the channel is but coarsely quantised."""

STEPS = 100
"""So many steps of the resolution an end of a range is away from zero: converters have 8 bits and more."""


def present(values: Array, valid: NDArray[np.bool_], noise: float) -> bool:
    """Of a channel of the motion, (N,); the noise of the output does not matter."""
    return bool(np.any(clipped(values, valid)))


def clipped(values: Array, valid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(N,): the samples at the end of the sensor's range, if it was reached."""
    usable = valid & np.isfinite(values)
    at_end = saturation.clipped(values, usable)
    below = usable & ~at_end
    top = saturation.largest(values, below)
    edge = sum(np.count_nonzero(size >= top * (1 - 1e-12)) for _, size in saturation.sizes(values, below))
    if top == 0.0 or np.count_nonzero(at_end) < LATTICE * edge:
        at_end[:] = False
    elif np.any(at_end) and np.min(np.diff(np.unique(values[usable])), initial=top) > top / STEPS:
        at_end[:] = False  # few steps, so that a slow motion dwells at the largest
    return at_end


EFFECT = Effect(
    id="imu-saturation",
    title="Saturation of the motion sensors",
    physics=(
        "Accelerometers and gyroscopes of the motion sensor have a range; in gusts the recorded value stays at its end while the "
        "platform moves on."
    ),
    source="range of the motion sensor's converters",
    equation=r"\bm a_{rec} = \min(\max(\bm a, -a_{max}), a_{max}),\; \bm\omega_{rec} \text{ likewise}",
    limits=(
        "Symmetric, axis by axis, before any filter: what has been smoothed after it clipped shows no edge. Samples at the "
        "end of the range are not used."
    ),
    kind="output",
    parameters=(
        shared("a_max", "a_{max}", "g", "largest recorded force", 2.0, neutral=float("inf"), fitted=False),
        shared(
            "omega_max",
            r"\omega_{max}",
            "deg/s",
            "largest recorded rate",
            100.0,
            neutral=float("inf"),
            fitted=False,
        ),
    ),
)
