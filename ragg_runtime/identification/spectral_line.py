"""A line in the spectrum of the whitened residual, with everything known projected out, against its level nearby."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ragg_runtime.estimation.scores import log_sf_f
from ragg_runtime.estimation.whitening import Piece

Array = NDArray[np.float64]

NEIGHBOURS = 200
"""Bins of the spectrum that tell the level about one of them."""

LOWEST_BIN = 4
"""First bin that may be a line: those below are bent by what a fit takes out."""


@dataclass(frozen=True)
class SpectralPeak:
    """The most significant bin of the spectrum: its frequency, Hz, and the share of the power that is in it."""

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

    def best(self) -> SpectralPeak | None:
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
        log_p = log_sf_f(float(ratio[k]), freedom, freedom * float(weight[k])) + float(np.log(np.sum(free)))
        share = 2.0 * (P[k] - level[k]) / float(self.length)
        return SpectralPeak(min(0.0, log_p), float(f[k]), float(np.clip(share, 0.0, 1.0)))
