"""Fitted parameters, and the combinations of accelerometers' (Sigma, D^1234, D^12, D^34; Eq. 18-19) that a record sees."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.regressors import Column, spell_name
from ragg_runtime.instrument.layout import Layout
from ragg_runtime.model.model import DerivedParameter, Model, name_values

Array = NDArray[np.float64]

SEEN = 0.3
"""Posterior over prior standard deviation below which a value is the record's own: the record then holds ten times
the information of the sheet (1/0.3^2 - 1)."""

UNSEEN = 0.9
"""The same from which a value is the test sheet's, not the record's: the record adds less than a quarter."""

PATTERNS: tuple[tuple[str, tuple[int, int, int, int]], ...] = (
    ("Sigma", (1, 1, 1, 1)),
    ("D1234", (1, 1, -1, -1)),
    ("D12", (1, -1, 0, 0)),
    ("D34", (0, 0, 1, -1)),
)
"""The paper's sums and differences over the four accelerometers."""


@dataclass(frozen=True)
class ParameterValue:
    """A fitted parameter, or a combination (weights (n,) over the accelerometers; empty of a single one), in its display unit."""

    name: str
    accelerometer: int | None
    value: float
    std: float
    unit: str
    weights: tuple[float, ...] = ()
    accelerometer_name: str = ""

    def as_json(self) -> dict[str, object]:
        own: dict[str, object] = {
            "name": self.name,
            "accelerometer": self.accelerometer,
            "value": self.value,
            "std": self.std,
            "unit": self.unit,
            **spell_name(self.accelerometer, self.accelerometer_name),
        }
        return own | ({"weights": list(self.weights)} if self.weights else {})


def weigh_accelerometers(model: Model, p: Array, name: str) -> Array:
    """(n,) weight of each accelerometer in G_out, k_VI K1 (Eq. 1), for a parameter of this name, over their mean; ``p`` is the
    model's parameter vector.
    """
    values = name_values(model.chain, p)
    g = values["k_VI"] if name == "K1" else values["k_VI"] * values["K1"]
    return np.asarray(g / np.mean(g))


def list_parameter_values(
    columns: Sequence[Column], values: Array, covariance: Array
) -> list[ParameterValue]:
    """Fitted parameters (in scales) in their display units."""
    found = []
    for k, c in enumerate(columns):
        factor = c.scale / c.unit_factor
        found.append(
            ParameterValue(
                name=own_name(c),
                accelerometer=c.accelerometer,
                value=float(values[k]) * factor,
                std=float(np.sqrt(covariance[k, k])) * factor,
                unit=c.unit,
                accelerometer_name=c.accelerometer_name,
            )
        )
    return found


def own_name(c: Column) -> str:
    """A column's parameter without the id of its effect."""
    return c.name.split(".", 1)[1] if c.effect else c.name


def list_patterns(columns: Sequence[Column], weight: Array, layout: Layout) -> Iterator[tuple[str, Array]]:
    """Name and (n,) weights of the combinations of a parameter's n columns, in its display unit; ``weight``: its :func:`gains`.

    Of another layout than the paper's: signs times cos and sin of n times the angle on the disc, named by their harmonic.
    """
    for pattern, signs in PATTERNS if layout.like_paper else _harmonics(layout):
        yield f"{pattern} {own_name(columns[0])}", np.array(signs) * weight


def _harmonics(layout: Layout) -> Iterator[tuple[str, tuple[float, ...]]]:
    for o in layout.outputs:
        for harmonic, weights in o.patterns:
            w = np.zeros(layout.size)
            w[list(o.members)] = weights
            yield f"{o.name} {harmonic}", tuple(float(x) for x in w)


@dataclass(frozen=True)
class Combination:
    """A parameter, or a combination of accelerometers', that a record sees.

    ``weights`` (n,), in ``unit``, are those of the fitted columns in scales; ``shares`` those of the accelerometers' values
    in ``unit``, empty of a parameter alone.
    """

    name: str
    weights: Array
    unit: str
    shares: tuple[float, ...] = ()


def find_combinations(
    model: Model, p: Array, columns: Sequence[Column], std: Callable[[Array], float]
) -> list[Combination]:
    """The combinations of accelerometers' values that the record determines, or the single values that it determines far better.

    ``std`` is that of weights (n,) of values in scales; ``p`` the model's parameter vector.
    """
    found = []
    alone = np.array([std(x) for x in np.eye(len(columns))])
    for name in dict.fromkeys(c.name for c in columns if c.accelerometer is not None):
        at = [k for k, c in enumerate(columns) if c.name == name]
        if len(at) != model.layout.size:
            continue
        each = [columns[k] for k in at]
        known = alone[at] if np.all(alone[at] < SEEN) else np.ones(len(at))
        factor = np.array([c.scale / c.unit_factor for c in each])
        for label, shares in list_patterns(each, weigh_accelerometers(model, p, name), model.layout):
            w = np.zeros(len(columns))
            w[at] = shares * factor
            if std(w) < SEEN * float(np.linalg.norm(w[at] * known)):
                values = tuple(float(x) for x in shares)
                found.append(Combination(name=label, weights=w, unit=each[0].unit, shares=values))
    return found


@dataclass(frozen=True)
class Estimates:
    """Fitted values (n,) of columns, in scales, with their covariance (n, n); ``p`` is the parameter vector of the model, SI."""

    model: Model
    p: Array
    columns: Sequence[Column]
    values: Array
    covariance: Array

    @staticmethod
    def of_calibration(f: Fitted) -> Estimates:
        """The calibrated parameters of a model."""
        c = f.calibration
        return Estimates(f.model, c.p, c.columns, c.in_scales, c.covariance)

    def select(self, effect: str | None) -> Estimates:
        """Those of one effect, or, of none, of the instrument."""
        own = [k for k, c in enumerate(self.columns) if c.effect == effect]
        return replace(
            self,
            columns=[self.columns[k] for k in own],
            values=self.values[own],
            covariance=self.covariance[np.ix_(own, own)],
        )

    def list_parameters(self) -> tuple[ParameterValue, ...]:
        """Each in its display unit."""
        return tuple(list_parameter_values(self.columns, self.values, self.covariance))

    def list_combinations(self) -> tuple[ParameterValue, ...]:
        """What the record sees of the accelerometers' values together (:func:`find_combinations`)."""

        def std(w: Array) -> float:
            return float(np.sqrt(max(0.0, float(w @ self.covariance @ w))))

        return tuple(
            ParameterValue(
                name=q.name,
                accelerometer=None,
                value=float(q.weights @ self.values),
                std=std(q.weights),
                unit=q.unit,
                weights=q.shares,
            )
            for q in find_combinations(self.model, self.p, self.columns, std)
        )


def list_bounded_columns(f: Fitted) -> list[tuple[int, Column, DerivedParameter]]:
    """The fitted columns of effects whose parameter cannot have any size, each with its place and that parameter."""
    own = {f"{e.id}.{q.name}": q for e in f.model.effects for q in e.parameters}
    bounded = {name for name, q in own.items() if q.physical is not None or q.largest is not None}
    return [(n, c, own[c.name]) for n, c in enumerate(f.calibration.columns) if c.name in bounded]
