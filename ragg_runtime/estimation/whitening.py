"""Passes over a flight: segment after segment, linearised about a point, whitened; flights prepared for tests by R factors of blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import progress
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.least_squares import compute_r_factor, join, make_prior
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import (
    BLOCKS,
    Observation,
    combine_output,
    make_block_edges,
    split_at_blocks,
)
from ragg_runtime.estimation.regressors import LinearisationPoint, linearise
from ragg_runtime.estimation.unknown_gradient import Window

Array = NDArray[np.float64]
R = TypeVar("R")


@dataclass(frozen=True)
class Piece:
    """A segment of a flight about one parameter vector: N samples, ``rows`` of the flight, m outputs.

    ``columns`` (n + 1, m, N), V, are base and candidates, each times its parameter's scale, and the residual;
    ``white`` (n + 1, rows) the same whitened, one output after the other, an unknown gradient (``windows``) projected out;
    ``sample`` (rows,) the flight's sample of each whitened row.
    """

    rows: slice
    observation: Observation
    columns: Array
    white: Array
    sample: NDArray[np.intp]
    windows: Sequence[Window]
    noise: NoiseModel

    def r_factor(self, first: int = 0, stop: int | None = None) -> Array:
        """Triangular factor (n + 1, n + 1) of the whitened columns: of the flight's samples from ``first`` on, before ``stop``."""
        mask = (self.sample >= first) & (self.sample < (self.rows.stop if stop is None else stop))
        return compute_r_factor(self.white if mask.all() else self.white[:, mask])

    def sums(self, samples: slice = slice(None)) -> Array:
        """(n + 1,), V: sums of the columns of G_out over ``samples``; zero of channels, which have lost their mean."""
        weights = self.observation.signs * (not self.observation.recorded.demodulated)
        return np.asarray(np.sum(self.columns[:, :, samples], axis=2) @ weights)

    def combine(self, e: Array) -> Array:
        """What residuals of the series (k, m, N), V, are of G_out (k, N); no unknown gradient."""
        e = unknown_gradient.take_out(e, self.windows, self.observation.record.valid)
        return combine_output(self.observation, e)


def pass_over(
    at: LinearisationPoint,
    o: Observation,
    noise: NoiseModel,
    work: Callable[[Piece], R],
    *,
    chosen: Sequence[slice] | None = None,
    whitened: bool = True,
    spanned: Sequence[Sequence[Window]] | None = None,
) -> Iterator[R]:
    """What ``work`` makes of every segment of a flight (or of the ``chosen``, in order); it must not keep a piece of several.

    Unless ``whitened``, the columns alone are made. ``spanned``: the windows of an unknown gradient in each segment, where they are known.
    """
    share = (1.0 if at.candidates else 0.4) * (1.0 if whitened else 0.5)
    past, end = None, 0
    segments = o.segments if chosen is None else chosen

    def make(k: int) -> tuple[slice, Observation, Array, Sequence[Window]]:
        rows, part = segments[k], o.part(segments[k])
        windows = unknown_gradient.make_windows(o, rows, noise) if spanned is None else spanned[k]
        return rows, part, linearise(at, part), windows

    for rows, part, columns, windows in progress.map_ahead(make, range(len(segments))):
        white, sample = np.empty((len(columns), 0)), np.empty(0, dtype=np.intp)
        if whitened:
            white, past = noise.whiten_segment(
                columns,
                part.record.valid,
                noise.level.of(part.record.quantity),
                past if rows.start == end else None,
            )
            end = rows.stop
            if windows:
                white = white.copy()  # a noise of one volt leaves the columns themselves
                unknown_gradient.project(white, windows)
            sample = np.tile(np.flatnonzero(part.record.valid) + rows.start, noise.outputs)
        result = work(Piece(rows, part, columns, white, sample, windows, noise))
        progress.step(share * (rows.stop - rows.start))
        yield result


@dataclass(frozen=True)
class PreparedFlight:
    """One flight about the calibrated parameters.

    ``pieces``: of a short flight its columns; those of a longer one (``None``) are computed anew in every pass.
    """

    observation: Observation
    noise: NoiseModel
    at: LinearisationPoint
    pieces: tuple[Piece, ...] | None = field(default=None, repr=False)

    @property
    def edges(self) -> NDArray[np.intp]:
        """(BLOCKS + 1,): samples at which the blocks of time begin and end."""
        return make_block_edges(len(self.observation.record.time))

    def noise_psd(self, f: Array) -> Array:
        """One-sided density of the noise of the output before demodulation at frequencies f, V^2/Hz."""
        return self.noise.psd(f, self.observation.signs)

    def each(
        self, work: Callable[[Piece], R], *, chosen: Sequence[slice] | None = None, whitened: bool = True
    ) -> Iterator[R]:
        """What ``work`` makes of every segment (or of the ``chosen``), in order: one pass over the flight. It must not keep one."""
        if self.pieces is not None:
            return map(work, self.pieces)
        return pass_over(self.at, self.observation, self.noise, work, chosen=chosen, whitened=whitened)

    def lean(self, places: Sequence[int]) -> tuple[PreparedFlight, list[int]]:
        """The flight that computes least for the columns of the base and those at ``places``, and where it has the latter."""
        if self.pieces is not None:
            return self, list(places)
        n = len(self.at.base)
        further = sorted({k - n for k in places if k >= n})
        at = replace(self.at, candidates=[self.at.candidates[k] for k in further])
        return replace(self, at=at), [k if k < n else n + further.index(k - n) for k in places]

    def residuals(self, v: Array, chosen: Sequence[slice] | None = None) -> Array:
        """Residuals of G_out (k, N), V, once columns have coefficients v (k, size); no unknown gradient."""
        n = len(self.at.base)
        places = [*range(n), *(n + np.flatnonzero(np.any(v[:, n:], axis=0)))]
        lean, rows = self.lean(places)

        def compute(piece: Piece) -> Array:
            return piece.combine(piece.columns[-1] - np.tensordot(v[:, places], piece.columns[rows], 1))

        return np.concatenate([*lean.each(compute, chosen=chosen, whitened=False)], axis=1)

    def with_steps(self, instants: Mapping[str, float]) -> PreparedFlight:
        """The same with steps (effect -> instant, s)."""
        if dict(instants) == dict(self.at.instants):
            return self
        return prepare_flight(self.observation, self.noise, replace(self.at, instants=instants))


def prepare_flight(o: Observation, noise: NoiseModel, at: LinearisationPoint) -> PreparedFlight:
    """A flight about a point."""
    if len(o.segments) > 1:
        return PreparedFlight(o, noise, at)
    return PreparedFlight(o, noise, at, tuple(pass_over(at, o, noise, lambda piece: piece)))


def factor_blocks(prepared: PreparedFlight) -> tuple[tuple[Array, ...], Array]:
    """Of the columns [base | candidates | residual]: R factors (n + 1, n + 1) of the whitened ones, one a block of
    time, and (BLOCKS, n + 1), V: sums of the plain ones of G_out.
    """
    samples, size = len(prepared.observation.record.time), len(prepared.at.base) + len(prepared.at.candidates)
    r_factors: dict[int, Array] = {}
    totals = np.zeros((BLOCKS, size + 1))

    def add(piece: Piece) -> None:
        first = piece.rows.start
        for b, x in split_at_blocks(piece.rows, samples):
            # a day has hundreds of segments: those of a block are joined as they come
            factor = piece.r_factor(x.start, x.stop)
            r_factors[b] = join([r_factors[b], factor]) if b in r_factors else factor
            totals[b] += piece.sums(slice(x.start - first, x.stop - first))

    for _ in prepared.each(add):
        pass
    nothing = np.zeros((size + 1, size + 1))
    return tuple(r_factors.get(b, nothing) for b in range(BLOCKS)), totals


DEPENDENT = 1e-6  # ratio of eigenvalues of inner products in single precision below which they are rounding


@dataclass(frozen=True)
class Projector:
    """Projects base and given columns out of whitened rows.

    Whitened columns (rows, len(taken)) times ``to_basis`` (len(taken), k) are orthonormal over all rows, without the directions
    that the data see worse than the prior; ``along`` (k,) are the residual's components. ``centre`` (len(taken),): of the priors of unit
    width that hold the columns' coefficients; ``None``: none does.
    """

    taken: NDArray[np.intp]
    to_basis: Array
    along: Array
    centre: Array | None = None

    def basis(self, piece: Piece) -> Array:
        """(rows, k): the piece's rows of the orthonormal basis."""
        return np.asarray(piece.white[self.taken].T @ self.to_basis)

    def project_residual(self, piece: Piece, Q: Array) -> Array:
        """(rows,): the whitened residual less its components along the basis."""
        return np.asarray(piece.white[-1] - Q @ self.along)

    def measure_explained(self, along: Array, gram: Array, scores: Array) -> Array:
        """(m,): chi-square that the first 1, 2, ... m of further columns explain if the priors hold the coefficients of the taken ones.

        ``along`` (m, k): their components along the basis; ``gram`` (m, m), ``scores`` (m,): their inner products beside it, with one
        another and with the residual.
        """
        n, m = len(self.taken), len(scores)
        sizes, U = np.linalg.eigh(gram)
        independent = sizes > DEPENDENT * sizes[-1]  # columns that are nearly the same, in single precision
        root = np.sqrt(np.where(independent, sizes, 0.0))
        beside = np.where(independent, U.T @ scores, 0.0) / np.where(independent, root, 1.0)
        X: Array = np.block(
            [
                [np.linalg.pinv(self.to_basis), along.T, self.along[:, None]],
                [np.zeros((m, n)), root[:, None] * U.T, beside[:, None]],
            ]
        )
        held = X if self.centre is None else np.vstack([X, make_prior(range(n), X.shape[1], self.centre)])
        R = np.asarray(np.linalg.qr(held, mode="r"))
        new = np.abs(np.diag(R)[n : n + m]) > np.sqrt(DEPENDENT) * np.linalg.norm(X[:, n:-1], axis=0)
        return np.asarray(np.cumsum(np.where(new, R[n : n + m, -1], 0.0) ** 2))

    def lean(
        self, x: PreparedFlight, further: Sequence[int] = ()
    ) -> tuple[PreparedFlight, Projector, list[int]]:
        """The flight that computes least for the columns taken and ``further`` ones, the projector for it, and where it has the latter."""
        x, places = x.lean([*self.taken, *further])
        k = len(self.taken)
        return x, replace(self, taken=np.array(places[:k], dtype=np.intp)), places[k:]


def make_projector(
    r_factors: Sequence[Array], n_base: int, extra: Sequence[int], to_nominal: Array | None = None
) -> Projector:
    """The projector onto base and ``extra`` candidate columns, from the block R factors of a flight; ``to_nominal`` (n_base,): where the
    priors of the base are centred, those of the others at zero.
    """
    taken = np.array([*range(n_base), *(n_base + n for n in extra)], dtype=np.intp)
    T = join([t[:, [*taken, t.shape[1] - 1]] for t in r_factors])
    U, s, Vt = np.linalg.svd(T[:, :-1], full_matrices=False)
    seen = s > 1.0
    centre = None if to_nominal is None else np.append(to_nominal, np.zeros(len(extra)))
    return Projector(taken, np.asarray(Vt[seen].T / s[seen]), np.asarray(U[:, seen].T @ T[:, -1]), centre)
