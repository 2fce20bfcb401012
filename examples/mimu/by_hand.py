"""What the record of the array shows without any model: clocks of the chips, whose the residual is, sensitivity to gravity.

python -m examples.mimu.by_hand RAW.bin.gz
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from examples.mimu.clocks import at_one_instant, clocks, slope
from examples.mimu.record import PLACES, RATE, REST, Array, places, read
from examples.mimu.variants import tangents, trusted

ROUNDS = 3
"""Times that the chips' own errors are taken out beside the rigid body."""

WRONG = 17.0
"""s by which ages are shifted as a counter-check."""


def shared(force: Array, rate: Array, good: NDArray[np.bool_]) -> tuple[float, float]:
    """rms of what specific force and rotation leave of the front's G_out, m/s^2; and with the back's G_out as well."""
    omega = rate.mean(axis=1)
    sums = []
    for side in (0, 1):
        each = [force[:, 2 * corner + side] @ t for (corner, _), t in zip(PLACES, tangents(), strict=True)]
        sums.append(each[0] + each[1] - each[2] - each[3])
    squares = [omega[:, i] * omega[:, k] for i in range(3) for k in range(i, 3)]
    X = np.column_stack([force[:, 1::2].mean(axis=1), slope(omega), *squares, np.ones(len(omega))])
    moving = good & (np.linalg.norm(omega, axis=1) > REST)
    left = []
    for columns in (X, np.column_stack([X, sums[1]])):
        p = np.linalg.lstsq(columns[good], sums[0][good], rcond=None)[0]
        left.append(float(np.std((sums[0] - columns @ p)[moving])))
    return left[0], left[1]


def rigid(force: Array, omega: Array, good: NDArray[np.bool_]) -> tuple[Array, Array]:
    """(N, 24) m/s^2: what one rigid body leaves of all accelerometers of the array; and (24, 6), what such a body does to them.

    ``force`` (N, 8, 3) m/s^2, ``omega`` (N, 3) rad/s. The body has three accelerations and three angular ones a sample; the chips'
    gains, axes, places and biases are taken out.
    """
    corners = places()
    lever = [np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]) for x, y, z in corners]
    H = np.concatenate([np.hstack([np.eye(3), m]) for m in lever])
    x = (force - np.cross(omega[:, None], np.cross(omega[:, None], corners))).reshape(len(force), 24)
    squares = np.stack([omega[:, i] * omega[:, k] for i in range(3) for k in range(i, 3)], axis=1)
    P = np.linalg.pinv(H)
    for _ in range(ROUNDS):
        body = x @ P.T
        X = np.column_stack([body, squares, slope(squares), omega, np.ones(len(x))])
        x = x - X @ np.linalg.lstsq(X[good], (x - body @ H.T)[good], rcond=None)[0]
    return x - x @ P.T @ H.T, H


def explained(left: Array, H: Array, age: Array) -> float:
    """Share of the power of what a rigid body leaves, (n, 24), that one jerk a sample takes, times the age (n, 8) of each chip.

    Three numbers of the eighteen that are free: of ages that say nothing it would be a sixth.
    """
    Q = np.eye(24) - H @ np.linalg.pinv(H)
    A = Q @ (np.repeat(age, 3, axis=1)[:, :, None] * H[:, :3])
    U, _, _ = np.linalg.svd(A, full_matrices=False)
    return float(np.sum(np.einsum("nik,ni->nk", U, left) ** 2) / np.sum(left**2))


def of_clocks(force: Array, rate: Array, saturated: NDArray[np.bool_]) -> tuple[float, float]:
    """The share of :func:`explained` by the clocks that the gyroscopes tell, and by ages of another time."""
    good = trusted(saturated)
    t = np.arange(len(rate)) / RATE
    age = np.stack([c.age(t) for c in clocks(rate, good)], axis=1)
    omega = at_one_instant(rate, age).mean(axis=1)
    left, H = rigid(force, omega, good)
    use = good & (np.linalg.norm(omega, axis=1) > REST)
    other = np.roll(age, round(WRONG * RATE), axis=0)
    return explained(left[use], H, age[use]), explained(left[use], H, other[use])


def gravity_on_rates(force: Array, rate: Array) -> tuple[float, float]:
    """What gravity does to the gyroscopes, by what they read at rest, deg/s per g: largest of nine coefficients of their mean,
    and what chance makes of it, 3 sigma.

    ``force``, ``rate`` (n, 3): mean of each rest.
    """
    X = np.column_stack([force / 9.81, np.ones(len(force))])
    p, *_ = np.linalg.lstsq(X, rate, rcond=None)
    scatter = np.std(rate - X @ p, axis=0, ddof=4)
    std = np.sqrt(np.diag(np.linalg.inv(X.T @ X)))[:3, None] * scatter
    return float(np.rad2deg(np.max(np.abs(p[:3])))), float(np.rad2deg(3.0 * np.max(std)))


def main(raw: str) -> None:
    force, rate, saturated = read(Path(raw))
    good = trusted(saturated)
    for k, c in enumerate(clocks(rate, good)):
        print(
            f"chip {k + 1}: clock slips at {c.slip:.3f} Hz, which explains {100 * c.share:.0f} % of its ages' scatter"
        )
    here, other = of_clocks(force, rate, saturated)
    print(
        "What one rigid body leaves of all accelerometers while it moves: one jerk a sample, times the age of each chip, is "
        f"{100 * here:.0f} % of it ({100 * other:.0f} % with the ages of another time)"
    )
    alone, together = shared(force, rate, good)
    print(
        f"G_out of the front, moving: {alone:.2f} m/s^2 left by the motion, {together:.2f} with that of the back as well"
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
