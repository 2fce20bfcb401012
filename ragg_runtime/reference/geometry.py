"""Where an accelerometer sits on the disc and how it is turned, as vectors fixed to the disc."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.layout import TANGENTIAL, AccelerometerPosition, Disc
from ragg_runtime.reference.rotation import Rotations, X, Y, Z, about, least_rotation

Array = NDArray[np.float64]

# Columns: the nominal axes of an accelerometer at angle 0. x along the turn, y outward, hence z down.
_NOMINAL = np.column_stack([Y, X, -Z])


@dataclass(frozen=True)
class Mount:
    """One accelerometer, in the frame of the disc.

    ``arm`` (3,): from the disc centre, over its radius. ``triad`` (3, 3): rows tau_x, tau_y, tau_z, its nominal frame
    at its actual position. ``lift`` (3,) m: along the axis, from the plane of the disc's centre.
    """

    arm: Array
    triad: Array
    lift: Array


def mount(place: AccelerometerPosition, beta_x: float, beta_z: float, rotations: Rotations) -> Mount:
    """An accelerometer with altitude beta_x and initial phase angle beta_z (rad).

    The arm is y turned by -beta_x about x, the triad by +beta_x (the senses of the printed Eq. 19); both then turn by
    beta_z about the spin axis and move to the station. A direction of the input axis turns the triad before that.
    """
    c, s = place.cosine_sine
    station = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    axes = station @ about(Z, beta_z, rotations) @ _NOMINAL
    turned = axes @ about(X, beta_x, rotations)
    if place.direction != TANGENTIAL:
        turned = turned @ _NOMINAL.T @ least_rotation(Y, np.array(place.direction), Z) @ _NOMINAL
    return Mount(arm=axes @ about(X, -beta_x, rotations) @ Y, triad=turned.T, lift=place.height * Z)


def standing(disc: Disc) -> Array | None:
    """(3, 3): takes a disc from where z is its axis and x its angle 0 to where it is; ``None``: it is there."""
    if disc.level:
        return None
    axis, zero = np.array(disc.axis), np.array(disc.zero)
    leaning = least_rotation(Z, axis, X)
    now = leaning @ X
    twist = float(np.arctan2(axis @ np.cross(now, zero), now @ zero))
    return about(axis, twist) @ leaning
