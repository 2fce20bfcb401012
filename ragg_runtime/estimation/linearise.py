"""The model's derivatives at a point of its parameters, as columns of a fit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.threads import stretches
from ragg_runtime.estimation import columns as design
from ragg_runtime.estimation.columns import Column
from ragg_runtime.estimation.observation import Observation, Thin, bridged
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.chain import Chain
from ragg_runtime.model.evaluator import Evaluator
from ragg_runtime.model.lateness import about
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import made_of

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Point:
    """About what a flight is linearised.

    ``instrument`` gives the columns their scales; ``p`` is the parameter vector of the model's chain, SI; ``instants`` are those of
    steps, by effect, s since the first sample; ``only`` the places of the wanted candidates' columns (``None``: all).
    """

    model: Model
    instrument: Instrument
    p: Array
    with_candidates: bool
    instants: Mapping[str, float] = field(default_factory=dict)
    only: tuple[int, ...] | None = None

    @cached_property
    def base(self) -> list[Column]:
        """The parameters of the model."""
        return [c for c, _ in design.base_columns(self.model, self.instrument)]

    @cached_property
    def candidates(self) -> list[Column]:
        """Those of the candidate effects whose columns are wanted."""
        every = design.candidate_columns(self.model, self.instrument) if self.with_candidates else []
        return every if self.only is None else [every[n] for n in self.only]

    @cached_property
    def rows(self) -> tuple[_Rows, _Rows]:
        """Which rows of chain and signatures make which columns."""
        chain, signatures = self.model.chain, self.model.signatures
        return _Rows.of(chain, self.base, 0), _Rows.of(signatures, self.candidates, len(self.base))

    @property
    def name(self) -> tuple[Chain, bytes]:
        """What tells the residuals of points apart."""
        return self.model.chain, self.p.tobytes()

    @cached_property
    def channels(self) -> frozenset[str]:
        """What of a record the outputs are made of."""
        return made_of(self.model.chain.INPUTS)


PART = 4096
"""Samples of a thinned record that are made of the whole one at a time."""

REMEMBERED = 2
"""Points about which the residual of a thinned record is remembered: the one at which a fit ended, and where another one is."""

CACHED = 4096
"""Samples at which a generated module is evaluated at a time: enough for what a call costs besides, few enough for the cache."""


@dataclass(frozen=True)
class _Run:
    """Neighbouring rows of a generated module's derivatives, the columns that they make, and their scales (k, 1)."""

    rows: slice
    columns: slice
    scale: Array


def _runs(made: Sequence[tuple[int, int, float]]) -> list[_Run]:
    """(column, row, scale) of one parameter after the other, gathered where rows are neighbours and columns evenly apart."""
    found: list[list[tuple[int, int, float]]] = []
    for one in made:
        last = found[-1] if found else []
        next_row = bool(last) and one[1] == last[-1][1] + 1
        if next_row and (len(last) == 1 or one[0] - last[-1][0] == last[1][0] - last[0][0]):
            last.append(one)
        else:
            found.append([one])
    return [
        _Run(
            rows=slice(own[0][1], own[-1][1] + 1),
            columns=slice(own[0][0], own[-1][0] + 1, own[1][0] - own[0][0] if len(own) > 1 else 1),
            scale=np.array([[scale] for _, _, scale in own]),
        )
        for own in found
    ]


@dataclass(frozen=True)
class _Rows:
    """Which rows of a generated module's derivatives make which columns, times what.

    ``own`` are parameters of one accelerometer, by its place; ``shared`` have one value for the instrument.
    """

    own: Mapping[int, Sequence[_Run]]
    shared: Sequence[_Run]

    @staticmethod
    def of(chain: Chain, columns: Sequence[Column], first: int) -> _Rows:
        """Of columns that are put from the place ``first`` on."""
        place = {name: k for k, (name, _) in enumerate(chain.ROWS)}
        made: dict[int | None, list[tuple[int, int, float]]] = {}
        for n, c in enumerate(columns):
            made.setdefault(c.accelerometer, []).append((first + n, place[c.name], c.scale))
        own = {j - 1: _runs(x) for j, x in made.items() if j is not None}
        return _Rows(own=own, shared=_runs(made.get(None, ())))

    @staticmethod
    def put(target: Array, at: slice, rows: Array, runs: Sequence[_Run], sign: float = 1.0) -> None:
        """Put derivatives (rows, n), times a sign, into columns (columns, N) at some samples."""
        for run in runs:
            np.multiply(rows[run.rows], sign * run.scale, out=target[run.columns, at])


@dataclass(frozen=True)
class _Module:
    """A generated module over an observation: its inputs (n_inputs, N), and which columns it makes."""

    evaluator: Evaluator
    inputs: Array
    p: Array
    rows: _Rows

    def put(self, columns: Array, o: Observation, some: slice) -> None:
        """Columns (columns, m, N) of some samples."""
        case, rows = self._case(o, some), self.rows
        if o.recorded.separate:
            for k, j in enumerate(o.output.members):
                rows.put(
                    columns[:, k],
                    some,
                    self.evaluator.derivatives(j, *case),
                    (*rows.own.get(j, ()), *rows.shared),
                )
            return
        together: Array | None = None  # signed sum over the accelerometers, in the cache
        for j, sign in zip(o.output.members, o.output.signs, strict=True):
            found = self.evaluator.derivatives(j, *case)
            rows.put(columns[:, 0], some, found, rows.own.get(j, ()), sign)
            if rows.shared and together is None:
                together = found if sign > 0 else np.negative(found, out=found)
            elif together is not None:
                (np.add if sign > 0 else np.subtract)(together, found, out=together)
        if together is not None:
            rows.put(columns[:, 0], some, together, rows.shared)

    def predict(self, found: Array, o: Observation, some: slice) -> None:
        """The outputs themselves (m, N), V, at some samples."""
        V = self.evaluator.voltages(*self._case(o, some), members=o.output.members)
        found[:, some] = V if o.recorded.separate else np.array(o.output.signs, dtype=np.float64) @ V

    def _case(self, o: Observation, some: slice) -> tuple[Array, Array, Array, Array]:
        return o.record.time[some], self.inputs[:, some], self.p, o.record.phi[some]


def linearised(at: Point, o: Observation) -> Array:
    """Base columns, candidates (if wanted), each times its parameter's scale, and residual: (n + 1, m, N), V."""
    base, candidates = at.base, at.candidates
    evaluators, (r, p) = at.model.evaluators, about(at.model, o.record, at.p)

    def module(name: str, chain: Chain, p: Array, rows: _Rows) -> _Module:
        return _Module(evaluator=evaluators(name), inputs=r.inputs(chain), p=p, rows=rows)

    chain = module("chain", at.model.chain, p, at.rows[0])
    modules = [chain]
    if candidates:
        q = np.concatenate([p, np.zeros(at.model.signatures.SIZE - len(p))])
        modules.append(module("signatures", at.model.signatures, q, at.rows[1]))
    # of one output that sums all accelerometers every column is written
    every = not o.recorded.separate and len(o.output.members) == at.instrument.layout.size
    columns = (np.empty if every else np.zeros)((len(base) + len(candidates) + 1, len(o.series), len(r.time)))

    for some in stretches(len(r.time), CACHED):
        for x in modules:
            x.put(columns, o, some)
        if o.thin is None:
            chain.predict(columns[-1], o, some)
    if o.recorded.demodulated:
        for k in range(len(columns)):
            columns[k] = o.recorded.through(columns[k], r)
    if o.thin is None:
        np.subtract(o.data, columns[-1], out=columns[-1])
    else:
        _left_of_the_whole(at, o.thin, columns[-1])
    for k, c in enumerate((*base, *candidates)):
        instant = at.instants.get(c.effect or "")
        if instant is not None:
            columns[k, :, r.time < instant] = 0.0
    if not r.valid.all():
        columns[:, :, ~r.valid] = 0.0
    return columns


def _left_of_the_whole(at: Point, thin: Thin, residual: Array) -> None:
    """Put the residual (m, N) of a thinned record in place: that of the whole one, thinned, for the outputs are a million times the
    noise.
    """
    known = _known(at, thin)

    for some in stretches(residual.shape[1], PART):
        part = thin.part(some)
        rows = (part.rows.start, part.rows.stop)
        if rows not in known:
            known[rows] = part.kept(left(at, part.source(at.channels)))
        residual[:, some] = known[rows]


def _known(at: Point, thin: Thin) -> dict[tuple[int, int], Array]:
    """What is known of the residual about a point: every pass over a long flight asks for the same again."""
    found = thin.memo.pop(at.name, {})
    while len(thin.memo) >= REMEMBERED:  # what was asked for longest ago
        del thin.memo[next(iter(thin.memo))]
    thin.memo[at.name] = found
    return found


def left(at: Point, o: Observation) -> Array:
    """Residual (m, N), V, at a point; between its neighbours where a sample is not valid."""
    r, p = about(at.model, o.record, at.p)
    evaluator, inputs = at.model.evaluators("chain"), r.inputs(at.model.chain)
    chain = _Module(evaluator=evaluator, inputs=inputs, p=p, rows=at.rows[0])
    found = np.empty((len(o.series), len(r.time)))
    for some in stretches(len(r.time), CACHED):
        chain.predict(found, o, some)
    np.subtract(o.data, found, out=found)
    return np.stack([bridged(x, r.valid) for x in found])
