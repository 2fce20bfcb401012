"""The model's derivatives at a point of its parameters, as columns of a fit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.fit import columns as design
from ragg_runtime.fit.columns import Column
from ragg_runtime.fit.observation import Observation
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.chain import Chain
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]


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


CACHED = 2048
"""Samples at which a generated module is evaluated at a time: its intermediates then stay in the cache."""


@dataclass(frozen=True)
class _Rows:
    """Which row of a generated module's derivatives makes which column, times what.

    ``own`` are parameters of one accelerometer, by its place; ``shared`` have one value for the instrument.
    """

    own: Mapping[int, Sequence[tuple[int, int, float]]]
    shared: Sequence[tuple[int, int, float]]

    @staticmethod
    def of(chain: Chain, columns: Sequence[Column], first: int) -> _Rows:
        """Of columns that are put from the place ``first`` on."""
        place = {name: k for k, (name, _) in enumerate(chain.ROWS)}
        own: dict[int, list[tuple[int, int, float]]] = {}
        shared = []
        for n, c in enumerate(columns):
            made = (first + n, place[c.name], c.scale)
            if c.accelerometer is None:
                shared.append(made)
            else:
                own.setdefault(c.accelerometer - 1, []).append(made)
        return _Rows(own=own, shared=shared)

    def put(self, target: Array, output: int, at: slice, rows: Array, j: int, sign: float) -> None:
        """Put derivatives of accelerometer j (rows, n), times its sign, into columns (columns, m, N) at some samples.

        Row by row, into their places: copies of many rows at a time would leave the cache.
        """
        for column, row, scale in self.own.get(j, ()):
            np.multiply(rows[row], sign * scale, out=target[column, output, at])
        part = np.empty(rows.shape[1])
        for column, row, scale in self.shared:
            place = target[column, output, at]
            np.add(place, np.multiply(rows[row], sign * scale, out=part), out=place)


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
    signs = None if o.recorded.separate else np.array(o.output.signs, dtype=np.float64)
    members = o.output.members
    columns = np.zeros((len(base) + len(candidates) + 1, m, n))
    for chain, evaluator, wanted, first, p in modules:
        x = r.inputs(chain)
        places = _Rows.of(chain, wanted, first)
        for start in range(0, n, CACHED):
            some = slice(start, min(start + CACHED, n))
            case = (r.time[some], x[:, some], p, r.phi[some], 1)
            for k, j in enumerate(members):
                sign, output = (1.0, k) if signs is None else (float(signs[k]), 0)
                places.put(columns, output, some, evaluator.derivatives(j, *case), j, sign)
            if first == 0:
                V = evaluator.voltages(*case, members=members)
                columns[-1, :, some] = V if signs is None else signs @ V
    if o.recorded.demodulated:
        for k in range(len(columns)):
            columns[k] = o.recorded.through(columns[k], r)
    for k, c in enumerate((*base, *candidates)):
        instant = at.instants.get(c.effect or "")
        if instant is not None:
            columns[k, :, r.time < instant] = 0.0
    np.subtract(o.data, columns[-1], out=columns[-1])
    if not r.valid.all():
        columns[:, :, ~r.valid] = 0.0
    return columns
