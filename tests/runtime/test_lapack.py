"""Rows enter a triangle with or without Python's lock: the same bits, and the inner products of all rows."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from ragg_runtime.fit import lapack
from ragg_runtime.fit.square_root import WORTH_TWO, fold, of_stretches, triangle


@pytest.mark.parametrize("n", [1, 7, 40, 130])
@pytest.mark.parametrize("trapezoid", [False, True])
def test_without_the_lock_it_is_the_same_routine(n: int, trapezoid: bool) -> None:
    rng = np.random.default_rng(n)
    R = np.asfortranarray(np.triu(rng.normal(size=(n, n))))
    part = np.asfortranarray(rng.normal(size=(n, n)))
    part = np.asfortranarray(np.triu(part)) if trapezoid else part
    rows = len(part) if trapezoid else 0
    assert lapack._address("dtpqrt") is not None
    bare, wrapped = R.copy(order="F"), R.copy(order="F")
    lapack.entered(bare, part.copy(order="F"), rows)
    lapack._wrapped(wrapped, part.copy(order="F"), rows, min(lapack.PANEL, n))
    assert np.array_equal(bare, wrapped)
    assert np.allclose(bare.T @ bare, R.T @ R + part.T @ part, rtol=1e-12, atol=1e-12 * n)


def test_columns_that_lapack_cannot_take_are_refused() -> None:
    with pytest.raises(ValueError, match="one after the other"):
        lapack.entered(np.zeros((3, 3)), np.zeros((5, 3)))


def test_triangles_keep_inner_products_over_fifteen_decades_and_in_any_thread() -> None:
    rng = np.random.default_rng(8)
    columns = rng.normal(size=(30, WORTH_TWO + 77)) * np.logspace(0, -15, 30)[:, None]
    with ThreadPoolExecutor(4) as pool:
        every = list(pool.map(triangle, [columns] * 8))
    assert all(np.array_equal(T, every[0]) for T in every)
    norms = np.linalg.norm(columns, axis=1)
    right = columns @ columns.T / np.outer(norms, norms)
    assert np.allclose(every[0].T @ every[0] / np.outer(norms, norms), right, atol=1e-13)


def test_many_trapezoids_are_those_one_after_the_other() -> None:
    rng = np.random.default_rng(9)
    parts = [np.triu(rng.normal(size=(m, 12))) for m in (12, 5, 12, 12, 3, 12, 7, 12, 12)]
    T = fold(parts)
    assert np.allclose(T.T @ T, sum(p.T @ p for p in parts), atol=1e-12)
    assert np.array_equal(T, np.triu(T))


@pytest.mark.parametrize("rows", [12, 90])
def test_stretches_of_rows_are_the_whole_whatever_is_zero_in_them(rows: int) -> None:
    """Voltages: columns of one accelerometer, of all, of a channel that was not recorded; and a stretch that all columns are in."""
    rng = np.random.default_rng(rows)
    stretches = [rng.normal(size=(30, rows)) for _ in range(4)]
    for j, x in enumerate(stretches[:3]):
        own = np.arange(30) % 4
        x[(own != j) & (np.arange(30) < 24)] = 0.0
    whole = np.concatenate(stretches, axis=1)
    T = of_stretches(stretches)
    assert T.shape == (30, 30)
    assert np.array_equal(T, np.triu(T))
    assert pytest.approx(whole @ whole.T, abs=1e-11) == T.T @ T
    for x in stretches:
        x[5] = 0.0
    assert not of_stretches(stretches)[:, 5].any()
    nothing = [np.empty((30, 0)), np.zeros((30, rows))]
    assert not of_stretches(nothing).any()
    with_it = of_stretches([nothing[0], whole, nothing[1]])
    assert with_it.T @ with_it == pytest.approx(whole @ whole.T, abs=1e-11)
