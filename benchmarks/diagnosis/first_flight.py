"""First flights of a real instrument, in which everything is missing at once: is the right effect named?

    python -m benchmarks.diagnosis.first_flight [--seed N] [--flights N] [--flight K] [--table]

Every flight draws how far the instrument is off its sheet (``sheet``: as usual, ``coarse``: ten times as far, ``first``: per cent,
millimetres, milliradians and milli-g, every kind of parameter by a factor of its own), whether the sheet states these sigmas,
none to two effects of 10 to 1,000 sigma or plausible size, and the record: length, rate, gaps, a line beside the multiples of the spin
rate, noise (red, growing), gradient. Strengths are measured without effects and with the true instrument for a sheet; so are the
oracle's (``oracle``), whose error has the true effects in the model. Plan and scoring were committed before any code they judge.

- ``right``: all that is hidden is named, itself or in its group, and nothing else; nothing hidden: nothing named;
- ``silent``: what is missing of the names an oracle does not see either; ``missed``: it does;
- ``extra``: all is named, and more; ``wrong``: something else is named; ``said``: ``unexplained`` or refused with a reason,
  ``unexplained``: without; ``unconverged``: the fit has not arrived; ``crash``.

A flight with a line and no effect is ``right`` as ``adequate`` and ``said`` as ``unexplained``: both say the line.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
import traceback
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.diagnosis import awkward, fly, oracle, score, strong
from benchmarks.diagnosis.inject import Bench, Hidden
from benchmarks.diagnosis.kept import Kept
from ragg_runtime.base.errors import UserError
from ragg_runtime.diagnosis import diagnose
from ragg_runtime.fit import fitted, observation
from ragg_runtime.flight import Flight
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model import model as load
from ragg_runtime.model_dir import derive
from ragg_runtime.reference.instruments import perturbed
from ragg_runtime.reference.scenario import Scenario, scenario

Array = NDArray[np.float64]

CACHE = Path(__file__).resolve().parents[2] / "build" / "bench-first-flight.jsonl"

MOST = 8_000
"""Samples of the longest flight."""

FIRST = {
    "dR": 1e-3,
    "beta_x": 5e-3,
    "beta_z": 5e-3,
    "vartheta_y": 5e-3,
    "vartheta_z": 5e-3,
    "K0": 0.05,
    "K1": 0.02,
    **{f"K{k}": 1e-5 for k in (2, 4, 5, 6, 7, 8)},
}
"""How far it may be off its sheet, SI (K1: of its value): 1 mm, 5 mrad, 5 mg, 2 %, 100 ug/g^2."""


@dataclass(frozen=True)
class World:
    """One flight; ``true`` is its scenario with the true instrument, as sure as the class is, for a sheet."""

    scenario: Scenario
    true: Scenario
    grade: str
    stated: bool
    line: float | None
    gaps: bool
    ramp: bool
    gradient: bool


def world(index: int, sample: int) -> World:
    """The flight of this number."""
    seed = 810_000_000 + 100_000 * sample + index
    rng = np.random.default_rng([seed, 5])
    grade = ("sheet", "coarse", "first")[int(rng.choice(3, p=[0.15, 0.2, 0.65]))]
    rate = float(rng.choice([4.0, 16.0, 100.0]))
    longest = min(3600.0, MOST / rate)
    duration = float(np.exp(rng.uniform(np.log(min(300.0, longest)), np.log(longest))))
    s = scenario(
        seed,
        trim="matched" if rng.random() < 0.5 else "table-v",
        duration=duration,
        rate=rate,
        noise_density=float(10 ** rng.uniform(-9.0, -7.5)),
        red_corner=(None, 0.05, 0.2)[int(rng.integers(3))],
        gradient_rms=20e-9 if rng.random() < 0.5 else 0.0,
    )
    stated = grade == "first" and bool(rng.random() < 0.3)
    sigma = {
        n: x
        * 10 ** rng.uniform(-0.5, 0.2)
        * (np.abs(s.sheet.accelerometers["K1"]) if n == "K1" else np.ones(4))
        for n, x in FIRST.items()
    }
    true = perturbed(s.sheet, rng, 10.0 if grade == "coarse" else 1.0)
    if grade == "first":
        true = s.sheet.replace(
            **{n: s.sheet.accelerometers[n] + x * rng.standard_normal(4) for n, x in sigma.items()}
        )
    said = {n: (np.maximum(x, s.sheet.sigma(n))) for n, x in sigma.items()}
    known = _stating(true, said) if grade == "first" else true
    return World(
        scenario=replace(s, sheet=_stating(s.sheet, said) if stated else s.sheet, instrument=true),
        true=replace(s, sheet=known, instrument=true),
        grade=grade,
        stated=stated,
        line=float(rng.uniform(0.06, 0.45) * rate) if rng.random() < 0.35 else None,
        gaps=bool(rng.random() < 0.35),
        ramp=bool(rng.random() < 0.15),
        gradient=bool(rng.random() < 0.6),
    )


def _stating(sheet: Instrument, sigmas: dict[str, Array]) -> Instrument:
    return replace(sheet, sigmas=sigmas)


def hidden_in(w: World, bench: Bench, rng: np.random.Generator) -> tuple[Hidden, ...]:
    """None to two effects; fewer where the flight cannot show what is drawn."""
    kinds = {e.id: e.kind for e in bench.fitted.model.candidates}
    columns = [e for e, k in kinds.items() if k in oracle.MODELLED and e not in strong.PHYSICAL]
    wanted = int(rng.choice([0, 1, 1, 2, 2, 2]))
    found: list[Hidden] = []
    end = w.scenario.duration * 0.4
    for _ in range(60):
        if wanted == len(found):
            break
        first, second = (str(e) for e in rng.choice(columns, 2, replace=False))
        beside = bench.block(second, end if kinds[second] == "step" else None)
        if wanted == 1 and rng.random() < 0.3:
            found = list(strong.plausible(bench, first, rng))
            continue
        h = strong.drawn(
            bench, first, float(10 ** rng.uniform(1.0, 3.0)), rng, beside if wanted == 2 else None
        )
        if h is None or strong._late(h):
            continue
        if wanted == 2:
            beside = bench.block(first, h.instant)
            other = strong.drawn(bench, second, float(10 ** rng.uniform(1.0, 3.0)), rng, beside)
            found = [] if other is None or strong._late(other) else [h, other]
        else:
            found = [h]
    return tuple(found)


def recorded(w: World, x: Flight, noise: Array, rng: np.random.Generator) -> Flight:
    """What the recorder makes of the output and its noise (N,), V."""
    e = noise * np.linspace(1.0, rng.uniform(2.0, 5.0), len(x)) if w.ramp else noise
    if w.line is not None:
        size = np.sqrt(2.0) * float(np.std(noise)) * 10 ** rng.uniform(-0.5, 1.0)
        e = e + size * np.cos(2 * np.pi * w.line * x.time + rng.uniform(0, 6))
    x = replace(x, outputs={"G_out": x.outputs["G_out"] - noise + e})
    return awkward.gaps(x, None, rng) if w.gaps else x  # type: ignore[arg-type]


def flown(index: int, sample: int) -> dict[str, object]:
    """The record of one flight; a crash is a result too."""
    begin = time.perf_counter()
    found: dict[str, object] = {}
    try:
        w = world(index, sample)
        s = w.scenario
        found = {
            "grade": w.grade,
            "stated": w.stated,
            "line": w.line,
            "gaps": w.gaps,
            "ramp": w.ramp,
            "gradient": w.gradient,
            "duration": s.duration,
            "rate": s.rate,
        }
        found |= _flown(w, f"{index:03d}")
    except UserError as e:
        found |= {
            "verdict": "refused",
            "reason": str(e),
            "found": [],
            "ranking": [],
            "converged": True,
            "terms": [],
        }
    except Exception:
        found |= {"crash": traceback.format_exc()}
    return (
        {"id": f"{index:03d}", "kind": "first"} | found | {"seconds": round(time.perf_counter() - begin, 1)}
    )


def prepared(w: World, name: str) -> fly.Prepared:
    """The flight as recorded, what is hidden in it, and the world of the oracle."""
    model, s = load.packaged(), w.scenario
    rng = np.random.default_rng([s.seed, 6])
    plain = s.simulate(record_gradient=w.gradient)
    truth = observation.observe(plain.flight(name), w.true.sheet)
    bench = Bench(fitted.fit(model, w.true.sheet, [truth]), plain)
    hidden = hidden_in(w, bench, rng)
    sim = s.simulate({h.effect: h.values for h in hidden}, record_gradient=w.gradient) if hidden else plain
    x = recorded(w, sim.flight(name), sim.G_out - sim.G_out_noise_free, rng)
    return fly.Prepared(w.true, sim, x, hidden, (), None, bench)


def _flown(w: World, name: str) -> dict[str, object]:
    p, sheet = prepared(w, name), w.scenario.sheet
    hidden: dict[str, object] = {"hidden": [h.as_json() for h in p.hidden]}
    begin = time.perf_counter()
    try:
        d = diagnose.diagnose(
            load.packaged(), sheet, [p.flight], lambda m, ids, **k: derive.with_effects(sheet, m, ids, **k)
        )
    except UserError as e:
        return hidden | {
            "verdict": "refused",
            "reason": str(e),
            "found": [],
            "ranking": [],
            "converged": True,
            "terms": [],
        }
    return hidden | {
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
            [t.term.harmonic, t.term.product, round(t.z, 2), t.how]
            for q in d.remainder.searches
            for t in q.terms
        ],
        "before": d.before.rms_Eo,
        "after": d.after.rms_Eo,
        "noise_floor": d.noise_floor,
        "oracle_after": _oracle_error(p),
        "oracle": oracle.seen(p),
        "diagnosis_seconds": round(time.perf_counter() - begin, 1),
    }


def _oracle_error(p: fly.Prepared) -> float:
    """rms, Eo, with what is hidden in the model, and the true instrument for a sheet."""
    sheet = fly._with_instants(
        p.scenario.sheet, {h.effect: h.instant for h in p.hidden if h.instant is not None}
    )
    ids, model = [h.effect for h in p.hidden], load.packaged()
    model = derive.with_effects(sheet, model, ids) if ids else fly._plain(model)
    return fly.scored(fitted.fit(model, sheet, [observation.observe(p.flight, sheet)]))[0]


def judged(x: score.Line) -> str:
    """One of :data:`OUTCOMES`."""
    if "crash" in x:
        return "crash"
    truth = {h["effect"] for h in x["hidden"]}
    if not x["converged"]:
        return "unconverged"
    if x["verdict"] in ("unexplained", "refused"):
        return "said" if x["reason"] else "unexplained"
    if score.exactly_both(x):
        return "right"
    if score.both(x):
        return "extra"
    if any(not score.group(x, e) & truth for e in x["found"]):
        return "wrong"
    named = score.claimed(x)
    catalogue = len(load.packaged().candidates)
    lost = [g for h, g in zip(x["hidden"], x["oracle"], strict=True) if h["effect"] not in named]
    return "missed" if any(oracle.detectable({"oracle": [g]}, catalogue) for g in lost) else "silent"


OUTCOMES = ("right", "silent", "said", "unexplained", "unconverged", "missed", "extra", "wrong", "crash")


def summary(lines: Sequence[score.Line]) -> list[str]:
    """Counts, by how far the instrument is off its sheet, then the flights that were not right."""
    text = [f"{'':16}" + "".join(f"{o:>12}" for o in OUTCOMES) + f"{'rms <= 1.02':>14}"]
    for grade, stated in (("sheet", False), ("coarse", False), ("first", True), ("first", False)):
        own = [x for x in lines if (x.get("grade"), x.get("stated")) == (grade, stated)]
        how = [judged(x) for x in own]
        down = sum(x.get("after", np.inf) <= 1.02 * x.get("oracle_after", 0.0) for x in own)
        name = grade + (", stated" if stated else "")
        text.append(
            f"{name:16}" + "".join(f"{how.count(o):>12}" for o in OUTCOMES) + f"{down:>7} of {len(own)}"
        )
    return text + [_line(x) for x in sorted(lines, key=lambda x: x["id"]) if judged(x) != "right"]


def _line(x: score.Line) -> str:
    if "crash" in x:
        return f"{x['id']}: crash: " + str(x["crash"]).strip().splitlines()[-1]
    hidden = " + ".join(f"{h['effect']} ({h['strength']:.3g})" for h in x["hidden"]) or "nothing"
    told = [n for n in ("stated", "gaps", "ramp", "gradient") if x[n]]
    told += [] if x["line"] is None else [f"line {x['line']:.4g} Hz"]
    said = f"{x['id']}: {judged(x)}: {hidden} -> {x['verdict']} ({', '.join(x['found'])}), {x['grade']}, {' '.join(told)}"
    said += f", {x['duration']:.0f} s at {x['rate']:g} Hz"
    if "after" in x:
        said += f", {x['before']:.4g} -> {x['after']:.4g} Eo, oracle {x['oracle_after']:.4g}, ranked "
        said += " ".join(r["effect"] for r in x["ranking"][:3])
        said += ", left " + "; ".join(
            f"{h} {p} ({z:.3g}{', ' + q if q else ''})" for h, p, z, q in x["terms"][:2]
        )
    return f"{said} {x['reason'] or ''}"


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.diagnosis.first_flight")
    parser.add_argument("--seed", type=int, default=0, help="which sample of flights")
    parser.add_argument("--flights", type=int, default=40)
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
