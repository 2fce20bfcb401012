"""Stage 1: what is recorded of the true motion. None of these effects touches the truth."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.reference.effects.catalogue import Injected
from ragg_runtime.reference.motion import Motion, MotionState
from ragg_runtime.reference.rotation import by_vector

Array = NDArray[np.float64]


def record_motion(motion: Motion, time: Array, effects: Injected) -> MotionState:
    """What the motion sensor reports at (N,) s.

    The sensor sits at l (lever arm), its axes are turned by e (misalignment), its gyroscopes scale each
    its own axis, and its record is late by delta_t; the true motion goes through them in that order.
    """
    delay = float(effects["time-offset"]["delta_t"]) if "time-offset" in effects else 0.0
    true = motion.at(time, delay)
    a, omega, omegadot = true.a, true.omega, true.omegadot
    if lever := effects.get("imu-lever-arm"):
        arm = np.array([lever["l_x"], lever["l_y"], lever["l_z"]])[:, None]
        a = a + np.cross(omegadot, arm, axis=0) + np.cross(omega, np.cross(omega, arm, axis=0), axis=0)
    if turned := effects.get("imu-misalignment"):
        # Components along axes turned by e: the inverse rotation of the vector.
        to_sensor = by_vector([turned["e_x"], turned["e_y"], turned["e_z"]]).T
        a, omega, omegadot = to_sensor @ a, to_sensor @ omega, to_sensor @ omegadot
    if scale := effects.get("gyro-scale"):
        factor = 1 + np.array([scale["s_x"], scale["s_y"], scale["s_z"]])[:, None]
        omega, omegadot = factor * omega, factor * omegadot
    return MotionState(a, omega, omegadot)
