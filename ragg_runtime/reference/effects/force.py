"""Stage 3: attraction that the gradient channels do not tell, and vibration that nobody recorded."""

from __future__ import annotations

import itertools
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.reference.effects.catalogue import Injected, Values
from ragg_runtime.reference.gravity import contract

Array = NDArray[np.float64]


def attraction(r: Array, auxiliaries: Mapping[str, Array], effects: Injected) -> Array | float:
    """Unmodelled a_g(r) - a_g(0) at positions (3, N) m, in m/s^2."""
    total: Array | float = 0.0
    if masses := effects.get("self-gradient"):
        for axis in ("roll", "pitch"):
            if axis in auxiliaries:
                total = total + contract(_turned(masses, axis), r) * np.sin(auxiliaries[axis])
    if standing := effects.get("gradient-offset"):
        xx, xy, xz, yy, yz = (standing[f"G_{c}"] for c in ("xx", "xy", "xz", "yy", "yz"))
        total = total + contract(np.array([xx, xy, xz, yy, yz, -(xx + yy)]), r)
    if near := effects.get("near-mass"):
        total = total + np.einsum("ijk,jn,kn->in", third_order_tensor(near), r, r) / 2
        total = total + np.einsum("ijkl,jn,kn,ln->in", fourth_order_tensor(near), r, r, r) / 6
    return total


def _turned(masses: Values, axis: str) -> Array:
    xx, xy, xz, yy, yz = (masses[f"G_{c}_{axis}"] for c in ("xx", "xy", "xz", "yy", "yz"))
    return np.array([xx, xy, xz, yy, yz, -(xx + yy)])


def third_order_tensor(near: Values) -> Array:
    """The symmetric, traceless (3, 3, 3) tensor of second derivatives of a_g, 1/(m s^2)."""
    seven = {name.removeprefix("T_"): float(value) for name, value in near.items() if len(name) == 5}
    # Laplace: each a_g component's Laplacian vanishes.
    seven["xzz"] = -(seven["xxx"] + seven["xyy"])
    seven["yzz"] = -(seven["xxy"] + seven["yyy"])
    seven["zzz"] = -(seven["xxz"] + seven["yyz"])
    return _symmetric(seven, 3)


def fourth_order_tensor(near: Values) -> Array:
    """The symmetric, traceless (3, 3, 3, 3) tensor of third derivatives of a_g, 1/(m^2 s^2)."""
    found = {name.removeprefix("T_"): float(value) for name, value in near.items() if len(name) == 6}
    for pair in ("xx", "xy", "xz", "yy", "yz", "zz"):  # Laplace, for each second derivative; z^4 comes last
        of_x, of_y = ("".join(sorted(f"{pair}{k}{k}")) for k in "xy")
        found[f"{pair}zz"] = -(found[of_x] + found[of_y])
    return _symmetric(found, 4)


def _symmetric(components: Mapping[str, float], rank: int) -> Array:
    """The tensor of components by their sorted indices."""
    tensor = np.empty((3,) * rank)
    for index in itertools.product(range(3), repeat=rank):
        tensor[index] = components["".join("xyz"[k] for k in sorted(index))]
    return tensor


# Gauss-Hermite for a standard normal variable, exact to the fifth power.
_VIBRATION = ((0.0, 2 / 3), (-np.sqrt(3.0), 1 / 6), (np.sqrt(3.0), 1 / 6))


def vibration(effects: Injected) -> tuple[tuple[Array, float], ...]:
    """Instances of the unrecorded vibration, (3, 1) m/s^2 each, and their probabilities.

    Averaging any polynomial of up to the fifth degree over them gives the expectation over a Gaussian
    vibration of covariance P exactly; abs(f_i) of ``odd-quadratic`` is averaged approximately.
    """
    covariance = effects.get("vibration-rectification")
    if covariance is None:
        return ((np.zeros((3, 1)), 1.0),)
    P = {name.removeprefix("P_"): float(value) for name, value in covariance.items()}
    variances, axes = np.linalg.eigh(
        [[P["xx"], P["xy"], P["xz"]], [P["xy"], P["yy"], P["yz"]], [P["xz"], P["yz"], P["zz"]]]
    )
    floor = 1e-12 * max(abs(variances[0]), abs(variances[-1]))
    if variances[0] < -floor:
        raise UserError(
            "the covariance P of vibration-rectification is not positive semidefinite",
            found=f"eigenvalues {', '.join(f'{v:g}' for v in variances)} (m/s^2)^2",
            remedy="P_xy^2 may not exceed P_xx P_yy, and so on",
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
