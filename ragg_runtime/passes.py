"""One pass over a flight: segment after segment, linearised about a parameter vector and whitened."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ragg_runtime import design, gradient, progress
from ragg_runtime.design import Column, Observation
from ragg_runtime.gradient import Window
from ragg_runtime.instrument import Instrument
from ragg_runtime.load import Chain, Model
from ragg_runtime.segments import ROWS, Segment, segments
from ragg_runtime.threads import mapped
from ragg_runtime.whiten import NoiseModel, filtered

Array = NDArray[np.float64]
R = TypeVar("R")


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

    def sums(self, some: slice = slice(None)) -> Array:
        """(n + 1,), V: sums of the columns of G_out over some samples; zero of channels, which have lost their mean."""
        weights = output_weights(self.observation) * (self.observation.kind != "channels")
        return np.asarray(np.sum(self.columns[:, :, some], axis=2) @ weights)

    def left(self, coefficients: Array) -> Array:
        """Residuals of G_out (k, N), V, once columns have these coefficients (k, n); no unknown gradient."""
        n = coefficients.shape[1]
        e = self.columns[-1] - np.tensordot(coefficients, self.columns[:n], 1)
        e = gradient.without(e, self.windows, self.observation.record.valid)
        return as_output(self.observation, e)


def as_output(o: Observation, e: Array) -> Array:
    """G_out (..., N) of what an observation holds (..., m, N): itself, or the sum of the voltages with their signs (Eq. 15)."""
    return np.asarray(np.einsum("m,...mn->...n", output_weights(o), e))


def output_weights(o: Observation) -> Array:
    """(m,): how much each output of an observation counts in G_out."""
    return len(o.weights) * o.weights if o.kind == "voltages" else o.weights


def flight_segments(o: Observation) -> list[Segment]:
    """The segments of a flight. Demodulated channels are not divided: their columns pass a two-sided filter."""
    n = len(o.record.time)
    return segments(n, max(n, ROWS) if o.kind == "channels" else ROWS)


CACHED = 2048
"""Samples at which a generated module is evaluated at a time: its intermediates then stay in the cache."""


@dataclass(frozen=True)
class _Rows:
    """Which rows of a generated module's derivatives make which columns, and their scales."""

    column: NDArray[np.intp]
    row: NDArray[np.intp]
    accelerometer: NDArray[np.intp]
    scale: Array

    @staticmethod
    def of(chain: Chain, columns: Sequence[Column], first: int, shared: bool) -> _Rows:
        """Those of parameters with one value for the instrument, or with one for each accelerometer."""
        place = {name: k for k, (name, _) in enumerate(chain.ROWS)}
        found = [(first + n, c) for n, c in enumerate(columns) if (c.accelerometer is None) == shared]
        return _Rows(
            np.array([n for n, _ in found], dtype=np.intp),
            np.array([place[c.name] for _, c in found], dtype=np.intp),
            np.array([(c.accelerometer or 1) - 1 for _, c in found], dtype=np.intp),
            np.array([c.scale for _, c in found]),
        )

    def put(
        self,
        target: Array,
        at: slice,
        rows: Sequence[Array],
        shared: bool,
        members: Sequence[int],
        signs: Array | None,
    ) -> None:
        """Put derivatives, of each accelerometer of an output (rows, n), into columns (columns, m, N) at some samples.

        ``signs`` combine them.
        """
        for k, j in enumerate(members):
            sign = 1.0 if signs is None else signs[k]
            output = k if signs is None else 0
            if shared:
                target[self.column, output, at] += rows[k][self.row] * (sign * self.scale[:, None])
            else:
                own = self.accelerometer == j
                target[self.column[own], output, at] = rows[k][self.row[own]] * (sign * self.scale[own, None])


def linearised(at: Point, o: Observation) -> Array:
    """Base columns, candidates (if wanted), each times its parameter's scale, and residual: (n + 1, m, N), V."""
    base = [c for c, _ in design.base_columns(at.model, at.instrument)]
    candidates = design.candidate_columns(at.model, at.instrument) if at.with_candidates else []
    evaluators = at.model.evaluators
    modules = [(at.model.chain, evaluators["chain"], base, 0, at.p)]
    if candidates:
        q = np.concatenate([at.p, np.zeros(at.model.signatures.SIZE - len(at.p))])
        modules.append((at.model.signatures, evaluators["signatures"], candidates, len(base), q))
    r, m = o.record, len(o.series)
    n = len(r.time)
    signs = None if o.kind == "voltages" else np.array(o.output.signs, dtype=np.float64)
    members = o.output.members
    columns = np.zeros((len(base) + len(candidates) + 1, m, n))
    for chain, evaluator, wanted, first, p in modules:
        x = r.inputs(chain)
        own, shared = (_Rows.of(chain, wanted, first, s) for s in (False, True))
        for start in range(0, n, CACHED):
            some = slice(start, min(start + CACHED, n))
            case = (r.time[some], x[:, some], p, r.phi[some], 1)
            rows = [evaluator.derivatives(j, *case) for j in members]
            own.put(columns, some, rows, False, members, signs)
            shared.put(columns, some, rows, True, members, signs)
            if first == 0:
                V = evaluator.voltages(*case, members=members)
                columns[-1, :, some] = V if signs is None else signs @ V
    if o.kind == "channels":
        for k in range(len(columns)):
            columns[k] = design.narrow(columns[k], r)
    for k, c in enumerate((*base, *candidates)):
        instant = at.instants.get(c.effect or "")
        if instant is not None:
            columns[k, :, r.time < instant] = 0.0
    np.subtract(o.data, columns[-1], out=columns[-1])
    if not r.valid.all():
        columns[:, :, ~r.valid] = 0.0
    return columns


def passed(
    at: Point,
    o: Observation,
    noise: Noise,
    work: Callable[[Piece], R],
    *,
    chosen: Sequence[Segment] | None = None,
    whitened: bool = True,
    effort: float = 0.0,
) -> Iterator[R]:
    """What ``work`` makes of every segment of a flight, in order; several segments are worked on at a time.

    ``chosen`` are some of the segments: then filters of more than one tap start from rest in each. If
    ``whitened`` is not wanted, the columns alone are made. ``work`` must not keep a piece of several; it takes
    ``effort`` times as long as what makes the piece.
    """
    n_base = len(design.base_columns(at.model, at.instrument))
    found = flight_segments(o) if chosen is None else chosen
    memory = max(len(t) for t in noise.filters) - 1 if whitened and chosen is None else 0
    tails: list[Future[Array | None]] = [Future() for _ in found]

    def one(k: int) -> R:
        s = found[k]
        part = o.part(s.rows)
        columns = linearised(at, part)
        flat, sample = np.empty((len(columns), 0)), np.empty(0, dtype=np.intp)
        windows = gradient.windows(o, s.rows, noise.filters)
        if whitened:
            tail = None
            if k and memory:
                tail = tails[k - 1].result()  # the segment before was begun before
                tails[k - 1] = Future()  # its memory is free again
            tails[k].set_result(_carried(tail, columns, memory))
            flat = whitened_columns(columns, noise, tail, part.record.valid)
            gradient.project(flat, windows)
            sample = np.tile(np.flatnonzero(part.record.valid) + s.rows.start, len(noise.filters))
        return work(Piece(s, part, columns, n_base, flat, sample, windows))

    def guarded(k: int) -> R:
        try:
            return one(k)
        except BaseException as error:
            if not tails[k].done():
                tails[k].set_exception(error)
            raise

    share = (1.0 if at.with_candidates else 0.4) * (1.0 if whitened else 0.5) * (1.0 + effort)
    for s, made in zip(found, mapped(guarded, range(len(found))), strict=True):
        progress.step(share * (s.rows.stop - s.rows.start))
        yield made


def whitened_columns(columns: Array, noise: Noise, tail: Array | None, valid: NDArray[np.bool_]) -> Array:
    """(n + 1, rows): columns (n + 1, m, N) through the filters, one output after the other."""
    rows = []
    for m, taps in enumerate(noise.filters):
        y = filtered(columns[:, m], taps, None if tail is None else tail[:, m])
        rows.append(y if valid.all() else y[:, valid])
    return rows[0] if len(rows) == 1 else np.concatenate(rows, axis=1)


def _carried(tail: Array | None, columns: Array, memory: int) -> Array | None:
    """What a filter remembers once it has seen ``columns``."""
    if memory == 0:
        return None
    n = columns.shape[2]
    if n >= memory:
        return columns[:, :, n - memory :]
    kept = columns if tail is None else np.concatenate([tail, columns], axis=2)
    return kept[:, :, -memory:]
