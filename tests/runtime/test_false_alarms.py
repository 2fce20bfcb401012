"""The levels of false alarm: that they add up, that records of noise keep to them, and that no other place has one."""

from __future__ import annotations

import numpy as np
from scipy import stats

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.identification import omnibus, selection
from ragg_runtime.identification.selection import Field
from ragg_runtime.model.model import packaged


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
