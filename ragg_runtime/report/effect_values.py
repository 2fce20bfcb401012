"""Fitted values of a ranked effect as the record really determines them.

The ranking fits the smallest block of an effect that does the work. Where that is one accelerometer, another
one may do as well: G_out shows K of A3 and minus K of A4 alike. Where it is all four, single values are seldom
determined, but the paper's combinations of them are. Both are said here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis import ranking
from ragg_runtime.diagnosis.parameters import SEEN, UNSEEN, ParameterValue, gains
from ragg_runtime.diagnosis.parameters import headlines as of_parameters
from ragg_runtime.diagnosis.parameters import own_name as _name
from ragg_runtime.diagnosis.ranking import Ranked
from ragg_runtime.fit.columns import Column
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.fit.posterior import Posterior, posterior
from ragg_runtime.report.parameters import PATTERNS
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]

MOST = 6
"""Values that a row of the ranking holds, the most significant ones."""


@dataclass(frozen=True)
class Value:
    """``name`` of accelerometer or combination ``of`` (empty: shared), with unit, and its significance."""

    name: str
    of: str
    text: str
    z: float


@dataclass(frozen=True)
class Values:
    """What a row shows: values, how many more there are, and accelerometers that would do as well."""

    values: tuple[Value, ...]
    more: int
    instead: tuple[Value, ...]


def values(f: Fitted, r: Ranked) -> Values:
    """The values of a ranked effect."""
    columns = [(n, c) for n, c in enumerate(f.candidates) if c.effect == r.effect]
    wanted = {(p.name, p.accelerometer) for p in r.parameters}
    own = [(n, c) for n, c in columns if (_name(c), c.accelerometer) in wanted]
    extra = [
        _plain(p.name, p.value, p.unit) for p in r.parameters if p.name not in {_name(c) for _, c in own}
    ]
    if not own:
        return Values(tuple(extra), 0, ())
    accelerometers = {c.accelerometer for _, c in own}
    if len(accelerometers) == 1 and None not in accelerometers:
        found = _single(f, own)
        others = ranking.other_accelerometers(f, r.effect, own, columns)
        return Values((*found, *extra), 0, tuple(v for block in others for v in _single(f, block)))
    found = _combined(f, own, _fit(f, own))
    kept = sorted(found, key=lambda v: -abs(v.z))[:MOST]
    return Values((*kept, *extra), len(found) - len(kept), ())


def headlines(
    parameters: Sequence[ParameterValue], combinations: Sequence[ParameterValue]
) -> tuple[Value, ...]:
    """One value per parameter, the same numbers as on the terminal and in the JSON."""
    return tuple(_headline(q) for q in of_parameters(parameters, combinations))


def _headline(q: ParameterValue) -> Value:
    of, _, name = q.name.rpartition(" ")
    if q.std <= 0.0:
        return _plain(name, q.value, q.unit)
    of = of.replace("Sigma", "Σ") or q.accelerometer_name
    text = numbers.with_unit(numbers.plus_minus(q.value, q.std), q.unit)
    return Value(name, of, text, q.value / q.std)


def _plain(name: str, value: float, unit: str) -> Value:
    return Value(name, "", numbers.with_unit(numbers.number(value, 4), unit), 0.0)


def _fit(f: Fitted, own: Sequence[tuple[int, Column]]) -> Posterior:
    """Values of an effect's columns, in scales, with their uncertainty."""
    both = posterior(f, [n for n, _ in own])
    return both.of(range(f.n_base, f.n_base + len(own)))


def joint(f: Fitted, effect: str) -> list[Value]:
    """The values of an effect that is in the model of ``f``, as calibrated."""
    places = [k for k, c in enumerate(f.calibration.columns) if c.effect == effect]
    own = [(k, f.calibration.columns[k]) for k in places]
    scale = np.array([c.scale for _, c in own])
    value = f.calibration.p[f.calibration.index[places]] / scale
    return _combined(f, own, Posterior(value, posterior(f).of(places).covariance))


def _single(f: Fitted, own: Sequence[tuple[int, Column]]) -> list[Value]:
    fitted = _fit(f, own)
    return [_value(c, c.accelerometer_name, np.eye(len(own))[k], fitted) for k, (_, c) in enumerate(own)]


def _value(c: Column, of: str, weights: Array, fitted: Posterior) -> Value:
    factor = c.scale / c.unit_factor
    v, s = float(weights @ fitted.value), fitted.std(weights)
    text = numbers.with_unit(numbers.plus_minus(v * factor, s * factor), c.unit)
    return Value(_name(c), of, text, v / s if s > 0.0 else 0.0)


def _combined(f: Fitted, own: Sequence[tuple[int, Column]], fitted: Posterior) -> list[Value]:
    """Combinations that the record sees of parameters of all four; others one by one unless they are unseen."""
    places: dict[str, list[int]] = {}
    for k, (_, c) in enumerate(own):
        places.setdefault(_name(c), []).append(k)
    found = []
    for positions in places.values():
        column = own[positions[0]][1]
        rows: list[tuple[str, Array, float]] = []
        if len(positions) == 4 and f.instrument.layout.like_paper:
            for name, signs in PATTERNS:
                w = np.zeros(len(own))
                w[positions] = np.array(signs) * gains(f.model, f.calibration.p, column.name)
                rows.append((name, w, SEEN))
        else:
            for k in positions:
                rows.append((own[k][1].accelerometer_name, np.eye(len(own))[k], UNSEEN))
        for of, w, limit in rows:
            if fitted.std(w) < limit * float(np.linalg.norm(w)):
                found.append(_value(column, of, w, fitted))
    return found
