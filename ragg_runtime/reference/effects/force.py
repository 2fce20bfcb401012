"""Stage 3: attraction missing from the gradient channels, and unrecorded vibration."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference.effects import Injected, Values
from ragg_runtime.reference.gravity import PointMass, contract

Array = NDArray[np.float64]


def attraction(r: Array, auxiliaries: Mapping[str, Array], effects: Injected) -> Array | float:
    """Unmodelled a_g(r) - a_g(0) at positions (3, N) m, in m/s^2."""
    total: Array | float = 0.0
    if masses := effects.get("self-gradient"):
        for axis in ("roll", "pitch"):
            if axis in auxiliaries:
                total = total + contract(_complete(masses, f"G_{{}}_{axis}"), r) * np.sin(auxiliaries[axis])
    if standing := effects.get("gradient-offset"):
        total = total + contract(_complete(standing), r)
    if tanks := effects.get("fuel-gradient"):
        total = total + contract(_complete(tanks), r) * auxiliaries["fuel_mass"]
    if carrier := effects.get("self-gradient-yaw"):
        d, xy, xz, yz = (carrier[f"G_{k}"] for k in ("d", "xy", "xz", "yz"))
        level = np.array([d, xy, xz, -d, yz, 0.0])
        total = total + _turn_attraction(level, r, [auxiliaries["yaw"]]) - contract(level, r)
    if rigid := effects.get("carrier-gradient"):
        level = _complete(rigid)
        full = level[:, None] + _complete(rigid, "F_{}")[:, None] * auxiliaries.get("fuel_mass", 0.0)
        attitude = [auxiliaries[n] for n in ("yaw", "pitch", "roll")]
        total = total + _turn_attraction(full, r, attitude) - contract(level, r)
    for body in ("near-sphere", "near-cuboid"):
        if body in effects:
            total = total + _of_body(effects[body], r, auxiliaries)
    if near := effects.get("near-mass"):
        total = total + np.einsum("ijk,jn,kn->in", gravity_tensor(near, 3), r, r) / 2
        total = total + np.einsum("ijkl,jn,kn,ln->in", gravity_tensor(near, 4), r, r, r) / 6
    return total


_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)


def _of_body(body: Values, r: Array, auxiliaries: Mapping[str, Array]) -> Array:
    """Attraction (3, N), m/s^2, at r less that at the centre, of a moving point mass, or of a cuboid by quadrature over points."""
    moved = np.stack([auxiliaries[f"mass_{k}"] for k in "xyz"])
    centre = moved + np.array([[float(body[k])] for k in "xyz"])
    edges = np.array([float(body.get(f"l_{k}", 0.0)) for k in "xyz"])
    points = zip(_NODES, _WEIGHTS / 2, strict=True) if np.any(edges) else [(0.0, 1.0)]
    total = np.zeros_like(r)
    for node in itertools.product(list(points), repeat=3):
        (x, y, z), weights = zip(*node, strict=True)
        at = np.asarray(centre + (edges * [x, y, z] / 2)[:, None])
        total += PointMass(float(body["M"] * np.prod(weights)), at).difference(r[0], r)
    return total


def _turn_attraction(tensor: Array, r: Array, attitude: Sequence[Array]) -> Array:
    """Attraction (3, N) m/s^2 of masses that turn with the carrier: r is looked at from there, and the answer turned back.

    ``attitude``: angles (N,) rad about z, y and x, or the first of them.
    """
    turns = list(zip(_PLANES, attitude, strict=False))
    position = np.array(r)
    for (a, b), angle in turns:
        c, s = np.cos(angle), np.sin(angle)
        position[a], position[b] = c * position[a] + s * position[b], c * position[b] - s * position[a]
    pulled = contract(tensor, position)
    for (a, b), angle in reversed(turns):
        c, s = np.cos(angle), np.sin(angle)
        pulled[a], pulled[b] = c * pulled[a] - s * pulled[b], c * pulled[b] + s * pulled[a]
    return pulled


_PLANES = ((0, 1), (2, 0), (1, 2))  # axes from which to which a turn about z, y and x goes


def _complete(values: Values, name: str = "G_{}") -> Array:
    """A gradient's six components of its five independent ones."""
    xx, xy, xz, yy, yz = (values[name.format(c)] for c in ("xx", "xy", "xz", "yy", "yz"))
    return np.array([xx, xy, xz, yy, yz, -(xx + yy)])


def jittered(r: Array, auxiliaries: Mapping[str, Array], effects: Injected) -> Array | float:
    """Mean centrifugal acceleration (3, N), m/s^2, of unrecorded angular jitter at r (3, N): to and fro about each principal axis."""
    jitter = effects.get("angular-jitter")
    if jitter is None:
        return 0.0
    W = {name.removeprefix("W_"): float(value) for name, value in jitter.items()}
    shares, axes = np.linalg.eigh(_matrix(W))
    level = auxiliaries["angular_vibration_rms"]
    total = np.zeros_like(r)
    for share, axis in zip(shares, axes.T, strict=True):
        inward = np.cross(axis[:, None], np.cross(axis[:, None], r, axis=0), axis=0)
        total += share * level**2 * inward
    return total


def _matrix(of: Mapping[str, float]) -> list[list[float]]:
    return [[of["xx"], of["xy"], of["xz"]], [of["xy"], of["yy"], of["yz"]], [of["xz"], of["yz"], of["zz"]]]


def gravity_tensor(near: Values, rank: int) -> Array:
    """The symmetric, traceless tensor of second or third derivatives of a_g, (3, 3, 3) 1/(m s^2) or (3, 3, 3, 3) 1/(m^2 s^2)."""
    entries = {n.removeprefix("T_"): float(x) for n, x in near.items() if len(n) == rank + 2}
    for axes in itertools.combinations_with_replacement("xyz", rank - 2):  # Laplace; z alone comes last
        of_x, of_y = ("".join(sorted((*axes, k, k))) for k in "xy")
        entries["".join(axes) + "zz"] = -(entries[of_x] + entries[of_y])
    tensor = np.empty((3,) * rank)
    for index in itertools.product(range(3), repeat=rank):
        tensor[index] = entries["".join("xyz"[k] for k in sorted(index))]
    return tensor


# Gauss-Hermite for a standard normal variable, exact to the fifth power.
_VIBRATION = ((0.0, 2 / 3), (-np.sqrt(3.0), 1 / 6), (np.sqrt(3.0), 1 / 6))


def vibration(effects: Injected, effect: str, letter: str) -> tuple[tuple[Array, float], ...]:
    """Instances of an unrecorded vibration, (3, 1) m/s^2 each (of ``vibration-level`` at a level of 1 m/s^2), and their probabilities.

    They are exact for polynomials of degree five; ``letter`` names the covariance.
    """
    covariance = effects.get(effect)
    if covariance is None:
        return ((np.zeros((3, 1)), 1.0),)
    P = {name.removeprefix(f"{letter}_"): float(value) for name, value in covariance.items()}
    variances, axes = np.linalg.eigh(_matrix(P))
    floor = 1e-12 * max(abs(variances[0]), abs(variances[-1]))
    if variances[0] < -floor:
        raise UserError(
            f"the covariance {letter} of {effect} is not positive semidefinite",
            found=f"eigenvalues {', '.join(f'{v:g}' for v in variances)}"
            + (" (m/s^2)^2" if letter == "P" else ""),
            remedy=f"{letter}_xy^2 may not exceed {letter}_xx {letter}_yy, and so on",
        )
    shaken = [axis * np.sqrt(v) for v, axis in zip(variances, axes.T, strict=True) if v > floor]
    return tuple(
        (
            np.asarray(sum((z * axis for (z, _), axis in zip(draw, shaken, strict=True)), np.zeros(3)))[
                :, None
            ],
            float(np.prod([weight for _, weight in draw])),
        )
        for draw in itertools.product(_VIBRATION, repeat=len(shaken))
    )
