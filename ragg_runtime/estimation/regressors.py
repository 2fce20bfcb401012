"""The model's derivatives at a point of its parameters, as regressors of a fit: which there are, and their values over a flight."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.progress import split_range
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.instrument.instrument import PARAMETERS, Instrument
from ragg_runtime.instrument.layout import Output
from ragg_runtime.instrument.units import Units, units
from ragg_runtime.model.chain import Chain
from ragg_runtime.model.memory import add_responses, first_memories, move_record
from ragg_runtime.model.model import DerivedEffect, Model, evaluate_voltages, find_unit_factor
from ragg_runtime.model.record import Record, RecordedSeries
from ragg_runtime.signals.derivative import bridge_gaps

Array = NDArray[np.float64]

# parameters that no record can tell: k_VI enters only as k_VI K1, vartheta_x not at the paper's order
UNOBSERVABLE = ("k_VI", "vartheta_x")
# width of the prior of an effect's parameter, in plausible sizes: what is missing may well surprise
EFFECT_PRIOR = 10.0


@dataclass(frozen=True)
class Column:
    """One scalar parameter as a column of a fit: the derivative times ``scale``, the width of its prior, SI.

    ``accelerometer`` is 1 ... n, or ``None`` if shared; ``unit_factor`` the display unit's SI value; ``effect`` the id of the
    effect that brings it, ``None`` for the paper's instrument. ``accelerometer_name`` is empty where it is
    read from a calibration file.
    """

    name: str
    accelerometer: int | None
    scale: float
    unit: str
    unit_factor: float
    effect: str | None
    accelerometer_name: str = ""

    @property
    def label(self) -> str:
        return self.name if self.accelerometer is None else f"{self.name}[{self.accelerometer}]"


def spell_name(accelerometer: int | None, name: str) -> dict[str, str]:
    """For JSON, next to an accelerometer's number: its name on the sheet, where that is not A and the number."""
    return {} if name in ("", f"A{accelerometer}") else {"accelerometer_name": name}


def list_base_columns(model: Model, instrument: Instrument) -> list[tuple[Column, int]]:
    """The calibratable parameters of the model, each with its index in the parameter vector."""
    table = units(instrument.g0)
    columns: list[tuple[Column, int]] = []
    start = {name: place.start for name, place in model.chain.places.items()}
    for q in PARAMETERS:
        if q.name in UNOBSERVABLE or q.name in instrument.fixed:
            continue
        factor, scales = find_unit_factor(q.display_unit, table), instrument.sigma(q.name)
        for j, place in enumerate(instrument.layout.names):
            c = Column(q.name, j + 1, float(scales[j]), q.display_unit, factor, None, place)
            columns.append((c, start[q.name] + j))
    for e in model.effects:
        if e.kind in ("deterministic", "step"):
            setting = instrument.effect(e.id)
            out = instrument.held | {f"{e.id}.{n}" for n in (setting.fixed if setting else ())}
            free = (
                (c, s) for c, s in _list_effect_columns(e, table, instrument) if not {c.name, c.label} & out
            )
            columns += [(c, start[s] + (c.accelerometer or 1) - 1) for c, s in free]
    return columns


def list_own_columns(columns: Sequence[Column], instrument: Instrument, place: int) -> list[int]:
    """Which of the fitted parameters an output's accelerometers have, or share with others."""
    members = instrument.layout.outputs[place].members
    return [k for k, c in enumerate(columns) if c.accelerometer is None or c.accelerometer - 1 in members]


def list_candidate_columns(model: Model, instrument: Instrument) -> list[Column]:
    """The parameters of the effects that are searched for and not in the model, in the order of the signatures' rows."""
    table = units(instrument.g0)
    searched = (e for e in model.candidates if e.kind != "output" and e.searched)
    return [c for e in searched for c, _ in _list_effect_columns(e, table, instrument)]


def list_tested_columns(model: Model, instrument: Instrument, records: Sequence[Record]) -> list[Column]:
    """The candidates' columns of which all records have what the effect needs: others are zero."""
    have = [r.recorded for r in records]
    effects = {e.id: e for e in model.candidates}

    def is_tested(c: Column) -> bool:
        e = effects[c.effect or ""]
        q = next(q for q in e.parameters if c.name == f"{e.id}.{q.name}")
        recorded = q.channel is None or any(q.channel in h for h in have)
        return recorded and not q.shape and not any(e.missing(h) for h in have)

    return [c for c in list_candidate_columns(model, instrument) if is_tested(c)]


def _list_effect_columns(e: DerivedEffect, table: Units, instrument: Instrument) -> list[tuple[Column, str]]:
    columns = []
    for q in e.parameters:
        if not q.fitted:
            continue
        name, factor = f"{e.id}.{q.name}", find_unit_factor(q.unit, table)
        scale = (
            EFFECT_PRIOR * q.plausible * factor * instrument.grade(q.like) * instrument.widths.get(name, 1.0)
        )
        for j, place in [(None, "")] if q.shared else enumerate(instrument.layout.names, 1):
            columns.append((Column(name, j, scale, q.unit, factor, e.id, place), q.symbol))
    return columns


def observe_voltages(o: Observation, v: Array) -> Array:
    """What an observation sees of its output's voltages: (members, N) -> (m, N)."""
    return o.recorded.through(o.recorded.of_voltages(o.output, v), o.record)


def predict_observed(model: Model, o: Observation, p: Array) -> Array:
    """(m, N), V: what a model with parameters p (size,), SI, predicts of what is observed; no unknown gradient."""
    return observe_voltages(o, evaluate_voltages(model.chain, *move_record(model, o.record, p), o.output))


def find_null_biases(columns: Sequence[Column]) -> list[int]:
    """Places of the instrument's K0 among columns."""
    return [n for n, c in enumerate(columns) if c.name == "K0" and c.effect is None]


def level_biases(coefficients: Array, sums: Array, biases: Sequence[int]) -> Array:
    """Coefficients (n,) with those at ``biases`` shifted until the residual of G_out has no mean.

    ``sums`` (n + 1,) are those of the columns and of the data over all samples; zeros: nothing is shifted.
    """
    weights = sums[list(biases)]
    shifted = coefficients.copy()
    if np.any(weights):
        left = sums[-1] - sums[:-1] @ coefficients
        shifted[list(biases)] += weights * left / (weights @ weights)
    return shifted


def group_by_effect(columns: Iterable[Column]) -> dict[str, list[tuple[int, Column]]]:
    """Effect id -> its (position, column)s."""
    groups: dict[str, list[tuple[int, Column]]] = {}
    for n, c in enumerate(columns):
        if c.effect is not None:
            groups.setdefault(c.effect, []).append((n, c))
    return groups


@dataclass(frozen=True)
class LinearisationPoint:
    """About what a flight is linearised: ``p`` is the parameter vector of the model's chain, SI.

    ``base`` are the model's columns, ``candidates`` those of effects that are not in it; ``instants`` those of steps, by effect, s
    since the first sample.
    """

    model: Model
    p: Array
    base: Sequence[Column]
    candidates: Sequence[Column] = ()
    instants: Mapping[str, float] = field(default_factory=dict)


def make_point(
    model: Model, instrument: Instrument, p: Array, candidates: Sequence[Column] = ()
) -> LinearisationPoint:
    """The point with parameters p (size,), SI, and the columns of the model and of ``candidates``."""
    return LinearisationPoint(model, p, [c for c, _ in list_base_columns(model, instrument)], candidates)


# samples at which a generated module is evaluated at a time: enough for what a call costs besides, few enough for the cache
CACHED = 4096


def linearise(at: LinearisationPoint, o: Observation) -> Array:
    """Base columns, candidates, each times its parameter's scale, and residual: (n + 1, m, N), V."""
    r, p = move_record(at.model, o.record, at.p)
    V = evaluate_voltages(at.model.chain, r, p, o.output)
    if r.reading is not None:  # in a column of what was read the noise would explain itself
        r = replace(r, reading=np.pad(o.output.combined(V), r.halo, mode="edge"))
    n_base = len(at.base)
    columns = np.zeros((n_base + len(at.candidates) + 1, len(o.series), len(r.time)))
    chain = at.model.chain
    where = (r.time, r.inputs(chain), r.phi)
    put_derivatives(columns, chain, at.base, where, p, o.recorded, o.output)
    if at.candidates:
        searched = (m for _, m in first_memories((e for e in at.model.candidates if e.searched), r))
        signatures = at.model.signatures
        r = add_responses(r, searched, signatures.INPUTS)
        q = np.concatenate([p, np.zeros(signatures.SIZE - len(p))])
        where = (r.time, r.inputs(signatures), r.phi)
        put_derivatives(columns[n_base:], signatures, at.candidates, where, q, o.recorded, o.output)
    for column in columns[:-1] if o.recorded.demodulated else ():
        column[:] = o.recorded.through(column, r)
    if o.thin is None:
        columns[-1] = o.data - observe_voltages(o, V)
    else:  # that of the whole record, thinned, for the outputs are a million times the noise
        columns[-1] = o.thin.decimate(compute_residual(at.model, o.thin.source(), at.p))
    for k, c in enumerate((*at.base, *at.candidates)):
        instant = at.instants.get(c.effect or "")
        if instant is not None:
            columns[k, :, r.time < instant] = 0.0
    if not r.valid.all():
        columns[:, :, ~r.valid] = 0.0
    return columns


def put_derivatives(
    columns: Array,
    chain: Chain,
    parameters: Sequence[Column],
    at: tuple[Array, Array, Array],
    p: Array,
    recorded: RecordedSeries,
    output: Output,
) -> None:
    """Put the derivatives of an output by parameters into the first of the columns (n, m, N), which are zero, before any demodulation.

    ``at``: instants (N,), s, inputs (n_inputs, N) and disc angles (N,), rad; ``p``: values of the model's parameters, SI. Each
    derivative is times its parameter's scale.
    """
    time, x, phi = at
    row = {name: k for k, (name, _) in enumerate(chain.ROWS)}
    for k, (j, sign) in enumerate(zip(output.members, output.signs, strict=True)):
        series, weight = (k, 1) if recorded.separate else (0, sign)
        entries = [
            (n, row[c.name], weight * c.scale)
            for n, c in enumerate(parameters)
            if c.accelerometer in (None, j + 1)
        ]
        for part in split_range(len(time), CACHED):
            slopes = chain.derivatives(j, time[part], x[:, part], p, phi[part])
            for n, of, scale in entries:
                columns[n, series, part] += scale * slopes[of]


def compute_residual(model: Model, o: Observation, p: Array) -> Array:
    """Residual (m, N), V, with parameters p (size,), SI; between its neighbours where a sample is not valid."""
    left = o.data - predict_observed(model, o, p)
    return np.stack([bridge_gaps(x, o.record.valid) for x in left])
