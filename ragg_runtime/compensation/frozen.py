"""A calibration that was kept, held against another flight: nothing is fitted, and how well it holds is said."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.base import false_alarms
from ragg_runtime.base.errors import UserError, did_you_mean
from ragg_runtime.base.threads import one_thread
from ragg_runtime.compensation import calibrated
from ragg_runtime.compensation.saved import Saved, read
from ragg_runtime.estimation.calibration import Calibration
from ragg_runtime.estimation.fitted import Fitted, about
from ragg_runtime.estimation.least_squares import join
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import Observation, observations_of, segments, spread
from ragg_runtime.estimation.regressors import Point, base_columns
from ragg_runtime.estimation.scores import Error, finite, log_sf
from ragg_runtime.identification import comparison as compare
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.instrument.form import ANGLE_ORIGINS
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import start_of

Array = NDArray[np.float64]

INFORMED = 0.1
"""A direction is tested where the flight knows at least this share of what the saved calibration knows: the rest is
noise that would hide a change."""

LOOKED, STRETCHES = 8000, 4
"""Samples, and number, of the stretches of a long flight that say whether a calibration holds: seconds of work, where
the whole flight would take longer than it takes to compensate it."""

HEARD = 4
"""Most segments of a flight of which the noise is estimated. Half of what a fit listens to takes half of the time, which is most of
what a million samples take, and tells the standard deviation of what passes the low-pass to 2 % at 100 Hz."""

LISTENED = 80_000
"""Most samples of these segments together: segments are of 15,000 to 30,000 by how long the flight is, and the estimate would take
so much longer of one flight than of another."""

BETTER = 5.0
"""Factor by which chi-square must fall for another origin of the disc angle to be named: as for mistakes (screening)."""

SUSPECTS = 5
"""Parameters that are named, at most, where the calibration does not hold."""


def in_force(kept: str | None, where: Path, model: Model, instrument: Instrument) -> Saved:
    """The calibration that a model directory keeps in a file, if it is of this model; UserError if there is none."""
    again = f"calibrate: ragg calibrate {where.parent} FLIGHT... --save"
    if kept is None:
        raise UserError("the model has no saved calibration", where=where.parent, remedy=again)
    saved = read(kept, str(where))[-1]
    nominal = vector(model, instrument)
    names = tuple(model.chain.PARAMETERS)
    here = (tuple(e.id for e in model.effects), instrument.form.words())
    if saved.layout != names or (saved.effects, saved.form) != here:
        raise UserError(
            "the saved calibration belongs to another model",
            where=where,
            found=f"{saved.form}, effects {', '.join(saved.effects) or 'none'}, made {saved.time}",
            expected=f"{here[1]}, effects {', '.join(here[0]) or 'none'}",
            remedy=again,
        )
    current = {(c.name, c.accelerometer): (c, k) for c, k in base_columns(model, instrument)}
    columns = []
    for c, k in zip(saved.columns, saved.index, strict=True):
        own, place = current.get((c.name, c.accelerometer), (c, None))
        if place != k:
            raise UserError(
                "the saved calibration names a parameter that the model does not fit",
                where=where,
                found=c.label,
                remedy=did_you_mean(c.name, [name for name, _ in current]) or again,
            )
        columns.append(replace(own, scale=c.scale, unit=c.unit, unit_factor=c.unit_factor))
    given = np.setdiff1d(np.arange(len(nominal)), saved.index)
    if not np.array_equal(saved.p[given], nominal[given]):
        raise UserError(
            "model.toml was changed since the calibration was saved: values that are not fitted differ",
            where=where,
            found=f"a calibration made {saved.time}",
            remedy=again,
        )
    if not scale_factor(model, saved.p) > 0.0:
        raise UserError("the saved calibration has no positive scale factor", where=where, remedy=again)
    return replace(saved, columns=tuple(columns))


def notes(saved: Saved, model: Model, instrument: Instrument) -> list[str]:
    """What is odd about a saved calibration, in sentences."""
    found = []
    if saved.derivation != model.digest:
        found.append("the model has been derived anew since the calibration was saved")
    if not saved.converged:
        found.append("the saved calibration had not converged")
    if not np.array_equal(saved.sheet, vector(model, instrument)):
        found.append(
            "model.toml has other values than when the calibration was saved; those it saved are used"
        )
    return found


def root(saved: Saved, model: Model, instrument: Instrument) -> Array:
    """(n, k): a root of the covariance of the calibration, in units of the present scales of the fitted columns."""
    place = {int(k): n for n, k in enumerate(saved.index)}
    inverse = calibrated.inverse(saved.information)
    columns = base_columns(model, instrument)
    found = np.zeros((len(columns), len(inverse)))
    for n, (c, k) in enumerate(columns):
        if k in place:  # else it stays where the sheet puts it
            found[n] = inverse[place[k]] * (saved.columns[place[k]].scale / c.scale)
    return found


def information(saved: Saved, model: Model, instrument: Instrument) -> Array:
    """(n, n) square root of the information of the calibration, in the present scales of the fitted columns."""
    columns = base_columns(model, instrument)
    place = {int(k): n for n, k in enumerate(saved.index)}
    rows = np.zeros((len(saved.information), len(columns)))
    for n, (c, k) in enumerate(columns):
        if k in place:
            rows[:, n] = saved.information[:, place[k]] * (c.scale / saved.columns[place[k]].scale)
    new = np.diag([0.0 if k in place else 1.0 for _, k in columns])
    return np.asarray(np.linalg.qr(np.vstack([rows, new]), mode="r"))


@one_thread
def calibration(
    saved: Saved, model: Model, instrument: Instrument, observations: Sequence[Observation]
) -> Calibration:
    """The saved parameters as the calibration of these flights; of the flights only the noise is estimated."""
    columns = base_columns(model, instrument)
    half = root(saved, model, instrument)
    at = Point(model, instrument, saved.p, with_candidates=True)
    noise: list[NoiseModel] = [
        NoiseModel.fit(at, o, most=HEARD, samples=LISTENED, slow=False) for o in observations
    ]
    return Calibration(
        p=saved.p,
        columns=tuple(c for c, _ in columns),
        index=np.array([k for _, k in columns], dtype=np.intp),
        covariance=half @ half.T,
        noise=tuple(noise),
        rows=int(sum(np.sum(o.record.valid) for o in observations)),
        chi2=0.0,
        excess=1.0,
        unheld=1.0,
        converged=True,
        reason="nothing is fitted: the parameters are those that were saved",
    )


@dataclass(frozen=True)
class Change:
    """The step from the frozen to the free fit.

    ``z`` (k,): components, each of unit variance if nothing has changed; ``signatures`` (k, n): what a change of each
    parameter, by its scale, makes of them; ``squares``: sums of the whitened residual, frozen and free.
    """

    z: Array
    signatures: Array
    squares: tuple[float, float]

    @property
    def chi2(self) -> float:
        return float(np.sum(self.z**2))

    @property
    def p_value(self) -> float:
        return float(special.chdtrc(len(self.z), self.chi2)) if len(self.z) else 1.0

    @property
    def holds(self) -> bool:
        return self.p_value > false_alarms.FROZEN

    def as_json(self) -> dict[str, Any]:
        return {
            "holds": self.holds,
            "chi2": self.chi2,
            "degrees_of_freedom": len(self.z),
            "p_value": self.p_value,
            "log10_p": finite(log_sf(self.chi2, len(self.z)) / np.log(10.0)) if len(self.z) else 0.0,
        }


@dataclass(frozen=True)
class Held:
    """How a frozen calibration holds on flights.

    In ``comparison``, ``calibrated`` and ``holdout`` are the frozen error. ``root`` (n, k): of the covariance of the
    calibration, in the scales of the fitted columns. ``free``, ``free_holdout``: errors if parameters were fitted to
    these flights. ``origin``: that it would hold with disc angles from elsewhere, in words.
    """

    comparison: Comparison
    root: Array
    saved: Saved
    free: Error
    free_holdout: Error
    change: Change
    origin: str | None = None

    @property
    def p_value(self) -> float:
        return self.change.p_value

    def suspects(self) -> list[dict[str, Any]]:
        """Single parameters whose change would explain the step, the best first; none if the calibration holds."""
        if self.holds:
            return []
        found: list[dict[str, Any]] = []
        for c, signature in zip(
            self.comparison.fitted.calibration.columns, self.change.signatures.T, strict=True
        ):
            power = float(signature @ signature)
            if not power > 1.0:
                continue  # the flight does not tell this one
            along = float(signature @ self.change.z)
            share = along**2 / power / self.change.chi2
            value = along / power * c.scale / c.unit_factor
            found.append({"name": c.label, "change": value, "unit": c.unit, "share": share})
        return sorted(found, key=lambda r: -r["share"])[:SUSPECTS]

    @property
    def holds(self) -> bool:
        return self.change.holds

    @property
    def chi2(self) -> float:
        return self.change.chi2

    @property
    def degrees_of_freedom(self) -> int:
        return len(self.change.z)

    def in_words(self) -> str:
        """How the calibration holds, in a sentence."""
        verdict = "holds" if self.holds else "does NOT hold"
        return (
            f"the calibration of {self.saved.time} on {', '.join(self.saved.flights)} {verdict} here: chi-square of the"
            f" step to the free fit {self.change.chi2:.1f} in {len(self.change.z)} directions (p = {self.p_value:.2g});"
            f" error frozen {self.comparison.calibrated.rms_Eo:.4g} Eo, free {self.free.rms_Eo:.4g} Eo rms"
            + ("" if self.origin is None else f"; {self.origin}")
        )

    def drift(self) -> list[dict[str, Any]]:
        """Every visible combination, frozen and as each of the flights alone has it; ``z``: how far it moved."""
        f = self.comparison.fitted
        c = f.calibration
        values = c.p[c.index] / np.array([q.scale for q in c.columns])
        rows = []
        seen = calibrated.visible(f.model, c.p, c.columns, self.root)
        for flight, step, root_now in calibrated.each_flight(f):
            for q in seen:
                value, std = q.of(values, self.root)
                now, now_std = q.of(values + step, root_now)
                both = float(np.hypot(std, now_std))
                z = (now - value) / both if both else 0.0
                row = {"flight": flight, "name": q.name, "frozen": value, "frozen_std": std}
                rows.append(row | {"value": now, "std": now_std, "unit": q.unit, "z": z})
        return rows

    def as_json(self) -> dict[str, Any]:
        frozen = {
            "made": self.saved.time,
            "flights": dict(self.saved.flights),
            "converged": self.saved.converged,
            **self.change.as_json(),
            "samples": self.comparison.fitted.calibration.rows,
            "whitened_squares": dict(zip(("frozen", "free"), self.change.squares, strict=True)),
            "suspects": self.suspects(),
            "free": {"calibrated": self.free.as_json(), "holdout": self.free_holdout.as_json()},
            "drift": self.drift(),
            "angle_origin": self.origin,
        }
        return self.comparison.as_json() | {"frozen": frozen}


def hold(model: Model, instrument: Instrument, flights: Sequence[Flight], saved: Saved) -> Held:
    """Hold a saved calibration against flights."""
    observations = observations_of(flights, instrument)
    f = about(model, instrument, observations, calibration(saved, model, instrument, observations))
    free, _ = f.coefficients(())
    half, _ = f.coefficients((), held_out=True)
    frozen, fitted, held_out, nominal = compare.errors(f, [np.zeros(f.n_base), free, half])
    half_covariance = root(saved, model, instrument)
    # nothing of these flights was fitted: all of their time is held out
    comparison = compare.concluded(f, nominal.whole, frozen, frozen.whole)
    change = changed(f, half_covariance)
    return Held(
        comparison=comparison,
        root=half_covariance,
        saved=saved,
        free=fitted.whole,
        free_holdout=held_out.held_out,
        change=change,
        origin=other_origin(model, instrument, flights, saved, change),
    )


def looked(
    model: Model, instrument: Instrument, observations: Sequence[Observation], saved: Saved, c: Calibration
) -> Change:
    """The step from frozen parameters to what observations say, of long ones to what some stretches of them say."""
    stretches, noise = [], []
    for o, own in zip(observations, c.noise, strict=True):
        # of the observation, not of the flight: the disc's angle counts from its beginning
        found = [o.part(rows) for rows in _stretches(len(o.record.time))]
        stretches += found
        noise += [own] * len(found)
    f = about(model, instrument, stretches, replace(c, noise=tuple(noise)), candidates=False)
    return changed(f, root(saved, model, instrument))


def _stretches(samples: int) -> list[slice]:
    if samples <= STRETCHES * LOOKED:
        return [slice(0, samples)]
    return [s.rows for s in spread(segments(samples, LOOKED), STRETCHES)]


def changed(f: Fitted, root: Array) -> Change:
    """Test the step from frozen parameters to what flights say; ``root`` (n, k) of the calibration's covariance."""
    n = f.n_base
    T = join([t[:, [*range(n), -1]] for x in f.triangles for t in x])
    U, s, _ = np.linalg.svd(T[:n, :n] @ root, full_matrices=False)
    informed = s**2 >= INFORMED
    both = (U.T @ T[:n])[informed] / np.sqrt(1.0 + s[informed] ** 2)[:, None]
    total = float(np.sum(T[:, n] ** 2))
    return Change(z=both[:, n], signatures=both[:, :n], squares=(total, float(T[n, n] ** 2)))


def other_origin(
    model: Model, instrument: Instrument, flights: Sequence[Flight], saved: Saved, change: Change
) -> str | None:
    """That a calibration which does not hold holds plainly better with disc angles from elsewhere, in words; ``None``: it does not."""
    here = [start_of(x, instrument) for x in flights]
    for origin in ANGLE_ORIGINS:
        other = replace(instrument, angle_origin=origin)
        encoders = all(d.angle_column in x.channels for d in instrument.layout.discs for x in flights)
        if change.holds or encoders or [start_of(x, other) for x in flights] == here:
            continue
        observations = observations_of(flights, other)
        c = calibration(saved, model, other, observations)
        if BETTER * looked(model, other, observations, saved, c).chi2 < change.chi2:
            return (
                f"with disc angles counted from {'t = 0' if origin == 'zero' else 'the first sample'} it fits far better: "
                f'is angle_origin = "{origin}" missing under [model] of model.toml?'
            )
    return None


def warning(made: str, change: Change) -> str:
    """What is said of a compensation by a calibration that does not hold, made at that instant."""
    return (
        f"the calibration of {made} does NOT hold here: chi-square of the step to what this record says "
        f"{change.chi2:.4g} in {len(change.z)} directions (p = {change.p_value:.2g}); what is left of the motion may be "
        "beyond the stated uncertainty. ragg compare --frozen says what changed"
    )
