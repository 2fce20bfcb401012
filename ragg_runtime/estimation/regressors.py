"""The model's derivatives at a point of its parameters, as regressors of a fit: which there are, and their values over a flight."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.threads import stretches
from ragg_runtime.estimation.observation import Observation, Thin, bridged
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.instrument.units import Units, units
from ragg_runtime.model.evaluate import Evaluator, unit_factor
from ragg_runtime.model.lateness import about
from ragg_runtime.model.model import Chain, Effect, Model
from ragg_runtime.model.record import made_of

Array = NDArray[np.float64]

UNOBSERVABLE = ("k_VI", "vartheta_x")
"""Parameters that no record can tell: k_VI enters only as k_VI K1, vartheta_x not at the paper's order."""

EFFECT_PRIOR = 10.0
"""Width of the prior of an effect's parameter, in plausible sizes: what is missing may well surprise."""


@dataclass(frozen=True)
class Column:
    """One scalar parameter as a column of a fit: the derivative times ``scale``, the width of its prior, SI.

    ``accelerometer`` is 1 ... n, or ``None`` if shared; ``unit_factor`` the display unit's SI value; ``effect`` the id of the
    effect that brings it, ``None`` for the paper's instrument. What a calibration file does not hold (``symbol`` in LaTeX,
    ``meaning``, ``accelerometer_name``) is empty.
    """

    name: str
    accelerometer: int | None
    scale: float
    unit: str
    unit_factor: float
    effect: str | None
    symbol: str = ""
    meaning: str = ""
    accelerometer_name: str = ""

    @property
    def label(self) -> str:
        return self.name if self.accelerometer is None else f"{self.name}[{self.accelerometer}]"


def spelt(accelerometer: int | None, name: str) -> dict[str, str]:
    """What JSON says beside an accelerometer's number: its name on the sheet, where that is not A and the number."""
    return {} if name in ("", f"A{accelerometer}") else {"accelerometer_name": name}


def base_columns(model: Model, instrument: Instrument) -> list[tuple[Column, int]]:
    """The calibratable parameters of the model, each with its index in the parameter vector."""
    known = units(instrument.g0)
    found: list[tuple[Column, int]] = []
    start = {}
    position = 0
    places = instrument.layout.names
    for name, size in model.chain.PARAMETERS:
        start[name] = position
        position += size
    for q in PARAMETERS:
        if q.name in UNOBSERVABLE:
            continue
        factor = unit_factor(q.display_unit, known)
        scales = instrument.sigma(q.name)
        for j in range(instrument.layout.size):
            column = Column(
                name=q.name,
                accelerometer=j + 1,
                scale=float(scales[j]),
                unit=q.display_unit,
                unit_factor=factor,
                effect=None,
                symbol=q.symbol,
                meaning=q.description,
                accelerometer_name=places[j],
            )
            found.append((column, start[q.name] + j))
    for e in model.effects:
        if e.kind in ("deterministic", "step"):
            found += [(c, start[s] + (c.accelerometer or 1) - 1) for c, s in _of_effect(e, known, instrument)]
    return found


def own_columns(columns: Sequence[Column], instrument: Instrument, place: int) -> list[int]:
    """Which of the fitted parameters an output's accelerometers have, or share with others."""
    members = instrument.layout.outputs[place].members
    return [k for k, c in enumerate(columns) if c.accelerometer is None or c.accelerometer - 1 in members]


def candidate_columns(model: Model, instrument: Instrument) -> list[Column]:
    """The parameters of the effects that are not in the model, in the order of the signatures' rows."""
    known = units(instrument.g0)
    return [c for e in model.candidates if e.kind != "output" for c, _ in _of_effect(e, known, instrument)]


def _of_effect(e: Effect, known: Units, instrument: Instrument) -> list[tuple[Column, str]]:
    columns = []
    places = instrument.layout.names
    for q in e.parameters:
        if not q.fitted:
            continue
        factor = unit_factor(q.unit, known)
        scale = EFFECT_PRIOR * q.plausible * factor * instrument.grade(q.like)
        for j in (None,) if q.shared else range(1, instrument.layout.size + 1):
            column = Column(
                name=f"{e.id}.{q.name}",
                accelerometer=j,
                scale=scale,
                unit=q.unit,
                unit_factor=factor,
                effect=e.id,
                symbol=q.latex,
                meaning=q.meaning,
                accelerometer_name="" if j is None else places[j - 1],
            )
            columns.append((column, q.symbol))
    return columns


def heard(columns: Sequence[Column], instrument: Instrument, place: int) -> slice | NDArray[np.intp]:
    """Which of these columns, and of the residual after them, are not zero in an output; a slice if there is one output."""
    if len(instrument.layout.outputs) == 1:
        return slice(None)
    return np.array([*own_columns(columns, instrument, place), len(columns)], dtype=np.intp)


def observed(o: Observation, v: Array, accelerometer: int | None) -> Array:
    """What an observation sees of its output's voltages: (members, N), or (N,) of one accelerometer -> (m, N)."""
    return o.recorded.through(o.recorded.of_voltages(o.output, v, accelerometer), o.record)


def null_biases(columns: Sequence[Column]) -> list[int]:
    """Places of the instrument's K0 among columns."""
    return [n for n, c in enumerate(columns) if c.name == "K0" and c.effect is None]


def levelled(coefficients: Array, sums: Array, biases: Sequence[int]) -> Array:
    """Coefficients (n,) with those at ``biases`` shifted until the residual of G_out has no mean.

    ``sums`` (n + 1,) are those of the columns and of the data over all samples; zeros: nothing is shifted.
    """
    own = sums[list(biases)]
    shifted = coefficients.copy()
    if np.any(own):
        left = sums[-1] - sums[:-1] @ coefficients
        shifted[list(biases)] += own * left / (own @ own)
    return shifted


def grouped(columns: Iterable[Column], offset: int = 0) -> dict[str, list[tuple[int, Column]]]:
    """Effect id -> its (position, column)s."""
    groups: dict[str, list[tuple[int, Column]]] = {}
    for n, c in enumerate(columns):
        if c.effect is not None:
            groups.setdefault(c.effect, []).append((n + offset, c))
    return groups


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
        return [c for c, _ in base_columns(self.model, self.instrument)]

    @cached_property
    def candidates(self) -> list[Column]:
        """Those of the candidate effects whose columns are wanted."""
        every = candidate_columns(self.model, self.instrument) if self.with_candidates else []
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
