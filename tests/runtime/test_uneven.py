"""Tests, their levels and probabilities: uneven noise, false alarms, until when a model holds, what each effect is worth."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats
from scipy.integrate import trapezoid

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation import fitted, likelihood_ratio
from ragg_runtime.estimation.likelihood_ratio import STRENGTHS
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.estimation.scores import Error
from ragg_runtime.identification import selection
from ragg_runtime.identification.consistency import find_change, log_e
from ragg_runtime.identification.ranking import HELD, Probabilities, Ranked, add_probability, weigh_effects
from ragg_runtime.identification.selection import ProjectedProblem
from ragg_runtime.model.model import load_packaged
from ragg_runtime.reference.scenario import scenario
from tests.simulated import RATE

Array = NDArray[np.float64]

ROWS = 2400


@dataclass(frozen=True)
class Whitened:
    """Of a flight what the tests read: its whitened columns (columns, rows)."""

    white: Array

    def lean(self, places: Sequence[int]) -> tuple[Whitened, list[int]]:
        return self, list(places)

    def each(self, work: Callable[[Whitened], Array]) -> list[Array]:
        return [work(replace(self, white=part)) for part in np.array_split(self.white, 3, axis=1)]


def field(X: Array, y: Array, names: Sequence[str], n_base: int = 0, **options: Any) -> ProjectedProblem:
    """Effects by the names of the columns after those of the base: "e", or "e.x1" of the first accelerometer."""
    columns: dict[str, tuple[tuple[int, Column], ...]] = {}
    for k, name in enumerate(names):
        effect, _, tag = name.partition(".")
        column = Column(f"{effect}.{tag[:1] or 'x'}", int(tag[1:]) if tag else None, 1.0, "1", 1.0, effect)
        columns[effect] = (*columns.get(effect, ()), (k, column))
    T = np.linalg.qr(np.column_stack([X, y]), mode="r")
    return ProjectedProblem(T, n_base, columns, **options)


def weigh(X: Array, y: Array) -> list[likelihood_ratio.Test]:
    """An effect of one column, beside a base of two: by even noise, and tempered."""
    white: Any = (Whitened(np.column_stack([X, y]).T),)
    return [field(X, y, ["e"], 2, flights=f).tests()["e"] for f in ((), white)]


def test_a_column_that_is_large_where_the_noise_is_loud_raises_no_alarm() -> None:
    """400 records: the tempered p-value is uniform."""
    rng = np.random.default_rng(1)
    p = []
    for _ in range(400):
        swing = np.exp(np.repeat(rng.normal(size=240), 10))  # a motion that comes in bouts
        X = rng.normal(size=(ROWS, 3)) * np.column_stack([np.ones((ROWS, 2)), swing])
        y = rng.normal(size=ROWS) * (1.0 + 0.5 * swing)
        y /= np.std(y)
        p.append([np.exp(t.log_p) for t in weigh(X, y)])
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
        naive, sober = weigh(X, y)
        assert sober.chi2 == naive.chi2
        lost.append(sober.log_p / naive.log_p)
    assert np.mean(lost) > 0.95  # of 8 sigma: 2,400 samples know the variance


def test_the_levels_add_up_to_what_is_promised() -> None:
    candidates = load_packaged().candidates
    random = sum(e.kind == "random" for e in candidates)
    columns = sum(e.kind in ("deterministic", "step") for e in candidates)
    total = false_alarms.CATALOGUE * (1 + random / columns) + false_alarms.REMAINDER
    total += false_alarms.REMAINDER * false_alarms.REMAINDER_SHARE
    assert total < 0.0375 < false_alarms.PROMISED  # as the module says; the rest is left to the noise
    assert (selection.MOST - 1) * false_alarms.COMPANION < false_alarms.CATALOGUE


def test_records_of_noise_keep_to_the_level_of_the_catalogue() -> None:
    """250 records of unit noise, 12 effects of four accelerometers with one or two parameters: some 50 ways to err."""
    rng = np.random.default_rng(5)
    names = [f"e{e}.{n}{a}" for e in range(12) for n in ("xy" if e % 2 == 0 else "x") for a in (1, 2, 3, 4)]
    alarms, runs = 0, 250
    for _ in range(runs):
        X = rng.normal(size=(90, len(names)))
        X[:, 1::2] += 2.0 * X[:, ::2]  # accelerometers of one disc look alike
        alarms += bool(selection.choose(field(X, rng.normal(size=90), names)))
    assert stats.binom.sf(alarms - 1, runs, false_alarms.CATALOGUE) > 0.01, alarms


def test_of_two_effects_those_accelerometers_are_chosen_that_have_both() -> None:
    rng = np.random.default_rng(0)
    u, r, w, z = np.linalg.qr(rng.normal(size=(400, 4)))[0].T
    v = 0.9 * u + 0.44 * r
    X = np.column_stack([u, u + 0.3 * w, v, v + 0.3 * z])
    y = X @ [0.0, 60.0, 0.0, -60.0] + rng.normal(size=400)
    choice = selection.choose(field(X, y, ["e.x1", "e.x2", "f.x1", "f.x2"]))
    assert choice == {"e": (1,), "f": (3,)}


def test_an_e_value_has_mean_one_under_the_null() -> None:
    """By quadrature, to 2e-5: rare, huge values carry much of the mean, which no sample would show."""
    z = np.concatenate([[0.0], np.logspace(-3, 6, 2001)])
    logs = np.array([log_e(np.array([x])) for x in z])
    density = np.exp(logs - z**2 / 2) / np.sqrt(2 * np.pi)
    assert 2 * trapezoid(density, z) == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(
    ("second", "found"),
    [
        ([{}], None),
        ([{"gain-step": {"dK1": [0, 0, 3e-6, 0], "t_step": [250.0]}}], ("leg 0", 240.0)),
        # within the second flight the scale factor is constant: the two do not agree on it
        ([{}, {"gain-step": {"dK1": [0, 0, 3e-6, 0], "t_step": [-10.0]}}], ("leg 1", 0.0)),
        # a model that never held has not changed; of 1e-7 rounding decides
        ([{"lag": {"tau": [4e-7, 0, 0, 0]}}], None),
    ],
    ids=["holds", "jumps", "another flight", "never held"],
)
def test_the_block_until_which_a_model_holds_is_named(second, found) -> None:
    s = scenario(3, duration=480.0, rate=RATE)
    flights = [s.simulate(h).flight(f"leg {n}") for n, h in enumerate(second)]
    o = observe_flights(flights, s.sheet)
    change = find_change(fitted.fit(load_packaged(), s.sheet, o, candidates=False))
    assert (change is None) == (found is None)
    if change is not None:
        assert (change.flight, change.until) == (found[0], pytest.approx(found[1], abs=20.0))


def field_of(X: Array, y: Array) -> ProjectedProblem:
    """One shared parameter an effect, no base."""
    return field(X, y, [f"e{k}" for k in range(X.shape[1])])


def drawn(rng: np.random.Generator, n: int = 60, effects: int = 7) -> Array:
    X = rng.normal(size=(n, effects))
    X[:, 1] = 0.97 * X[:, 0] + 0.25 * X[:, 1]  # two that are hard to tell apart
    return X / np.linalg.norm(X, axis=0) * 5.0


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
        held += tuple(f"e{k}" for k in truth) in weigh_effects(field_of(X, y), ()).credible
    assert held >= stats.binom.ppf(0.001, 400, HELD)


def test_two_that_the_record_cannot_tell_apart_share_the_probability_and_noise_has_none() -> None:
    rng = np.random.default_rng(3)
    X = drawn(rng)
    X[:, 1] = X[:, 0]
    weights = weigh_effects(field_of(X, X[:, 0] * 4.0 + rng.normal(size=len(X))), ())
    assert weights.of["e0"] == pytest.approx(weights.of["e1"])
    assert 0.4 < weights.of["e0"] < 0.6
    assert {("e0",), ("e1",)} <= set(weights.credible)
    nothing = weigh_effects(field_of(drawn(rng), rng.normal(size=60)), ())
    assert nothing.credible[0] == ()
    assert max(nothing.of.values()) < 0.3


def test_of_an_effect_that_the_model_explains_otherwise_or_does_without_it_is_none() -> None:
    """A twin that did worse in the model is no column of what is left any more: 1.0 was said of it, by its p-value, beside the
    1.0 of the right one. Of random effects the p-value is all there is.
    """
    error = Error(*(1.0,) * 4)
    probabilities = Probabilities({"right": 1.0, "faint": 0.02}, (("right",),))
    values = {}
    for effect, log_p in (("right", -900.0), ("faint", -3.0), ("twin", -890.0), ("random", -9.0)):
        row = Ranked.without_columns(effect, likelihood_ratio.Test(1.0, 1, log_p, ()), error)
        values[effect] = add_probability(row, probabilities, {"right", "faint", "twin"}).probability
    assert (values["right"], values["faint"], values["twin"]) == (1.0, 0.02, 0.0)
    assert values["random"] is None
