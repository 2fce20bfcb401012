"""Scores that vary more than they should: what tests are worth where the noise is not one of known weights.

A likelihood-ratio test trusts that whitened noise has unit variance everywhere. Where the noise's level was seen to change
(``estimation.noise``) the weights are estimates by groups, tails are heavy, and a term that is large in a few swings
of the motion rides on them. The squares of the residual, weighted by those of what is tested, give the real variance of its score
(H. White, Econometrica 48, 1980): its ratio to what unit variance gives divides chi-square (J. N. K. Rao, A. J. Scott, Ann. Stat. 12,
1984, first-order correction). It is known from as many samples as carry the score (F. Satterthwaite, Biometrics 2, 1946): the test then
follows Fisher's F, as one of a variance that was estimated.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.estimation.whitening import Piece, PreparedFlight
from ragg_runtime.identification.likelihood_ratio import Test, log_bayes

Array = NDArray[np.float64]

DIRECTIONS = 1e-7
"""Relative size below which a direction of the tested columns is rounding."""


@dataclass(frozen=True)
class Scatter:
    """How much more than they should the scores of some tests vary, (m,), and the degrees of freedom (m,) that tell it."""

    inflation: Array
    freedom: Array

    @staticmethod
    def of(direction: Array, left: Array) -> Array:
        """(3, m): the sums over samples that it follows from: directions (rows, m), and what is left beside each (rows, m)."""
        square = direction**2
        return np.stack([np.sum(square, axis=0), np.sum(square**2, axis=0), np.sum(square * left**2, axis=0)])

    @staticmethod
    def from_sums(sums: Array) -> Scatter:
        """Of the sums (3, m) of all samples."""
        square, fourth, score = sums
        return Scatter(np.maximum(1.0, score / square), square**2 / fourth)


def measure_scatter(
    T: Array, flights: Sequence[PreparedFlight], given: Sequence[int], tests: Sequence[Sequence[int]]
) -> Scatter:
    """Of each of some tests, of so many columns of an R factor [columns | data], beside those ``given``: along what is fitted, beside it,
    so that what is tested raises no doubt of itself. ``flights``: those that the R factor is of.
    """
    # (given, columns + 1): what those given explain of every column, and of the data
    B = np.linalg.lstsq(T[:, given], T, rcond=None)[0]
    n, columns = len(given), sorted({k for tested in tests for k in tested})
    along, left = np.zeros((2, n + len(columns), len(tests)))
    for m, tested in enumerate(tests):
        X, y = (T[:, k] - T[:, given] @ B[:, k] for k in (tested, [-1]))
        g = np.linalg.lstsq(X, y, rcond=DIRECTIONS)[0][:, 0]
        along[[n + columns.index(k) for k in tested], m] = g
        along[:n, m] = -B[:, tested] @ g
        left[:, m] = -along[:, m]
        left[:n, m] -= B[:, -1]
    sums = np.zeros((3, len(tests)))
    for x in flights:
        lean, own = x.lean([*given, *columns])

        def of(piece: Piece, own: Sequence[int] = own) -> Array:
            X = piece.white[own].T
            return Scatter.of(X @ along, piece.white[-1][:, None] + X @ left)

        sums += sum(lean.each(of))
    return Scatter.from_sums(sums)


def temper_test(t: Test, by: float, known: float, freedom: float = np.inf) -> Test:
    """A test whose chi-square is divided by the variance of its scores, ``known`` from so many degrees of freedom, where the noise is
    from ``freedom``; corrections for variants stay.
    """
    if by <= 1.0:
        return t
    change = log_sf(t.chi2 / by, t.rank, min(freedom, known)) - log_sf(t.chi2, t.rank, freedom)
    less = float(log_bayes(t.chi2, t.rank) - log_bayes(t.chi2 / by, t.rank))
    return replace(t, log_p=min(0.0, t.log_p + change), log_b=t.log_b - less, inflation=by)
