"""Where an accelerometer sits on the disc and how it is turned, as vectors fixed to the disc."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.reference.rotation import Rotations, X, Y, Z, about

Array = NDArray[np.float64]

_STATIONS = ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0))
"""Cosine and sine of the angle of A1 ... A4 on the disc: 0, 180, 90 and 270 degrees."""

# Columns: the nominal axes of an accelerometer at angle 0. x along the turn, y outward, hence z down.
_NOMINAL = np.column_stack([Y, X, -Z])


@dataclass(frozen=True)
class Mount:
    """One accelerometer, in the frame of the disc.

    Attributes
    ----------
    arm
        (3,) from the disc centre to the accelerometer, over its radius (unit length in exact rotations).
    triad
        (3, 3), rows tau_x, tau_y, tau_z: its nominal frame at its actual position.
    """

    arm: Array
    triad: Array


def mount(j: int, beta_x: float, beta_z: float, rotations: Rotations) -> Mount:
    """Accelerometer j = 0 ... 3 with altitude beta_x and initial phase angle beta_z (rad).

    In its own nominal axes the arm is y turned by -beta_x about x, which lifts it towards +z of the
    measurement frame (nominal z points down), while the triad is turned by +beta_x: the senses of the
    printed Eq. 19. Both then turn by beta_z about the spin axis and move to the station.
    """
    c, s = _STATIONS[j]
    station = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    axes = station @ about(Z, beta_z, rotations) @ _NOMINAL
    return Mount(
        arm=axes @ about(X, -beta_x, rotations) @ Y,
        triad=(axes @ about(X, beta_x, rotations)).T,
    )
