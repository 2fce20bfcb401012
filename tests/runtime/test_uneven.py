"""Tests where the noise is not of known weights: its level follows the rotation, its scores scatter from block to block."""

from __future__ import annotations

import numpy as np
from scipy import linalg

from ragg_runtime.estimation.regressors import Column
from ragg_runtime.identification import likelihood_ratio, selection, uneven
from ragg_runtime.identification.selection import Field

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
