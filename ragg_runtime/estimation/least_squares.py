"""Least squares on R factors: QR of columns in stretches, joined flights, priors; nonlinear by SciPy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import linalg, optimize

from ragg_runtime.estimation.scores import INDISTINGUISHABLE
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


SETTLED = 0.01
"""Chi-square that the linearised problem may still promise at an optimum: a tenth of a standard deviation in one
direction, well below what noise does to any estimate."""

RELATIVE = 1e-5
"""The same as a share of chi-square, where what is left is far more than noise: half of it is the share of the rms."""

SLOW = 0.01
"""Share of chi-square that may still be promised where no step gains anything: half of it is the share of the rms, below the 1 % to
which it is asked for."""

TRUSTED = 100.0
"""Length of the first step, in widths of the priors, that is taken as it is: the sheet is seldom so far off."""

MOST_TRIALS = 150
"""Most trials of a fit; usual are three or four. Where there is no noise but the last digits of a file the floor of the valley is a
thousand times narrower, and a hundred steps lead along it."""


@dataclass(frozen=True)
class Linear:
    """A sum of squares about a point: |y - R step|^2 + rest; R (n, n) is regular."""

    R: Array
    y: Array
    rest: float

    @property
    def cost(self) -> float:
        """The sum of squares at the point itself."""
        return self.decrement + self.rest

    @property
    def step(self) -> Array:
        """(n,): to where the sum of squares is least."""
        return np.asarray(np.linalg.solve(self.R, self.y))

    @property
    def decrement(self) -> float:
        """Decrease that the best step promises: |y|^2, the gradient's square in the metric of R^T R."""
        return float(self.y @ self.y)

    @property
    def covariance(self) -> Array:
        """(n, n)."""
        inverse = np.linalg.inv(self.R)
        return np.asarray(inverse @ inverse.T)

    @property
    def is_settled(self) -> bool:
        """The test of optimality: nothing worth having is promised any more."""
        return self.decrement <= max(SETTLED, RELATIVE * self.cost)


L = TypeVar("L", bound=Linear)


@dataclass(frozen=True)
class Minimum(Generic[L]):
    """Where the search ended: ``x`` (n,), the problem linearised ``at`` it, and why it ended there."""

    x: Array
    at: L
    converged: bool
    reason: str

    @property
    def last(self) -> Array:
        """(n,): the step to the optimum of the linearised problem, where that is below what noise does."""
        return self.at.step if self.at.decrement < SETTLED else np.zeros(len(self.x))


def minimise(linearise: Callable[[Array], L], start: Array, most: int = MOST_TRIALS) -> Minimum[L]:
    """Minimise a sum of squares from ``start`` (n,) by SciPy's trust region; a point of infinite cost is out of the model's reach.

    Of a point x + d residual and Jacobian are those of the triangle there: [y, sqrt(rest)] and -R, of which only inner products matter.
    """

    @lru_cache(maxsize=4)
    def at(moved: bytes) -> L:
        return linearise(start + np.frombuffer(moved))

    def residual(moved: Array) -> Array:
        p = at(moved.tobytes())
        return np.append(p.y, np.sqrt(p.rest))

    def jacobian(moved: Array) -> Array:
        R = at(moved.tobytes()).R
        return np.vstack([-R, np.zeros(len(R))])

    def end_if_settled(intermediate_result: optimize.OptimizeResult) -> None:
        if at(intermediate_result.x.tobytes()).is_settled:
            raise StopIteration

    nowhere = np.zeros(len(start))
    begun = at(nowhere.tobytes())
    if not np.isfinite(begun.cost):
        return Minimum(
            start, begun, converged=False, reason="the model output is not finite at the starting point"
        )
    if begun.is_settled:
        return Minimum(start, begun, converged=True, reason="no further gain")
    found = optimize.least_squares(
        residual,
        nowhere,
        jacobian,
        ftol=1e-6,
        xtol=1e-9,
        x_scale=TRUSTED,
        max_nfev=most,
        callback=end_if_settled,
    )
    end = at(found.x.tobytes())
    # where samples come and go with the parameters, or all is rounding, what is promised is not there
    arrived = end.is_settled or (found.status > 0 and end.decrement < max(INDISTINGUISHABLE, SLOW * end.cost))
    reason = "no significant gain"
    if not arrived:
        reason = f"stopped after {most} trials" if found.status == 0 else "no step reduces the misfit"
    return Minimum(start + found.x, end, converged=arrived, reason=reason)
