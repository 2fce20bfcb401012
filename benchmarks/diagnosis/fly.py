"""One flight: hide something in it, write its files, diagnose them as a user would. One JSON object."""

from __future__ import annotations

import signal
import tempfile
import time
import traceback
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np
from numpy.typing import NDArray

import ragg
from benchmarks.diagnosis import outside, plan, records
from benchmarks.diagnosis.outside import Outside, Surroundings
from benchmarks.diagnosis.plan import Spec, World
from benchmarks.diagnosis.records import CleanOutput, Loudness, Table
from benchmarks.diagnosis.strength import Hidden, Oracle
from benchmarks.sheet import model_text
from ragg_runtime.base.errors import UserError
from ragg_runtime.io.record import SI_UNITS
from ragg_runtime.reference.effects import EffectValues, resolve
from ragg_runtime.reference.effects.sensing import record_output
from ragg_runtime.reference.simulate import Simulation, combine
from ragg_runtime.signals.demodulators import low_pass
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]

LONGEST = 90.0
"""s of processor time for one flight; usual are three."""

TRIES = 60

STRONG = (300.0, 3000.0)


@dataclass(frozen=True)
class Prepared:
    """The columns of the file, and what is hidden in them."""

    world: World
    table: Table
    hidden: tuple[Hidden, ...]
    term: Outside | None
    oracle: Oracle | None


def fly(spec: Spec) -> dict[str, Any]:
    """The line of one flight; a crash is a result too."""
    begin, cpu = time.perf_counter(), time.process_time()
    found: dict[str, Any] = {"id": spec.id, "kind": spec.kind, "record": spec.record}
    try:
        with _limited(LONGEST):
            p = prepared(spec)
            found |= {
                "hidden": [h.as_json() for h in p.hidden],
                "outside": None if p.term is None else [p.term.name, p.term.with_mimics],
            }
            ready = time.process_time()
            found |= diagnosed(p)
            found["cpu"] = round(time.process_time() - ready, 2)
    except Exception:
        found["crash"] = traceback.format_exc()
    found["seconds"] = round(time.perf_counter() - begin, 2)
    return found | {"total_cpu": round(time.process_time() - cpu, 2)}


@contextmanager
def _limited(seconds: float) -> Iterator[None]:
    """Raise TimeoutError once this process has used so much time of its processor."""

    def stop(number: int, frame: FrameType | None) -> None:
        raise TimeoutError(f"no end after {seconds:g} s of processor time")

    old = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, old)


@lru_cache(maxsize=128)
def prepared(spec: Spec) -> Prepared:
    """The file of a flight."""
    w, kind = plan.world(spec), records.KINDS[spec.record]
    plain = _simulated(w, {})
    channels = _table(plain, plain.voltages_noise_free)
    noise_rms = kind.noise(channels, spec.rng(2))
    hidden: tuple[Hidden, ...] = ()
    term = oracle = None
    if spec.kind != "quiet":
        changed = kind.change(
            channels, CleanOutput(plain.G_out_noise_free, 1.0, w.scenario.rate), spec.rng(4)
        )
        lost = np.isnan(changed["G_out"])
        flight = plain.flight("plain", voltages=w.output == "voltages")
        oracle = Oracle(w, flight, noise_rms, lost, spec.catalogue)
        hidden = _hidden(spec, oracle)
        if spec.kind == "outside":
            term = outside.drawn(oracle, Surroundings(plain, w.scenario), outside.name_of(spec), 10.0)
    values = {h.effect: h.values for h in hidden}
    recorder = {e: values.pop(e) for e in ("output-curve", "quantisation", "saturation") if e in values}
    sim = _simulated(w, values) if values else plain
    return Prepared(w, _recorded(spec, w, sim, noise_rms, term, recorder), hidden, term, oracle)


def _simulated(w: World, effects: EffectValues) -> Simulation:
    return w.scenario.simulate(effects, record_gradient=w.gradient, start=w.start)


def _table(sim: Simulation, voltages: Array) -> Table:
    return {
        "time": sim.time,
        **{n: np.asarray(x) for n, x in sim.channels.items()},
        **{f"V_{j + 1}": v for j, v in enumerate(voltages)},
        "G_out": combine(voltages),
    }


def _recorded(
    spec: Spec,
    w: World,
    sim: Simulation,
    noise_rms: Loudness,
    term: Outside | None,
    recorder: Mapping[str, Any],
) -> Table:
    """What the recorder makes of a flight: noise, what the kind of its record is, and the outputs that are recorded."""
    s, i = w.scenario, w.scenario.instrument.accelerometers
    scale = (i["k_VI"] * i["K1"])[:, None]
    noise = scale * records.sampled(noise_rms, w.density, spec.rng(3), len(sim.time), s.rate)
    x = _table(sim, sim.voltages_noise_free + noise)
    if term is not None:
        x["G_out"] = x["G_out"] + term.change
        if w.output == "voltages":
            x["V_1"] = x["V_1"] + term.change
    if w.output != "voltages":
        x = {n: v for n, v in x.items() if not n.startswith("V_")}
    rms = float(np.std(combine(noise))) or 1e-12 * float(np.std(x["G_out"]))
    clean = x["G_out"] - combine(noise)
    x = records.KINDS[spec.record].change(x, CleanOutput(clean, rms, s.rate), spec.rng(4))
    x["G_out"] = record_output(x["G_out"], resolve(recorder))
    return _channels(w, x) if w.output == "channels" else x


def _channels(w: World, x: Table) -> Table:
    """Demodulated channels in the place of the output; at both ends the filter has not seen enough."""
    phi, low = 2 * np.pi * w.scenario.sheet.spin_frequency * x["time"], low_pass(w.scenario.rate)
    k, half, G = w.scenario.sheet.scale_factor, len(low) // 2, x.pop("G_out")
    made = {"inline": 4 * G * np.sin(2 * phi), "cross": -2 * G * np.cos(2 * phi)}
    ends = {"constant_values": np.nan}
    return x | {n: np.pad(convolve(v, low) / k, half, **ends) for n, v in made.items()}  # type: ignore[call-overload]


def _hidden(spec: Spec, o: Oracle) -> tuple[Hidden, ...]:
    rng = spec.rng(5)
    known = list(o.kinds)
    if spec.kind == "pair":
        return _pair(spec, o, rng)
    if spec.kind == "outside" or (spec.kind == "off-sheet" and spec.index % 3 == 2):
        return ()
    low, high = {"five": (5.0, 5.0), "ten": (10.0, 10.0), "strong": STRONG}.get(spec.kind, (10.0, 1000.0))
    strength = min(high, float(np.exp(rng.uniform(np.log(low), np.log(high)))))  # to rounding
    order = np.random.default_rng(list(plan.COUNTS).index(spec.kind)).permutation(len(known))
    place = spec.index + plan.COUNTS[spec.kind] * (spec.sample % 10)
    effect = known[order[place % len(known)]]  # in turn, in an order of each kind's own
    for _ in range(TRIES):
        h = o.drawn(effect, strength, rng)
        if h is not None:
            return (h,)
        effect = str(rng.choice(known))
    raise RuntimeError("no effect is testable on this flight")


def _pair(spec: Spec, o: Oracle, rng: np.random.Generator) -> tuple[Hidden, ...]:
    """Two effects, each of its strength beside the whole other one."""
    columns = [e for e, k in o.kinds.items() if k in ("deterministic", "step")]
    time = o.flight.time
    middle = float(time[0] + 0.4 * (time[-1] - time[0]))
    strong = 300.0 if spec.index % 2 else 10.0
    for _ in range(TRIES):
        first, second = (str(e) for e in rng.choice(columns, 2, replace=False))
        pair = (
            o.drawn(first, strong, rng, o.block(second, middle)),
            o.drawn(second, 10.0, rng, o.block(first, middle)),
        )
        if pair[0] is not None and pair[1] is not None:
            return pair[0], pair[1]
    raise RuntimeError("no two effects are testable on this flight")


def diagnosed(p: Prepared) -> dict[str, Any]:
    """What ``ragg diagnose`` says of sheet and flight in files."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        (place / "sheet.toml").write_text(model_text(p.world.scenario.sheet), "utf-8")
        records.write(p.table, SI_UNITS, place / "flight.parquet")
        try:
            m = ragg.new(place / "model", place / "sheet.toml")
            d = ragg.diagnose(m, ragg.read_flights(m, [place / "flight.parquet"])).as_json()
        except UserError as e:
            return {"verdict": "refused", "reason": str(e), "found": [], "ranking": [], "terms": []}
    return essence(d)


def essence(d: Mapping[str, Any]) -> dict[str, Any]:
    """What the scoring needs of the JSON of a diagnosis."""
    kept = [r for k, r in enumerate(d["ranking"]) if k < 6 or r["effect"] in d["found"]]
    return {
        "verdict": d["verdict"],
        "reason": d["remark"],
        "found": list(d["found"]),
        "ranking": [
            {
                "effect": r["effect"],
                "log10_p": r["log10_p"],
                "probability": r["probability"],
                "twins": list(r["indistinguishable_from"]),
            }
            for r in kept
        ],
        "probability": {
            r["effect"]: round(r["probability"], 4)
            for r in d["ranking"]
            if r["probability"] is not None and r["probability"] > 1e-3
        },
        "credible_set": [list(s) for s in d["credible_set"][:50]],
        "tested": d["tests"],
        "terms_log10_p": d["unexplained"]["log10_p"],
        "terms": [
            {n: t[n] for n in ("harmonic", "term", "kind")} | {"z": round(t["z"], 1)}
            for t in d["unexplained"]["terms"][:3]
        ],
        "before": d["error"]["before"]["rms_Eo"],
        "after": d["error"]["after"]["rms_Eo"],
        "noise_floor": d["noise_floor"]["rms_Eo"],
        "converged": d.get("converged", True),
    }
