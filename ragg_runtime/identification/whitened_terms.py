"""Generic terms, whitened, over one segment of a flight: the directions along which a residual is asked.

Any direction tells a standard normal deviate from white noise; the whitened series of a term is the one that finds
the term best. Terms that are slow or come alone pass through the noise's filter as everything does. The many
that oscillate pass the same filter taken as periodic in the segment, but for a few of its last samples where its length is
one that transforms take long for. Their inner product with the residual is then that of the plain series with the residual
filtered backwards, and their norm a sum over their spectrum, at a quarter of the cost.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ragg_runtime.base.threads import stretches
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.whitening import Piece, PreparedFlight
from ragg_runtime.identification.dictionary import Dictionary, Term
from ragg_runtime.signals.fir import GROUP, filtered

Array = NDArray[np.float64]
Singles = NDArray[np.float32]

MEMORY = 16384
"""Most taps of the filter that terms are whitened with: a direction need not be the best one for its
score to be a standard normal deviate, and slower memory than this buys little."""

STRETCH = 2048
"""Samples that are summed in single precision."""


def products(X: Singles, right: Array | Singles, starts: Sequence[int] | None = None) -> Array:
    """X (terms, N) times right (N, k): single precision within a stretch, double from stretch to stretch.

    ``starts``: of the stretches that count (all).
    """
    singles = right.astype(np.float32, copy=False)
    total = np.zeros((len(X), right.shape[1]))
    for start in range(0, X.shape[1], STRETCH) if starts is None else starts:
        total += X[:, start : start + STRETCH] @ singles[start : start + STRETCH]
    return total


SILENT = 1e-12
"""Share of the square of what an unknown gradient spans in a window below which a stretch of time, far from it, is left out. The
filter of red noise has long tails, and of a slow term, large before it and small behind it, they take away what the near
part adds: with 1e-7 the square of what is left of one was five times too small."""


def _heard(Z: Array) -> tuple[Singles, list[int]]:
    """Columns Z (N, k) in single precision, and where the stretches begin in which they are not silent."""
    energy = np.add.reduceat(np.sum(Z**2, axis=1), np.arange(0, len(Z), STRETCH))
    heard = [int(n) * STRETCH for n in np.flatnonzero(energy > SILENT * np.sum(energy))]
    return Z.astype(np.float32), heard


def squares(X: Singles) -> Array:
    """(terms,): sums of squares of X (terms, N), as :func:`products` sums."""
    total = np.zeros(len(X))
    for start in range(0, X.shape[1], STRETCH):
        part = X[:, start : start + STRETCH]
        total += np.matmul(part[:, None, :], part[:, :, None])[:, 0, 0]
    return total


LARGEST = 13
"""Prime factor of the length of a transform up to which it takes at most half as long again; of 7,199 samples, 23 times 313, six times
as long. To the next length without a larger one it is 0.2 % of 7,000 or 28,800 samples in the mean, 1 % at most."""


def _quick(n: int) -> int:
    """The greatest length up to n that a transform is quick for."""
    while n > 1:
        rest = n
        for prime in range(2, LARGEST + 1):
            while rest % prime == 0:
                rest //= prime
        if rest == 1:
            break
        n -= 1
    return n


def _kept(X: Singles, valid: NDArray[np.bool_]) -> Singles:
    return X if valid.all() else X[:, valid]


class Directions:
    """Whitened series of the terms of a dictionary over a segment, as terms of the output or of ``only`` one of its series."""

    def __init__(
        self, prepared: PreparedFlight, dictionary: Dictionary, piece: Piece, only: int | None = None
    ) -> None:
        self.piece, self.dictionary, self.whole = piece, dictionary, prepared.observation
        r = piece.observation.record
        self.filters = prepared.noise.taps(MEMORY)
        o = piece.observation
        self.weights = prepared.noise.weights(
            o.weights if only is None else np.where(np.arange(len(o.signs)) == only, o.signs, 0.0)
        )
        self.samples = len(r.time)
        self.size = _quick(self.samples)
        self.level = prepared.noise.level_of(r.quantity)
        steady = not prepared.noise.uneven
        self.may_be_periodic = steady and bool(r.valid.all()) and not self.whole.recorded.demodulated
        """Whether terms may be filtered periodically: not past gaps, through the demodulator, nor where the noise's level changes."""
        if self.may_be_periodic:
            cut = [np.asarray(taps[: self.size]) for taps in self.filters]
            self.gains = [w * fft.rfft(h, self.size) for w, h in zip(self.weights, cut, strict=True)]

    def whitened(self, terms: Sequence[Term]) -> Iterator[tuple[slice, Singles, Singles]]:
        """Places of some terms, their series (terms, N), and these whitened (terms, rows), through the filter."""
        o, piece = self.piece.observation, self.piece
        rows = piece.segment.rows
        lead = min(rows.start, max(len(t) for t in self.filters) - 1)
        wide = self.whole.record.part(slice(rows.start - lead, rows.stop)) if lead else o.record
        valid = o.record.valid
        for at, x in self.dictionary.chunks(wide, terms):
            if o.recorded.demodulated:  # what the recorder made of G_out before it was recorded
                x = o.recorded.through(x.astype(np.float64), wide).astype(np.float32)
                x[:, ~wide.valid] = 0.0
            parts = [
                _kept(self._even(filtered(x, np.asarray(w * taps), lead=lead)), valid)
                for w, taps in zip(self.weights, self.filters, strict=True)
            ]
            yield at, x[:, lead:], self._without_gradient(parts)

    def _even(self, X: Singles) -> Singles:
        return X if isinstance(self.level, float) else np.asarray(X / self.level.astype(np.float32))

    def periodic(self, terms: Sequence[Term]) -> Iterator[tuple[slice, Singles, Singles]]:
        """As :meth:`whitened`, through the periodic filter."""
        for at, x in self.dictionary.chunks(self.piece.observation.record, terms):
            spectrum = fft.rfft(x[:, : self.size], axis=1)
            parts = [fft.irfft(spectrum * g.astype(np.complex64), self.size, axis=1) for g in self.gains]
            parts = [np.pad(X, ((0, 0), (0, self.samples - self.size))) for X in parts]
            yield at, x, self._without_gradient(parts)

    def _without_gradient(self, parts: Sequence[Singles]) -> Singles:
        X = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)
        unknown_gradient.project(X, self.piece.windows)
        return X

    def scores(self, terms: Sequence[Term], right: Array) -> Iterator[tuple[slice, Singles, Array, Array]]:
        """Places, series (terms, N), inner products with ``right`` (rows, k), and squared norms, through the periodic filter.

        ``right`` must hold nothing that an unknown gradient spans.
        """
        back = self._back(right).astype(np.float32)
        lost = [_heard(self._back(w.white, w.places)) for w in self.piece.windows]
        # Parseval: the squared norm over all outputs is a weighted sum over the spectrum
        power = np.sum([np.abs(g) ** 2 for g in self.gains], axis=0) / self.size
        power[1 : len(power) - (self.size % 2 == 0)] *= 2.0
        weight = np.sqrt(power).astype(np.float32)
        for at, x in self.dictionary.chunks(self.piece.observation.record, terms):
            spectrum = fft.rfft(x[:, : self.size], axis=1) * weight
            norm2 = squares(spectrum.view(np.float32))
            for Z, starts in lost:
                norm2 -= np.sum(products(x, Z, starts) ** 2, axis=1)
            yield at, x, products(x, back), norm2

    def _back(self, right: Array, places: NDArray[np.intp] | None = None) -> Array:
        """(N, k): columns over whitened rows (all, or those at ``places``) through the transposed filter."""
        m, n, size = len(self.gains), self.samples, self.size
        back, columns = np.conj(np.stack(self.gains)), right.T
        found = np.zeros((len(columns), n))
        for some in stretches(len(columns), GROUP):
            full = np.zeros((some.stop - some.start, m * n))
            full[:, slice(None) if places is None else places] = columns[some]
            waves = fft.rfft(full.reshape(-1, m, n)[:, :, :size], axis=2) * back
            found[some, :size] = fft.irfft(np.sum(waves, axis=1), size, axis=1)
        return found.T
