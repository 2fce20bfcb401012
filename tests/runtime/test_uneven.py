"""Tests and their levels: noise of unknown weights, levels of false alarm, and from when on a model no longer holds."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import linalg, stats
from scipy.integrate import trapezoid

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.identification import likelihood_ratio, omnibus, selection, uneven
from ragg_runtime.identification.selection import Field
from ragg_runtime.identification.sequential import SequentialTest, follow_model, log_e
from ragg_runtime.model import model
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.scenario import scenario

ROWS, BLOCKS = 2400, 24


def field(X: np.ndarray, y: np.ndarray, *, tempered: bool) -> Field:
    """An effect of one column, beside a base of two."""
    own = Column("e.x", None, 1.0, "1", 1.0, "e")
    M = np.column_stack([X, y])
    blocks = tuple(linalg.qr(part, mode="r")[0] for part in np.split(M, BLOCKS))
    T = linalg.qr(np.vstack(blocks), mode="economic")[1]
    return Field(T, 2, {"e": ((0, own),)}, ROWS, blocks=blocks if tempered else ())


def test_a_column_that_is_large_where_the_noise_is_loud_raises_no_alarm() -> None:
    """200 records at a level of 0.5 %."""
    rng = np.random.default_rng(1)
    plain = tempered = 0
    for _ in range(200):
        swing = np.exp(np.repeat(rng.normal(size=240), 10))  # a motion that comes in bouts
        X = rng.normal(size=(ROWS, 3)) * np.column_stack([np.ones((ROWS, 2)), swing])
        y = rng.normal(size=ROWS) * (1.0 + 0.5 * swing)
        y /= np.std(y)
        naive, sober = (field(X, y, tempered=t).tests()["e"] for t in (False, True))
        plain += selection.is_significant(naive, 1, selection.FURTHER)
        tempered += selection.is_significant(sober, 1, selection.FURTHER)
    assert plain > 20
    assert tempered <= 6


def test_even_noise_costs_little_and_what_is_there_is_found() -> None:
    rng = np.random.default_rng(2)
    lost = []
    for _ in range(40):
        X = rng.normal(size=(ROWS, 3))
        y = rng.normal(size=ROWS) + X @ [1.0, -1.0, 8.0 / np.sqrt(ROWS)]
        naive, sober = (field(X, y, tempered=t).tests()["e"] for t in (False, True))
        assert sober.chi2 == naive.chi2
        lost.append(sober.log_p / naive.log_p)
    assert np.mean(lost) > 0.7  # of 8 sigma; the ratio is known from 24 blocks only


def test_few_blocks_say_nothing() -> None:
    rng = np.random.default_rng(3)
    M = rng.normal(size=(70, 4))
    blocks = np.split(M, 7)
    assert uneven.inflation(uneven.ProjectedBlocks(M, blocks, 2, []), [2]) == 1.0
    t = likelihood_ratio.Test(30.0, 1, -14.0, (2,))
    assert uneven.temper_test(t, 1.0, np.inf, 24) is t
    assert -6.0 < uneven.temper_test(t, 3.0, np.inf, 24).log_p < -4.0 + np.log(10.0)


def test_the_levels_add_up_to_what_is_promised() -> None:
    candidates = packaged().candidates
    random = sum(e.kind == "random" for e in candidates)
    columns = sum(e.kind in ("deterministic", "step") for e in candidates)
    every = false_alarms.CATALOGUE * (1 + random / columns) + false_alarms.REMAINDER
    assert every < 0.0355 < false_alarms.PROMISED  # as the module says; the rest is left to the noise
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
        alarms += bool(selection.choose(Field(T, 0, columns, 90)).chosen)
    assert stats.binom.sf(alarms - 1, runs, false_alarms.CATALOGUE) > 0.01, alarms


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


def followed(*hidden: dict[str, dict[str, list[float]]]) -> SequentialTest:
    s = scenario(3, duration=480.0)
    flights = [s.simulate(h).flight(f"leg {n}") for n, h in enumerate(hidden)]
    return follow_model(fitted.fit(model.packaged(), s.sheet, observe_flights(flights, s.sheet)))


def test_a_model_that_holds_is_let_be() -> None:
    found = followed({})
    assert found.change is None
    assert found.log_m.max() < found.limit
    assert len(found.time) == 24


def test_the_block_in_which_a_scale_factor_jumps_is_named() -> None:
    found = followed({"gain-step": {"dK1": [0, 0, 3e-6, 0], "t_step": [250.0]}})
    assert found.change is not None
    assert found.change.until == pytest.approx(240.0, abs=20.0)


def test_a_change_between_two_flights_is_named_with_its_flight() -> None:
    # Within the second flight the scale factor is constant: the two do not agree on it.
    found = followed({}, {"gain-step": {"dK1": [0, 0, 3e-6, 0], "t_step": [-10.0]}})
    assert found.change is not None
    assert (found.change.flight, found.change.until) == ("leg 1", 0.0)


def test_a_model_that_never_held_has_not_changed() -> None:
    found = followed({"lag": {"tau": [1e-7, 0, 0, 0]}})
    assert found.log_m[0] > found.limit
    assert found.change is None
