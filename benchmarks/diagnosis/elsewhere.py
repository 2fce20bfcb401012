"""Flights of other instruments than the paper's, through the commands' own path: does the diagnosis hold there?

    python -m benchmarks.diagnosis.elsewhere [--seed N] [--flights N] [--cache FILE] [--only WHAT] [--table]

Every flight draws its own instrument (radius, spin rate, class of accelerometers: navigation, ten times worse, MEMS whose
sheet says how little it is sure), motion (how much, of what spectrum, recorded), length, rate, noise, gradient, and the
outputs that are recorded (G_out, voltages, or inline and cross alone), and hides one effect of a plausible size in it; in every
sixth none. Sheet and flight are written to files, read, diagnosed, and what is found is added, as a user would.

- ``right``: all that is hidden is found, itself or in its group, and nothing else; or nothing, where nothing is hidden;
- ``silent``: adequate, and an oracle (``oracle``) does not see the effect either;
- ``said``: ``unexplained`` or refused, with a reason; ``unexplained``: without one;
- ``missed``: adequate, although an oracle sees the effect; ``wrong``: another effect is named; ``crash``;
- ``after``: rms with what was found in the model, over the noise that was added.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.diagnosis import effect_free, oracle, score
from benchmarks.diagnosis.kept import Kept
from ragg_runtime.base.errors import UserError
from ragg_runtime.flight import Flight, read_flight, write_flight
from ragg_runtime.instrument.edit_toml import model_text
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.evaluate import unit_factor
from ragg_runtime.model.model import Effect, packaged
from ragg_runtime.reference.accelerometer_noise import Noise, eotvos_noise
from ragg_runtime.reference.auxiliaries import further, plausible
from ragg_runtime.reference.instruments import table_v, trimmed
from ragg_runtime.reference.motion import Motion, recorded_motion
from ragg_runtime.reference.scenario import Scenario, draw_gradient, draw_motion
from ragg_runtime.reference.turbulence import SHAPES
from ragg_runtime.signals.demodulate import low_pass
from ragg_runtime.signals.fir import convolved
from ragg_runtime.workflow import loop

Array = NDArray[np.float64]

ROOT = Path(__file__).resolve().parents[2]
CACHE = ROOT / "build" / "bench-elsewhere.jsonl"

MOST = (8_000, 60_000)
"""Samples of the longest flight, of four in five and of the fifth."""

HIDDEN = ("deterministic", "step")

NOT_HIDDEN = ("disc-spin", "second-order-misalignment")
"""Effects that nature knows at one size alone."""

MEMS: Mapping[str, tuple[float, str]] = {
    "dR": (5e-4, "m"),
    "beta_x": (5e-3, "rad"),
    "beta_z": (5e-3, "rad"),
    "vartheta_x": (5e-3, "rad"),
    "vartheta_y": (5e-3, "rad"),
    "vartheta_z": (5e-3, "rad"),
    "K0": (0.2, "m/s^2"),
    "K1": (1e-2, "of its value"),
    **{f"K{k}": (1e-5, "1/(m/s^2)") for k in (2, 4, 5, 6, 7, 8)},
}
"""How far a MEMS accelerometer may be from its sheet: 20 mg, per cent, milliradians, 100 ug/g^2."""


@dataclass(frozen=True)
class World:
    """One flight: its scenario, what is recorded of it, and what is hidden."""

    scenario: Scenario
    grade: str
    recorded: str
    gradient: bool
    effect: str | None
    values: Mapping[str, float | list[float]]


def world(index: int, sample: int) -> World:
    """The flight of this number."""
    seed = 700_000 + 10_000 * sample + index
    rng = np.random.default_rng([seed, 12])
    grade = ("navigation", "tactical", "mems")[int(rng.choice(3, p=[0.5, 0.25, 0.25]))]
    spin = float(10 ** rng.uniform(-1.0, 0.0)) if rng.random() < 0.6 else 0.25
    radius = float(10 ** rng.uniform(-1.5, -0.3)) if rng.random() < 0.6 else 0.1
    rate = float(rng.choice([r for r in (8.0, 10.0, 16.0, 20.0, 32.0, 50.0) if r >= 16 * spin]))
    most = MOST[int(rng.random() < 0.2)]
    duration = min(float(10 ** rng.uniform(np.log10(300.0), np.log10(7200.0))), most / rate)
    sheet, true = _instruments(rng, grade, radius, spin)
    density = (
        2e-9 * float(10 ** rng.uniform(-1.0, 1.0)) * {"navigation": 1.0, "tactical": 10.0, "mems": 1e4}[grade]
    )
    white = eotvos_noise(density, radius)
    corner = (0.0, 0.05, 0.2)[int(rng.integers(3))]
    scale = float(10 ** rng.uniform(-0.7, 0.7))
    s = Scenario(
        sheet=sheet,
        instrument=true,
        motion=_motion(rng, duration, scale),
        gravity=draw_gradient(rng, 20e-9 if rng.random() < 0.5 else 0.0),
        noise=Noise(alpha=white.omega_T * corner, b=1.0, omega_T=white.omega_T),
        auxiliaries={**plausible(rng), **further(rng)},
        duration=duration,
        rate=rate,
        rotations="first-order",
        seed=seed,
    )
    recorded = ("G_out", "voltages", "channels")[int(rng.choice(3, p=[0.6, 0.2, 0.2]))]
    effect = None if index % 6 == 5 else _effect(rng)
    values = {} if effect is None else _values(rng, effect, duration, sheet)
    gradient = bool(rng.random() < 0.6)
    return World(s, grade, recorded, gradient, None if effect is None else effect.id, values)


def _instruments(
    rng: np.random.Generator, grade: str, radius: float, spin: float
) -> tuple[Instrument, Instrument]:
    """The sheet, and an instrument about it."""
    base = table_v() if rng.random() < 0.5 else trimmed()
    sigma = {n: base.sigma(n) / 20.0 for n in MEMS}
    values = dict(base.accelerometers)
    said: dict[str, Array] = {}
    if grade == "tactical":
        sigma = {n: 10.0 * s for n, s in sigma.items()}
    if grade == "mems":
        sigma = {n: s * (np.abs(values["K1"]) if n == "K1" else np.ones(4)) for n, (s, _) in MEMS.items()}
        said = sigma
    drawn = {n: values[n] + sigma[n] * rng.standard_normal(4) for n in sigma}
    sheet = Instrument.build(radius=radius, spin_frequency=spin, g0=9.8, accelerometers=values, sigmas=said)
    true = Instrument.build(radius=radius, spin_frequency=spin, g0=9.8, accelerometers={**values, **drawn})
    return sheet, true


def _motion(rng: np.random.Generator, duration: float, scale: float) -> Motion:
    if rng.random() < 0.15 and duration < 600.0:
        x = read_flight(effect_free.RECORD, 9.8)
        a, omega = (np.stack([x.channels[f"{q}_{c}"] for c in "xyz"]) for q in ("a", "omega"))
        return recorded_motion(x.time - x.time[0], a, omega)
    shape = str(rng.choice(list(SHAPES))) if rng.random() < 0.5 else None
    return draw_motion(rng, duration, shape=shape, turbulence_scale=scale)


def _effect(rng: np.random.Generator) -> Effect:
    known = [e for e in packaged().candidates if e.kind in HIDDEN and e.id not in NOT_HIDDEN]
    return known[int(rng.integers(len(known)))]


def _values(
    rng: np.random.Generator, effect: Effect, duration: float, sheet: Instrument
) -> dict[str, float | list[float]]:
    """One of its parameters, plausibly large, of one accelerometer or of all."""
    own = [q for q in effect.parameters if q.fitted]
    q = own[int(rng.integers(len(own)))]
    size = (
        q.plausible
        * unit_factor(q.unit, sheet.units)
        * sheet.grade(q.like)
        * float(10 ** rng.uniform(-0.3, 0.5))
    )
    one_sided = effect.id in ("lag", "output-filter", "second-order-loop")
    sign = 1.0 if one_sided else float(rng.choice([-1.0, 1.0]))
    name = q.name
    found: dict[str, float | list[float]] = {}
    if q.shared:
        found[name] = sign * size
    else:
        drawn = rng.standard_normal(4) * (1.0 if rng.random() < 0.5 else np.eye(4)[int(rng.integers(4))])
        found[name] = (size * (np.abs(drawn) if one_sided else drawn)).tolist()
    if effect.id in ("vibration-rectification", "vibration-level", "angular-jitter"):
        found = {name: size}  # of a covariance
    if effect.kind == "step":
        found["t_step"] = float(duration * rng.uniform(0.2, 0.8))
    return found


def flown(index: int, sample: int) -> dict[str, object]:
    """The record of one flight; a crash is a result too."""
    begin = time.perf_counter()
    found: dict[str, object] = {}
    try:
        w = world(index, sample)
        found = _said(w)
        found |= _flown(w)
    except UserError as e:
        found |= {"verdict": "refused", "reason": str(e), "found": [], "ranking": []}
    except Exception:
        found |= {"crash": traceback.format_exc()}
    return (
        {"id": f"{index:03d}", "kind": "elsewhere"}
        | found
        | {"seconds": round(time.perf_counter() - begin, 1)}
    )


def _said(w: World) -> dict[str, object]:
    s = w.scenario
    return {
        "grade": w.grade,
        "recorded": w.recorded,
        "gradient": w.gradient,
        "spin": s.sheet.spin_frequency,
        "radius": s.sheet.radius,
        "duration": s.duration,
        "rate": s.rate,
        "hidden": [] if w.effect is None else [{"effect": w.effect, "values": dict(w.values)}],
    }


def record(w: World) -> tuple[Flight, float]:
    """What is recorded, and the rms of the noise in it, Eo before demodulation."""
    s = w.scenario
    sim = s.simulate({} if w.effect is None else {w.effect: w.values}, record_gradient=w.gradient)
    k = s.sheet.scale_factor * 1e-9
    noise = float(np.std(sim.G_out - sim.G_out_noise_free)) / k
    x = sim.flight("flight", voltages=w.recorded == "voltages")
    if w.recorded == "channels":
        phi, low = 2 * np.pi * s.sheet.spin_frequency * x.time, low_pass(s.rate)
        made = {
            "inline": convolved(4 * x.outputs["G_out"] * np.sin(2 * phi), low) / k * 1e-9,
            "cross": convolved(-2 * x.outputs["G_out"] * np.cos(2 * phi), low) / k * 1e-9,
        }
        half = len(low) // 2  # at both ends the filter has not seen enough
        made = {n: np.pad(v, half, constant_values=np.nan) for n, v in made.items()}
        x = replace(x, outputs=made, valid=np.isfinite(made["inline"]), units={})
    return x, noise


def _flown(w: World) -> dict[str, object]:
    x, noise = record(w)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        (place / "sheet.toml").write_text(model_text(w.scenario.sheet), "utf-8")
        write_flight(x, place / "flight.parquet")
        m = loop.new(place / "model", place / "sheet.toml")
        flights = loop.read_flights(m, [place / "flight.parquet"])
        begin = time.perf_counter()
        d = loop.diagnose(m, flights)
        seconds = time.perf_counter() - begin
        after = d.before.rms_Eo
        for e in d.found:
            step = loop.add(m, e, flights)
            m = step.loaded or m
            if step.after is not None:
                after = step.after.calibrated.rms_Eo
        return {
            "verdict": d.verdict,
            "converged": d.converged,
            "reason": d.as_json()["reason"],
            "found": list(d.found),
            "ranking": [
                {
                    "effect": r.effect,
                    "log_p": max(r.log_p, -1e9),
                    "chi2": r.chi2,
                    "twins": list(r.indistinguishable_from),
                }
                for r in d.ranking[:6]
            ],
            "terms": [
                [t.term.harmonic, t.term.product, round(t.z, 2)]
                for q in d.remainder.searches
                for t in q.terms
            ],
            "before": d.before.rms_Eo,
            "after": after,
            "noise_floor": d.noise_floor,
            "noise_true": noise,
            "diagnosis_seconds": round(seconds, 2),
            "oracle": None if w.effect is None else oracle.gain(d.fitted, [w.effect], _instant(w), w.effect),
        }


def _instant(w: World) -> Mapping[str, float]:
    at = w.values.get("t_step")
    return MappingProxyType({w.effect: float(at)} if isinstance(at, float) and w.effect is not None else {})


def judged(x: score.Line) -> str:
    """``right``, ``silent``, ``said``, ``unexplained``, ``missed``, ``wrong`` or ``crash``."""
    if "crash" in x:
        return "crash"
    truth = {h["effect"] for h in x["hidden"]}
    if x["verdict"] in ("unexplained", "refused"):
        return "said" if x["reason"] else "unexplained"
    if x["verdict"] == "adequate":
        if not truth:
            return "right"
        catalogue = len(packaged().candidates)
        return "missed" if oracle.detectable({"oracle": [x["oracle"]]}, catalogue) else "silent"
    return "right" if truth and score.exactly_both(x) else "wrong"


OUTCOMES = ("right", "silent", "said", "unexplained", "missed", "wrong", "crash")


def summary(lines: Sequence[score.Line]) -> list[str]:
    """Counts, by the class of instrument, then the flights that went wrong."""
    text = [f"{'':12}" + "".join(f"{o:>12}" for o in OUTCOMES)]
    for grade in ("navigation", "tactical", "mems"):
        own = [judged(x) for x in lines if x.get("grade") == grade]
        text.append(f"{grade:12}" + "".join(f"{own.count(o):>12}" for o in OUTCOMES))
    for x in sorted(lines, key=lambda x: x["id"]):
        how, large = judged(x), x.get("after", 0.0) > 1.1 * x.get("noise_true", np.inf)
        if how in ("right", "silent") and not large:
            continue
        text.append(f"{x['id']}: {how}: {_line(x)}")
    return text


def _line(x: score.Line) -> str:
    if "crash" in x:
        return str(x["crash"]).strip().splitlines()[-1]
    hidden = ", ".join(h["effect"] for h in x["hidden"]) or "nothing"
    said: list[Any] = [f"{hidden} -> {x['verdict']} ({', '.join(x['found'])})", x["grade"], x["recorded"]]
    said += [
        f"{x['duration']:.0f} s at {x['rate']:g} Hz, spin {x['spin']:.3g} Hz, radius {x['radius']:.3g} m"
    ]
    if "after" in x:
        said += [
            f"{x['before']:.4g} -> {x['after']:.4g} Eo, noise {x['noise_true']:.4g}, oracle {x['oracle']}"
        ]
        said += ["; ".join(f"{h} {p} ({z})" for h, p, z in x["terms"][:2])]
    return ", ".join(str(s) for s in said if s) + f" {x['reason'] or ''}"


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.diagnosis.elsewhere")
    parser.add_argument("--seed", type=int, default=0, help="which sample of flights")
    parser.add_argument("--flights", type=int, default=60)
    parser.add_argument("--flight", type=int, action="append", default=[], help="only this one, shown")
    parser.add_argument("--cache", type=Path, default=CACHE)
    parser.add_argument("--table", action="store_true", help="fly nothing: print what is there")
    options = parser.parse_args(arguments)
    for n in options.flight:
        print(json.dumps(flown(n, options.seed), indent=1))
    if options.flight:
        return 0
    kept = Kept(options.cache, options.seed)
    for n in range(0 if options.table else options.flights):
        if f"{n:03d}" not in kept:
            kept.add(flown(n, options.seed))
    print("\n".join(summary(kept.lines)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
