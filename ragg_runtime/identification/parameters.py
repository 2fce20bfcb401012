"""Fitted parameters, and the combinations of accelerometers' (Sigma, D^1234, D^12, D^34; Eq. 18-19) that a record sees."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.regressors import Column, spell_name
from ragg_runtime.instrument.layout import Layout
from ragg_runtime.model.model import DerivedParameter, Model, name_values

Array = NDArray[np.float64]

# posterior over prior standard deviation below which a value is the record's own: the record then holds ten times the information of
# the sheet (1/0.3^2 - 1)
SEEN = 0.3
# the same from which a value is the test sheet's, not the record's: the record adds less than a quarter
UNSEEN = 0.9
# the paper's sums and differences over the four accelerometers
PATTERNS: tuple[tuple[str, tuple[int, int, int, int]], ...] = (
    ("Sigma", (1, 1, 1, 1)),
    ("D1234", (1, 1, -1, -1)),
    ("D12", (1, -1, 0, 0)),
    ("D34", (0, 0, 1, -1)),
)


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
        entries = {n: getattr(self, n) for n in ("name", "accelerometer", "value", "std", "unit")}
        weights = {"weights": list(self.weights)} if self.weights else {}
        return entries | spell_name(self.accelerometer, self.accelerometer_name) | weights


def list_parameter_values(
    columns: Sequence[Column], values: Array, covariance: Array
) -> list[ParameterValue]:
    """Fitted parameters (in scales) in their display units."""
    parameters = []
    for c, value, variance in zip(columns, values, np.diag(covariance), strict=True):
        factor = c.scale / c.unit_factor
        std = float(np.sqrt(variance)) * factor
        fields = own_name(c), c.accelerometer, float(value) * factor, std, c.unit
        parameters.append(ParameterValue(*fields, accelerometer_name=c.accelerometer_name))
    return parameters


def own_name(c: Column) -> str:
    """A column's parameter without the id of its effect."""
    return c.name.split(".", 1)[1] if c.effect else c.name


def list_patterns(layout: Layout) -> list[tuple[str, Array]]:
    """Name and (n,) weights of the combinations of n accelerometers' values that an output depends on.

    Of another layout than the paper's: signs times cos and sin of n times the angle on the disc, named by their harmonic.
    """
    if layout.like_paper:
        return [(name, np.array(signs)) for name, signs in PATTERNS]
    patterns = []
    for o in layout.outputs:
        for harmonic, weights in o.patterns:
            w = np.zeros(layout.size)
            w[list(o.members)] = weights
            patterns.append((f"{o.name} {harmonic}", w))
    return patterns


# a name, a unit, the weights (n,), in that unit, of fitted columns in scales, and those of the accelerometers' values in it
Combination = tuple[str, str, Array, tuple[float, ...]]


def find_combinations(
    model: Model, p: Array, columns: Sequence[Column], std: Callable[[Array], float]
) -> list[Combination]:
    """The combinations of accelerometers' values that the record determines, or the single values that it determines far better.

    ``std`` is that of weights (n,) of values in scales; ``p`` the model's parameter vector.
    """
    combinations = []
    alone, slopes = np.array([std(x) for x in np.eye(len(columns))]), name_values(model.chain, p)
    for name in dict.fromkeys(c.name for c in columns if c.accelerometer is not None):
        at = [k for k, c in enumerate(columns) if c.name == name]
        if len(at) != model.layout.size:
            continue
        each = [columns[k] for k in at]
        stds = alone[at] if np.all(alone[at] < SEEN) else np.ones(len(at))
        factor = np.array([c.scale / c.unit_factor for c in each])
        # by the weight of each accelerometer in G_out, k_VI K1 (Eq. 1), over their mean
        gain = slopes["k_VI"] if name == "K1" else slopes["k_VI"] * slopes["K1"]
        for pattern, signs in list_patterns(model.layout):
            shares, w = signs * gain / np.mean(gain), np.zeros(len(columns))
            w[at] = shares * factor
            if std(w) < SEEN * float(np.linalg.norm(w[at] * stds)):
                label = f"{pattern} {own_name(each[0])}"
                combinations.append((label, each[0].unit, w, tuple(float(x) for x in shares)))
    return combinations


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
        """The estimates of one effect, or (``None``) of the instrument."""
        places = [k for k, c in enumerate(self.columns) if c.effect == effect]
        return replace(
            self,
            columns=[self.columns[k] for k in places],
            values=self.values[places],
            covariance=self.covariance[np.ix_(places, places)],
        )

    def list_parameters(self) -> tuple[ParameterValue, ...]:
        """Each in its display unit."""
        return tuple(list_parameter_values(self.columns, self.values, self.covariance))

    def list_combinations(self) -> tuple[ParameterValue, ...]:
        """What the record sees of the accelerometers' values together (:func:`find_combinations`)."""

        def std(w: Array) -> float:
            return float(np.sqrt(max(0.0, float(w @ self.covariance @ w))))

        combinations = find_combinations(self.model, self.p, self.columns, std)
        return tuple(
            ParameterValue(name, None, float(w @ self.values), std(w), unit, shares)
            for name, unit, w, shares in combinations
        )


def list_bounded_columns(f: Fitted) -> list[tuple[int, Column, DerivedParameter]]:
    """The fitted columns of effects whose parameter is limited in size, each with its place and that parameter."""
    parameters = {f"{e.id}.{q.name}": q for e in f.model.effects for q in e.parameters}
    bounded = {name for name, q in parameters.items() if q.physical is not None or q.largest is not None}
    return [(n, c, parameters[c.name]) for n, c in enumerate(f.calibration.columns) if c.name in bounded]
