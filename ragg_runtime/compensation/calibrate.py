"""Calibrate once: the parameters, which of them the record determines, and which only the prior does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from ragg_runtime.compensation.saved import Saved
from ragg_runtime.estimation.fitted import Fitted, fit, list_noise_floor, measure_noise_floor
from ragg_runtime.estimation.least_squares import Linear, add_prior, join
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.estimation.scores import Error, list_errors
from ragg_runtime.identification import comparison
from ragg_runtime.identification.parameters import SEEN, find_combinations, list_parameter_values, own_name
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.model import Model, name_values

Array = NDArray[np.float64]

LEARNED = 0.5
"""About a parameter whose standard deviation the record at least halves, the record says more than the sheet."""


@dataclass(frozen=True)
class Calibrated:
    """A model calibrated on flights, and its errors."""

    fitted: Fitted
    nominal: Error
    error: Error
    holdout: Error

    @property
    def directions(self) -> tuple[int, int]:
        """How many directions of the parameters the record determines, and how many there are."""
        return count_directions(self.fitted)

    def as_json(self) -> dict[str, Any]:
        """As ``ragg calibrate --json`` writes it."""
        f = self.fitted
        return {
            "converged": f.calibration.converged,
            "effects": [e.id for e in f.model.effects],
            "error": self.errors_json(),
            "noise_floor": list_noise_floor(f, measure_noise_floor(f)),
            "directions": dict(zip(("seen", "fitted"), self.directions, strict=True)),
            "parameters": list_parameters(f),
            "combinations": list_combinations(f),
        }

    def errors_json(self) -> dict[str, Any]:
        """The ``error`` of the JSON: nominal, calibrated, holdout."""
        return list_errors(self.nominal, self.error, self.holdout)


def count_directions(f: Fitted) -> tuple[int, int]:
    """How many directions of the parameters the record determines, and how many there are."""
    deviations = np.linalg.svd(invert_root(information(f)), compute_uv=False)
    return int(np.sum(deviations < LEARNED)), len(deviations)


def list_parameters(f: Fitted) -> list[dict[str, Any]]:
    """Every fitted parameter with its prior, as in JSON."""
    c = f.calibration
    values, found = list_parameter_values(c.columns, c.in_scales, c.covariance), []
    for q, column, off, variance in zip(values, c.columns, f.to_nominal, np.diag(c.covariance), strict=True):
        factor = column.scale / column.unit_factor
        own = {"effect": column.effect, "sheet": q.value + float(off) * factor, "sheet_sigma": factor}
        found.append({**q.as_json(), **own, "said_by": "record" if variance < LEARNED**2 else "sheet"})
    return found


def list_combinations(f: Fitted) -> list[dict[str, Any]]:
    """What the record determines: combinations of accelerometers', and single values, as JSON has them."""
    columns, values, root = f.calibration.columns, f.calibration.in_scales, invert_root(information(f))
    together = find_combinations(f.model, f.calibration.p, columns, lambda w: float(np.linalg.norm(w @ root)))
    found = [(name, w, unit) for name, unit, w, _ in together]
    single = np.linalg.norm(root, axis=1) < SEEN
    for name in dict.fromkeys(c.name for c in columns):
        places = [k for k, c in enumerate(columns) if c.name == name]
        if len(places) != f.model.layout.size or np.all(single[places]):
            for k, c in ((k, columns[k]) for k in places if single[k]):
                label = own_name(c) if c.accelerometer is None else f"{own_name(c)}[{c.accelerometer}]"
                found.append((label, c.scale / c.unit_factor * np.eye(len(columns))[k], c.unit))
    return [
        {"name": name, "value": float(w @ values), "std": float(np.linalg.norm(w @ root)), "unit": unit}
        for name, w, unit in found
    ]


def calibrate(model: Model, instrument: Instrument, flights: Sequence[Flight]) -> Calibrated:
    """Fit a model to flights, and score the fit on held-out time as well.

    Raises
    ------
    UserError
        If the flights are not of this instrument.
    """
    f = fit(model, instrument, observe_flights(flights, instrument))
    whole, held_out, nominal = comparison.score_with_nominal(f, [np.zeros(f.size), f.fit_held_out()])
    return Calibrated(fitted=f, nominal=nominal.whole, error=whole.whole, holdout=held_out.held_out)


def make_saved(c: Calibrated, flights: Sequence[Flight], time: str) -> Saved:
    """The calibration as a model directory keeps it; ``time``: now, UTC."""
    f, q = c.fitted, c.fitted.calibration
    values, sheet = (
        {name: x.tolist() for name, x in name_values(f.model.chain, p).items()} for p in (q.p, f.sheet)
    )
    return Saved(
        time=time,
        converged=q.converged,
        model={
            "effects": [e.id for e in f.model.effects],
            "form": f.instrument.form.words(),
            "derivation": f.model.digest,
        },
        values=values,
        sheet=sheet,
        columns=q.columns,
        index=q.index,
        information=information(f),
        validity=find_ranges(flights),
        flights={x.name: x.digest for x in flights},
        error=c.errors_json(),
    )


def find_ranges(flights: Sequence[Flight]) -> Mapping[str, tuple[float, float]]:
    """Channel -> its range, SI, over the valid samples of all flights that have it; ``time`` since the first sample."""
    found: dict[str, tuple[float, float]] = {}
    for x in flights:
        for name, values in {"time": x.time - x.time[0], **x.channels}.items():
            y = values[x.valid & np.isfinite(values)]
            if len(y):
                low, high = found.get(name, (np.inf, -np.inf))
                found[name] = min(low, float(np.min(y))), max(high, float(np.max(y)))
    return found


# --- results of a fit in scales: units of the prior widths of its parameters


def information(f: Fitted) -> Array:
    """(n, n) upper triangular R: square root of the information of all flights and the sheet."""
    return np.asarray(np.triu(f.whole[: f.n_base, : f.n_base]))


def invert_root(R: Array) -> Array:
    """(n, n): the root R^-1 of the covariance of a square root R of the information, with a positive diagonal."""
    return np.asarray(linalg.solve_triangular(R, np.diag(np.sign(np.diag(R)))))


def list_base_r_factors(f: Fitted, k: int) -> list[Array]:
    """Of an observation the R factors [base | residual] of its blocks of time."""
    return [t[:, [*range(f.n_base), -1]] for t in f.r_factors[k]]


def fit_some(f: Fitted, r_factors: Sequence[Array]) -> tuple[Array, Array]:
    """The posterior of some R factors [base | residual] and the prior: the step (n,) from here, and a root (n, n) of its covariance."""
    whole = add_prior(join(r_factors), range(f.n_base), f.to_nominal)
    R = whole[:-1, :-1]
    return Linear(whole).step, invert_root(R)
