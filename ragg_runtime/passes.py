"""One pass over a flight: segment after segment, linearised about a parameter vector and whitened."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ragg_runtime import design, gradient
from ragg_runtime.design import Observation
from ragg_runtime.gradient import Window
from ragg_runtime.instrument import Instrument
from ragg_runtime.load import Model
from ragg_runtime.segments import ROWS, Segment, segments
from ragg_runtime.whiten import NoiseModel, filtered

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Noise:
    """Noise of each output of an observation, and its whitening filters."""

    models: tuple[NoiseModel, ...]
    filters: tuple[Array, ...]


@dataclass(frozen=True)
class Point:
    """About what a flight is linearised.

    Attributes
    ----------
    model, instrument
        The model, and the test sheet that gives the columns their scales.
    p
        Parameter vector of the model's chain, SI.
    with_candidates
        Whether the columns of the candidate effects are wanted.
    instants
        Effect id -> instant of its step, s since the first sample; at all times where none is given.
    """

    model: Model
    instrument: Instrument
    p: Array
    with_candidates: bool
    instants: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Piece:
    """A segment of a flight about one parameter vector.

    Attributes
    ----------
    segment, observation
        Which part of the flight, and the part itself (N samples, m outputs).
    columns
        (n + 1, m, N), V: base, candidates, each times its parameter's scale; the residual last.
    n_base
        How many of them are base columns.
    white
        (n + 1, rows): the same whitened, an unknown gradient projected out; one output after the other.
    sample
        (rows,): the flight's sample that a whitened row ends at.
    windows
        What an unknown gradient spans.
    """

    segment: Segment
    observation: Observation
    columns: Array
    n_base: int
    white: Array
    sample: NDArray[np.intp]
    windows: Sequence[Window]

    @property
    def residual(self) -> Array:
        """(m, N), V."""
        return np.asarray(self.columns[-1])

    def left(self, coefficients: Array) -> Array:
        """Residuals of G_out (k, N), V, once columns have these coefficients (k, n); no unknown gradient."""
        n = coefficients.shape[1]
        e = self.columns[-1] - np.tensordot(coefficients, self.columns[:n], 1)
        e = gradient.without(e, self.windows, self.observation.record.valid)
        return as_output(self.observation, e)


def as_output(o: Observation, e: Array) -> Array:
    """G_out (..., N) of what an observation holds (..., m, N): itself, or V_1 + V_2 - V_3 - V_4 (Eq. 15)."""
    return np.asarray(np.einsum("m,...mn->...n", 4 * o.weights if o.kind == "voltages" else o.weights, e))


def flight_segments(o: Observation) -> list[Segment]:
    """The segments of a flight. Demodulated channels are not divided: their columns pass a two-sided filter."""
    n = len(o.record.time)
    return segments(n, max(n, ROWS) if o.kind == "channels" else ROWS)


def linearised(at: Point, o: Observation) -> Array:
    """Base columns, candidates (if wanted), each times its parameter's scale, and residual: (n + 1, m, N), V."""
    V, by = design.derivatives(at.model.chain, o.record, at.p)
    known = [(c, by) for c, _ in design.base_columns(at.model, at.instrument)]
    if at.with_candidates and (wanted := design.candidate_columns(at.model, at.instrument)):
        q = np.concatenate([at.p, np.zeros(at.model.signatures.SIZE - len(at.p))])
        _, of_candidates = design.derivatives(at.model.signatures, o.record, q)
        known += [(c, of_candidates) for c in wanted]
    columns = np.empty((len(known) + 1, *o.data.shape))
    for n, (c, rows) in enumerate(known):
        v = rows[c.name, c.accelerometer]
        instant = at.instants.get(c.effect or "")
        if instant is not None:
            v = np.where(o.record.time >= instant, v, 0.0)
        columns[n] = design.observe(o, v, c.accelerometer)
        columns[n] *= c.scale
    columns[-1] = o.data - design.observe(o, V, None)
    if not o.record.valid.all():
        columns[:, :, ~o.record.valid] = 0.0
    return columns


def pieces(
    at: Point, o: Observation, noise: Noise | None, chosen: Sequence[Segment] | None = None
) -> Iterator[Piece]:
    """The segments of a flight, in order; without ``noise`` not whitened.

    ``chosen`` are some of the segments: then filters of more than one tap start from rest in each.
    """
    n_base = len(design.base_columns(at.model, at.instrument))
    tail: Array | None = None
    for s in flight_segments(o) if chosen is None else chosen:
        part = o.part(s.rows)
        columns = linearised(at, part)
        flat = np.empty((len(columns), 0))
        sample = np.empty(0, dtype=np.intp)
        windows: list[Window] = []
        if noise is not None:
            valid = part.record.valid
            rows = [
                filtered(columns[:, m], taps, None if tail is None else tail[:, m])[:, valid]
                for m, taps in enumerate(noise.filters)
            ]
            flat = rows[0] if len(rows) == 1 else np.concatenate(rows, axis=1)
            windows = gradient.windows(o, s.rows, noise.filters)
            gradient.project(flat, windows)
            sample = np.tile(np.flatnonzero(valid) + s.rows.start, len(rows))
            if chosen is None:
                tail = _carried(tail, columns, max(len(t) for t in noise.filters) - 1)
        yield Piece(s, part, columns, n_base, flat, sample, windows)


def _carried(tail: Array | None, columns: Array, memory: int) -> Array | None:
    """What a filter remembers once it has seen ``columns``."""
    if memory == 0:
        return None
    n = columns.shape[2]
    if n >= memory:
        return columns[:, :, n - memory :].copy()
    kept = columns if tail is None else np.concatenate([tail, columns], axis=2)
    return kept[:, :, -memory:].copy()
