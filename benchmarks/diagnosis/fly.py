"""One flight: hide something in it, diagnose it, add what was found, ask the peers. One JSON object."""

from __future__ import annotations

import signal
import time
import traceback
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from types import FrameType, MappingProxyType

import numpy as np
from numpy.typing import NDArray

from benchmarks.diagnosis import inject, outside, peers
from benchmarks.diagnosis.inject import Bench, Hidden
from benchmarks.diagnosis.plan import STRENGTH, Spec, scenario_of
from ragg_runtime.diagnosis import diagnose
from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.fit import fitted as fitted_
from ragg_runtime.fit import observation
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.flight import Flight
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.model import model as load
from ragg_runtime.model.evaluate import output, vector
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import record
from ragg_runtime.model_dir import derive
from ragg_runtime.reference.scenario import Scenario
from ragg_runtime.reference.simulate import Simulation

Array = NDArray[np.float64]

_SENSORS = {"a": 1e-6, "omega": 1e-7, "omegadot": 1e-6}
"""White noise of the motion record, SI, before it is scaled to the error that it is to cause."""

_TRIES = 60

LONGEST = 60.0
"""s of processor time for one flight; usual are three."""


def fly(spec: Spec) -> dict[str, object]:
    """The record of one flight; a crash is a result too."""
    begin = time.perf_counter()
    try:
        with _limited(LONGEST):
            found = _flown(spec)
    except Exception:
        found = {"crash": traceback.format_exc()}
    return found | {"total_seconds": round(time.perf_counter() - begin, 2)}


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


@dataclass(frozen=True)
class Prepared:
    """A flight ready to be diagnosed, and what is hidden in it."""

    scenario: Scenario
    simulation: Simulation
    flight: Flight
    hidden: tuple[Hidden, ...]
    untestable: tuple[str, ...]
    term: outside.Outside | None
    bench: Bench

    @cached_property
    def noise_Eo(self) -> float:
        """rms of the noise that was added, the motion record's left out, Eo."""
        e = self.simulation.G_out - self.simulation.G_out_noise_free
        return float(np.std(e)) / self.bench.fitted.k_ggi


def _flown(spec: Spec) -> dict[str, object]:
    p = prepared(spec)
    model, sheet = load.packaged(), p.scenario.sheet
    begin = time.perf_counter()
    d = diagnose.diagnose(
        model, sheet, [p.flight], lambda m, ids, **k: derive.with_effects(sheet, m, ids, **k)
    )
    seconds = time.perf_counter() - begin
    c = peers.columns(d.fitted)
    return {
        "hidden": [
            h.as_json() | {"twins": inject.twins(p.bench, h), "kind": _kind(model, h.effect)}
            for h in p.hidden
        ],
        "untestable": list(p.untestable),
        "outside": None
        if p.term is None
        else {
            "name": p.term.name,
            "factor": p.term.factor,
            "strength": p.term.strength,
            "strength_with_mimics": p.term.strength_with_mimics,
        },
        "verdict": d.verdict,
        "found": list(d.found),
        "ranking": [
            {"effect": r.effect, "log_p": max(r.log_p, -1e4), "twins": list(r.indistinguishable_from)}
            for r in d.ranking[:6]
        ],
        "tested": len(d.ranking),
        "remainder_log_p": d.remainder.log_p,
        "terms": [
            [t.term.harmonic, t.term.product, round(t.z, 2)] for s in d.remainder.searches for t in s.terms
        ],
        "seconds": round(seconds, 3),
        "noise_floor": d.noise_floor,
        "noise_true": p.noise_Eo,
        "errors": _errors(p, d) if spec.kind != "outside" else None,
        "peers": peers.claims(c),
        "peer_columns": [len(c.y), len(c.effects)],
    }


def _kind(model: Model, effect: str) -> str:
    return next(e.kind for e in model.candidates if e.id == effect)


def prepared(spec: Spec) -> Prepared:
    """Fly a spec: first without any effect, to measure strengths on, then with what it is to hide."""
    s = scenario_of(spec)
    plain = s.simulate(record_gradient=spec.gradient[1] == "recorded")
    flight = _with_sensor_noise(spec, s, plain)
    model = load.packaged()
    bench = Bench(fitted_.fit(model, s.sheet, [observation.observe(flight, s.sheet)]), plain)
    hidden: tuple[Hidden, ...] = ()
    untestable: tuple[str, ...] = ()
    term = None
    sim = plain
    if spec.kind.startswith("single"):
        hidden, untestable = _one(spec, bench)
    elif spec.kind == "two":
        hidden, untestable = _two(spec, bench)
    if hidden:
        values = {h.effect: h.values for h in hidden}
        sim = s.simulate(values, record_gradient=spec.gradient[1] == "recorded")
        flight = _with_sensor_noise(spec, s, sim)
    if spec.kind == "outside":
        r = bench.piece.observation.record
        phi = np.arctan2(r.sin_phi, r.cos_phi)
        name = outside.NAMES[spec.index % len(outside.NAMES)]
        term = outside.drawn(bench, s, name, STRENGTH[spec.kind], phi)
        flight = replace(flight, outputs={"G_out": flight.outputs["G_out"] + term.change})
    return Prepared(s, sim, flight, hidden, untestable, term, bench)


def _with_sensor_noise(spec: Spec, s: Scenario, sim: Simulation) -> Flight:
    """The flight as recorded: white noise on the motion channels, sized by the error that it causes."""
    flight = sim.flight(spec.id)
    if not spec.sensor_noise or s.noise is None:
        return flight
    rng = spec.rng(2)
    noisy = dict(flight.channels)
    noise = {
        f"{q}_{k}": sigma * rng.standard_normal(len(flight.time))
        for q, sigma in _SENSORS.items()
        for k in "xyz"
    }
    model = load.packaged()
    p = vector(model, s.instrument)

    def G(factor: float) -> Array:
        channels = noisy | {n: noisy[n] + factor * e for n, e in noise.items()}
        return output(model.chain, record(replace(flight, channels=channels), s.sheet), p)

    wanted = spec.sensor_noise * float(np.std(sim.G_out - sim.G_out_noise_free))
    factor = wanted / float(np.std(G(1.0) - G(0.0)))
    return replace(flight, channels=noisy | {n: noisy[n] + factor * e for n, e in noise.items()})


def _effects(bench: Bench) -> list[str]:
    return [e.id for e in bench.fitted.model.candidates]


def _one(spec: Spec, bench: Bench) -> tuple[tuple[Hidden, ...], tuple[str, ...]]:
    """The effect whose turn it is, or, where the flight cannot show it, another one drawn at random."""
    rng = spec.rng(1)
    known = _effects(bench)
    untestable: list[str] = []
    effect = known[spec.index % len(known)]
    for _ in range(_TRIES):
        if (h := inject.drawn(bench, effect, STRENGTH[spec.kind], rng)) is not None:
            return (h,), tuple(untestable)
        untestable.append(effect)
        effect = str(rng.choice([e for e in known if e not in untestable]))
    raise RuntimeError("no effect is testable on this flight")


def _two(spec: Spec, bench: Bench) -> tuple[tuple[Hidden, ...], tuple[str, ...]]:
    """Two effects, each of the full strength beside the whole other; an error of the motion record in a third."""
    rng = spec.rng(1)
    kinds = {e.id: e.kind for e in bench.fitted.model.candidates}
    known = [e for e, k in kinds.items() if k in ("deterministic", "step")]
    strength = STRENGTH[spec.kind]
    untestable: list[str] = []
    for _ in range(_TRIES):
        first = str(rng.choice(inject.MOTION_RECORD if spec.index % 3 == 0 else known))
        second = str(rng.choice([e for e in known if e != first]))
        instants = {e: float(bench.piece.observation.record.time[-1] * 0.4) for e in (first, second)}
        pair = [
            inject.drawn(bench, e, strength, rng, bench.block(o, instants[o] if kinds[o] == "step" else None))
            for e, o in ((first, second), (second, first))
        ]
        if pair[0] is not None and pair[1] is not None:
            return (pair[0], pair[1]), tuple(untestable)
        untestable.append(f"{first} + {second}")
    raise RuntimeError("no two effects are testable on this flight")


def _errors(p: Prepared, d: Diagnosis) -> dict[str, object]:
    """Error after adding what was found, and after adding what was hidden, Eo: calibrated and held out."""
    model, sheet = load.packaged(), p.scenario.sheet
    steps = {h.effect: h.instant for h in p.hidden if h.instant is not None}
    estimated = {
        r.effect: q.value
        for r in d.ranking
        for q in r.parameters
        if q.name == "t_step" and r.effect in d.found
    }

    def fitted(ids: Sequence[str], instants: Mapping[str, float]) -> tuple[float, float]:
        ids = [e for e in ids if _kind(model, e) in ("deterministic", "step")]
        instrument = _with_instants(sheet, {e: t for e, t in instants.items() if e in ids})
        extended = derive.with_effects(sheet, model, ids) if ids else _plain(model)
        return scored(fitted_.fit(extended, instrument, d.fitted.observations))

    oracle = fitted([h.effect for h in p.hidden], steps)
    same = set(d.found) == {h.effect for h in p.hidden} and not steps
    tool = oracle if same else fitted(d.found, estimated)
    before = scored(d.fitted)
    return {"before": before, "tool": tool, "oracle": oracle}


def _plain(model: Model) -> Model:
    """The model without candidates, as those with effects added come."""
    return replace(model, candidates=(), signatures=model.chain)


def _with_instants(sheet: Instrument, instants: Mapping[str, float]) -> Instrument:
    settings = tuple(
        EffectSetting(e, MappingProxyType({"t_step": RawQuantity(t, "s")})) for e, t in instants.items()
    )
    return replace(sheet, effects=settings)


def scored(f: Fitted) -> tuple[float, float]:
    """rms error, Eo, of a fitted model: calibrated, and on the blocks of time that a fit left out."""
    half, _ = f.coefficients((), held_out=True)
    calibrated, held_out = f.score([np.zeros(f.size), f.vector(half)])
    return calibrated.whole.rms_Eo, held_out.held_out.rms_Eo
