"""Least squares on R factors: QR of columns in segments, joined flights, priors; nonlinear by a trust region."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import linalg, optimize

from ragg_runtime.estimation.scores import INDISTINGUISHABLE
from ragg_runtime.signals.fir import find_nonzero

Array = NDArray[np.float64]


def add_prior(T: Array, columns: Sequence[int], centre: Array | float = 0.0) -> Array:
    """An R factor (n, n) whose last column is the data, with a prior of unit width on some of the other columns.

    ``centre`` (columns,) or one number is where the prior has its mean. A prior is so many further rows of data.
    """
    return np.asarray(np.linalg.qr(np.vstack([T, make_prior(columns, T.shape[1], centre)]), mode="r"))


def make_prior(columns: Sequence[int], n: int, centre: Array | float = 0.0) -> Array:
    """(columns, n): the rows of such a prior."""
    rows = np.zeros((len(columns), n))
    rows[range(len(columns)), list(columns)] = 1.0
    rows[:, -1] = centre
    return rows


def orthonormalise(columns: Array) -> Array:
    """(rows, k): orthonormal basis of columns (n, rows); those that vanish (knots in a gap) span nothing."""
    norms = np.linalg.norm(columns, axis=1)
    return np.asarray(np.linalg.qr(columns[norms > 1e-9 * np.max(norms, initial=0.0)].T)[0])


# rows that enter an R factor at a time: so many that it is passed through seldom, so few that they stay in the cache
CHUNK = 2048
PANEL = 32  # columns that LAPACK eliminates at a time


def compute_r_factor(columns: Array) -> Array:
    """Triangular factor (n, n) of columns (n, rows): the same inner products in n rows. What is zero stays so, without work."""
    nonzero = find_nonzero(columns)
    k = np.count_nonzero(nonzero)
    R = np.zeros((k, k), order="F")
    for start in range(0, columns.shape[1], CHUNK):
        R = _enter_rows(R, np.asfortranarray(columns[nonzero, start : start + CHUNK].T))
    T = np.zeros((len(columns),) * 2)
    T[np.ix_(nonzero, nonzero)] = R
    return T


def _enter_rows(R: Array, part: Array, trapezoid: int = 0) -> Array:
    """The factor of the rows of R (n, n), upper triangular, and of ``part`` (m, n), both in Fortran's order and used up; the last
    ``trapezoid`` rows of ``part`` are an upper trapezoid.
    """
    if not part.size:
        return R
    panel = min(PANEL, len(R))
    return np.asarray(linalg.lapack.dtpqrt(trapezoid, panel, R, part, overwrite_a=True, overwrite_b=True)[0])


def join(blocks: Sequence[Array]) -> Array:
    """The R factor of several records together, each given by rows (k, n) with the right inner products."""
    if len(blocks) == 1:
        return blocks[0]
    return compute_r_factor(np.vstack(blocks).T)


def fold(trapezoids: Sequence[Array]) -> Array:
    """The same of upper trapezoids, row i of which is zero before column i: a fourth of the work, as the zeros stay."""
    first, *others = trapezoids
    n = first.shape[1]
    R = np.zeros((n, n), order="F")
    R[: len(first)] = first
    for t in others:
        R = _enter_rows(R, np.array(t, order="F"), len(t))
    return R


def pick_columns(T: Array, first: int, picked: Sequence[int]) -> Array:
    """The R factor of the first columns of T (n, n), which are triangular in it already, and of others ``picked``."""
    k = first + len(picked)
    R = np.zeros((k, k))
    R[:first, :first] = T[:first, :first]
    R[:first, first:] = T[:first, picked]
    rest = np.linalg.qr(T[first:, picked], mode="r")
    R[first : first + len(rest), first:] = rest
    return R


def marginalise(root: Array, parameters: Sequence[int]) -> Array:
    """(n, n): a root of the information about some parameters, marginal over the others, from a root of that about all."""
    others = [k for k in range(len(root)) if k not in set(parameters)]
    if not others:
        return root
    whole = np.asarray(np.linalg.qr(root[:, [*others, *parameters]], mode="r"))
    return whole[len(others) :, len(others) :]


# Chi-square that the linearised problem may still promise at an optimum: a tenth of a standard deviation in one direction, well below
# what noise does to any estimate
SETTLED = 0.01
# the same as a share of chi-square, where what is left is far more than noise: half of it is the share of the rms
RELATIVE = 1e-5
# Chi-square still promised at which a search ends that gains less than SETTLED in a step: a curved valley, or rounding
VALLEY = 1.0

# the same where what is left is far more than noise, as a share of chi-square: half of it is the share of the rms, below the 1 % to
# which it is asked for. A search ends there whose step gained less than RELATIVE and could not have been longer.
SLOW = 0.01
ACCEPTED = 1e-4  # least share of the promised decrease for which a step is taken
POOR, GOOD = 0.25, 0.75  # shares below which the radius shrinks, and above which it may grow (Moré's)
CORRECTION = 0.5  # length of a step back to the floor of a valley over that of the step along it
CORRECTIONS = 2  # most of them after a step
# difference between a step's fall and what was promised of it, as a share, up to which the problem counts as linear
FAITHFUL = 0.01

# most trials of a fit; usual are two or three. Where there is no noise but the last digits of a file the floor of the valley is a
# thousand times narrower, and a hundred steps lead along it.
MOST_TRIALS = 150

# trials after which, again and again, a search must be on its way to its end. Along a valley whose floor is a parabola what is left to
# gain falls with the square of the way that is left, which at the pace of these trials must be gone within the rest of them.
PACE = 20


@dataclass(frozen=True)
class Linear:
    """A sum of squares about a point: |y - R step|^2 and what is left; ``T`` (n + 1, n + 1): R factor of [columns | residual]."""

    T: Array

    @property
    def R(self) -> Array:
        return self.T[:-1, :-1]

    @property
    def y(self) -> Array:
        return self.T[:-1, -1]

    @property
    def cost(self) -> float:
        """The sum of squares at the point itself."""
        return float(self.T[:, -1] @ self.T[:, -1])

    @cached_property
    def _factors(self) -> tuple[Array, Array, Array]:
        U, s, Vt = np.linalg.svd(self.R)
        return s, U.T @ self.y, Vt.T

    @cached_property
    def step(self) -> Array:
        """(n,): to where the sum of squares is least."""
        return np.asarray(linalg.solve_triangular(self.R, self.y))

    @property
    def decrement(self) -> float:
        """Decrease that the best step promises: |y|^2, the gradient's square in the metric of R^T R."""
        return float(self.y @ self.y)

    @property
    def covariance(self) -> Array:
        """(n, n)."""
        inverse = np.linalg.inv(self.R)
        return np.asarray(inverse @ inverse.T)

    def within(self, radius: float) -> Array:
        """(n,): the best step no longer than ``radius``: that of |y - R step|^2 + damping |step|^2 with the right damping."""
        if np.linalg.norm(self.step) <= radius:
            return self.step
        s, d, V = self._factors

        def excess(log_damping: float) -> float:
            # Moré: one over the length is nearly linear in the damping
            length = float(np.linalg.norm(s * d / (s**2 + np.exp(log_damping))))
            return 1.0 / radius - 1.0 / max(length, 1e-300)

        low, high = 2 * np.log(float(s[-1])) - 60.0, np.log(float(np.linalg.norm(s * d)) / radius) + 1.0
        damping = float(np.exp(optimize.brentq(excess, min(low, high - 1.0), high, xtol=1e-6)))
        return np.asarray(V @ (s * d / (s**2 + damping)))

    def predict_decrease(self, step: Array) -> float:
        """Decrease that a step promises."""
        return self.decrement - float(np.sum((self.y - self.R @ step) ** 2))


L = TypeVar("L", bound=Linear)


@dataclass(frozen=True)
class Minimum(Generic[L]):
    """Where the search ended: ``x`` (n,), the problem linearised ``at`` it, and why the search ended there.

    ``faithful``: the last step did what was promised of it, and none before had to be shortened.
    """

    x: Array
    at: L
    converged: bool
    reason: str
    faithful: bool = False

    @property
    def last(self) -> Array:
        """(n,): the step to the optimum of the linearised problem, where that is below what noise does."""
        trusted = self.faithful and self.at.decrement < SETTLED
        return self.at.step if trusted else np.zeros(len(self.x))


def is_settled(at: Linear) -> bool:
    """The test of optimality: nothing worth having is promised any more."""
    return at.decrement <= max(SETTLED, RELATIVE * at.cost)


def minimise(linearise: Callable[[Array], L], start: Array, most: int = MOST_TRIALS) -> Minimum[L]:
    """Minimise a sum of squares from ``start`` (n,); chi-square never rises. A point of infinite cost is out of the model's reach."""
    x = np.array(start, dtype=np.float64)
    at = linearise(x)
    radius, faithful, trials = np.inf, False, 1
    mark, before = trials, at.cost

    def finish(converged: bool, reason: str, faithful: bool = False) -> Minimum[L]:
        return Minimum(x=x, at=at, converged=converged, reason=reason, faithful=faithful)

    if not np.isfinite(at.cost):
        return finish(False, "the model output is not finite at the starting point")
    while trials < most:
        if is_settled(at):
            return finish(True, "no further gain", faithful)
        step = at.within(radius)
        length = float(np.linalg.norm(step))
        end, ahead, tried = _correct_second_order(linearise, at, x, step)
        trials += tried
        fallen = at.cost - ahead.cost
        ratio = fallen / at.predict_decrease(step) if np.isfinite(fallen) else -np.inf
        if ratio < POOR:
            radius = length * _shrink(float(at.y @ (at.R @ step)), fallen)
        elif ratio > GOOD:
            radius = max(radius, 2.0 * length)
        if ratio > ACCEPTED:
            x, at = end, ahead
            faithful = tried == 1 and abs(ratio - 1.0) < FAITHFUL and not np.isfinite(radius)
            creeps = ratio <= GOOD and fallen < RELATIVE * at.cost and at.decrement < SLOW * at.cost
            if creeps or (fallen < SETTLED and at.decrement < VALLEY):
                return finish(True, "no significant gain")
        elif radius < 1e-9 * (1.0 + float(np.linalg.norm(x))):
            # where samples come and go with the parameters, or all is rounding, what is promised is not there
            if at.decrement < INDISTINGUISHABLE:
                return finish(True, "no significant gain")
            return finish(False, "no step reduces the misfit")
        if trials - mark >= PACE:
            gained, needed = (before - at.cost) * (most - trials), 2.0 * at.decrement * (trials - mark)
            if at.decrement > max(INDISTINGUISHABLE, SLOW * at.cost) and 0.0 < gained < needed:
                return finish(False, f"no end in sight after {trials} trials")
            mark, before = trials, at.cost
    return finish(is_settled(at), f"stopped after {most} trials")


def _correct_second_order(
    linearise: Callable[[Array], L], at: L, x: Array, step: Array
) -> tuple[Array, L, int]:
    """The end of a step from x, with a second-order correction (Fletcher 1982), the problem about it, and the points tried."""
    end = x + step
    ahead = linearise(end)
    room = CORRECTION * float(np.linalg.norm(step))
    for tried in range(1, CORRECTIONS + 1):
        if at.cost - ahead.cost >= POOR * at.predict_decrease(step) or not np.isfinite(ahead.cost):
            return end, ahead, tried
        back = ahead.within(room)
        nearer = linearise(end + back)
        if not nearer.cost < ahead.cost:
            return end, ahead, tried + 1
        end, ahead = end + back, nearer
    return end, ahead, CORRECTIONS + 1


def _shrink(slope: float, fallen: float) -> float:
    """Factor for the radius after a poor step: where the parabola with this slope (half of it) and this fall has its minimum."""
    if not np.isfinite(fallen):
        return 0.1
    return float(np.clip(slope / max(2.0 * slope - fallen, 1e-300), 0.1, 0.5))
