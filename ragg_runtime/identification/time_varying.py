"""What in a residual is no steady term: terms that come and go.

The coefficient of a term may not be the same throughout a flight. Four questions are asked of every term, on its scores in short
intervals of time: do the coefficients fitted in each block of time scatter; does it act in one window only; does it jump; does it swing
with a period? All are asked of the whitened residual, with everything known projected out, against its own level nearby, so that noise
that is not quite stationary or not quite white raises no alarm.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.observation import make_block_edges
from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.estimation.whitening import Piece

Array = NDArray[np.float64]

PARTS = 4  # intervals in a block of time
WINDOWS = (1, 2, 4, 8, 16)  # lengths of windows, in intervals; each is moved by half of it
CYCLES = np.arange(1, 61) / 2  # cycles of a swing in a flight. The shortest is three intervals long.
# share of a term's information that must lie on either side of an instant for a jump there to be told from the whole
ONE_SIDED = 0.01
# determinant of a cosine and a sine of one period, over the product of their squares, below which they are one and the same
ONE_PHASE = 0.01

QUESTIONS = 4


@dataclass(frozen=True)
class Varying:
    """The term whose coefficient varies most.

    ``place`` is the term's; ``coefficient`` the root mean square of its coefficient over the flight, in units of the
    term's series, and ``std`` its standard deviation; ``how`` describes how it varies.
    """

    log_p: float
    place: int
    chi2: float
    coefficient: float
    std: float
    how: str
    rank: int = 1


class BlockScores:
    """Scores of some terms in every interval of time: sums over segments, counted in one after the other."""

    def __init__(self, count: int, time: Array) -> None:
        self.count = count
        blocks = make_block_edges(len(time))
        inner = [np.linspace(a, b, PARTS + 1)[:-1] for a, b in pairwise(blocks)]
        self.edges = np.concatenate([*inner, blocks[-1:]]).astype(np.intp)
        at = np.minimum(self.edges, len(time) - 1)
        self.time = np.asarray(time[at], dtype=np.float64)
        intervals = len(self.edges) - 1
        self.dot, self.norm2 = np.zeros((intervals, count)), np.zeros((intervals, count))
        self.square, self.rows, self.fourth = np.zeros(intervals), np.zeros(intervals), 0.0

    def _runs(self, piece: Piece) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Where, among the whitened rows of a segment, runs within one interval begin; and their intervals."""
        which = np.searchsorted(self.edges, piece.sample, side="right") - 1
        starts = np.flatnonzero(np.diff(which, prepend=-1))
        return starts, which[starts]

    def level(self, piece: Piece, y: Array) -> None:
        """Count in the residual of a segment, (rows,)."""
        starts, intervals = self._runs(piece)
        np.add.at(self.square, intervals, np.add.reduceat(y**2, starts))
        np.add.at(self.rows, intervals, np.diff(starts, append=len(y)).astype(np.float64))
        self.fourth += float(np.sum(y**4))

    def add(self, piece: Piece, y: Array, at: slice, X: Array) -> None:
        """Count in the whitened series X (terms, rows) of the terms at places ``at``; others are left alone."""
        if at.start >= self.count:
            return
        at = slice(at.start, min(at.stop, self.count))
        X = X[: at.stop - at.start]
        starts, intervals = self._runs(piece)
        for a, b, interval in zip(starts, [*starts[1:], len(y)], intervals, strict=True):
            self.dot[interval, at] += X[:, a:b] @ y[a:b]
            self.norm2[interval, at] += np.einsum("ij,ij->i", X[:, a:b], X[:, a:b])

    def best(self, good: NDArray[np.bool_]) -> Varying | None:
        """The most variable of the ``good`` terms."""
        terms = np.flatnonzero(good[: self.count])
        used = self.rows > 0
        if np.sum(used) < 2 or not len(terms):
            return None
        # over the record the residual is as large as its noise model predicts; blocks may be larger or smaller
        block = np.arange(len(self.rows)) // PARTS
        square, rows = np.bincount(block, self.square), np.bincount(block, self.rows)
        level = square / np.maximum(rows, 1.0) / (np.sum(square) / np.sum(rows))
        d, v = self.dot[:, terms], self.norm2[:, terms] * level[block][:, None]
        # of heavy tails, as the fourth moment tells, a block's rows tell its level no better than fewer Gaussian ones would
        spread = self.fourth * float(np.sum(rows)) / float(np.sum(square)) ** 2 - 1.0
        freedom = float(np.mean(rows[rows > 0])) * min(1.0, 2.0 / max(spread, 1e-3))
        tests = [self._scatter(d, v, block), self._window(d, v, freedom), self._jump(d, v), self._swing(d, v)]
        best = min((f for f in tests if f is not None), key=lambda f: f.log_p)
        log_p = min(0.0, best.log_p + float(np.log(len(terms) * QUESTIONS)))
        return replace(best, log_p=log_p, place=int(terms[best.place]))

    def _scatter(self, d: Array, v: Array, block: NDArray[np.intp]) -> Varying:
        starts = np.flatnonzero(np.diff(block, prepend=-1))
        d, v = np.add.reduceat(d, starts, axis=0), np.add.reduceat(v, starts, axis=0)
        each = np.sum(_divide(d**2, v), axis=0)
        k = int(np.argmax(each))
        chi2, norms2 = float(each[k]), v[v[:, k] > 0.0, k]
        freedom = max(1, len(norms2))
        size2 = float(np.mean(norms2)) if len(norms2) else np.inf
        coefficient = float(np.sqrt(max(0.0, chi2 - freedom) / freedom / size2))
        how = "varies from block to block of time"
        return Varying(log_sf(chi2, freedom), k, chi2, coefficient, size2**-0.5, how, freedom)

    def _window(self, d: Array, v: Array, rows: float) -> Varying:
        # the level of a block is known from its rows alone: Student's t
        D, V = (np.concatenate([np.zeros((1, x.shape[1])), np.cumsum(x, axis=0)]) for x in (d, v))
        spans = [(a, a + n) for n in WINDOWS if n < len(d) for a in range(0, len(d) - n + 1, max(1, n // 2))]
        a, b = np.array(spans).T
        how = [f"from {self.time[a]:.4g} to {self.time[b]:.4g} s" for a, b in spans]
        variance = V[b] - V[a]
        return _find_largest(
            _divide((D[b] - D[a]) ** 2, variance), variance, (b - a) / len(d), how, freedom=rows
        )

    def _jump(self, d: Array, v: Array) -> Varying:
        """The coefficient after an instant less that before it, the mean of both taken out."""
        at = np.arange(PARTS, len(d) - PARTS + 1, PARTS)
        D, V = np.cumsum(d[::-1], axis=0)[::-1], np.cumsum(v[::-1], axis=0)[::-1]
        share = _divide(V[at], V[0])
        variance = np.where((share > ONE_SIDED) & (share < 1.0 - ONE_SIDED), V[at] * (1.0 - share), 0.0)
        since, how = 1.0 - at / len(d), [f"since {self.time[n]:.4g} s" for n in at]
        chi2 = _divide((D[at] - share * D[0]) ** 2, variance)
        return _find_largest(chi2, variance, since * (1.0 - since), how)

    def _swing(self, d: Array, v: Array) -> Varying:
        middle = (self.time[1:] + self.time[:-1]) / 2
        duration = float(self.time[-1] - self.time[0])
        angle = 2 * np.pi * np.outer(CYCLES, (middle - self.time[0]) / duration)
        c, s = np.cos(angle), np.sin(angle)
        C, S, cc, ss, cs = c @ d, s @ d, c**2 @ v, s**2 @ v, (c * s) @ v
        determinant = cc * ss - cs**2
        clear = determinant > ONE_PHASE * cc * ss
        chi2 = np.where(clear, _divide(C**2 * ss + S**2 * cc - 2 * C * S * cs, determinant), 0.0)
        how = [f"with a period of {duration / cycles:.3g} s" for cycles in CYCLES]
        return _find_largest(chi2, cc + ss, np.ones(len(CYCLES)), how, rank=2)


def _find_largest(
    chi2: Array, variance: Array, share: Array, how: Sequence[str], rank: int = 1, freedom: float = np.inf
) -> Varying:
    """The largest of scores of shapes, (shapes, terms), of ``rank`` coefficients; ``share`` (shapes,): mean square of each shape."""
    n, k = np.unravel_index(int(np.argmax(chi2)), chi2.shape)
    best = float(chi2[n, k])
    std = float(np.sqrt(share[n] / max(float(variance[n, k]), 1e-300)))
    log_p = log_sf(best, rank, freedom) + float(np.log(len(chi2)))
    return Varying(log_p, int(k), best, std * float(np.sqrt(best)), std, how[int(n)], rank)


def _divide(a: Array, b: Array) -> Array:
    """a / b, zero where b is not positive."""
    return np.asarray(np.where(b > 0.0, a / np.where(b > 0.0, b, 1.0), 0.0))
