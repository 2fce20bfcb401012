"""A saved calibration compared with another flight: nothing is fitted, and a chi-square tests whether it still holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import false_alarms
from ragg_runtime.base.progress import one_thread
from ragg_runtime.compensation.calibrate import Saved, invert_root, list_base_r_factors
from ragg_runtime.estimation.calibration import Calibration
from ragg_runtime.estimation.fitted import Fitted, prepare_evidence
from ragg_runtime.estimation.least_squares import join
from ragg_runtime.estimation.noise_estimate import estimate_noise
from ragg_runtime.estimation.observation import Observation, divide_into_segments, observe_flights, spread
from ragg_runtime.estimation.regressors import Column, list_candidate_columns, make_point
from ragg_runtime.estimation.scores import Error, log_sf
from ragg_runtime.identification import comparison
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.model import Model
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]

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
