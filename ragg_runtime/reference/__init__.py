"""The numerical model of the instrument (Eq. 49-53): an independent reference for the derived ones.

Built from vectors, rotations and cross products, not from the derivation's algebra, and free of its
truncations where asked (``rotations="exact"``, Newton's law, effects in full form). It never sees ``derive`` or ``generated``.
"""

from __future__ import annotations

from ragg_runtime.reference.effects import CATALOGUE, EffectValues
from ragg_runtime.reference.motion import (
    MotionSignals,
    MotionState,
    RecordedSignal,
    Sinusoids,
    disc_angle,
    recorded_motion,
    still,
    turns,
)
from ragg_runtime.reference.simulate import Simulation, instants, simulate

__all__ = [
    "CATALOGUE",
    "EffectValues",
    "MotionSignals",
    "MotionState",
    "RecordedSignal",
    "Simulation",
    "Sinusoids",
    "disc_angle",
    "instants",
    "recorded_motion",
    "simulate",
    "still",
    "turns",
]
