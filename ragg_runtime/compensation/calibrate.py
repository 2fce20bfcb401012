"""Calibrate once: fitted parameters, the file that keeps them, and a test whether they still hold for another flight."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from ragg_runtime.base import false_alarms
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.progress import one_thread
from ragg_runtime.estimation.calibration import Calibration
from ragg_runtime.estimation.fitted import (
    Fitted,
    fit,
    list_noise_floor,
    measure_noise_floor,
    prepare_evidence,
)
from ragg_runtime.estimation.least_squares import Linear, add_prior, join
from ragg_runtime.estimation.noise_estimate import estimate_noise
from ragg_runtime.estimation.observation import (
    Observation,
    divide_into_segments,
    observe_flights,
    spread,
)
from ragg_runtime.estimation.regressors import (
    Column,
    list_base_columns,
    list_candidate_columns,
    make_point,
)
from ragg_runtime.estimation.scores import Error, list_errors, log_sf
from ragg_runtime.identification import comparison
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.parameters import SEEN, find_combinations, list_parameter_values, own_name
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.directory import CALIBRATION
from ragg_runtime.model.model import Model, make_vector, name_values, scale_factor
from ragg_runtime.wording import numbers
from ragg_runtime.workspace import Loaded

Array = NDArray[np.float64]

# about a parameter whose standard deviation the record at least halves, the record says more than the sheet
LEARNED = 0.5


@dataclass(frozen=True)
class Calibrated:
    """A model calibrated on flights, and its errors."""

    fitted: Fitted
    nominal: Error
    error: Error
    holdout: Error

    def as_json(self) -> dict[str, Any]:
        """As ``ragg calibrate --json`` writes it."""
        f = self.fitted
        return {
            "converged": f.calibration.converged,
            "effects": [e.id for e in f.model.effects],
            "error": self.errors_json(),
            "noise_floor": list_noise_floor(f, measure_noise_floor(f)),
            "directions": dict(zip(("seen", "fitted"), count_directions(f), strict=True)),
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
    values, entries = list_parameter_values(c.columns, c.in_scales, c.covariance), []
    for q, column, off, variance in zip(values, c.columns, f.to_nominal, np.diag(c.covariance), strict=True):
        factor = column.scale / column.unit_factor
        origin = {"effect": column.effect, "sheet": q.value + float(off) * factor, "sheet_sigma": factor}
        entries.append({**q.as_json(), **origin, "said_by": "record" if variance < LEARNED**2 else "sheet"})
    return entries


def list_combinations(f: Fitted) -> list[dict[str, Any]]:
    """Combinations of accelerometers' parameters, and single ones, that the record determines, as in JSON."""
    columns, values, root = f.calibration.columns, f.calibration.in_scales, invert_root(information(f))
    together = find_combinations(f.model, f.calibration.p, columns, lambda w: float(np.linalg.norm(w @ root)))
    combinations = [(name, w, unit) for name, unit, w, _ in together]
    single = np.linalg.norm(root, axis=1) < SEEN
    for name in dict.fromkeys(c.name for c in columns):
        places = [k for k, c in enumerate(columns) if c.name == name]
        if len(places) != f.model.layout.size or np.all(single[places]):
            for k, c in ((k, columns[k]) for k in places if single[k]):
                label = own_name(c) if c.accelerometer is None else f"{own_name(c)}[{c.accelerometer}]"
                combinations.append((label, c.scale / c.unit_factor * np.eye(len(columns))[k], c.unit))
    return [
        {"name": name, "value": float(w @ values), "std": float(np.linalg.norm(w @ root)), "unit": unit}
        for name, w, unit in combinations
    ]


def calibrate(model: Model, instrument: Instrument, flights: Sequence[Flight]) -> Calibrated:
    """Fit a model to flights, and score the fit on held-out time as well.

    Raises
    ------
    UserError
        If the flights are not of this instrument.
    """
    f = fit(model, instrument, observe_flights(flights, instrument))
    fit_scores, held_out, nominal = comparison.score_with_nominal(f, [np.zeros(f.size), f.fit_held_out()])
    return Calibrated(fitted=f, nominal=nominal.whole, error=fit_scores.whole, holdout=held_out.held_out)


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
    ranges: dict[str, tuple[float, float]] = {}
    for x in flights:
        for name, values in {"time": x.time - x.time[0], **x.channels}.items():
            y = values[x.valid & np.isfinite(values)]
            if len(y):
                low, high = ranges.get(name, (np.inf, -np.inf))
                ranges[name] = min(low, float(np.min(y))), max(high, float(np.max(y)))
    return ranges


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


def move_parameters(c: Calibration, step: Array | float) -> Array:
    """(size,), SI: the parameters that are a step (n,), in scales, from those of a calibration."""
    p = c.p.copy()
    p[c.index] += step * np.array([q.scale for q in c.columns])
    return p


def fit_r_factors(f: Fitted, r_factors: Sequence[Array]) -> tuple[Array, Array]:
    """The posterior of some R factors [base | residual] and the prior: the step (n,) from here, and a root (n, n) of its covariance."""
    posterior = add_prior(join(r_factors), range(f.n_base), f.to_nominal)
    R = posterior[:-1, :-1]
    return Linear(posterior).step, invert_root(R)


# --- calibration.json of a model directory: the calibration that was kept ---

# least diagonal number of the square root of the information: the sheet alone, in its own units, says 1
LEAST = 1e-3


@dataclass(frozen=True)
class Saved:
    """A calibration as it was kept.

    ``time``: UTC, ISO 8601. ``model``: its ``effects``, its ``form``, and the digest of its ``derivation``. ``values``, ``sheet``:
    parameter -> SI, calibrated, and of model.toml then. ``columns``, ``index``: the fitted parameters and their places in ``p``.
    ``information`` (n, n): upper triangular R in units of the scales, prior included (variances span sixteen decades: a covariance
    would round them away). ``validity``: channel -> least and largest value, SI. ``flights``: name -> SHA-256. ``error``: nominal,
    calibrated, holdout.
    """

    time: str
    converged: bool
    model: Mapping[str, Any]
    values: Mapping[str, list[float]]
    sheet: Mapping[str, list[float]]
    columns: tuple[Column, ...]
    index: NDArray[np.intp]
    information: Array
    validity: Mapping[str, tuple[float, float]]
    flights: Mapping[str, str]
    error: Mapping[str, Any]

    @cached_property
    def p(self) -> Array:
        """(size,), SI: the calibrated parameters."""
        return np.concatenate([*self.values.values()])

    def as_text(self) -> str:
        """The text of calibration.json."""
        return f"{json.dumps(self.as_json(), allow_nan=False, ensure_ascii=False)}\n"

    def as_json(self) -> dict[str, Any]:
        """As in the file."""
        fields = ("time", "converged", "model", "values", "sheet", "validity", "flights", "error")
        return {
            **{name: getattr(self, name) for name in fields},
            "fitted": [
                {"name": c.name, "accelerometer": c.accelerometer, "scale": c.scale} for c in self.columns
            ],
            "square_root_information": [row[n:].tolist() for n, row in enumerate(self.information)],
        }

    def find_oddities(self, model: Model, instrument: Instrument) -> list[str]:
        """Oddities of the calibration, in sentences."""
        odd = []
        if self.model["derivation"] != model.digest:
            odd.append("the model has been derived anew since the calibration was saved")
        if not self.converged:
            odd.append("the saved calibration had not converged")
        if not np.array_equal(np.concatenate([*self.sheet.values()]), make_vector(model, instrument)):
            odd.append("model.toml has changed since the calibration was saved; the saved values are used")
        if "balancing-loop" in self.model["effects"]:
            odd.append(
                "balancing loops change scale factors or second-order coefficients during every flight: the saved calibration holds only "
                "with their recorded currents"
            )
        return odd


def _refuse(text: str) -> float:
    raise ValueError(f"{text} is not a number")


def saved_calibration(m: Loaded) -> Saved:
    """The calibration that a model directory keeps, in the present scales of the parameters that are fitted.

    Raises
    ------
    UserError
        If there is none, if it is damaged, or of another model.
    """
    text, where = m.directory.calibration, m.directory.path / CALIBRATION
    remedy = f"calibrate: ragg calibrate {where.parent} FLIGHT... --save"
    if text is None:
        raise UserError("the model has no saved calibration", where=where.parent, remedy=remedy)
    refuse = partial(UserError, where=where, remedy=remedy)
    try:
        return _parse_saved(json.loads(text, parse_constant=_refuse), m, refuse)
    except (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError) as error:
        reason = f"no {error}" if isinstance(error, KeyError) else str(error)[:200]
        raise refuse("the saved calibration is damaged", found=reason) from None


def _parse_saved(e: Mapping[str, Any], m: Loaded, refuse: Callable[..., UserError]) -> Saved:
    """A saved calibration, from its JSON; an error made by ``refuse`` if it is not of the present model."""
    model, instrument = m.model, m.instrument
    effects, form = [x.id for x in model.effects], instrument.form.words()
    description, layout = e["model"], [(name, len(x)) for name, x in e["values"].items()]
    if (description["effects"], description["form"], layout) != (effects, form, [*model.chain.PARAMETERS]):
        raise refuse(
            "the saved calibration belongs to another model",
            found=f"{description['form']}, effects {', '.join(description['effects']) or 'none'}, made {e['time']}",
            expected=f"{form}, effects {', '.join(effects) or 'none'}",
        )
    columns, places = zip(*list_base_columns(model, instrument), strict=True)
    if [(c.name, c.accelerometer) for c in columns] != [(x["name"], x["accelerometer"]) for x in e["fitted"]]:
        raise refuse("other parameters are fitted than when the calibration was saved")
    R = np.zeros((len(columns), len(columns)))
    R[np.triu_indices(len(R))] = np.concatenate(e["square_root_information"])
    if not np.min(np.abs(np.diag(R))) > LEAST:
        raise ValueError("the square root of the information is singular")
    saved = Saved(
        time=str(e["time"]),
        converged=bool(e["converged"]),
        model=description,
        values=e["values"],
        sheet=e["sheet"],
        columns=columns,
        index=np.array(places, dtype=np.intp),
        information=R * [c.scale / float(x["scale"]) for c, x in zip(columns, e["fitted"], strict=True)],
        validity={name: (float(low), float(high)) for name, (low, high) in e["validity"].items()},
        flights=dict(e["flights"]),
        error=dict(e["error"]),
    )
    nominal = make_vector(model, instrument)
    fixed = np.setdiff1d(np.arange(len(nominal)), places)
    if not np.array_equal(saved.p[fixed], nominal[fixed]):
        what = "model.toml was changed since the calibration was saved: values that are not fitted differ"
        raise refuse(what, found=f"a calibration made {saved.time}")
    if not scale_factor(model, saved.p) > 0.0:
        raise refuse("the saved calibration has no positive scale factor")
    return saved


# --- whether a saved calibration holds for another flight: nothing is fitted, and a chi-square tests it ---

INFORMED = 0.1
"""Least information of the flight, over that of the saved calibration, for a direction to be tested: others would add
noise that hides a change."""

TESTED, BLOCKS = 8000, 4
"""Samples and number of the blocks of a long flight by which a calibration is tested: that takes seconds, all of the
flight longer than its compensation."""

SEGMENTS, SAMPLES = 4, 80_000
"""Most segments of a flight, and their samples together, from which the noise is estimated: half of a fit's, in half the time; the
noise behind the low-pass comes out to 2 % at 100 Hz."""

SUSPECTS = 5  # parameters that are named, at most, where the calibration does not hold


@dataclass(frozen=True)
class CalibrationChange:
    """The step from the frozen to the free fit.

    ``z`` (k,): components, each of unit variance if nothing has changed; ``signatures`` (k, n): what a change of each
    parameter, by its scale, makes of them.
    """

    z: Array
    signatures: Array

    @property
    def chi2(self) -> float:
        return float(np.sum(self.z**2))

    @property
    def log_p(self) -> float:
        return log_sf(self.chi2, len(self.z))

    @property
    def holds(self) -> bool:
        return bool(self.log_p > np.log(false_alarms.FROZEN))

    def find_suspects(self, columns: Sequence[Column]) -> list[dict[str, Any]]:
        """Single parameters whose change would explain the step, the best first; none if the calibration holds."""
        suspects: list[dict[str, Any]] = []
        for c, signature in zip(columns, self.signatures.T, strict=True):
            power, along = float(signature @ signature), float(signature @ self.z)
            if power > 1.0:  # else the flight does not determine this one
                value = along / power * c.scale / c.unit_factor
                share = along**2 / power / self.chi2
                suspects.append({"name": c.label, "change": value, "unit": c.unit, "share": share})
        return [] if self.holds else sorted(suspects, key=lambda r: -r["share"])[:SUSPECTS]

    def as_json(self) -> dict[str, Any]:
        return {
            "holds": self.holds,
            "chi2": self.chi2,
            "degrees_of_freedom": len(self.z),
            "p_value": float(np.exp(self.log_p)),
            "log10_p": self.log_p / float(np.log(10.0)),
        }


@dataclass(frozen=True)
class Held:
    """How a frozen calibration holds on flights.

    In ``comparison``, ``calibrated`` and ``holdout`` are the frozen error; ``free``: the error if parameters were fitted to these
    flights.
    """

    comparison: Comparison
    saved: Saved
    free: Error
    change: CalibrationChange

    def as_json(self) -> dict[str, Any]:
        """As ``ragg compare --frozen --json`` writes it."""
        c = self.comparison.fitted.calibration
        frozen = {
            **describe_saved(self.saved),
            **self.change.as_json(),
            "samples": c.rows,
            "suspects": self.change.find_suspects(c.columns),
            "free": {"calibrated": self.free.as_json()},
        }
        return self.comparison.as_json() | {"frozen": frozen}


def describe_saved(saved: Saved) -> dict[str, Any]:
    """When, on what and how a saved calibration was made, for JSON."""
    return {"made": saved.time, "flights": dict(saved.flights), "converged": saved.converged}


@one_thread
def make_calibration(
    saved: Saved, model: Model, instrument: Instrument, observations: Sequence[Observation]
) -> Calibration:
    """The saved parameters as the calibration of these flights; only the noise is estimated from them."""
    root = invert_root(saved.information)
    at = make_point(model, instrument, saved.p, list_candidate_columns(model, instrument))
    noise = tuple(estimate_noise(at, o, most=SEGMENTS, samples=SAMPLES, slow=False) for o in observations)
    return Calibration(
        p=saved.p,
        columns=saved.columns,
        index=saved.index,
        covariance=root @ root.T,
        noise=noise,
        rows=int(sum(np.sum(o.record.valid) for o in observations)),
        chi2=0.0,
        excess=1.0,
        unheld=1.0,
        converged=True,
        reason="nothing is fitted; the saved parameters are used",
    )


def compare_frozen(model: Model, instrument: Instrument, flights: Sequence[Flight], saved: Saved) -> Held:
    """Compare flights with a model by a saved calibration, and test whether it holds for them."""
    observations = observe_flights(flights, instrument)
    f = prepare_evidence(
        model, instrument, observations, make_calibration(saved, model, instrument, observations)
    )
    free = f.vector(f.coefficients(())[0])
    frozen, fitted, nominal = comparison.score_with_nominal(f, [np.zeros(f.size), free])
    return Held(
        # nothing of these flights was fitted: all of their time is held out
        comparison=comparison.conclude(f, nominal.whole, frozen, frozen.whole),
        saved=saved,
        free=fitted.whole,
        change=measure_change(f, saved),
    )


def measure_change(f: Fitted, saved: Saved) -> CalibrationChange:
    """Test the step from frozen parameters to those fitted to flights."""
    n, root = f.n_base, invert_root(saved.information)
    T = join([t for k in range(len(f.observations)) for t in list_base_r_factors(f, k)])
    U, s, _ = np.linalg.svd(T[:n, :n] @ root, full_matrices=False)
    informed = s**2 >= INFORMED
    whitened = (U.T @ T[:n])[informed] / np.sqrt(1.0 + s[informed] ** 2)[:, None]
    return CalibrationChange(z=whitened[:, n], signatures=whitened[:, :n])


def retest_change(
    model: Model, instrument: Instrument, observations: Sequence[Observation], saved: Saved, c: Calibration
) -> CalibrationChange:
    """The same from observations, of long ones from some blocks of them."""
    parts, noise = [], []
    for o, noise_model in zip(observations, c.noise, strict=True):
        n = len(o.record.time)
        blocks = [slice(0, n)]
        if n > BLOCKS * TESTED:
            blocks = spread(divide_into_segments(n, TESTED), BLOCKS)
        # of the observation, not of the flight: the disc's angle counts from its beginning
        parts += [o.part(rows) for rows in blocks]
        noise += [noise_model] * len(blocks)
    f = prepare_evidence(model, instrument, parts, replace(c, noise=tuple(noise)), candidates=False)
    return measure_change(f, saved)


def warn_of_change(time: str, change: CalibrationChange) -> str:
    """The warning of a compensation by a calibration, made at that instant, that does not hold."""
    p = numbers.equate_probability(change.log_p / np.log(10.0))
    return (
        f"The calibration of {time} does NOT hold here: against parameters fitted to this record chi-square is "
        f"{change.chi2:.4g} in {len(change.z)} directions ({p}). Motion errors beyond the "
        "stated uncertainty may remain; no sample is marked good. What changed: ragg compare --frozen"
    )
