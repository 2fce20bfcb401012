"""Records in which no effect is hidden, most of them awkward: how often is one named, or something left unexplained?

    python -m benchmarks.diagnosis.effect_free [--seed N] [--only KIND] [--flights N] [--cache FILE] [--table]

Every kind draws its own instruments, motions and disturbances; a flight is determined by the sample (``--seed``), the kind
and its number. Flights come from the independent simulator and pass through the examination that files pass through.
One process flies them one after the other. Scored, per flight:

- ``named``: an effect is claimed that is not what was done to the record (``ALLOWED``);
- ``unexplained``: so is the verdict, and no reason is given;
- ``constant``: an effect is named as a constant term at a multiple of the spin rate, and the reason says how far off it a line
  may be that would do as well: all that a record can say of a line nearer than that (kind ``line``);
- ``said``: the verdict is ``unexplained`` or the record is refused, and a reason says what is wrong with the record;
- of records in which nothing follows the motion (``NOTHING``): ``named`` if the verdict is not ``unexplained``.

Seeds, cases and scoring were committed before the changes that they judge, but for ``constant``, which was taken out of ``named``
when the diagnosis had learned to say so.
"""

from __future__ import annotations

import argparse
import sys
import time
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.diagnosis import awkward, score
from benchmarks.diagnosis.awkward import DURATION, RATE, Change
from benchmarks.diagnosis.kept import Kept
from ragg_runtime.base.errors import UserError
from ragg_runtime.diagnosis import diagnose
from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.flight import Flight, read_flight
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model import model as load
from ragg_runtime.model_dir import derive
from ragg_runtime.reference.motion import recorded_motion
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.workflow.loaded import as_read

Array = NDArray[np.float64]

RECORD = Path(__file__).parents[2] / "examples" / "demo-flight.parquet"
"""A flight whose motion channels are flown again, as a record."""

ROOT = Path(__file__).resolve().parents[2]
CACHE = ROOT / "build" / "bench-effect-free.jsonl"

PER_KIND = 20


@dataclass(frozen=True)
class World:
    """What a kind flies: options of ``scenario``, and whether the gradient is recorded."""

    duration: float = DURATION
    red_corner: float | None = None
    gradient_rms: float = 0.0
    record_gradient: bool = True
    noise_density: float = 2e-9
    recorded: bool = False
    shape: str | None = None


@dataclass(frozen=True)
class Kind:
    """What is flown, and what is done to the record."""

    change: Change = awkward.nothing
    world: World = World()
    clock: tuple[float, float] | None = None
    """Range of the logarithm (base 10) of the true spin rate's relative error."""


KINDS: Mapping[str, Kind] = {
    "white-20s": Kind(world=World(duration=20.0)),
    "white-60s": Kind(world=World(duration=60.0)),
    "white-90s": Kind(world=World(duration=90.0)),
    "white-300s": Kind(),
    "red-60s": Kind(world=World(duration=60.0, red_corner=0.1)),
    "red": Kind(world=World(red_corner=0.1)),
    "unknown-gradient": Kind(world=World(gradient_rms=20e-9, record_gradient=False)),
    "unknown-gradient-90s": Kind(world=World(duration=90.0, gradient_rms=20e-9, record_gradient=False)),
    "heavy-tails": Kind(awkward.heavy),
    "level-tenfold": Kind(awkward.level),
    "ramp": Kind(awkward.ramp),
    "step": Kind(awkward.step),
    "mains": Kind(awkward.mains),
    "bursts": Kind(awkward.bursts),
    "coarse": Kind(awkward.coarse),
    "gaps": Kind(awkward.gaps),
    "rough-gaps": Kind(awkward.rough_gaps),
    "clock-50ppm": Kind(awkward.clock, clock=(np.log10(50e-6), np.log10(50e-6))),
    "spin-ppb": Kind(awkward.clock, clock=(-8.5, -7.0)),
    "follows-ax": Kind(awkward.follows),
    "cyclic": Kind(awkward.cyclic),
    "line": Kind(awkward.line),
    "recorded": Kind(world=World(recorded=True)),
    "recorded-noisy": Kind(awkward.sensors, World(recorded=True)),
    "noisy-motion": Kind(awkward.sensors),
    "no-omegadot": Kind(awkward.without_omegadot),
    "digits": Kind(awkward.digits),
    "quiet-1e-4": Kind(awkward.digits, World(noise_density=2e-13)),
    "noiseless": Kind(awkward.digits, World(noise_density=0.0)),
    "shuffled": Kind(awkward.shuffled),
    "pure-noise": Kind(awkward.pure_noise),
}

ALLOWED: Mapping[str, frozenset[str]] = {
    "clock-50ppm": frozenset({"spin-rate-offset"}),
    "spin-ppb": frozenset({"spin-rate-offset"}),
    "coarse": frozenset({"quantisation"}),
    "digits": frozenset({"quantisation"}),
    "quiet-1e-4": frozenset({"quantisation"}),
    "noiseless": frozenset({"quantisation"}),
}
"""What is really there."""

NOTHING = ("shuffled", "pure-noise")
"""Kinds in which nothing follows the motion: adequate is wrong."""


def _spun(i: Instrument, f: float) -> Instrument:
    """An instrument of the paper's layout whose disc turns at f Hz."""
    return Instrument.build(radius=i.radius, spin_frequency=f, g0=i.g0, accelerometers=i.accelerometers)


def drawn(kind: str, index: int, sample: int) -> tuple[Scenario, Flight]:
    """The flight of this kind and number, as recorded, and its world."""
    k = KINDS[kind]
    seed = 90_000_000 + 1_000_000 * sample + 10_000 * list(KINDS).index(kind) + index
    rng = np.random.default_rng([seed, 77])
    w = k.world
    s = scenario(
        seed,
        trim="table-v" if index % 2 else "matched",
        duration=w.duration,
        rate=RATE,
        shape=w.shape,
        noise_density=w.noise_density,
        red_corner=w.red_corner,
        gradient_rms=w.gradient_rms,
    )
    if w.recorded:
        x = read_flight(RECORD, 9.8)
        a, omega = (np.stack([x.channels[f"{q}_{c}"] for c in "xyz"]) for q in ("a", "omega"))
        start = x.time[0] + 1.0 + (x.time[-1] - x.time[0] - w.duration - 2.0) * rng.random()
        s = replace(s, motion=recorded_motion(x.time - start, a, omega))
    if k.clock is not None:
        off = float(rng.choice([-1.0, 1.0])) * 10 ** rng.uniform(*k.clock)
        s = replace(s, instrument=_spun(s.instrument, s.instrument.spin_frequency * (1 + off)))
    sim = s.simulate(record_gradient=w.record_gradient)
    return s, k.change(sim.flight(f"{kind}/{index:03d}"), sim, rng)


def flown(kind: str, index: int, sample: int) -> dict[str, object]:
    """The record of one flight; a crash is a result too."""
    begin = time.perf_counter()
    try:
        found = _flown(*drawn(kind, index, sample))
    except UserError as e:
        found = {"verdict": "refused", "reason": str(e), "found": [], "ranking": [], "terms": []}
    except Exception:
        found = {"crash": traceback.format_exc()}
    seconds = round(time.perf_counter() - begin, 2)
    return {"id": f"{kind}/{index:03d}", "kind": kind, "seconds": seconds} | found


def _flown(s: Scenario, flight: Flight) -> dict[str, object]:
    model = load.packaged()
    x = as_read(model, s.sheet, flight)
    d: Diagnosis = diagnose.diagnose(
        model, s.sheet, [x], lambda m, ids, **k: derive.with_effects(s.sheet, m, ids, **k)
    )
    return {
        "verdict": d.verdict,
        "reason": d.as_json()["reason"],
        "found": list(d.found),
        "groups": [g.as_json() for g in d.groups],
        "ranking": [
            {"effect": r.effect, "log_p": max(r.log_p, -1e4), "twins": list(r.indistinguishable_from)}
            for r in d.ranking[:4]
        ],
        "remainder_log_p": d.remainder.log_p,
        "terms": [
            [t.term.harmonic, t.term.product, round(t.z, 2), t.how]
            for q in d.remainder.searches
            for t in q.terms
        ],
        "after": d.after.rms_Eo,
        "noise_floor": d.noise_floor,
    }


def judged(x: score.Line) -> str:
    """``right``, ``named``, ``constant``, ``unexplained``, ``said`` or ``crash``."""
    if "crash" in x:
        return "crash"
    if x["kind"] in NOTHING:
        return "right" if x["verdict"] in ("unexplained", "refused") else "named"
    allowed = ALLOWED.get(x["kind"], frozenset())
    if any(not (score.group(x, e) & allowed) for e in x["found"]):
        groups = x.get("groups", [])
        only_constant = (
            bool(groups) and all(g["name"] for g in groups) and "; a line within" in str(x["reason"])
        )
        return "constant" if only_constant and x["kind"] == "line" else "named"
    if x["verdict"] in ("unexplained", "refused"):
        return "said" if x["reason"] else "unexplained"
    return "right"


def summary(lines: Sequence[score.Line]) -> list[str]:
    """One line a kind, then the flights that were not right."""
    outcomes = ("right", "named", "constant", "unexplained", "said", "crash")
    text = [f"{'kind':22}" + "".join(f"{o:>12}" for o in outcomes) + f"{'s':>7}"]
    total = dict.fromkeys(outcomes, 0)
    for kind in KINDS:
        own = [x for x in lines if x["kind"] == kind]
        if not own:
            continue
        counts = {o: sum(judged(x) == o for x in own) for o in outcomes}
        total = {o: total[o] + counts[o] for o in outcomes}
        seconds = float(np.median([x["seconds"] for x in own]))
        text.append(f"{kind:22}" + "".join(f"{counts[o]:>12}" for o in outcomes) + f"{seconds:>7.1f}")
    text.append(f"{'all':22}" + "".join(f"{total[o]:>12}" for o in outcomes))
    for x in sorted(lines, key=lambda x: x["id"]):
        if (how := judged(x)) == "crash":
            text.append(f"{x['id']}: crash: {x['crash'].strip().splitlines()[-1]}")
        elif how != "right":
            terms = "; ".join(f"{h} {p} ({z:.3g}{', ' + q if q else ''})" for h, p, z, q in x["terms"][:2])
            text.append(
                f"{x['id']}: {x['verdict']} ({', '.join(x['found'])}) {terms} {x['reason'] or ''}".rstrip()
            )
    return text


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.diagnosis.effect_free")
    parser.add_argument("--seed", type=int, default=0, help="which sample of flights")
    parser.add_argument("--only", action="append", choices=list(KINDS), help="kinds (default: all)")
    parser.add_argument("--flights", type=int, default=PER_KIND, help="of each kind")
    parser.add_argument("--cache", type=Path, default=CACHE)
    parser.add_argument("--table", action="store_true", help="fly nothing: print what is there")
    options = parser.parse_args(arguments)
    kept = Kept(options.cache, options.seed)
    for n in range(0 if options.table else options.flights):
        for k in options.only or KINDS:  # the kinds in turn
            if f"{k}/{n:03d}" not in kept:
                kept.add(flown(k, n, options.seed))
    print("\n".join(summary(kept.lines)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
