"""Passes over a flight: segment after segment, linearised about a point, whitened; flights prepared for tests by R factors of blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import progress
from ragg_runtime.estimation import regressors as design
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.least_squares import compute_r_factor, join
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import (
    BLOCKS,
    ROWS,
    THINNER,
    Observation,
    Segment,
    combine_output,
    divide_into_segments,
    make_block_edges,
    split_at_blocks,
)
from ragg_runtime.estimation.regressors import LinearisationPoint, linearise, thin_residual
from ragg_runtime.estimation.unknown_gradient import Window

Array = NDArray[np.float64]
R = TypeVar("R")


@dataclass(frozen=True)
class Piece:
    """A segment of a flight about one parameter vector: N samples, m outputs.

    ``columns`` (n + 1, m, N), V, are base (``n_base``) and candidates, each times its parameter's scale, and the residual;
    ``white`` (n + 1, rows) the same whitened, one output after the other, an unknown gradient (``windows``) projected out;
    ``sample`` (rows,) the flight's sample of each whitened row; ``nonzero`` the columns that are not zero.
    """

    segment: Segment
    observation: Observation
    columns: Array
    n_base: int
    white: Array
    sample: NDArray[np.intp]
    windows: Sequence[Window]
    nonzero: slice | NDArray[np.intp]
    noise: NoiseModel

    def r_factor(self, first: int = 0, stop: int | None = None) -> Array:
        """Triangular factor (n + 1, n + 1) of the whitened columns: of the flight's samples from ``first`` on, before ``stop``."""
        valid = int(np.count_nonzero(self.observation.record.valid))
        ends = (first, self.segment.rows.stop if stop is None else stop)
        a, b = (int(k) for k in np.searchsorted(self.sample[:valid], ends))
        begins = range(0, max(1, self.white.shape[1]), max(1, valid))  # of every output
        return compute_r_factor(np.concatenate([self.white[:, k + a : k + b] for k in begins], axis=1))

    def sums(self, some: slice = slice(None)) -> Array:
        """(n + 1,), V: sums of the columns of G_out over some samples; zero of channels, which have lost their mean."""
        weights = self.observation.signs * (not self.observation.recorded.demodulated)
        return np.asarray(np.sum(self.columns[:, :, some], axis=2) @ weights)

    def left(self, coefficients: Array) -> Array:
        """Residuals of G_out (k, N), V, once columns have these coefficients (k, n); no unknown gradient."""
        base, further = coefficients[:, : self.n_base], coefficients[:, self.n_base :]
        e = self.columns[-1] - np.tensordot(base, self.columns[: base.shape[1]], 1)
        for left, own in zip(e, further, strict=True):  # of an effect's fit all but a few are zero
            few = np.flatnonzero(own)
            if len(few):
                left -= np.tensordot(own[few], self.columns[self.n_base + few], 1)
        return self.observed(e)

    def observed(self, e: Array) -> Array:
        """What residuals of the series (k, m, N), V, are of G_out (k, N); no unknown gradient."""
        e = unknown_gradient.take_out(e, self.windows, self.observation.record.valid)
        return combine_output(self.observation, e)


def divide_flight(o: Observation) -> list[Segment]:
    """The segments of a flight. Demodulated channels are not divided: their columns pass a two-sided filter."""
    n = len(o.record.time)
    if o.recorded.demodulated:
        return divide_into_segments(n, max(n, ROWS))
    return divide_into_segments(n, ROWS // THINNER if o.thin is not None and n > ROWS else ROWS)


def is_long(o: Observation) -> bool:
    """Whether a flight is longer than what its noise is seen in at a time: of noise that is slower nothing is known."""
    return len(divide_flight(o)) > 1


def find_segments(o: Observation) -> list[Segment]:
    """The segments of a flight that hold valid samples."""
    return [s for s in divide_flight(o) if np.any(o.record.valid[s.rows])]


def pass_over(
    at: LinearisationPoint,
    o: Observation,
    noise: NoiseModel,
    work: Callable[[Piece], R],
    *,
    chosen: Sequence[Segment] | None = None,
    whitened: bool = True,
    residual: Array | None = None,
    windows: Sequence[Window] | None = None,
) -> Iterator[R]:
    """What ``work`` makes of every segment of a flight (or of the ``chosen``, in order); it must not keep a piece of several.

    Unless ``whitened``, the columns alone are made. ``residual`` (m, N) V: that of a thinned flight, if it is known.
    ``windows``: of a flight of one segment, if they are known.
    """
    n_base = len(at.base)
    nonzero = design.find_nonzero([*at.base, *at.candidates], at.instrument, o.place)
    found = divide_flight(o) if chosen is None else chosen
    memory = noise.memory if whitened else 0
    tail: Array | None = None
    before = 0
    share = (1.0 if at.with_candidates else 0.4) * (1.0 if whitened else 0.5)
    for s in found:
        part = o.part(s.rows)
        columns = linearise(at, part, None if residual is None else residual[:, s.rows])
        flat, sample = np.empty((len(columns), 0)), np.empty(0, dtype=np.intp)
        taken = unknown_gradient.make_windows(o, s.rows, noise) if windows is None else windows
        if whitened:
            level = noise.level.of(part.record.quantity)
            series = noise.interpolate(columns[nonzero], part.record.valid, level)
            if tail is not None:
                tail = np.pad(tail, ((0, 0), (0, 0), (0, min(memory, s.rows.start - before))))[:, :, -memory:]
            white = noise.filter(series, part.record.valid, level, tail=tail)
            flat = _project_segment(white, series, len(columns), nonzero, taken)
            if memory:
                whole = tail is None or series.shape[2] >= memory
                past = series if whole else np.concatenate([tail, series], axis=2)
                tail, before = past[:, :, -memory:], s.rows.stop
            sample = np.tile(np.flatnonzero(part.record.valid) + s.rows.start, noise.outputs)
        piece = Piece(
            segment=s,
            observation=part,
            columns=columns,
            n_base=n_base,
            white=flat,
            sample=sample,
            windows=taken,
            nonzero=nonzero,
            noise=noise,
        )
        made = work(piece)
        progress.step(share * (s.rows.stop - s.rows.start))
        yield made


def _project_segment(
    some: Array, series: Array, count: int, nonzero: slice | NDArray[np.intp], windows: Sequence[Window]
) -> Array:
    """(count, rows): of so many columns those that are not zero, ``series``, whitened, ``some``, without what an unknown gradient spans."""
    if windows:
        some = some.copy() if np.shares_memory(some, series) else some
        unknown_gradient.project(some, windows)
    if isinstance(nonzero, slice):
        return some
    flat = np.zeros((count, some.shape[1]))
    flat[nonzero] = some
    return flat


@dataclass(frozen=True)
class PreparedFlight:
    """One flight about the calibrated parameters.

    Attributes
    ----------
    pieces
        Of a short flight its columns; those of a longer one (``None``) are computed anew in every pass.
    residual
        Of a thinned flight that of the whole record, thinned, (m, N) V.
    """

    observation: Observation
    noise: NoiseModel
    at: LinearisationPoint
    residual: Array | None = field(default=None, repr=False)
    pieces: tuple[Piece, ...] | None = field(default=None, repr=False)

    @property
    def edges(self) -> NDArray[np.intp]:
        """(BLOCKS + 1,): samples at which the blocks of time begin and end."""
        return make_block_edges(len(self.observation.record.time))

    def noise_psd(self, f: Array) -> Array:
        """One-sided density of the noise of the output before demodulation at frequencies f, V^2/Hz."""
        return self.noise.psd(f, self.observation.signs)

    def each(
        self, work: Callable[[Piece], R], *, chosen: Sequence[Segment] | None = None, whitened: bool = True
    ) -> Iterator[R]:
        """What ``work`` makes of every segment (or of the ``chosen``), in order: one pass over the flight. It must not keep one."""
        if self.pieces is not None:
            return map(work, self.pieces)
        return pass_over(
            self.at,
            self.observation,
            self.noise,
            work,
            chosen=chosen,
            whitened=whitened,
            residual=self.residual,
        )

    def lean(self, places: Sequence[int]) -> tuple[PreparedFlight, list[int]]:
        """What makes the columns of the base and those at ``places`` at least cost, and where it puts the latter."""
        if self.pieces is not None:
            return self, list(places)
        n = len(self.at.base)
        further = sorted({k - n for k in places if k >= n})
        known = range(len(self.at.candidates)) if self.at.only is None else self.at.only
        at = replace(self.at, with_candidates=bool(further), only=tuple(known[k] for k in further))
        return replace(self, at=at), [k if k < n else n + further.index(k - n) for k in places]

    def for_residuals(self, v: Array) -> tuple[PreparedFlight, Array]:
        """What yields residuals for coefficients v (k, size) at least cost, and these coefficients of its columns."""
        n = len(self.at.base)
        places = [*range(n), *(n + np.flatnonzero(np.any(v[:, n:], axis=0)))]
        lean, own = self.lean(places)
        w = np.zeros((len(v), v.shape[1] if lean is self else len(places)))
        w[:, own] = v[:, places]
        return lean, w

    def with_steps(self, instants: Mapping[str, float]) -> PreparedFlight:
        """The same with steps (effect -> instant, s)."""
        if dict(instants) == dict(self.at.instants):
            return self
        at = replace(self.at, instants=instants)
        return prepare_flight(self.observation, self.noise, at, self.residual)


def prepare_flight(
    o: Observation, noise: NoiseModel, at: LinearisationPoint, residual: Array | None = None
) -> PreparedFlight:
    """A flight about a point; ``residual`` is known of a thinned flight that was prepared about the same parameters."""
    if residual is None and o.thin is not None:
        residual = thin_residual(at, o.thin)
    if len(o.record.time) > ROWS:
        return PreparedFlight(o, noise, at, residual)
    pieces = pass_over(at, o, noise, lambda piece: piece, residual=residual)
    return PreparedFlight(o, noise, at, residual, tuple(pieces))


def factor_blocks(prepared: PreparedFlight) -> tuple[tuple[Array, ...], Array]:
    """Of the columns [base | candidates | residual]: R factors (n + 1, n + 1) of the whitened ones, one a block of
    time, and (BLOCKS, n + 1), V: sums of the plain ones of G_out.
    """
    samples = len(prepared.observation.record.time)

    def own(piece: Piece) -> list[tuple[int, Array, Array]]:
        first, parts = piece.segment.rows.start, split_at_blocks(piece.segment.rows, samples)
        return [
            (b, piece.r_factor(x.start, x.stop), piece.sums(slice(x.start - first, x.stop - first)))
            for b, x in parts
        ]

    r_factors: dict[int, Array] = {}
    totals: dict[int, Array] = {}
    for parts in prepared.each(own):  # a day has hundreds: those of a block are joined as they come
        for b, T, sums in parts:
            r_factors[b] = join([r_factors[b], T]) if b in r_factors else T
            totals[b] = totals[b] + sums if b in totals else sums
    nothing = np.zeros_like(next(iter(r_factors.values())))
    each = range(BLOCKS)
    return tuple(r_factors.get(b, nothing) for b in each), np.stack([totals.get(b, nothing[0]) for b in each])


DEPENDENT = 1e-6
"""Ratio of eigenvalues of inner products in single precision below which they are rounding."""


@dataclass(frozen=True)
class Projector:
    """Projects base and given columns out of whitened rows.

    Whitened columns (rows, len(taken)) times ``to_basis`` (len(taken), k) are orthonormal over all rows, without the directions
    that the data see worse than the prior; ``along`` (k,) are the residual's components. ``centre`` (len(taken),): of the priors of unit
    width that hold the columns' coefficients (NaN: none does).
    """

    taken: NDArray[np.intp]
    to_basis: Array
    along: Array
    centre: Array

    def basis(self, piece: Piece) -> Array:
        """(rows, k): the piece's rows of the orthonormal basis."""
        return np.asarray(piece.white[self.taken].T @ self.to_basis)

    def left(self, piece: Piece, Q: Array) -> Array:
        """(rows,): the whitened residual less its components along the basis."""
        return np.asarray(piece.white[-1] - Q @ self.along)

    def explained(self, along: Array, gram: Array, scores: Array) -> Array:
        """(m,): chi-square that the first 1, 2, ... m of further columns explain if the priors hold the coefficients of the taken ones.

        ``along`` (m, k): their components along the basis; ``gram`` (m, m), ``scores`` (m,): their inner products beside it, with one
        another and with the residual.
        """
        n, m, held = len(self.taken), len(scores), np.flatnonzero(np.isfinite(self.centre))
        sizes, U = np.linalg.eigh(gram)
        known = sizes > DEPENDENT * sizes[-1]  # columns that are nearly the same, in single precision
        root = np.sqrt(np.where(known, sizes, 0.0))
        beside = np.where(known, U.T @ scores, 0.0) / np.where(known, root, 1.0)
        X = np.vstack(
            [
                np.hstack([np.linalg.pinv(self.to_basis), along.T]),
                np.hstack([np.zeros((m, n)), root[:, None] * U.T]),
                np.hstack([np.eye(n)[held], np.zeros((len(held), m))]),
            ]
        )
        y = np.concatenate([self.along, beside, self.centre[held]])
        R = np.asarray(np.linalg.qr(np.column_stack([X, y]), mode="r"))
        new = np.abs(np.diag(R)[n : n + m]) > np.sqrt(DEPENDENT) * np.linalg.norm(X[:, n:], axis=0)
        return np.asarray(np.cumsum(np.where(new, R[n : n + m, -1], 0.0) ** 2))

    def lean(
        self, x: PreparedFlight, further: Sequence[int] = ()
    ) -> tuple[PreparedFlight, Projector, list[int]]:
        """What makes the columns that are taken, and ``further`` ones, at least cost, with the places of both in it."""
        x, places = x.lean([*self.taken, *further])
        k = len(self.taken)
        return x, replace(self, taken=np.array(places[:k], dtype=np.intp)), places[k:]


def make_projector(
    r_factors: Sequence[Array], n_base: int, given: Sequence[int], to_nominal: Array | None = None
) -> Projector:
    """The projector onto base and ``given`` candidate columns, from the block R factors of a flight; ``to_nominal`` (n_base,): where the
    priors of the base are centred.
    """
    taken = np.array([*range(n_base), *(n_base + n for n in given)], dtype=np.intp)
    T = join([t[:, [*taken, t.shape[1] - 1]] for t in r_factors])
    U, s, Vt = np.linalg.svd(T[:, :-1], full_matrices=False)
    seen = s > 1.0
    centre = np.full(len(taken), np.nan)
    if to_nominal is not None:
        centre[:n_base] = to_nominal
    return Projector(taken, np.asarray(Vt[seen].T / s[seen]), np.asarray(U[:, seen].T @ T[:, -1]), centre)
