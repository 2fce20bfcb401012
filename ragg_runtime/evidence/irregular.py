"""What no steady term can express: one that comes and goes, and a line in the spectrum.

Both are asked of the whitened residual, with everything known projected out, against its own level nearby, so
that noise that is not quite stationary or not quite white raises no alarm.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, stats

from ragg_runtime.passes import Piece
from ragg_runtime.segments import BLOCKS

Array = NDArray[np.float64]

NEIGHBOURS = 200
"""Bins of the spectrum that tell the level about one of them."""

LOWEST_BIN = 4
"""First bin that may be a line: those below are bent by what a fit takes out."""


@dataclass(frozen=True)
class Varying:
    """The term whose coefficient, fitted in every block of time by itself, varies most.

    ``place`` is the term's; ``coefficient`` the root mean square of its coefficients, in units of the term's
    series, and ``std`` that of one of them.
    """

    log_p: float
    place: int
    chi2: float
    coefficient: float
    std: float


class BlockScores:
    """Scores of some terms in every block of time: sums over segments."""

    def __init__(self, count: int) -> None:
        self.count = count
        self.dot, self.norm2 = np.zeros((BLOCKS, count)), np.zeros((BLOCKS, count))
        self.square, self.rows = np.zeros(BLOCKS), np.zeros(BLOCKS)

    def join(self, other: BlockScores) -> None:
        """Count in the sums of further segments."""
        for name in ("dot", "norm2", "square", "rows"):
            getattr(self, name)[...] += getattr(other, name)

    def level(self, piece: Piece, y: Array) -> None:
        """Count in the residual of a segment, (rows,)."""
        for b, rows in piece.segment.blocks:
            inside = (piece.sample >= rows.start) & (piece.sample < rows.stop)
            self.square[b] += float(y[inside] @ y[inside])
            self.rows[b] += float(np.sum(inside))

    def add(self, piece: Piece, y: Array, at: slice, X: NDArray[np.float32]) -> None:
        """Count in the whitened series X (terms, rows) of the terms at places ``at``; others than ours are left."""
        if at.start >= self.count:
            return
        at = slice(at.start, min(at.stop, self.count))
        X = X[: at.stop - at.start]
        for b, rows in piece.segment.blocks:
            inside = (piece.sample >= rows.start) & (piece.sample < rows.stop)
            part = X[:, inside].astype(np.float64)
            self.dot[b, at] += part @ y[inside]
            self.norm2[b, at] += np.einsum("ij,ij->i", part, part)

    def best(self, good: NDArray[np.bool_]) -> Varying | None:
        """The most variable of the ``good`` terms."""
        used = self.rows > 0
        blocks = int(np.sum(used))
        good = good[: self.count]
        if blocks < 2 or not good.any():
            return None
        # over the whole the residual is as loud as its noise model says; blocks may be louder or quieter
        level = self.square[used] / self.rows[used] / (np.sum(self.square) / np.sum(self.rows))
        variance = self.norm2[used] * level[:, None]
        chi2 = np.sum(self.dot[used] ** 2 / np.where(variance > 0.0, variance, np.inf), axis=0)
        chi2 = np.where(good, chi2, 0.0)
        k = int(np.argmax(chi2))
        log_p = min(0.0, float(stats.chi2.logsf(chi2[k], blocks)) + float(np.log(np.sum(good))))
        norm2 = float(np.mean(self.norm2[used, k]))
        excess = max(0.0, float(chi2[k]) - blocks) / blocks
        return Varying(log_p, k, float(chi2[k]), float(np.sqrt(excess / norm2)), float(1 / np.sqrt(norm2)))


@dataclass(frozen=True)
class Line:
    """The bin of the spectrum that stands out most: its frequency, Hz, and the share of the power that is in it."""

    log_p: float
    frequency: float
    share: float


class Periodogram:
    """Mean periodogram of the whitened residual over the segments of a flight."""

    def __init__(self, length: int, rate: float, excluded: tuple[float, float] | None) -> None:
        self.length, self.rate, self.excluded = length, rate, excluded
        self.sum = np.zeros(length // 2 + 1)
        self.count = 0

    def join(self, other: Periodogram) -> None:
        """Count in further segments."""
        self.sum += other.sum
        self.count += other.count

    def add(self, piece: Piece, y: Array) -> None:
        """Count in a segment; ``y`` (rows,) holds one output after the other."""
        valid = piece.observation.record.valid
        if np.sum(valid) < len(valid) / 2:
            return
        for part in np.split(y, len(piece.observation.series)):
            grid = np.zeros(len(valid))
            grid[valid] = part
            self.sum += np.abs(np.fft.rfft(grid, self.length)) ** 2 / np.sum(valid)
            self.count += 1

    def best(self) -> Line | None:
        """The strongest line."""
        f = np.arange(len(self.sum)) * self.rate / self.length
        free = (np.arange(len(f)) >= LOWEST_BIN) & (np.arange(len(f)) < len(f) - 1)
        if self.excluded is not None:
            free &= (f < self.excluded[0]) | (f > self.excluded[1])
        if self.count == 0 or np.sum(free) <= 2 * NEIGHBOURS:
            return None
        P = np.where(free, self.sum / self.count, 0.0)
        size = NEIGHBOURS + 1
        weight = ndimage.uniform_filter1d(free.astype(np.float64), size, mode="constant") * size - free
        level = (ndimage.uniform_filter1d(P, size, mode="constant") * size - P) / np.maximum(weight, 1.0)
        ratio = np.where(free & (weight > NEIGHBOURS / 2), P / np.maximum(level, 1e-300), 0.0)
        k = int(np.argmax(ratio))
        freedom = 2 * self.count
        log_p = float(stats.f.logsf(ratio[k], freedom, freedom * weight[k])) + float(np.log(np.sum(free)))
        share = 2.0 * (P[k] - level[k]) / float(self.length)
        return Line(min(0.0, log_p), float(f[k]), float(np.clip(share, 0.0, 1.0)))
