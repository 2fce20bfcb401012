"""Saturation of the motion sensors."""

from __future__ import annotations

import math

from derive.effect import Effect, EffectParameter

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
    parameters=(
        EffectParameter(
            "a_max",
            "a_{max}",
            "g",
            "largest recorded force",
            2.0,
            shared=True,
            neutral=math.inf,
            fitted=False,
        ),
        EffectParameter(
            "omega_max",
            r"\omega_{max}",
            "deg/s",
            "largest recorded rate",
            100.0,
            shared=True,
            neutral=math.inf,
            fitted=False,
        ),
    ),
)
