"""Calibrate once: parameters, what the record sees of them and what the sheet alone says, and where it is valid."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from ragg_runtime.compensation.saved import Saved
from ragg_runtime.estimation.fitted import Fitted, fit, noise_floor
from ragg_runtime.estimation.least_squares import Linear, join, with_prior
from ragg_runtime.estimation.observation import ROWS, observations_of
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.estimation.scores import Error
from ragg_runtime.identification import comparison
from ragg_runtime.identification.parameters import (
    SEEN,
    Combination,
    ParameterValue,
    combinations_seen,
    own_name,
    parameter_values,
)
from ragg_runtime.identification.series import noise_floor_json
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]

LEARNED = 0.5
"""About a parameter whose standard deviation the record at least halves, the record says more than the sheet."""


def visible(model: Model, p: Array, columns: Sequence[Column], root: Array) -> list[Combination]:
    """What a root (n, k) of a covariance, in scales, says to be determined: combinations of accelerometers', and single values."""

    def std(w: Array) -> float:
        return float(np.linalg.norm(w @ root))

    found = combinations_seen(model, p, columns, std)
    single = np.linalg.norm(root, axis=1) < SEEN
    for name in dict.fromkeys(c.name for c in columns):
        places = [k for k, c in enumerate(columns) if c.name == name]
        if len(places) == model.layout.size and not np.all(single[places]):
            continue
        for k in places:
            c = columns[k]
            if single[k]:
                label = own_name(c) if c.accelerometer is None else f"{own_name(c)}[{c.accelerometer}]"
                w = np.zeros(len(columns))
                w[k] = c.scale / c.unit_factor
                found.append(Combination(name=label, weights=w, unit=c.unit))
    return found


def with_sheet(T: Array, to_nominal: Array) -> Linear:
    """The fit of a triangle [base | residual] and of the sheet, whose values are ``to_nominal`` (n,) away, in scales."""
    whole = with_prior(T, range(len(to_nominal)), to_nominal)
    return Linear(R=whole[:-1, :-1], y=whole[:-1, -1], rest=float(whole[-1, -1] ** 2))


def base(triangles: Sequence[Array], n: int) -> list[Array]:
    """Of triangles [base (n) | candidates | residual] the columns without candidates."""
    return [t[:, [*range(n), -1]] for t in triangles]


def each_flight(f: Fitted) -> Iterator[tuple[str, Array, Array]]:
    """What every flight, of all its outputs, says by itself (with the sheet), in scales: its name, the step from here, and a
    root of its covariance.
    """
    for n in dict.fromkeys(o.flight for o in f.observations):
        own = [k for k, o in enumerate(f.observations) if o.flight == n]
        triangles = base([t for k in own for t in f.triangles[k]], f.n_base)
        normal = with_sheet(join(triangles), f.to_nominal)
        yield f.observations[own[0]].flight_name, normal.step, inverse(normal.R)


def information(f: Fitted) -> Array:
    """(n, n) upper triangular R: square root of the information of all flights and the sheet, in scales."""
    return np.asarray(np.triu(f.whole[: f.n_base, : f.n_base]))


def inverse(R: Array) -> Array:
    """(n, n): the root R^-1 of the covariance of a square root R of the information, with a positive diagonal."""
    return np.asarray(linalg.solve_triangular(R, np.diag(np.sign(np.diag(R)))))


@dataclass(frozen=True)
class Calibrated:
    """A model calibrated on flights."""

    fitted: Fitted
    nominal: Error
    error: Error
    holdout: Error

    @property
    def converged(self) -> bool:
        return self.fitted.calibration.converged

    @cached_property
    def values(self) -> Array:
        """(n,): the fitted parameters, in scales."""
        c = self.fitted.calibration
        return np.asarray(c.p[c.index] / np.array([q.scale for q in c.columns]))

    @cached_property
    def parameters(self) -> list[ParameterValue]:
        c = self.fitted.calibration
        return parameter_values(c.columns, self.values, c.covariance)

    @cached_property
    def root(self) -> Array:
        """(n, n): a root of the covariance, in scales."""
        return inverse(information(self.fitted))

    @cached_property
    def combinations(self) -> list[Combination]:
        f = self.fitted
        return visible(f.model, f.calibration.p, f.calibration.columns, self.root)

    @cached_property
    def directions(self) -> tuple[int, int]:
        """How many directions of the parameters the record determines, and how many there are."""
        deviations = np.linalg.svd(self.root, compute_uv=False)
        return int(np.sum(deviations < LEARNED)), len(deviations)

    def drift(self) -> list[dict[str, Any]]:
        """The visible combinations as every flight alone has them; nothing for one flight."""
        flights = list(each_flight(self.fitted))
        rows = []
        for name, step, root in flights if len(flights) > 1 else ():
            for q in self.combinations:
                value, std = q.of(self.values + step, root)
                rows.append({"flight": name, "name": q.name, "value": value, "std": std, "unit": q.unit})
        return rows

    def as_json(self) -> dict[str, Any]:
        c = self.fitted.calibration
        sheet = self.values + self.fitted.to_nominal
        parameters = []
        for q, column, s, variance in zip(
            self.parameters, c.columns, sheet, np.diag(c.covariance), strict=True
        ):
            factor = column.scale / column.unit_factor
            said_by = "record" if variance < LEARNED**2 else "sheet"
            parameters.append(
                {
                    **q.as_json(),
                    "effect": column.effect,
                    "sheet": float(s) * factor,
                    "sheet_sigma": factor,
                    "said_by": said_by,
                }
            )
        combinations = []
        for x in self.combinations:
            value, std = x.of(self.values, self.root)
            combinations.append({"name": x.name, "value": value, "std": std, "unit": x.unit})
        return {
            "converged": self.converged,
            "effects": [e.id for e in self.fitted.model.effects],
            "error": {
                "nominal": self.nominal.as_json(),
                "calibrated": self.error.as_json(),
                "holdout": self.holdout.as_json(),
            },
            "noise_floor": noise_floor_json(self.fitted, noise_floor(self.fitted)),
            "directions": dict(zip(("seen", "fitted"), self.directions, strict=True)),
            "parameters": parameters,
            "combinations": combinations,
            "drift": self.drift(),
        }


def calibrated(model: Model, instrument: Instrument, flights: Sequence[Flight]) -> Calibrated:
    """Fit a model to flights and hold it against held-out time."""
    f = fit(model, instrument, observations_of(flights, instrument))
    half, _ = f.coefficients((), held_out=True)
    whole, held_out, nominal = comparison.errors(f, [np.zeros(f.n_base), half])
    return Calibrated(fitted=f, nominal=nominal.whole, error=whole.whole, holdout=held_out.held_out)


def to_save(c: Calibrated, flights: Sequence[Flight], time: str) -> Saved:
    """The calibration as it is kept."""
    f, q = c.fitted, c.fitted.calibration
    return Saved(
        time=time,
        effects=tuple(e.id for e in f.model.effects),
        form=f.instrument.form.words(),
        derivation=f.model.digest,
        layout=tuple(f.model.chain.PARAMETERS),
        p=q.p,
        sheet=f.sheet,
        columns=q.columns,
        index=q.index,
        information=information(f),
        converged=c.converged,
        validity=validity(flights),
        flights={x.name: x.digest for x in flights},
        error=c.as_json()["error"],
    )


def validity(flights: Sequence[Flight]) -> Mapping[str, tuple[float, float]]:
    """Channel -> its range, SI, over the valid samples of all flights that have it; ``time`` since the first sample."""
    found: dict[str, tuple[float, float]] = {}
    for x in flights:
        for name, values in ({"time": x.time} | dict(x.channels)).items():
            low, high = found.get(name, (np.inf, -np.inf))
            for start in range(0, len(x.time), ROWS):
                some = slice(start, start + ROWS)
                y = values[some][x.valid[some]]
                y = y[np.isfinite(y)] - (x.time[0] if name == "time" else 0.0)
                if len(y):
                    low, high = min(low, float(np.min(y))), max(high, float(np.max(y)))
            if low <= high:
                found[name] = (low, high)
    return found
