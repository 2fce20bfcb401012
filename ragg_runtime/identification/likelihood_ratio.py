"""Evidence for a candidate effect: what its columns explain once the base columns, with their prior, are projected out of all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.estimation.noise import score_excess
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.estimation.whitening import Piece

Array = NDArray[np.float64]

TESTABLE = 0.3
"""Whitened norm, after projection, of a parameter of one scale (ten times plausible) below which it is not
testable: at 0.3 a 3-sigma effect would be a hundred times the plausible size."""

COLLINEAR = 1e-6
"""Relative size below which what is left of a column after projection is rounding and truncation."""


STRENGTHS = np.logspace(0.0, 8.0, 17)
"""Prior variance of an effect over that of the noise, g: from what hides in the noise to 1e4 times its standard deviation."""

_SHRINK, _COST = 0.5 * STRENGTHS / (1.0 + STRENGTHS), 0.5 * np.log1p(STRENGTHS)


def log_bayes(chi2: Array | float, rank: Array | float) -> Array:
    """log B of explanations against none, with Zellner's prior, g averaged: ``chi2`` is what their ``rank`` coefficients explain."""
    each = np.multiply.outer(chi2, _SHRINK) - np.multiply.outer(rank, _COST)
    top = each.max(axis=-1)
    return np.asarray(top + np.log(np.mean(np.exp(each - top[..., None]), axis=-1)))


@dataclass(frozen=True)
class Test:
    """A likelihood-ratio test of some columns: chi-square with ``rank`` degrees of freedom; ``log_p`` is corrected for the number
    of sub-blocks tried, of which ``which`` are the best one's columns; ``log_b``: the log evidence, charged alike. ``inflation``: how
    much more its scores vary than they should.
    """

    chi2: float
    rank: int
    log_p: float
    which: tuple[int, ...]
    log_b: float = 0.0
    inflation: float = 1.0

    @property
    def charge(self) -> float:
        """Logarithm of the number of variants that it was chosen from."""
        return self.weigh_alone(self.inflation) - self.log_b

    def weigh_alone(self, inflation: float = 1.0) -> float:
        """Log evidence of its columns, as if no others had been tried, its scores varying so much more than they should."""
        return float(log_bayes(self.chi2 / inflation, self.rank))


def project(T: Array, onto: int) -> Array:
    """What is left of the later columns once the first ``onto`` are projected out."""
    return T[onto:, onto:]


WEAKEST = 0.3
"""Share of the floor of columns below which a direction of several is not tested."""


def find_basis(P: Array, columns: Sequence[int], floor: Array, weakest: float = WEAKEST) -> Array:
    """(rows, k): orthonormal directions of those of some ``columns`` of P that have a norm above ``floor``."""
    own = [k for k in columns if np.linalg.norm(P[:, k]) > floor[k]]
    if not own:
        return P[:, []]
    U, s, _ = np.linalg.svd(P[:, own], full_matrices=False)
    return np.asarray(U[:, s > max(weakest * np.max(floor[own]), 1e-7 * s[0])])


def measure_explained(P: Array, columns: Sequence[int], floor: Array) -> tuple[float, int]:
    """(chi-square, rank) of the last column of P explained by ``columns`` of a norm above ``floor``."""
    Q = find_basis(P, columns, floor)
    return float(np.sum((Q.T @ P[:, -1]) ** 2)), Q.shape[1]


def list_sub_blocks(columns: Sequence[tuple[int, Column]]) -> list[tuple[tuple[int, ...], int]]:
    """Ways in which an effect may be present, each with the number of its kind: all its parameters; those of one accelerometer; one
    parameter in all accelerometers; one single value.
    """
    return [(tuple(columns[k][0] for k in block), count) for block, count in _list_ways(_kinds(columns))]


Kinds = tuple[tuple[int | None, str], ...]


def _kinds(columns: Sequence[tuple[int, Column]]) -> Kinds:
    return tuple((c.accelerometer, c.name) for _, c in columns)


@lru_cache(maxsize=1024)
def _list_ways(kinds: Kinds) -> list[tuple[tuple[int, ...], int]]:
    """:func:`list_sub_blocks` of columns of these accelerometers and names, by their places: the same for every record."""
    every = tuple(range(len(kinds)))
    families: list[list[tuple[int, ...]]] = [[every]]
    by_accelerometer: dict[int | None, list[int]] = {}
    by_name: dict[str, list[int]] = {}
    for n, (accelerometer, name) in enumerate(kinds):
        by_accelerometer.setdefault(accelerometer, []).append(n)
        by_name.setdefault(name, []).append(n)
    for groups in (by_accelerometer.values(), by_name.values(), [[n] for n in every]):
        family = [tuple(g) for g in groups]
        if len(family) > 1 and not any(set(family) == set(f) for f in families):
            families.append(family)
    return [(block, len(family) * len(families)) for family in families for block in family]


def test(
    P: Array,
    columns: Sequence[tuple[int, Column]],
    floor: Array,
    penalty: float = 0.0,
    freedom: float = np.inf,
) -> Test:
    """The best of an effect's sub-blocks, its p-value corrected for their number (and by ``penalty``); ``freedom`` is the noise's."""
    every = [n for n, _ in columns]
    # of hundreds of rows only those matter in which the effect's columns, triangular, are not zero
    small, low = np.asarray(np.linalg.qr(P[:, [*every, -1]], mode="r")), floor[every]
    squares, along = np.sum(small[:, :-1] ** 2, axis=0), small[:, -1] @ small[:, :-1]
    seen = squares > low**2
    alone = np.where(seen, along**2 / np.where(seen, squares, 1.0), 0.0).tolist()
    blocks, counts = zip(*_list_ways(_kinds(columns)), strict=True)
    chi2, rank = np.array(
        [(alone[b[0]], int(seen[b[0]])) if len(b) == 1 else measure_explained(small, b, low) for b in blocks]
    ).T
    charge = np.log(counts) + penalty
    evidence = log_bayes(chi2, rank) - charge
    k = int(np.argmax(np.where(rank > 0, evidence, -np.inf)))
    log_p = min(0.0, log_sf(float(chi2[k]), int(rank[k]), freedom) + float(charge[k]))
    return Test(float(chi2[k]), int(rank[k]), log_p, tuple(every[n] for n in blocks[k]), float(evidence[k]))


DRAWS = 1000
"""Records of noise that tell how many independent tests the catalogue is: at a level of 0.03 thirty of them err, a fifth either way."""


@dataclass(frozen=True)
class Way:
    """A way in which an effect may be present: orthonormal directions (rows, k), and the number of its kind."""

    Q: Array
    count: int


def list_ways(
    P: Array, columns: Sequence[tuple[int, Column]], floor: Array, weakest: float = WEAKEST
) -> list[Way]:
    """The ways in which an effect of these columns may be present, of which each can be tested."""
    found = [Way(find_basis(P, block, floor, weakest), count) for block, count in list_sub_blocks(columns)]
    return [w for w in found if w.Q.shape[1]]


def estimate_effective_number(effects: Sequence[Sequence[Way]], level: float) -> float:
    """Number of independent tests whose least p-value is below a level as often as that of these effects.

    Columns are alike, and so are the p-values of effects: the least of them, of records of noise with these columns, tells how many
    they are (J. Cheverud, Heredity 87, 2001, by simulation).
    """
    if not effects:
        return 1.0
    noise = np.random.default_rng(0).standard_normal((len(effects[0][0].Q), DRAWS))
    largest: dict[
        tuple[int, int], Array
    ] = {}  # of tests of one rank and number the largest has the least p-value
    for ways in effects:
        along = np.concatenate([w.Q for w in ways], axis=1).T @ noise
        ranks = np.array([w.Q.shape[1] for w in ways])
        every = np.add.reduceat(along**2, np.cumsum(ranks) - ranks, axis=0)
        for w, rank, chi2 in zip(ways, ranks, every, strict=True):
            largest[rank, w.count] = np.maximum(largest.get((rank, w.count), 0.0), chi2)
    p = [special.chdtrc(rank, chi2) * count for (rank, count), chi2 in largest.items()]
    least = np.min([np.ones(DRAWS), *p], axis=0)
    x = float(np.quantile(least, level))
    return max(1.0, float(np.log1p(-level) / np.log1p(-min(x, level))))


@dataclass(frozen=True)
class Variance:
    """Sums over samples for a score test of a random effect: is the residual larger where it would show, and nowhere else?

    ``gram`` (k + 2, k + 2): inner products of what the noise's own variance may follow (k), of the effect's variance, and of the
    squared residual (:func:`noise.score_excess`).
    """

    gram: Array

    @staticmethod
    def of(piece: Piece, place: int, residual: Array) -> Variance:
        """Of a segment; ``place`` is the effect's column, ``residual`` (rows,) is whitened and projected."""
        X = np.vstack(
            [piece.noise.variance_shapes(piece.observation.record), piece.white[place] ** 2, residual**2]
        )
        return Variance(X @ X.T)

    def test(self) -> Test:
        """Score test of the variance, with the residual's own fourth moment, so that heavy tails raise no alarm."""
        z, _ = score_excess(self.gram)
        chi2 = max(z, 0.0) ** 2
        return Test(chi2, 1, float(special.log_ndtr(-z)), (0,), float(log_bayes(chi2, 1)))


def pool_variances(parts: Sequence[Variance]) -> Variance:
    """The sums of several segments or flights together."""
    return Variance(np.sum([p.gram for p in parts], axis=0))
