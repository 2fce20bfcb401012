"""Generic terms, whitened, over one segment of a flight: the directions along which a residual is asked.

Any direction tells a standard normal deviate from white noise; the whitened series of a term is the one that finds
the term best.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.whitening import Piece, PreparedFlight
from ragg_runtime.identification.dictionary import Dictionary, Term
from ragg_runtime.signals.fir import filtered

Array = NDArray[np.float64]
Singles = NDArray[np.float32]

MEMORY = 16384
"""Most taps of the filter that terms are whitened with: a direction need not be the best one for its
score to be a standard normal deviate, and slower memory than this buys little."""

STRETCH = 2048
"""Samples that are summed in single precision."""


def products(X: Singles, right: Array | Singles) -> Array:
    """X (terms, N) times right (N, k): single precision within a segment, double between segments."""
    singles = right.astype(np.float32, copy=False)
    total = np.zeros((len(X), right.shape[1]))
    for start in range(0, X.shape[1], STRETCH):
        total += X[:, start : start + STRETCH] @ singles[start : start + STRETCH]
    return total


def squares(X: Singles) -> Array:
    """(terms,): sums of squares of X (terms, N), as :func:`products` sums."""
    total = np.zeros(len(X))
    for start in range(0, X.shape[1], STRETCH):
        part = X[:, start : start + STRETCH]
        total += np.matmul(part[:, None, :], part[:, :, None])[:, 0, 0]
    return total


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
        self.level = prepared.noise.level_of(r.quantity)

    def whitened(self, terms: Sequence[Term]) -> Iterator[tuple[slice, Singles, Singles]]:
        """Places of some terms, their series (terms, N), and these whitened (terms, rows), through the filter."""
        o, piece = self.piece.observation, self.piece
        rows = piece.segment.rows
        lead = min(rows.start, max(len(t) for t in self.filters) - 1)
        wide = self.whole.record.part(slice(rows.start - lead, rows.stop)) if lead else o.record
        valid = o.record.valid
        for at, x in self.dictionary.make_chunks(wide, terms):
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

    def _without_gradient(self, parts: Sequence[Singles]) -> Singles:
        X = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)
        unknown_gradient.project(X, self.piece.windows)
        return X
