"""The next flight: a motion that separates the alternatives left by the flights so far, as a file to fly or simulate."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.api import Loaded, diagnose
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text
from ragg_runtime.compensation.calibrate import invert_root
from ragg_runtime.estimation.fitted import Fitted, fit
from ragg_runtime.estimation.least_squares import compute_r_factor
from ragg_runtime.estimation.observation import combine_output, observe_flights
from ragg_runtime.estimation.scores import demodulate_residual
from ragg_runtime.estimation.whitening import Piece
from ragg_runtime.identification.next_motion import (
    AXES,
    HIGHEST,
    LONGEST,
    MASS,
    Alternatives,
    Knowledge,
    Sinusoid,
    find_motion,
    find_unit,
    list_tones,
    move_channels,
    share_evenly,
)
from ragg_runtime.identification.parameters import find_combinations
from ragg_runtime.identification.selection import make_problem
from ragg_runtime.io import Flight
from ragg_runtime.wording.sections import make_environment

Array = NDArray[np.float64]
Json = Mapping[str, Any]

CHANNELS = ("inline_Eo", "cross_Eo")


@dataclass(frozen=True)
class NextFlight:
    """Sinusoids about the mean of the flights, and what they promise; ``body``: what is moved beside the instrument, in words."""

    sinusoids: Sequence[Sinusoid]
    promise: Json
    mean: Mapping[str, float]
    duration: float
    rate: float
    body: str = ""

    def motion(self) -> Flight:
        """The motion as a flight without output."""
        time = np.arange(round(self.duration * self.rate)) / self.rate
        channels: dict[str, Array] = {n: np.full(len(time), v) for n, v in self.mean.items()}
        channels |= {f"omegadot_{k}": np.zeros(len(time)) for k in "xyz"}
        channels |= move_channels(channels, self.sinusoids, time)
        return Flight(time=time, channels=channels, outputs={}, name="next motion")

    def as_json(self) -> dict[str, object]:
        names = ("axis", "frequency_Hz", "amplitude", "phase_rad")
        return {
            "duration_s": self.duration,
            "rate_Hz": self.rate,
            "sinusoids": [
                dict(zip(names, s, strict=True)) | {"unit": find_unit(s[0])} for s in self.sinusoids
            ],
            **self.promise,
        }


def next_flight(
    m: Loaded,
    flights: Sequence[Flight],
    limits: Mapping[str, float],
    *,
    duration: float = 600.0,
    rate: float | None = None,
    band: tuple[float, float] | None = None,
    purpose: Literal["effects", "calibration"] = "effects",
    criterion: Literal["A", "D"] = "A",
) -> NextFlight:
    """The motion that separates the alternatives left, or the best one to calibrate for motion such as the flights'.

    ``rate``, Hz: default that of the flights; ``band``, Hz: default all that the rate holds. ``criterion`` of a calibration: least
    mean variance of the channels (A), or least volume of their uncertainty (D).
    """
    rate = flights[0].rate if rate is None else rate
    tones = _list_possible(m, limits, rate, band)
    mean = {n: float(np.mean([np.mean(x.channels[n][x.valid]) for x in flights])) for n in AXES}
    body = _name_body(m) if any(t[0] in MASS for t in tones) else ""
    if body:
        mean |= dict.fromkeys(MASS, 0.0)
    promise: dict[str, Any] = {"separations": []}
    if purpose == "calibration":
        f = fit(m.model, m.instrument, observe_flights(flights, m.instrument), candidates=False)
        variance = ChannelVariance.of(f)
        worth = {"A": variance.weigh_variance, "D": variance.weigh_volume}[criterion]
        motion = find_motion(variance.known, worth, tones, duration)
        promise |= {"criterion": criterion} | variance.promise(motion, duration)
    else:
        d = diagnose(m, flights)
        pairs = [(r.effect, o) for r in d.ranking if r.effect in d.found for o in r.indistinguishable_from]
        alternatives = Alternatives.of(d.fitted, make_problem(d.fitted), pairs, both=True)
        motion = share_evenly(tones)
        if alternatives.pairs:
            motion = find_motion(alternatives.known, alternatives.worth, tones, duration)
            promise = {"separations": [s.as_json() for s in alternatives.promise(motion, duration)]}
    return NextFlight(motion, promise, mean, duration, rate, body)


def _name_body(m: Loaded) -> str:
    """The body of the model that can be moved: its effect's id and values; UserError if there is none."""
    bodies = {e.id for e in m.model.effects if e.channels == MASS}
    for e in m.instrument.effects:
        if e.id in bodies:
            return f"{e.id}, {', '.join(f'{n} = {value}' for n, value in e.values.items())}"
    raise UserError(
        "the model has no body that could be moved",
        where="--limit mass",
        expected="near-sphere or near-cuboid among the effects of model.toml, with its mass and place",
        remedy="ragg effects near-sphere says how it is listed",
    )


def _list_possible(
    m: Loaded, limits: Mapping[str, float], rate: float, band: tuple[float, float] | None
) -> list[Sinusoid]:
    """The sinusoids that limits, rate and band, Hz, let be; UserError if there are none."""
    band = (0.0, HIGHEST * rate) if band is None else band
    tones = list_tones(m.instrument.spin_frequency, limits, band)
    if not tones or band[1] > HIGHEST * rate:
        raise UserError(
            "no motion is possible with these frequencies",
            where="--band",
            found=f"{band[0]:g} to {band[1]:g} Hz at {rate:g} samples a second",
            expected=f"multiples of the spin frequency among them, none above {HIGHEST * rate:g} Hz",
            remedy="give a wider band or a higher --rate",
        )
    return tones


# --- the motion that calibrates: what the parameters add to the variance of the compensated channels (A-optimal), or the volume of what
# they leave uncertain there (D-optimal; A. Atkinson, A. Donev, R. Tobias, Optimum Experimental Designs, 2007, ch. 10)

MATTER = 1e-3  # least share of the channels' variance for a direction to count in D


@dataclass(frozen=True)
class ChannelVariance:
    """How uncertain parameters show in the compensated channels, in the motion of the flights.

    ``r_factors`` (2, n, n), Eo: of the mean square of inline, and of cross, as linear functions of the parameters in their scales.
    """

    known: Knowledge
    r_factors: Array

    @staticmethod
    def of(f: Fitted) -> ChannelVariance:
        """Of the first flight of a fit; UserError if it has no channels."""
        x, n, k_ggi = f.prepared[0], f.n_base, f.scales[0]

        def demodulate_columns(piece: Piece) -> Array:
            o = piece.observation
            volts = combine_output(o, piece.columns[:n])
            g = np.array([demodulate_residual(e, o.record, k_ggi) for e in volts])
            return np.stack([g.real, g.imag], axis=1)[:, :, np.isfinite(g[0])]

        changes = np.concatenate([*x.each(demodulate_columns, whitened=False)], axis=2)  # (n, 2, instants)
        if not changes.shape[2]:
            raise UserError(
                "no motion can be designed: the flight is too short to demodulate, or its disc does not turn",
                where=x.observation.name,
                remedy="give a longer flight of the motion that is to be compensated",
            )
        r_factors = np.stack([compute_r_factor(changes[:, k]) for k in range(2)]) / np.sqrt(changes.shape[2])
        return ChannelVariance(Knowledge.of(f), np.asarray(r_factors))

    def rms(self, R: Array) -> tuple[float, float]:
        """Standard deviations of inline and cross, Eo, by parameters with this R factor."""
        inline, cross = (float(np.linalg.norm(G @ invert_root(R))) for G in self.r_factors)
        return inline, cross

    def weigh_variance(self, R: Array) -> float:
        """A-criterion: the less variance, the more."""
        return -sum(x**2 for x in self.rms(R))

    def weigh_volume(self, R: Array) -> float:
        """D-criterion: minus the log volume of uncertainty, squared, in the directions of the channels' variance so far."""
        stacked = np.vstack([*self.r_factors])
        U, s, _ = np.linalg.svd(stacked @ invert_root(self.known.root), full_matrices=False)
        matter = U[:, s**2 > MATTER * np.sum(s**2)].T @ stacked
        return -2 * float(np.sum(np.log(np.linalg.svd(matter @ invert_root(R), compute_uv=False))))

    def promise(self, motion: Sequence[Sinusoid], duration: float) -> dict[str, Any]:
        """Standard deviations of channels, parameters and combinations now, and after ``duration`` s of a motion."""
        f, R = self.known.f, {"now": self.known.root, "then": self.known.fly(motion, duration, LONGEST)}
        root, columns = {when: invert_root(x) for when, x in R.items()}, f.calibration.columns

        def std(w: Array, when: str = "then") -> float:
            return float(np.linalg.norm(w @ root[when]))

        def describe(name: str, accelerometer: int | None, unit: str, w: Array) -> dict[str, Any]:
            entry: dict[str, Any] = {"name": name, "accelerometer": accelerometer, "unit": unit}
            return entry | {when: std(w, when) for when in R}

        alone = np.diag([q.scale / q.unit_factor for q in columns])
        channels = {"now": self.rms(R["now"]), "planned": self.rms(R["then"])}
        return {
            "channels": {k: {"inline_Eo": x, "cross_Eo": y} for k, (x, y) in channels.items()},
            "parameters": [
                describe(q.name, q.accelerometer, q.unit, w) for q, w in zip(columns, alone, strict=True)
            ],
            "combinations": [
                describe(name, None, unit, w)
                for name, unit, w, _ in find_combinations(f.model, f.calibration.p, columns, std)
            ],
        }


# --- the run sheet, and what was reached


def write_run_sheet(x: NextFlight) -> str:
    """Instructions for the crew, and the plan by which the calibration is certified afterwards, as Markdown."""
    channels = x.motion().channels
    peaks = {s[0]: float(np.max(np.abs(channels[s[0]] - x.mean[s[0]]))) for s in x.sinusoids}
    filters = {"unit": find_unit, "degrees": lambda phase: np.degrees(phase) % 360}
    env = make_environment("ragg_runtime", filters)
    return env.get_template("run_sheet.md.j2").render(flight=x, plan=x.promise, peaks=peaks)


def read_plan(path: Path) -> Json:
    """The JSON of `ragg next-motion --for calibration`; UserError if the file is none."""
    try:
        plan = json.loads(read_text(path))
        for q in (*plan["parameters"], *plan["combinations"]):
            if not {"name", "accelerometer", "unit"} <= q.keys():
                raise ValueError
            q |= {when: float(q[when]) for when in ("now", "then")}
        plan["channels"] = {
            when: {n: float(plan["channels"][when][n]) for n in CHANNELS} for when in ("now", "planned")
        }
    except (ValueError, KeyError, TypeError, AttributeError):
        raise UserError(
            "this is not a plan of a calibration",
            where=path,
            expected="the JSON of ragg next-motion MODEL FLIGHT... --for calibration --json PLAN.json",
        ) from None
    return dict(plan)


def certify(plan: Json, f: Fitted, calibration: Json) -> dict[str, Any]:
    """Planned against reached uncertainties, added to the JSON of `calibrate`; ``calibration`` is that JSON, ``f`` its fit.

    ``certificate``: value and standard uncertainties of every parameter; ``certified``: those of the combinations, and what all
    parameters add to the channels of the first flight.
    """
    values = [*calibration["combinations"], *calibration["parameters"]]
    full = [f"{q['effect']}.{q['name']}" if q.get("effect") else q["name"] for q in values]
    by_label = {(name, q.get("accelerometer")): q for name, q in zip(full, values, strict=True)}
    reached = ChannelVariance.of(f)
    after = dict(zip(CHANNELS, reached.rms(reached.known.root), strict=True))
    before, planned = (plan["channels"][when] for when in ("now", "planned"))
    channels = {n: {"before": before[n], "planned": planned[n], "reached": after[n]} for n in CHANNELS}
    return {
        "certificate": [_certify_one(q, by_label) for q in plan["parameters"]],
        "certified": {
            "channels": channels,
            "combinations": [_certify_one(q, by_label) for q in plan["combinations"]],
        },
    }


def _certify_one(x: Json, calibrated: Mapping[Any, Json]) -> dict[str, Any]:
    q = calibrated.get((x["name"], x["accelerometer"]))
    if q is None and x["accelerometer"] is not None:
        raise UserError(
            "the plan is of another model: a parameter of it is not fitted",
            found=x["name"],
            remedy="plan again with the present model: ragg next-motion --for calibration",
        )
    return {
        **{k: x[k] for k in ("name", "accelerometer", "unit")},
        "value": None if q is None else q["value"],  # a combination that the flights do not determine
        "std_before": x["now"],
        "std_planned": x["then"],
        "std_reached": None if q is None else q["std"],
        "reached": q is not None and bool(q["std"] <= REACHED * x["then"]),
    }


# a standard deviation within so much of the planned one counts as reached: noise is known to some per cent
REACHED = 1.1
