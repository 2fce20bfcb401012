"""Rotations as matrices: elementary ones, by Rodrigues' formula, exact or to a power of the angle."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

Rotations = Literal["first-order", "second-order", "exact"]

Array = NDArray[np.float64]

X, Y, Z = np.eye(3)


def cross_matrix(axis: ArrayLike) -> Array:
    """Matrix of u -> axis x u, shape (3, 3)."""
    x, y, z = np.asarray(axis, dtype=np.float64)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def about(axis: ArrayLike, angle: float, rotations: Rotations = "exact") -> Array:
    """Right-handed rotation of vectors by ``angle`` (rad) about the unit vector ``axis``, (3, 3)."""
    k = cross_matrix(axis)
    turn: Array = angle * k
    if rotations == "exact":
        # 2 sin^2(angle/2) keeps 1 - cos(angle) accurate for arc seconds.
        turn = np.sin(angle) * k + 2 * np.sin(angle / 2) ** 2 * (k @ k)
    elif rotations == "second-order":
        turn = turn + angle**2 / 2 * (k @ k)
    return np.eye(3) + turn


def by_vector(vector: ArrayLike) -> Array:
    """Exact rotation about the direction of ``vector`` by its length (rad), (3, 3)."""
    v = np.asarray(vector, dtype=np.float64)
    angle = float(np.linalg.norm(v))
    return np.eye(3) if angle == 0 else about(v / angle, angle)


def least_rotation(start: Array, end: Array, spare: Array) -> Array:
    """The smallest rotation that takes a unit vector to another, (3, 3); about ``spare`` if they are opposite."""
    axis = np.cross(start, end)
    sine = float(np.linalg.norm(axis))
    if sine < 1e-12:
        return np.eye(3) if start @ end > 0 else about(spare, np.pi)
    return about(axis / sine, float(np.arctan2(sine, start @ end)))


def frame_rotation(
    x: ArrayLike, y: ArrayLike, z: ArrayLike, rotations: Literal["first-order", "exact"] = "exact"
) -> Array:
    """Coordinates of a fixed vector after its frame turns about x, then its new y, then its new z, by angles in rad, ()
    or (N,).

    To first order this is the paper's C (Eq. 2). (3, 3) or (3, 3, N): row k gives the component along axis k of the
    turned frame.
    """
    x, y, z = np.broadcast_arrays(*(np.asarray(v, dtype=np.float64) for v in (x, y, z)))
    one, nil = np.ones_like(x), np.zeros_like(x)
    if rotations == "first-order":
        return np.array([[one, z, -y], [-z, one, x], [y, -x, one]])
    first = np.array([[one, nil, nil], [nil, np.cos(x), np.sin(x)], [nil, -np.sin(x), np.cos(x)]])
    second = np.array([[np.cos(y), nil, -np.sin(y)], [nil, one, nil], [np.sin(y), nil, np.cos(y)]])
    third = np.array([[np.cos(z), np.sin(z), nil], [-np.sin(z), np.cos(z), nil], [nil, nil, one]])
    return np.asarray(np.einsum("ij...,jk...,kl...->il...", third, second, first), dtype=np.float64)
