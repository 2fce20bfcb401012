"""The trust region finds minima, never goes up, and says whether it has arrived."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import optimize

from ragg_runtime.estimation.least_squares import SETTLED, VALLEY, Linear, add_prior, is_settled, minimise

Array = NDArray[np.float64]
Residual = Callable[[Array], Array]


def problem(residual: Residual, costs: list[float]) -> Callable[[Array], Linear]:
    """A sum of squares as a linearised problem about a point, its Jacobian by differences."""

    def linearise(x: Array) -> Linear:
        r = residual(x)
        J = np.stack([(residual(x + h) - residual(x - h)) / 2e-6 for h in 1e-6 * np.eye(len(x))], axis=1)
        costs.append(float(r @ r))
        n = len(x) + 1
        rows = np.vstack([np.column_stack([J, -r]), np.zeros((n, n))])
        return Linear(np.linalg.qr(rows, mode="r"))

    return linearise


def make_linear(y: list[float], rest: float) -> Linear:
    """With the identity for R."""
    T = np.eye(len(y) + 1)
    T[:-1, -1], T[-1, -1] = y, np.sqrt(rest)
    return Linear(T)


def rosenbrock(x: Array) -> Array:
    return 30.0 * np.array([100.0 * (x[1] - x[0] ** 2), 1.0 - x[0], 0.3])


def powell(x: Array) -> Array:
    """Powell's badly scaled function, with a prior that keeps it regular."""
    return np.array([1e4 * x[0] * x[1] - 1.0, np.exp(-x[0]) + np.exp(-x[1]) - 1.0001, *(1e-3 * x)])


@pytest.mark.parametrize(
    ("residual", "start"), [(rosenbrock, [-1.2, 1.0]), (rosenbrock, [8.0, -5.0]), (powell, [0.5, 1.0])]
)
def test_the_minimum_is_that_of_scipy_and_no_accepted_step_went_up(residual, start) -> None:
    costs: list[float] = []
    found = minimise(problem(residual, costs), np.array(start), most=400)
    best = min(
        float(2 * optimize.least_squares(residual, start, method=m, max_nfev=2000).cost)
        for m in ("lm", "trf")
    )
    assert found.converged
    assert found.at.cost <= best + VALLEY
    assert found.at.cost <= costs[0]


def test_a_rise_that_was_promised_as_a_fall_is_not_settled() -> None:
    """What ended fits far from their optimum: a step that gains less than nothing counted as the last."""

    def wall(x: Array) -> Array:
        return np.array([10.0 - x[0] + 3.0 * np.maximum(x[0] - 1.0, 0.0) ** 2, 0.1 * x[0]])

    costs: list[float] = []
    found = minimise(problem(wall, costs), np.zeros(1))
    best = optimize.minimize_scalar(
        lambda x: float(np.sum(wall(np.array([x])) ** 2)), bounds=(0, 3), method="bounded"
    )
    assert found.converged
    assert found.at.cost == pytest.approx(float(best.fun), abs=2 * SETTLED)
    assert max(costs) > costs[0]  # it was tried, and refused


def test_a_model_that_does_not_follow_its_slope_has_not_converged() -> None:
    def liar(x: Array) -> Linear:
        return make_linear([5.0, 0.0], float(np.sum(np.abs(x))))

    found = minimise(liar, np.zeros(2))
    assert not found.converged
    assert "no step reduces the misfit" in found.reason
    assert not is_settled(found.at)


@pytest.mark.parametrize(("promise", "converged"), [(0.8, True), (2.5, True), (12.0, False)])
def test_a_small_promise_that_drowns_in_rounding_is_none(promise: float, converged: bool) -> None:
    """Of a record without noise the sum of squares scatters by some tenths from one point to the next."""

    def grainy(x: Array) -> Linear:
        return make_linear([promise**0.5, 0.0], 10.0 + 0.2 * float(np.sin(1e13 * np.sum(x))))

    assert minimise(grainy, np.zeros(2)).converged is converged


@pytest.mark.parametrize(("way", "trials"), [(1000, 22), (60, 60)])
def test_a_search_is_left_where_its_pace_would_not_bring_it_to_its_end(way: int, trials: int) -> None:
    seen: list[Array] = []

    def creeping(x: Array) -> Linear:
        seen.append(x)
        return make_linear([1e3 * max(0.0, 1.0 - len(seen) / way)], 1.0)

    assert minimise(creeping, np.zeros(1)).converged is (way == trials)
    assert len(seen) == pytest.approx(trials, abs=3)


def test_a_point_where_the_model_has_no_output_is_left_alone() -> None:
    def edge(x: Array) -> Linear:
        r = np.sqrt(1.0 - x[0]) if x[0] < 1.0 else np.inf
        if not np.isfinite(r):
            return make_linear([0.0], np.inf)
        slope = np.array([[-0.5 / r]])
        return Linear(add_prior(np.array([[slope[0, 0], -r], [0.0, 0.0]]), [0], 0.0 - x))

    found = minimise(edge, np.zeros(1))
    assert np.isfinite(found.at.cost)
    assert found.x[0] < 1.0
