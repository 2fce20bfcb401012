"""The constants by which the derived models tell the accelerometers of a layout apart, as numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.layout import TANGENTIAL, Disc, Layout, Vector3

Array = NDArray[np.float64]


def axes(disc: Disc) -> Array:
    """(3, 3): its columns are the axes of a disc at rest (angle 0, a quarter turn on, spin) in the measurement frame."""
    return np.column_stack([*disc.across, disc.axis])


def turn(direction: Vector3) -> Array:
    """(3, 3): the smallest rotation in (e_r, e_t, e_a) that takes e_t to a direction; half a turn about e_a to -e_t."""
    c = float(np.dot(TANGENTIAL, direction))
    if c <= -1.0 + 1e-15:
        return np.diag([-1.0, -1.0, 1.0])
    x, y, z = np.cross(TANGENTIAL, direction)
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + K + K @ K / (1.0 + c))


def constants(layout: Layout) -> Mapping[str, tuple[float, ...]]:
    """Name -> one number for each accelerometer; heights, turns and axes only where the layout has some."""
    places = layout.places
    found: dict[str, tuple[float, ...]] = {
        "cos_j": tuple(p.cosine_sine[0] for p in places),
        "sin_j": tuple(p.cosine_sine[1] for p in places),
    }
    if any(p.height != 0.0 for p in places):
        found["height_j"] = tuple(float(p.height) for p in places)
    if any(p.direction != TANGENTIAL for p in places):
        found |= _entries("turn", [turn(p.direction) for p in places])
    if not all(d.level for d in layout.discs):
        found |= _entries("axes", [axes(layout.discs[p.disc]) for p in places])
    return found


PARTS = 1_000_000
"""Of a degree: what an angle on the disc is written in."""


def degrees(layout: Layout) -> tuple[Fraction | None, ...]:
    """The exact angle of each accelerometer, as it was written; ``None``: it was not written in millionths of a degree."""
    found = []
    for p in layout.places:
        parts = math.degrees(p.angle) * PARTS
        exact = Fraction(round(parts), PARTS)
        # what turning degrees into radians rounds off
        found.append(exact if abs(parts - round(parts)) < 1e-12 * PARTS else None)
    return tuple(found)


def _entries(name: str, matrices: list[Array]) -> dict[str, tuple[float, ...]]:
    # + 0.0 makes -0.0 the zero that it is
    return {
        f"{name}_{i}{k}_j": tuple(float(m[i, k]) + 0.0 for m in matrices) for i in range(3) for k in range(3)
    }
