"""The gravity gradient tensor from the demodulated channels of several discs, and what is left over as a check.

A disc with axes e_1, e_2 (angle 0, a quarter turn on) sees inline = e_1 G e_1 - e_2 G e_2 and cross = e_1 G e_2. No
channel sees the trace: it is zero by Laplace's equation, and that is put in. So three discs give six channels for five
components, and one combination of them vanishes for any gradient (for axes at right angles the sum of the three
inline channels, (Gamma_yy - Gamma_zz) + (Gamma_zz - Gamma_xx) + (Gamma_xx - Gamma_yy)): its size is a figure of quality.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, count

Array = NDArray[np.float64]
Axis = Sequence[float] | Array

COMPONENTS = ("xx", "xy", "xz", "yy", "yz", "zz")

ILL = 1e-6
"""Smallest over largest singular value of the channels' dependence on the tensor below which they do not determine it."""


@dataclass(frozen=True)
class Tensor:
    """A tensor over time.

    Attributes
    ----------
    gamma
        (6, N), components in the order of :data:`COMPONENTS`, in the unit of the channels; without trace.
    closure
        (checks, N): combinations of the channels that vanish for any gradient, each of them normalised so that
        channels with errors of the size of ``std`` give it a standard deviation of 1.
    std
        (6,): standard deviation of the components for the given ones of the channels.
    """

    gamma: Array
    closure: Array
    std: Array

    @property
    def quality(self) -> float:
        """rms of the closure over its expected size: 1 if the channels are as good as stated."""
        return float(np.sqrt(np.mean(self.closure**2))) if self.closure.size else float("nan")


def project_components(first: Array, second: Array) -> Array:
    """(2, 6): inline and cross of a disc with these axes (3,), by the six components."""
    inline = np.outer(first, first) - np.outer(second, second)
    cross = (np.outer(first, second) + np.outer(second, first)) / 2
    i, k = np.triu_indices(3)
    return np.array([inline[i, k], cross[i, k]]) * np.where(i == k, 1.0, 2.0)


def spread_across(axes: tuple[Axis, Axis], inline: Array, cross: Array) -> Array:
    """(6, N): the tensor across a disc's two axes that it sees as these channels (N,); in their unit."""
    first, second = (np.array(a, dtype=np.float64) for a in axes)
    one = (np.outer(first, first) - np.outer(second, second)) / 2
    other = np.outer(first, second) + np.outer(second, first)
    upper = np.triu_indices(3)
    return np.asarray(np.outer(one[upper], inline) + np.outer(other[upper], cross))


_TRACELESS = np.insert(np.eye(5), 5, [-1.0, 0.0, 0.0, -1.0, 0.0], axis=0)
"""The six components by xx, xy, xz, yy, yz: zz = -(xx + yy)."""


def tensor(axes: Sequence[tuple[Axis, Axis]], channels: Array, std: Array) -> Tensor:
    """The tensor that agrees best with channels (2 discs, N), inline and cross of each disc in turn.

    Parameters
    ----------
    axes
        First two axes of each disc.
    std
        (2 discs,): standard deviation of each channel.

    Raises
    ------
    UserError
        If the discs do not determine it: fewer than three, or axes in one plane.
    """
    pairs = (np.asarray(pair, dtype=np.float64) for pair in axes)
    W = np.concatenate([project_components(*pair) for pair in pairs]) @ _TRACELESS / std[:, None]
    U, s, Vt = np.linalg.svd(W)
    if len(s) < 5 or s[4] < ILL * s[0]:
        raise UserError(
            "the discs do not determine the gravity gradient tensor",
            found=count(len(axes), "disc"),
            expected="three discs with axes that do not lie in one plane",
        )
    y = channels / std[:, None]
    inverse = Vt.T / s
    gamma = _TRACELESS @ inverse @ (U[:, :5].T @ y)
    spread = _TRACELESS @ inverse
    return Tensor(gamma=gamma, closure=U[:, 5:].T @ y, std=np.asarray(np.linalg.norm(spread, axis=1)))
