"""Saturation of the motion sensors."""

from __future__ import annotations

import math

from derive.effect import Effect, EffectParameter

EFFECT = Effect(
    id="motion-saturation",
    title="Saturation of the motion sensors",
    physics=(
        "Accelerometers and gyroscopes of the motion sensor have a range, whose end stands in the record for what is beyond: "
        "the model is told a motion that was not."
    ),
    source="range of inertial sensors; found in a record of real ones (docs/real-measurements.md)",
    equation=(
        r"a_k \leftarrow \min(\max(a_k, -a_{max}), a_{max}),\;"
        r" \omega_k \leftarrow \min(\max(\omega_k, -\omega_{max}), \omega_{max})"
    ),
    limits=(
        "What was beyond is lost: a model with this effect leaves out the samples that stand at the end of a range. Of the mean of "
        "several sensors, samples at which only some of them have reached it are not recognised."
    ),
    kind="output",
    parameters=(
        EffectParameter(
            "a_max",
            "a_{max}",
            "m/s^2",
            "largest specific force that is recorded",
            160.0,
            shared=True,
            neutral=math.inf,
            fitted=False,
        ),
        EffectParameter(
            "omega_max",
            r"\omega_{max}",
            "rad/s",
            "largest angular rate that is recorded",
            35.0,
            shared=True,
            neutral=math.inf,
            fitted=False,
        ),
    ),
)
