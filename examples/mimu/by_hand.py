"""What the record of the array shows without any model: clocks of the chips, and whose the residual is.

python -m examples.mimu.by_hand RAW.bin.gz
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline
from scipy.ndimage import binary_dilation

from examples.mimu.record import PLACES, RATE, REST, read

Array = NDArray[np.float64]

BESIDE = 7
"""Samples about a saturated one that are left out."""

SWIFT = 500.0
"""rad/s^2 from which an age can be told from what a gyroscope reads."""


def ages(rate: Array, good: NDArray[np.bool_]) -> tuple[float, Array]:
    """How old what a chip's gyroscopes read is, against the mean of all, s: standard deviation and quantiles (5).

    Of each chip first its own gains, axes, delay and bias are taken out.
    """
    omega = rate.mean(axis=1)
    t = np.arange(len(omega)) / RATE
    alpha = make_interp_spline(t, omega, k=5).derivative()(t)
    swift = good & (np.linalg.norm(alpha, axis=1) > SWIFT)
    found = []
    for k in range(rate.shape[1]):
        left = np.empty_like(omega)
        for i in range(3):
            X = np.column_stack([omega, alpha[:, i], np.ones(len(t))])
            p = np.linalg.lstsq(X[good], rate[good, k, i], rcond=None)[0]
            left[:, i] = rate[:, k, i] - X @ p
        found.append(-np.sum(left * alpha, axis=1)[swift] / np.sum(alpha**2, axis=1)[swift])
    every = np.concatenate(found)
    return float(np.std(every)), np.quantile(every, [0.05, 0.25, 0.5, 0.75, 0.95])


def shared(force: Array, rate: Array, good: NDArray[np.bool_]) -> tuple[float, float]:
    """rms of what specific force and rotation leave of the front's G_out, m/s^2; and with the back's G_out as well."""
    omega = rate.mean(axis=1)
    t = np.arange(len(omega)) / RATE
    alpha = make_interp_spline(t, omega, k=5).derivative()(t)
    sums = []
    for side in (0, 1):
        total = np.zeros(len(t))
        for (corner, degrees), sign in zip(PLACES, (1, 1, -1, -1), strict=True):
            angle = np.deg2rad(degrees)
            total += sign * force[:, 2 * corner + side] @ np.array([-np.sin(angle), np.cos(angle), 0.0])
        sums.append(total)
    squares = [omega[:, i] * omega[:, k] for i in range(3) for k in range(i, 3)]
    X = np.column_stack([force[:, 1::2].mean(axis=1), alpha, *squares, np.ones(len(t))])
    moving = good & (np.linalg.norm(omega, axis=1) > REST)
    left = []
    for columns in (X, np.column_stack([X, sums[1]])):
        p = np.linalg.lstsq(columns[good], sums[0][good], rcond=None)[0]
        left.append(float(np.std((sums[0] - columns @ p)[moving])))
    return left[0], left[1]


def main(raw: str) -> None:
    force, rate, saturated = read(Path(raw))
    good = ~binary_dilation(saturated, np.ones(2 * BESIDE + 1))
    good[:20] = good[-20:] = False
    std, quantiles = ages(rate, good)
    print(f"age of a gyroscope's sample: standard deviation {1e3 * std:.2f} ms (evenly over 1 ms: 0.29)")
    print("  quantiles 5, 25, 50, 75, 95 %:", " ".join(f"{1e3 * q:+.2f}" for q in quantiles), "ms")
    alone, together = shared(force, rate, good)
    print(
        f"G_out of the front, moving: {alone:.2f} m/s^2 left by the motion, {together:.2f} with that of the back as well"
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
