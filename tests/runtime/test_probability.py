"""Probabilities of effects: against evidence by direct integration, and their coverage on drawn records."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats

from ragg_runtime.estimation.regressors import Column
from ragg_runtime.estimation.scores import Error
from ragg_runtime.identification import likelihood_ratio
from ragg_runtime.identification.likelihood_ratio import STRENGTHS
from ragg_runtime.identification.probability import HELD, Probabilities, weigh_sets
from ragg_runtime.identification.ranking import Ranked, add_probability
from ragg_runtime.identification.selection import Field

Array = NDArray[np.float64]


def field(X: Array, y: Array) -> Field:
    """One shared parameter an effect, no base."""
    T = np.linalg.qr(np.column_stack([X, y]), mode="r")
    names = [f"e{k}" for k in range(X.shape[1])]
    columns = {e: ((k, Column(f"{e}.x", None, 1.0, "1", 1.0, e)),) for k, e in enumerate(names)}
    return Field(T, 0, columns, len(y))


def drawn(rng: np.random.Generator, n: int = 60, effects: int = 7) -> Array:
    X = rng.normal(size=(n, effects))
    X[:, 1] = 0.97 * X[:, 0] + 0.25 * X[:, 1]  # two that are hard to tell apart
    return X / np.linalg.norm(X, axis=0) * 5.0


def test_evidence_is_that_of_the_gaussian_itself() -> None:
    """B_S is the density of y under N(0, I + g X (X'X)^-1 X') over that under N(0, I)."""
    rng = np.random.default_rng(1)
    X = drawn(rng, 30, 3)
    y = X @ [1.0, 0.0, -0.5] + rng.normal(size=30)
    expected = {}
    for s in ((), (0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (0, 1, 2)):
        Z = X[:, list(s)]
        H = Z @ np.linalg.pinv(Z) if s else np.zeros((30, 30))
        logs = [stats.multivariate_normal(np.zeros(30), np.eye(30) + g * H).logpdf(y) for g in STRENGTHS]
        expected[s] = np.exp(logs).mean() * (1 / 3) ** len(s) * (2 / 3) ** (3 - len(s))
    total = sum(expected.values())
    sets = weigh_sets(field(X, y))
    found = {tuple(np.flatnonzero(s).tolist()): log for s, log in zip(sets.holds, sets.logs, strict=True)}
    assert sets.effects == ("e0", "e1", "e2") and found.keys() == expected.keys()
    for s, weight in expected.items():
        assert np.exp(found[s] - np.logaddexp.reduce(sets.logs)) == pytest.approx(weight / total, rel=1e-6)


def test_the_credible_set_holds_the_truth_as_often_as_it_says() -> None:
    """Truths drawn from the prior: the sets that together hold 95 % hold the truth in at least that many of 400."""
    rng = np.random.default_rng(7)
    held = 0
    for _ in range(400):
        X = drawn(rng)
        truth = tuple(k for k in range(7) if rng.random() < 1 / 7)[:3]
        Z = X[:, list(truth)]
        b = np.zeros(len(truth))
        if truth:
            R = np.linalg.qr(Z, mode="r")
            b = np.linalg.solve(R, rng.normal(size=len(truth))) * np.sqrt(rng.choice(STRENGTHS))
        y = Z @ b + rng.normal(size=len(X))
        held += tuple(f"e{k}" for k in truth) in weigh_sets(field(X, y)).probabilities().credible
    assert held >= stats.binom.ppf(0.001, 400, HELD)


def test_two_that_the_record_cannot_tell_apart_share_the_probability() -> None:
    rng = np.random.default_rng(3)
    X = drawn(rng)
    X[:, 1] = X[:, 0]
    y = X[:, 0] * 4.0 + rng.normal(size=len(X))
    found = weigh_sets(field(X, y)).probabilities()
    assert found.of["e0"] == pytest.approx(found.of["e1"])
    assert 0.4 < found.of["e0"] < 0.6
    assert {("e0",), ("e1",)} <= set(found.credible)


def test_nothing_is_missing_in_noise() -> None:
    rng = np.random.default_rng(5)
    X = drawn(rng)
    found = weigh_sets(field(X, rng.normal(size=len(X)))).probabilities()
    assert found.credible[0] == ()
    assert max(found.of.values()) < 0.3


def test_what_is_sure_shares_its_place_with_its_rivals() -> None:
    """Sets of one of two rivals more: each half of the weight, and what two ways make alike is added."""
    sets = weigh_sets(field(*_alike()))
    beside = sets.with_one_of(("e1", "z"))
    found = dict(zip((tuple(np.flatnonzero(s)) for s in beside.holds), np.exp(beside.logs), strict=True))
    before = dict(zip((tuple(np.flatnonzero(s)) for s in sets.holds), np.exp(sets.logs), strict=True))
    assert beside.effects == ("e0", "e1", "z")
    assert found[1,] == pytest.approx((before[()] + before[1,]) / 2)
    assert found[2,] == pytest.approx(before[()] / 2)
    assert found[1, 2] == pytest.approx(before[1,] / 2)
    assert found[0, 1] == pytest.approx((before[0,] + before[0, 1]) / 2)
    assert sum(found.values()) == pytest.approx(sum(before.values()))


def _alike() -> tuple[Array, Array]:
    X = drawn(np.random.default_rng(9), 30, 2)
    return X, X @ [0.4, 0.2] + np.random.default_rng(10).normal(size=30)


def test_of_an_effect_that_the_model_explains_otherwise_or_does_without_it_is_none() -> None:
    """A twin that did worse in the model is no column of what is left any more: 1.0 was said of it, by its p-value, beside the
    1.0 of the right one. Of random effects the p-value is all there is.
    """
    error = Error(*(1.0,) * 4)
    found = Probabilities({"right": 1.0, "faint": 0.02}, (("right",),))
    said = {}
    for effect, log_p in (("right", -900.0), ("faint", -3.0), ("twin", -890.0), ("random", -9.0)):
        row = Ranked.without_columns(effect, likelihood_ratio.Test(1.0, 1, log_p, ()), error)
        said[effect] = add_probability(row, found, {"right", "faint", "twin"}).probability
    assert (said["right"], said["faint"], said["twin"]) == (1.0, 0.02, 0.0)
    assert said["random"] is None
