"""Evidence for a candidate effect: what its columns explain once the base columns, with their prior, are projected out of all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import count

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.estimation.least_squares import fold, make_prior, pick_columns
from ragg_runtime.estimation.noise import score_excess
from ragg_runtime.estimation.observation import BLOCKS
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.estimation.whitening import Piece, PreparedFlight

Array = NDArray[np.float64]

# whitened norm, after projection, of a parameter of one scale (ten times plausible) below which it is not testable: at 0.3 a 3-sigma
# effect would be a hundred times the plausible size
TESTABLE = 0.3
# relative size below which what is left of a column after projection is rounding and truncation
COLLINEAR = 1e-6


def find_floor(norms: Array) -> Array:
    """(n,): the norms after projection below which columns with these norms before it are not testable."""
    return np.maximum(TESTABLE, COLLINEAR * norms)


# prior variance of an effect over that of the noise, g: from what hides in the noise to 1e4 times its standard deviation
STRENGTHS = np.logspace(0.0, 8.0, 17)

_SHRINK, _COST = 0.5 * STRENGTHS / (1.0 + STRENGTHS), 0.5 * np.log1p(STRENGTHS)


def log_bayes(chi2: Array | float, rank: Array | float) -> Array:
    """log B of explanations against none, with Zellner's prior, g averaged: ``chi2`` is what their ``rank`` coefficients explain."""
    each = np.multiply.outer(chi2, _SHRINK) - np.multiply.outer(rank, _COST)
    top = each.max(axis=-1)
    return np.asarray(top + np.log(np.mean(np.exp(each - top[..., None]), axis=-1)))


def weigh(chi2: float, rank: float, charge: float = 0.0, spread: float = 1.0) -> float:
    """Log evidence of an explanation of a chi-square with so many coefficients.

    ``charge``: logarithm of the number of choices that it was; ``spread``: variance of the scores, 1 of noise alone.
    """
    return float(log_bayes(chi2 / spread, rank)) - charge


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
        return weigh(self.chi2, self.rank, spread=inflation)


WEAKEST = 0.3  # share of the floor of columns below which a direction of several is not tested


def find_basis(P: Array, columns: Sequence[int], floor: Array, weakest: float = WEAKEST) -> Array:
    """(rows, k): orthonormal basis of those ``columns`` of P whose norm is above ``floor``."""
    testable = [k for k in columns if np.linalg.norm(P[:, k]) > floor[k]]
    if not testable:
        return P[:, []]
    U, s, _ = np.linalg.svd(P[:, testable], full_matrices=False)
    return np.asarray(U[:, s > max(weakest * np.max(floor[testable]), 1e-7 * s[0])])


def list_sub_blocks(columns: Sequence[tuple[int, Column]]) -> list[tuple[tuple[int, ...], int]]:
    """Ways in which an effect may be present, each with the number of its kind: all its parameters; those of one accelerometer; one
    parameter in all accelerometers; one single value.
    """
    whole = tuple(n for n, _ in columns)
    by_accelerometer: dict[int | None, list[int]] = {}
    by_name: dict[str, list[int]] = {}
    for n, c in columns:
        by_accelerometer.setdefault(c.accelerometer, []).append(n)
        by_name.setdefault(c.name, []).append(n)
    families: list[list[tuple[int, ...]]] = [[whole]]
    for groups in (by_accelerometer.values(), by_name.values(), [[n] for n in whole]):
        family = [tuple(g) for g in groups]
        if len(family) > 1 and family not in families:
            families.append(family)
    return [(block, len(family) * len(families)) for family in families for block in family]


@dataclass(frozen=True)
class Way:
    """A way in which an effect may be present: its columns, orthonormal directions (rows, k) of them, and the number of its kind."""

    which: tuple[int, ...]
    Q: Array
    count: int


def list_ways(
    P: Array, columns: Sequence[tuple[int, Column]], floor: Array, weakest: float = WEAKEST
) -> list[Way]:
    """The ways in which an effect of these columns may be present, of which each can be tested."""
    ways = (Way(block, find_basis(P, block, floor, weakest), n) for block, n in list_sub_blocks(columns))
    return [w for w in ways if w.Q.shape[1]]


def test(
    P: Array,
    columns: Sequence[tuple[int, Column]],
    floor: Array,
    penalty: float = 0.0,
    freedom: float = np.inf,
) -> Test:
    """The best of an effect's sub-blocks, its p-value corrected for their number (and by ``penalty``); ``freedom`` is the noise's."""
    places = [n for n, _ in columns]
    # of hundreds of rows only those matter in which the effect's columns, triangular, are not zero
    small = np.asarray(np.linalg.qr(P[:, [*places, -1]], mode="r"))
    ways = list_ways(small, [(k, c) for k, (_, c) in enumerate(columns)], floor[places])
    if not ways:
        return Test(chi2=0.0, rank=0, log_p=0.0, which=tuple(places))
    chi2 = np.array([np.sum((small[:, -1] @ w.Q) ** 2) for w in ways])
    rank = np.array([w.Q.shape[1] for w in ways])
    charge = np.log([w.count for w in ways]) + penalty
    evidence = log_bayes(chi2, rank) - charge
    k = int(np.argmax(evidence))
    log_p = min(0.0, log_sf(float(chi2[k]), int(rank[k]), freedom) + float(charge[k]))
    return Test(
        float(chi2[k]), int(rank[k]), log_p, tuple(places[n] for n in ways[k].which), float(evidence[k])
    )


def find_best_edges(
    r_factors: Sequence[Sequence[Array]], centre: Array, columns: Mapping[str, Sequence[tuple[int, Column]]]
) -> dict[str, tuple[Test, int]]:
    """For each step the test of its columns from the edge between two segments of time on from which it explains most, and which edge.

    ``r_factors``: of every output one of each segment; ``centre`` (k,): of the base's priors.
    """
    k, pairs = len(centre), [c for each in columns.values() for c in each]
    m, others = len(pairs), [*(k + n for n, _ in pairs), -1]
    picked = [fold([pick_columns(t, k, others) for t in each]) for each in zip(*r_factors, strict=True)]
    # The segments after an edge count with the steps' columns, those before it without; the prior in them.
    after: list[Array] = [np.pad(make_prior(range(k), k + m + 1, centre), ((0, m + 1), (0, 0)))]
    for t in reversed(picked[1:]):
        after.append(fold([after[-1], t]))
    before = np.zeros((k + m + 1, k + m + 1))
    place = count()
    named = {e: [(next(place), c) for _, c in each] for e, each in columns.items()}
    floor = np.full(m + 1, TESTABLE)
    best: dict[str, tuple[Test, int]] = {}
    for n in range(len(picked) - 1):
        off = picked[n].copy()
        off[:, k : k + m] = 0.0
        before = fold([before, off])
        P = fold([before, after[len(picked) - 1 - n]])[k:, k:]
        for e, each in named.items():
            one = test(P, each, floor, float(np.log(2 * BLOCKS)))
            if e not in best or one.log_p < best[e][0].log_p:
                best[e] = one, n
    return best


# records of noise that tell how many independent tests the catalogue is: at a level of 0.03 thirty of them err, a fifth either way
DRAWS = 1000


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
        squares = np.add.reduceat(along**2, np.cumsum(ranks) - ranks, axis=0)
        for w, rank, chi2 in zip(ways, ranks, squares, strict=True):
            largest[rank, w.count] = np.maximum(largest.get((rank, w.count), 0.0), chi2)
    p = [special.chdtrc(rank, chi2) * count for (rank, count), chi2 in largest.items()]
    least = np.min([np.ones(DRAWS), *p], axis=0)
    x = float(np.quantile(least, level))
    return max(1.0, float(np.log1p(-level) / np.log1p(-min(x, level))))


def sum_variances(piece: Piece, place: int, residual: Array) -> Array:
    """Sums over a segment for a score test of a random effect: is the residual larger where it would show, and nowhere else?

    (k + 2, k + 2): inner products of what the noise's own variance may follow (k), of the effect's variance, and of the squared
    residual. ``place`` is the effect's column, ``residual`` (rows,) is whitened and projected.
    """
    shapes = piece.noise.variance_shapes(piece.observation.record)
    X = np.vstack([shapes, piece.white[place] ** 2, residual**2])
    return np.asarray(X @ X.T)


def test_variance(gram: Array) -> Test:
    """Score test of the variance, with the residual's own fourth moment, so that heavy tails raise no alarm."""
    z, _ = score_excess(gram)
    chi2 = max(z, 0.0) ** 2
    return Test(chi2, 1, float(special.log_ndtr(-z)), (0,), weigh(chi2, 1))


# --- uneven noise. A likelihood-ratio test trusts that whitened noise has unit variance everywhere. Where the noise's level was seen
# to change (``estimation.noise``) the weights are estimates by groups, tails are heavy, and a term that is large in a few swings of the
# motion rides on them. The squares of the residual, weighted by those of what is tested, give the real variance of its score (H. White,
# Econometrica 48, 1980): its ratio to what unit variance gives divides chi-square (J. N. K. Rao, A. J. Scott, Ann. Stat. 12, 1984,
# first-order correction). It is known from as many samples as carry the score (F. Satterthwaite, Biometrics 2, 1946): the test then
# follows Fisher's F, as one of a variance that was estimated.

DIRECTIONS = 1e-7  # relative size below which a direction of the tested columns is rounding


@dataclass(frozen=True)
class Scatter:
    """How many times more the scores of tests vary than they should, (m,), and degrees of freedom (m,) of this estimate."""

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
    T: Array, flights: Sequence[PreparedFlight], nuisance: Sequence[int], tests: Sequence[Sequence[int]]
) -> Scatter:
    """Of each of some tests, of so many columns of an R factor [columns | data], beside the ``nuisance`` ones: along what is fitted, beside
    it, so that what is tested raises no doubt of itself. ``flights``: those that the R factor is of.
    """
    # (nuisance, columns + 1): what those explain of every column, and of the data
    B = np.linalg.lstsq(T[:, nuisance], T, rcond=None)[0]
    n, columns = len(nuisance), sorted({k for tested in tests for k in tested})
    along, left = np.zeros((2, n + len(columns), len(tests)))
    for m, tested in enumerate(tests):
        X, y = (T[:, k] - T[:, nuisance] @ B[:, k] for k in (tested, [-1]))
        g = np.linalg.lstsq(X, y, rcond=DIRECTIONS)[0][:, 0]
        along[[n + columns.index(k) for k in tested], m] = g
        along[:n, m] = -B[:, tested] @ g
        left[:, m] = -along[:, m]
        left[:n, m] -= B[:, -1]
    sums = np.zeros((3, len(tests)))
    for x in flights:
        lean, places = x.lean([*nuisance, *columns])

        def of(piece: Piece, places: Sequence[int] = places) -> Array:
            X = piece.white[places].T
            return Scatter.of(X @ along, piece.white[-1][:, None] + X @ left)

        sums += sum(lean.each(of))
    return Scatter.from_sums(sums)


def temper_test(t: Test, inflation: float, degrees: float, freedom: float = np.inf) -> Test:
    """A test whose chi-square is divided by ``inflation``, the variance of its scores, which is estimated with so many ``degrees`` of
    freedom, as the noise is with ``freedom``; corrections for variants stay.
    """
    if inflation <= 1.0:
        return t
    change = log_sf(t.chi2 / inflation, t.rank, min(freedom, degrees)) - log_sf(t.chi2, t.rank, freedom)
    less = t.weigh_alone() - t.weigh_alone(inflation)
    return replace(t, log_p=min(0.0, t.log_p + change), log_b=t.log_b - less, inflation=inflation)
