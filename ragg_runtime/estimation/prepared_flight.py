"""Flights prepared for diagnosis: triangles of whitened columns in blocks of time, and passes over the columns."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.calibrate import Calibration
from ragg_runtime.estimation.linearise import Point
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.estimation.passes import Piece, passed, whitened_columns
from ragg_runtime.estimation.segments import BLOCKS, ROWS, block_edges
from ragg_runtime.estimation.square_root import join
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]
R = TypeVar("R")


@dataclass(frozen=True)
class PreparedFlight:
    """One flight about the calibrated parameters.

    A short flight keeps its columns in memory; those of a longer one are computed anew in every pass.
    """

    observation: Observation
    noise: NoiseModel
    at: Point
    _kept: list[Piece] = field(default_factory=list, repr=False)

    @property
    def edges(self) -> NDArray[np.intp]:
        """(BLOCKS + 1,): samples at which the blocks of time begin and end."""
        return block_edges(len(self.observation.record.time))

    def noise_psd(self, f: Array) -> Array:
        """One-sided density of the noise of the output before demodulation at frequencies f, V^2/Hz."""
        return self.noise.psd(f, self.observation.signs)

    def each(self, work: Callable[[Piece], R], *, whitened: bool = True, effort: float = 0.0) -> Iterator[R]:
        """What ``work`` makes of every segment, in order: one pass over the flight. It must not keep a segment."""
        if self._kept:
            return map(work, self._kept)
        if not whitened or len(self.observation.record.time) > ROWS:
            return passed(self.at, self.observation, self.noise, work, whitened=whitened, effort=effort)
        self._kept.extend(passed(self.at, self.observation, self.noise, lambda piece: piece))
        return map(work, self._kept)

    def lean(self, places: Sequence[int]) -> tuple[PreparedFlight, list[int]]:
        """What makes the columns of the base and those at ``places`` at least cost, and where it puts the latter."""
        if self._kept:
            return self, list(places)
        n = len(self.at.base)
        further = sorted({k - n for k in places if k >= n})
        known = range(len(self.at.candidates)) if self.at.only is None else self.at.only
        at = replace(self.at, with_candidates=bool(further), only=tuple(known[k] for k in further))
        return replace(self, at=at, _kept=[]), [k if k < n else n + further.index(k - n) for k in places]

    def for_residuals(self, v: Array) -> tuple[PreparedFlight, Array]:
        """What yields residuals for coefficients v (k, size) at least cost, and these coefficients of its columns."""
        n = len(self.at.base)
        places = [*range(n), *(n + np.flatnonzero(np.any(v[:, n:], axis=0)))]
        lean, own = self.lean(places)
        w = np.zeros((len(v), v.shape[1] if lean is self else len(places)))
        w[:, own] = v[:, places]
        return lean, w

    def with_steps(
        self, instants: Mapping[str, float], places: Mapping[str, Sequence[int]]
    ) -> PreparedFlight:
        """The same with steps (effect -> instant, s; effect -> places of its columns). Kept columns move to it."""
        moved = [k for e in instants for k in places[e]]
        kept = list(self._kept)
        self._kept.clear()
        for piece in kept:  # a flight that is kept is one segment: the filter starts from rest
            record = piece.observation.record
            for e, instant in instants.items():
                piece.columns[places[e], :, : int(np.searchsorted(record.time, instant))] = 0.0
            part = whitened_columns(piece.columns[moved], self.noise, None, record)
            unknown_gradient.project(part, piece.windows)
            piece.white[moved] = part
        return replace(self, at=replace(self.at, instants=instants), _kept=kept)

    def released(self) -> PreparedFlight:
        """The same without the columns."""
        return replace(self, _kept=[])

    def release(self) -> None:
        """Free the memory of kept columns; should this flight be asked again, it computes them anew."""
        self._kept.clear()


def blocks(prepared: PreparedFlight) -> tuple[tuple[Array, ...], Array]:
    """Of the columns [base | candidates | residual]: triangles (n + 1, n + 1) of the whitened ones, one a block of
    time, and (BLOCKS, n + 1), V: sums of the plain ones of G_out.
    """
    size = 1

    def own(piece: Piece) -> list[tuple[int, Array, Array]]:
        first = piece.segment.rows.start
        return [
            (
                b,
                piece.triangle(rows.start, rows.stop),
                piece.sums(slice(rows.start - first, rows.stop - first)),
            )
            for b, rows in piece.segment.blocks
        ]

    triangles: list[Array | None] = [None] * BLOCKS
    totals: list[Array | float] = [0.0] * BLOCKS
    for parts in prepared.each(own):
        for b, T, sums in parts:
            size = len(T)
            before = triangles[b]
            triangles[b] = T if before is None else join([before, T])
            totals[b] = totals[b] + sums
    empty = np.zeros((size, size))
    return (
        tuple(empty if t is None else t for t in triangles),
        np.stack([np.broadcast_to(x, size) for x in totals]),
    )


def prepare(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    c: Calibration,
    *,
    candidates: bool,
) -> tuple[PreparedFlight, ...]:
    """Every flight about the calibrated parameters."""
    at = Point(model, instrument, c.p, with_candidates=candidates)
    return tuple(PreparedFlight(o, noise, at) for o, noise in zip(observations, c.noise, strict=True))


def to_nominal(model: Model, instrument: Instrument, c: Calibration) -> Array:
    """(n_base,): how far the nominal values are from the calibrated ones, in scales: the prior's centre."""
    scale = np.array([q.scale for q in c.columns])
    return np.asarray((vector(model, instrument)[c.index] - c.p[c.index]) / scale)


@dataclass(frozen=True)
class Projector:
    """Takes whatever base and given columns can explain out of whitened rows.

    Whitened columns (rows, len(taken)) times ``to_basis`` (len(taken), k) are orthonormal over all rows, without the directions
    that the data see worse than the prior; ``along`` (k,) are the residual's components.
    """

    taken: NDArray[np.intp]
    to_basis: Array
    along: Array

    def basis(self, piece: Piece) -> Array:
        """(rows, k): the piece's rows of the orthonormal basis."""
        return np.asarray(piece.white[self.taken].T @ self.to_basis)

    def left(self, piece: Piece, Q: Array) -> Array:
        """(rows,): the whitened residual less its components along the basis."""
        return np.asarray(piece.white[-1] - Q @ self.along)

    def lean(
        self, x: PreparedFlight, further: Sequence[int] = ()
    ) -> tuple[PreparedFlight, Projector, list[int]]:
        """What makes the columns that are taken, and ``further`` ones, at least cost, with the places of both in it."""
        x, places = x.lean([*self.taken, *further])
        k = len(self.taken)
        return x, replace(self, taken=np.array(places[:k], dtype=np.intp)), places[k:]


def projector(triangles: Sequence[Array], n_base: int, given: Sequence[int]) -> Projector:
    """The projector onto base and ``given`` candidate columns, from the block triangles of a flight."""
    taken = np.array([*range(n_base), *(n_base + n for n in given)], dtype=np.intp)
    T = join([t[:, [*taken, t.shape[1] - 1]] for t in triangles])
    U, s, Vt = np.linalg.svd(T[:, :-1], full_matrices=False)
    seen = s > 1.0
    return Projector(taken, np.asarray(Vt[seen].T / s[seen]), np.asarray(U[:, seen].T @ T[:, -1]))
