"""Saturation of the motion sensors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from derive.effect import Effect, EffectParameter

Array = NDArray[np.float64]

CLIPPED = 5
"""Samples at one and the same extreme value that make a saturated sensor."""

LATTICE = 5
"""So many times as often as the next smaller value occurs the extreme one, or the channel is but coarsely quantised."""


def present(values: Array, valid: NDArray[np.bool_], noise: float) -> bool:
    """Of a channel of the motion, (N,); the noise does not matter."""
    return bool(np.any(clipped(values, valid)))


def clipped(values: Array, valid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(N,): the samples of a channel that stand at the end of the sensor's range, if many do and few stand just below."""
    size = np.abs(np.where(valid & np.isfinite(values), values, 0.0))
    top = float(np.max(size))
    at = size >= top * (1 - 1e-12)
    below = np.where(at, 0.0, size)
    next_ = float(np.max(below))
    neighbours = int(np.sum(at[1:] & at[:-1]))
    many = np.sum(at) >= CLIPPED and neighbours >= 2
    if next_ == 0.0 or not many or np.sum(at) < LATTICE * np.sum(below >= next_ * (1 - 1e-12)):
        return np.zeros(len(values), dtype=np.bool_)
    return np.asarray(at)


EFFECT = Effect(
    id="imu-saturation",
    title="Saturation of the motion sensors",
    physics=(
        "Accelerometers and gyroscopes of the motion sensor have a range; in gusts the record stands at its end while the "
        "platform moves on."
    ),
    source="range of the motion sensor's converters",
    equation=r"\bm a_{rec} = \min(\max(\bm a, -a_{max}), a_{max}),\; \bm\omega_{rec} \text{ likewise}",
    limits=(
        "Symmetric, axis by axis, before any filter: what has been smoothed after it clipped shows no edge. Samples at the "
        "end of the range are not used."
    ),
    kind="output",
    channels=("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z"),
    parameters=(
        EffectParameter(
            "a_max",
            "a_{max}",
            "g",
            "largest recorded force",
            2.0,
            shared=True,
            neutral=float("inf"),
            fitted=False,
        ),
        EffectParameter(
            "omega_max",
            r"\omega_{max}",
            "deg/s",
            "largest recorded rate",
            100.0,
            shared=True,
            neutral=float("inf"),
            fitted=False,
        ),
    ),
)
