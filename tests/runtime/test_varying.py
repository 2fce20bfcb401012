"""Terms whose coefficient varies: noise does not raise them, and each way of varying is seen and said."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats

from ragg_runtime.estimation.whitening import Piece
from ragg_runtime.identification.time_varying import BlockScores

Array = NDArray[np.float64]

RATE, SAMPLES, TERMS = 16.0, 9600, 40
TIME = np.arange(SAMPLES) / RATE


def _piece(sample: NDArray[np.intp]) -> Piece:
    return cast(Piece, SimpleNamespace(sample=sample))


def _scores(y: Array, X: Array, cuts: tuple[int, ...] = ()) -> BlockScores:
    """Over segments that end at ``cuts``, one after the other."""
    total = BlockScores(len(X), TIME)
    for rows in np.split(np.arange(SAMPLES), list(cuts)):
        total.level(_piece(rows), y[rows])
        half = len(X) // 2
        for at in (slice(0, half), slice(half, len(X) + 7)):  # more terms than are asked about
            columns = X[at, rows] if at.start == 0 else np.concatenate([X[half:, rows], X[:7, rows]])
            total.add(_piece(rows), y[rows], at, columns)
    return total


def _columns(rng: np.random.Generator) -> Array:
    """Slow and fast columns, of power that is not the same throughout."""
    k = np.arange(1, TERMS + 1)[:, None]
    swell = 1.0 + 0.8 * np.sin(2 * np.pi * TIME / 400.0)
    return np.asarray(np.sin(0.3 * k * TIME + rng.uniform(0, 6, (TERMS, 1))) * swell)


def test_noise_raises_none_and_segments_leave_no_trace() -> None:
    rng = np.random.default_rng(3)
    X = _columns(rng)
    everything = np.ones(TERMS, dtype=bool)
    found = []
    for n in range(200):
        loud = 1.0 + 0.3 * np.sin(2 * np.pi * TIME / 600.0) * (n % 2)  # every other not quite stationary
        y = rng.standard_normal(SAMPLES) * loud
        best = _scores(y, X).best(everything)
        assert best is not None
        found.append(best.log_p)
        if n == 0:
            parts = _scores(y, X, (1000, 1003, 5000)).best(everything)
            assert parts is not None
            assert (parts.place, parts.how) == (best.place, best.how)
            assert parts.chi2 == pytest.approx(best.chi2, rel=1e-5)
    for level in (0.05, 0.2):
        assert np.sum(np.array(found) < np.log(level)) <= stats.binom.ppf(0.999, len(found), level)


@pytest.mark.parametrize(
    ("shape", "said"),
    [
        (np.where(np.abs(TIME - 250.0) < 20.0, 1.0, 0.0), "from"),
        (np.where(TIME > 300.0, 1.0, -1.0), "since"),
        (np.cos(2 * np.pi * TIME / 40.0 + 1.0), "with a period of 40 s"),
        (np.random.default_rng(1).standard_normal(24).repeat(SAMPLES // 24), "from block to block"),
    ],
)
def test_each_way_of_varying_is_seen_and_said(shape: Array, said: str) -> None:
    rng = np.random.default_rng(4)
    X = _columns(rng)
    change = shape * X[11]
    change *= 11.0 / np.linalg.norm(change)
    best = _scores(rng.standard_normal(SAMPLES) + change, X).best(np.ones(TERMS, dtype=bool))
    assert best is not None
    assert best.log_p < np.log(1e-3)
    assert best.place == 11
    assert said in best.how
    rms = float(np.sqrt(np.mean(shape**2))) * 11.0 / np.linalg.norm(shape * X[11])
    assert best.coefficient == pytest.approx(rms, rel=0.35)


def test_what_is_not_good_is_not_asked_about() -> None:
    rng = np.random.default_rng(5)
    X = _columns(rng)
    y = rng.standard_normal(SAMPLES) + 0.5 * X[3] * (TIME > 500.0)
    good = np.ones(TERMS, dtype=bool)
    assert (best := _scores(y, X).best(good)) is not None
    assert best.place == 3
    good[3] = False
    assert (best := _scores(y, X).best(good)) is not None
    assert best.place != 3
    assert _scores(y, X).best(np.zeros(TERMS, dtype=bool)) is None
