"""Least squares on triangular factors: QR of columns in stretches, joined flights, priors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from ragg_runtime.signals.fir import not_zero

Array = NDArray[np.float64]


def with_prior(T: Array, columns: Sequence[int], centre: Array | float = 0.0) -> Array:
    """A triangle (n, n) whose last column is the data, with a prior of unit width on some of the other columns.

    ``centre`` (columns,) or one number is where the prior has its mean. A prior is so many further rows of data.
    """
    return np.asarray(np.linalg.qr(np.vstack([T, prior(columns, T.shape[1], centre)]), mode="r"))


def prior(columns: Sequence[int], n: int, centre: Array | float = 0.0) -> Array:
    """(columns, n): the rows of such a prior."""
    rows = np.zeros((len(columns), n))
    rows[range(len(columns)), list(columns)] = 1.0
    rows[:, -1] = centre
    return rows


def orthonormal(columns: Array) -> Array:
    """(rows, k): orthonormal basis of columns (n, rows); those that vanish (knots in a gap) span nothing."""
    norms = np.linalg.norm(columns, axis=1)
    return np.asarray(np.linalg.qr(columns[norms > 1e-9 * np.max(norms, initial=0.0)].T)[0])


CHUNK = 2048
"""Rows that enter a triangle at a time: so many that it is passed through seldom, so few that they stay in the cache."""

PANEL = 32
"""Columns that LAPACK eliminates at a time."""


def triangle(columns: Array) -> Array:
    """Triangular factor (n, n) of columns (n, rows): the same inner products in n rows. What is zero stays so, without work."""
    some = not_zero(columns)
    k = np.count_nonzero(some)
    R = np.zeros((k, k), order="F")
    for start in range(0, columns.shape[1], CHUNK):
        R = _entered(R, np.asfortranarray(columns[some, start : start + CHUNK].T))
    T = np.zeros((len(columns),) * 2)
    T[np.ix_(some, some)] = R
    return T


def _entered(R: Array, part: Array, trapezoid: int = 0) -> Array:
    """The factor of the rows of R (n, n), upper triangular, and of ``part`` (m, n), both in Fortran's order and used up; the last
    ``trapezoid`` rows of ``part`` are an upper trapezoid.
    """
    if not part.size:
        return R
    panel = min(PANEL, len(R))
    return np.asarray(linalg.lapack.dtpqrt(trapezoid, panel, R, part, overwrite_a=True, overwrite_b=True)[0])


def join(blocks: Sequence[Array]) -> Array:
    """The triangle of several records together, each of them in any rows (k, n) with the right inner products."""
    if len(blocks) == 1:
        return blocks[0]
    return triangle(np.vstack(blocks).T)


def fold(trapezoids: Sequence[Array]) -> Array:
    """The same of upper trapezoids, row i of which is zero before column i: a fourth of the work, as the zeros stay."""
    first, *others = trapezoids
    n = first.shape[1]
    R = np.zeros((n, n), order="F")
    R[: len(first)] = first
    for t in others:
        R = _entered(R, np.array(t, order="F"), len(t))
    return R


def below(T: Array, first: int, picked: Sequence[int]) -> Array:
    """The triangle of the first columns of T (n, n), which are triangular in it already, and of others ``picked``."""
    k = first + len(picked)
    R = np.zeros((k, k))
    R[:first, :first] = T[:first, :first]
    R[:first, first:] = T[:first, picked]
    rest = np.linalg.qr(T[first:, picked], mode="r")
    R[first : first + len(rest), first:] = rest
    return R


def of_some(root: Array, own: Sequence[int]) -> Array:
    """(n, n): what a root (all, all) of an information knows of some parameters, whatever the others are."""
    others = [k for k in range(len(root)) if k not in set(own)]
    if not others:
        return root
    whole = np.asarray(np.linalg.qr(root[:, [*others, *own]], mode="r"))
    return whole[len(others) :, len(others) :]
