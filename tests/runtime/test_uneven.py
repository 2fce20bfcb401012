"""Tests, their levels and probabilities: uneven noise, false alarms, until when a model holds, what each effect is worth."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import linalg, stats
from scipy.integrate import trapezoid

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.estimation.scores import Error
from ragg_runtime.identification import likelihood_ratio, omnibus, selection, uneven
from ragg_runtime.identification.likelihood_ratio import STRENGTHS
from ragg_runtime.identification.probability import HELD, Probabilities, weigh_sets
from ragg_runtime.identification.ranking import Ranked, add_probability
from ragg_runtime.identification.selection import ProjectedProblem
from ragg_runtime.identification.sequential import ChangePoint, find_change, log_e
from ragg_runtime.model import model
from ragg_runtime.model.model import load_packaged
from ragg_runtime.reference.scenario import scenario

ROWS = 2400


@dataclass(frozen=True)
class Whitened:
    """Of a flight what the tests read: its whitened columns (columns, rows)."""

    white: np.ndarray

    def lean(self, places: Sequence[int]) -> tuple[Whitened, list[int]]:
        return self, list(places)

    def each(self, work: Callable[[Whitened], np.ndarray]) -> list[np.ndarray]:
        return [work(replace(self, white=part)) for part in np.array_split(self.white, 3, axis=1)]


def field(X: np.ndarray, y: np.ndarray, *, tempered: bool) -> ProjectedProblem:
    """An effect of one column, beside a base of two."""
    own = Column("e.x", None, 1.0, "1", 1.0, "e")
    M = np.column_stack([X, y])
    T = linalg.qr(M, mode="economic")[1]
    return ProjectedProblem(T, 2, {"e": ((0, own),)}, flights=(Whitened(M.T),) if tempered else ())  # type: ignore[arg-type]


def test_a_column_that_is_large_where_the_noise_is_loud_raises_no_alarm() -> None:
    """400 records: the tempered p-value is uniform."""
    rng = np.random.default_rng(1)
    p = []
    for _ in range(400):
        swing = np.exp(np.repeat(rng.normal(size=240), 10))  # a motion that comes in bouts
        X = rng.normal(size=(ROWS, 3)) * np.column_stack([np.ones((ROWS, 2)), swing])
        y = rng.normal(size=ROWS) * (1.0 + 0.5 * swing)
        y /= np.std(y)
        p.append([np.exp(field(X, y, tempered=t).tests()["e"].log_p) for t in (False, True)])
    plain, tempered = (np.sum(np.array(p) < level, axis=0) for level in (0.005, 0.03))
    assert plain[0] > 40
    assert stats.binom.sf(plain[1] - 1, 400, 0.005) > 0.01
    assert 5 <= tempered[1] <= 20


def test_even_noise_costs_little_and_what_is_there_is_found() -> None:
    rng = np.random.default_rng(2)
    lost = []
    for _ in range(40):
        X = rng.normal(size=(ROWS, 3))
        y = rng.normal(size=ROWS) + X @ [1.0, -1.0, 8.0 / np.sqrt(ROWS)]
        naive, sober = (field(X, y, tempered=t).tests()["e"] for t in (False, True))
        assert sober.chi2 == naive.chi2
        lost.append(sober.log_p / naive.log_p)
    assert np.mean(lost) > 0.95  # of 8 sigma: 2,400 samples know the variance


def test_what_few_samples_tell_is_worth_less() -> None:
    """A test is no surer than the samples that carry it: of two a hundred sigma are no certainty."""
    few = np.zeros((ROWS, 1))
    few[:2] = 1.0
    scatter = uneven.Scatter.from_sums(uneven.Scatter.of(few, np.full((ROWS, 1), 2.0)))
    assert (scatter.inflation[0], scatter.freedom[0]) == (4.0, 2.0)
    t = likelihood_ratio.Test(30.0, 1, -14.0, (2,))
    assert uneven.temper_test(t, 1.0, 2.0) is t
    assert uneven.temper_test(t, 1.1, 1000.0).log_p < -12.0
    assert uneven.temper_test(t, 1.1, 2.0).log_p > -2.0


def test_the_levels_add_up_to_what_is_promised() -> None:
    candidates = load_packaged().candidates
    random = sum(e.kind == "random" for e in candidates)
    columns = sum(e.kind in ("deterministic", "step") for e in candidates)
    every = false_alarms.CATALOGUE * (1 + random / columns) + false_alarms.REMAINDER
    every += false_alarms.REMAINDER * false_alarms.REMAINDER_SHARES[0]
    assert every < 0.0375 < false_alarms.PROMISED  # as the module says; the rest is left to the noise
    assert sum(false_alarms.REMAINDER_SHARES) == 1.0
    assert (selection.MOST - 1) * false_alarms.COMPANION < false_alarms.CATALOGUE


def test_records_of_noise_keep_to_the_level_of_the_catalogue() -> None:
    """250 records of unit noise, 12 effects of four accelerometers with one or two parameters: some 50 ways to err."""
    rng = np.random.default_rng(5)
    alarms, runs = 0, 250
    for _ in range(runs):
        columns: dict[str, tuple[tuple[int, Column], ...]] = {}
        n = 0
        for e in range(12):
            names = [f"e{e}.x"] if e % 2 else [f"e{e}.x", f"e{e}.y"]
            own = [(name, a) for name in names for a in (1, 2, 3, 4)]
            columns[f"e{e}"] = tuple(
                (n + k, Column(name, a, 1.0, "1", 1.0, f"e{e}")) for k, (name, a) in enumerate(own)
            )
            n += len(own)
        X = rng.normal(size=(90, n))
        X[:, 1::2] += 2.0 * X[:, ::2]  # accelerometers of one disc look alike
        T = np.linalg.qr(np.column_stack([X, rng.normal(size=90)]), mode="r")
        alarms += bool(selection.choose(ProjectedProblem(T, 0, columns)))
    assert stats.binom.sf(alarms - 1, runs, false_alarms.CATALOGUE) > 0.01, alarms


def test_of_two_effects_those_accelerometers_are_chosen_that_have_both() -> None:
    rng = np.random.default_rng(0)
    u, r, w, z = np.linalg.qr(rng.normal(size=(400, 4)))[0].T
    v = 0.9 * u + 0.44 * r
    X = np.column_stack([u, u + 0.3 * w, v, v + 0.3 * z])
    T = np.linalg.qr(np.column_stack([X, X @ [0.0, 60.0, 0.0, -60.0] + rng.normal(size=400)]), mode="r")
    columns = {
        e: tuple((2 * k + a, Column(f"{e}.x", a + 1, 1.0, "1", 1.0, e)) for a in range(2))
        for k, e in enumerate("ef")
    }
    assert selection.choose(ProjectedProblem(T, 0, columns)) == {"e": (1,), "f": (3,)}


def test_the_largest_of_many_scores_keeps_to_the_level_of_the_remainder() -> None:
    rng = np.random.default_rng(6)
    level, tried, runs = 0.2, 2000, 2000  # a level at which 2,000 records tell; the p-value knows none
    p = np.array([np.exp(omnibus._log_p(rng.normal(size=tried), tried)) for _ in range(runs)])
    share = np.mean(p < level)
    assert share < level * false_alarms.REMAINDER_SHARES[0] + 3 * np.sqrt(level / runs)
    assert share > 0.6 * level * false_alarms.REMAINDER_SHARES[0]  # and is not so strict that it says nothing


def test_an_e_value_has_mean_one_under_the_null() -> None:
    """By quadrature, to 2e-5: rare, huge values carry much of the mean, which no sample would show."""
    z = np.concatenate([[0.0], np.logspace(-3, 6, 2001)])
    logs = np.array([log_e(np.array([x])) for x in z])
    density = np.exp(logs - z**2 / 2) / np.sqrt(2 * np.pi)
    assert 2 * trapezoid(density, z) == pytest.approx(1.0, abs=1e-3)


def followed(*hidden: dict[str, dict[str, list[float]]]) -> ChangePoint | None:
    s = scenario(3, duration=480.0)
    flights = [s.simulate(h).flight(f"leg {n}") for n, h in enumerate(hidden)]
    return find_change(
        fitted.fit(model.load_packaged(), s.sheet, observe_flights(flights, s.sheet), candidates=False)
    )


def test_a_model_that_holds_is_let_be() -> None:
    assert followed({}) is None


def test_the_block_in_which_a_scale_factor_jumps_is_named() -> None:
    found = followed({"gain-step": {"dK1": [0, 0, 3e-6, 0], "t_step": [250.0]}})
    assert found is not None
    assert found.until == pytest.approx(240.0, abs=20.0)


def test_a_change_between_two_flights_is_named_with_its_flight() -> None:
    # Within the second flight the scale factor is constant: the two do not agree on it.
    found = followed({}, {"gain-step": {"dK1": [0, 0, 3e-6, 0], "t_step": [-10.0]}})
    assert found == ChangePoint("leg 1", 0.0)


def test_a_model_that_never_held_has_not_changed() -> None:
    assert followed({"lag": {"tau": [4e-7, 0, 0, 0]}}) is None  # of 1e-7 rounding decides


Array = NDArray[np.float64]


def field_of(X: Array, y: Array) -> ProjectedProblem:
    """One shared parameter an effect, no base."""
    T = np.linalg.qr(np.column_stack([X, y]), mode="r")
    names = [f"e{k}" for k in range(X.shape[1])]
    columns = {e: ((k, Column(f"{e}.x", None, 1.0, "1", 1.0, e)),) for k, e in enumerate(names)}
    return ProjectedProblem(T, 0, columns)


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
    sets = weigh_sets(field_of(X, y))
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
        held += tuple(f"e{k}" for k in truth) in weigh_sets(field_of(X, y)).probabilities().credible
    assert held >= stats.binom.ppf(0.001, 400, HELD)


def test_two_that_the_record_cannot_tell_apart_share_the_probability() -> None:
    rng = np.random.default_rng(3)
    X = drawn(rng)
    X[:, 1] = X[:, 0]
    y = X[:, 0] * 4.0 + rng.normal(size=len(X))
    found = weigh_sets(field_of(X, y)).probabilities()
    assert found.of["e0"] == pytest.approx(found.of["e1"])
    assert 0.4 < found.of["e0"] < 0.6
    assert {("e0",), ("e1",)} <= set(found.credible)


def test_nothing_is_missing_in_noise() -> None:
    rng = np.random.default_rng(5)
    X = drawn(rng)
    found = weigh_sets(field_of(X, rng.normal(size=len(X)))).probabilities()
    assert found.credible[0] == ()
    assert max(found.of.values()) < 0.3


def test_what_is_sure_shares_its_place_with_its_rivals() -> None:
    """Sets of one of two rivals more: each half of the weight, and what two ways make alike is added."""
    sets = weigh_sets(field_of(*_alike()))
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
