"""One flight: hide something in it, write its files, diagnose them as a user would. One JSON object.

What is hidden is an effect or two, or physics that no effect of the catalogue can make: further terms of V_1, the recorder, a
suspension. Each such term is a specific force in the first accelerometer up to a factor, which is chosen so that what *neither the
calibration nor any combination of catalogue effects* can absorb has the strength asked for. (What a catalogue effect could mimic comes on
top.)
"""

from __future__ import annotations

import signal
import tempfile
import time
import traceback
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import scipy.signal
from numpy.typing import NDArray

import ragg
from benchmarks.diagnosis import plan, records
from benchmarks.diagnosis.oracle import Hidden, Oracle, weigh
from benchmarks.diagnosis.plan import COUNTS, Spec, World
from benchmarks.diagnosis.records import QUARTERS, CleanOutput, Loudness, Table
from ragg_runtime.base.errors import UserError
from ragg_runtime.io.files import write_tables
from ragg_runtime.io.record import SI_UNITS
from ragg_runtime.io.tables import DataColumn, DataTable
from ragg_runtime.reference.effects import EffectValues, resolve
from ragg_runtime.reference.effects.sensing import record_output
from ragg_runtime.reference.scenario import Scenario
from ragg_runtime.reference.simulate import Simulation, combine
from ragg_runtime.signals.demodulators import low_pass
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]

LONGEST = 90.0  # s of processor time for one flight; usual are three
TRIES = 60
PROBABLE = 1e-3  # probability above which an effect counts in the table of probabilities

STRONG = (300.0, 3000.0)

# --- physics outside the catalogue -----------------------------------------------------------------------


class Surroundings:
    """What a term may depend on: channels and other series (N,), forces (4, N) along the accelerometers' tangential and radial axes."""

    def __init__(self, plain: Simulation, scenario: Scenario) -> None:
        self.channels, self.time, self.output = plain.channels, plain.time, plain.G_out_noise_free
        self.rate, self.duration = scenario.rate, scenario.duration
        self.phi = 2 * np.pi * scenario.sheet.spin_frequency * self.time
        psi = self.phi[None] + QUARTERS[:, None]
        self.f_i = self["a_y"] * np.cos(psi) - self["a_x"] * np.sin(psi)
        self.f_o = self["a_x"] * np.cos(psi) + self["a_y"] * np.sin(psi)

    def __getitem__(self, name: str) -> Array:
        return self.channels[name]

    def change(self, name: str) -> Array:
        """A channel less its mean."""
        return np.asarray(self[name] - np.mean(self[name]))


def _creep(x: Array, rate: float, constant: float) -> Array:
    """x through a relaxation of some time constant, s."""
    c = np.exp(-1 / (rate * constant))
    return np.asarray(scipy.signal.lfilter([1 - c], [1, -c], x))


def _rms(x: Array) -> float:
    return float(np.sqrt(np.mean(x**2)))


def _play(x: Array, width: float) -> Array:
    """Hysteresis: what a part with so much play follows of x."""
    y = np.empty_like(x)
    state = 0.0
    for n, value in enumerate(x):
        state = min(max(state, value - width), value + width)
        y[n] = state
    return y


def _resonant(x: Array, rate: float, frequency: float, damping: float) -> Array:
    """What a suspension with this resonance makes of x, less x; in the limit of fine sampling."""
    w, fine = 2 * np.pi * frequency, 8
    y = scipy.signal.resample_poly(x - x[0], fine, 1)
    b, a = scipy.signal.bilinear([w**2], [1.0, 2 * damping * w, w**2], fs=rate * fine)
    return np.asarray(scipy.signal.lfilter(b, a, y)[::fine] - (x - x[0]))


def _late(x: Array, rate: float, delay: float) -> Array:
    """x some time ago, s."""
    time = np.arange(len(x)) / rate
    return np.asarray(np.interp(time - delay, time, x))


TERMS: Mapping[str, Callable[[Surroundings], Array]] = {
    "omega_z": lambda w: w["omega_z"],
    "omega_x cos phi": lambda w: w["omega_x"] * np.cos(w.phi),
    "omegadot_x^2": lambda w: w["omegadot_x"] ** 2,
    "omegadot_z a_x": lambda w: w["omegadot_z"] * w["a_x"],
    "a_x omega_y": lambda w: w["a_x"] * w["omega_y"],
    "f_i omega_z (scale by rate)": lambda w: w.f_i[0] * w["omega_z"],
    "f_i omega^2 (scale by rate squared)": lambda w: (
        w.f_i[0] * (w["omega_x"] ** 2 + w["omega_y"] ** 2 + w["omega_z"] ** 2)
    ),
    "a_x pressure": lambda w: w["a_x"] * w.change("pressure"),
    "a_z B_x": lambda w: w["a_z"] * w.change("B_x"),
    "f_i pressure (scale by pressure)": lambda w: w.f_i[0] * w.change("pressure"),
    "f_i temperature^2": lambda w: w.f_i[0] * w.change("temperature") ** 2,
    "omega_z temperature": lambda w: w["omega_z"] * w.change("temperature"),
    "sin 5 phi": lambda w: np.sin(5 * w.phi),
    "a_z cos 6 phi": lambda w: w["a_z"] * np.cos(6 * w.phi),
    "f_i^4": lambda w: w.f_i[0] ** 4,
    "abs(f_o)": lambda w: np.abs(w.f_o[0]),
    "f_i^2 sign(da_z/dt) (friction)": lambda w: w.f_i[0] ** 2 * np.sign(np.gradient(w["a_z"])),
    "creep of f_p over 20 s": lambda w: _creep(w["a_z"] - w["a_z"][0], w.rate, 20.0),
    "creep of f_i over 0.4 s": lambda w: _creep(w.f_i[0], w.rate, 0.4),
    "f_i cos 2 pi t/45 s (supply)": lambda w: w.f_i[0] * np.cos(2 * np.pi * w.time / 45),
    "line at 0.37 Hz (pump)": lambda w: np.sin(2 * np.pi * 0.37 * w.time),
    "misalignment jump": lambda w: np.where(w.time > 0.45 * w.duration, w["a_z"], 0.0),
    "burst of a_x for 40 s": lambda w: np.where(np.abs(w.time - 0.7 * w.duration) < 20, w["a_x"], 0.0),
    "misalignment drift": lambda w: w["a_z"] * (w.time - w.time[-1] / 2),
    # further ones, of which the dictionary of the diagnosis holds most in no such form
    "dead zone of f_i": lambda w: np.clip(w.f_i[0], -0.4 * _rms(w.f_i[0]), 0.4 * _rms(w.f_i[0])),
    "play in f_i (hysteresis)": lambda w: _play(w.f_i[0], 0.3 * _rms(w.f_i[0])),
    "f_i^2 temperature": lambda w: w.f_i[0] ** 2 * w.change("temperature"),
    "f_i roll": lambda w: w.f_i[0] * w["roll"],
    "sqrt(abs(f_o))": lambda w: np.sqrt(np.abs(w.f_o[0])),
    "resonance at 3 Hz": lambda w: _resonant(w.f_i[0], w.rate, 3.0, 0.1),
    "cross-talk of A3, 0.3 s late": lambda w: _late(w.f_i[2], w.rate, 0.3),
    "heating by f_i^2, 30 s": lambda w: _creep(w.f_i[0] ** 2, w.rate, 30.0),
    "play in a_x": lambda w: _play(w["a_x"] - np.mean(w["a_x"]), 0.5 * float(np.std(w["a_x"]))),
    "mount resonant at 3 Hz, Q 15": lambda w: _resonant(w.f_i[0], w.rate, 3.0, 1 / 30),
    "abs(G_out)": lambda w: np.abs(w.output),
    "cube of G_out (converter)": lambda w: w.output**3,
    "square of G_out (converter)": lambda w: w.output**2,
}
"""Terms by name, (N,) m/s^2 in the first accelerometer; of the first ones the dictionary of the diagnosis holds many."""

# Those that have become effects of the catalogue since the terms were chosen: naming these is right
SINCE: Mapping[str, str] = {
    "play in f_i (hysteresis)": "bias-hysteresis",
    "heating by f_i^2, 30 s": "inner-temperature",
    "f_i^2 temperature": "thermal-second-order",
    "misalignment jump": "misalignment-step",
    "misalignment drift": "misalignment-drift",
    "cube of G_out (converter)": "output-curve",
    "square of G_out (converter)": "output-curve",
}


def name_of(s: Spec) -> str:
    """The term that is put into a flight with physics outside the catalogue."""
    return list(TERMS)[(s.index + COUNTS["outside"] * (s.sample % 3)) % len(TERMS)]


@dataclass(frozen=True)
class Outside:
    """A term in a flight: what it adds to G_out (N,) V, and its strength with what effects could feign of it, in sigmas."""

    name: str
    change: Array
    with_mimics: float


def make_outside(name: str, oracle: Oracle, plain: Simulation, scenario: Scenario) -> Outside:
    """A term of ten sigmas beyond the calibration and all effects of the catalogue together."""
    k = scenario.instrument.accelerometers
    unit = k["k_VI"][0] * k["K1"][0] * TERMS[name](Surroundings(plain, scenario))
    factor = 10.0 / oracle.beyond_all(unit)
    return Outside(name, factor * unit, factor * float(np.linalg.norm(oracle.row(unit))))


# --- a flight --------------------------------------------------------------------------------------------


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
    line: dict[str, Any] = {"id": spec.id, "kind": spec.kind, "record": spec.record}
    signal.signal(signal.SIGVTALRM, _stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, LONGEST)
    try:
        p = prepared(spec)
        line["hidden"] = [asdict(h) for h in p.hidden]
        line["outside"] = None if p.term is None else [p.term.name, p.term.with_mimics]
        ready = time.process_time()
        line |= diagnosed(p)
        line["cpu"] = round(time.process_time() - ready, 2)
    except Exception:
        line["crash"] = traceback.format_exc()
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
    return line


def tested(spec: Spec) -> dict[str, Any]:
    """What an oracle finds of the effect that is hidden in a flight."""
    p = prepared(spec)
    assert p.oracle is not None
    return {"id": spec.id, "kind": spec.kind} | weigh(p.oracle, p.world, p.table, p.hidden[0])


def _stop(*_: object) -> None:
    raise TimeoutError(f"no end after {LONGEST:g} s of processor time")


@lru_cache(maxsize=128)
def prepared(spec: Spec) -> Prepared:
    """The file of a flight."""
    w, kind = plan.world(spec), records.KINDS[spec.record]
    plain = simulated(w, {})
    channels = table(plain, plain.voltages_noise_free)
    noise_rms = kind.noise(channels, spec.rng(2))
    hidden: tuple[Hidden, ...] = ()
    term = oracle = None
    if spec.kind != "quiet":
        clean = CleanOutput(plain.G_out_noise_free, 1.0, w.scenario.rate)
        lost = np.isnan(kind.change(channels, clean, spec.rng(4))["G_out"])
        flight = plain.flight("plain", voltages=w.output == "voltages")
        oracle = Oracle(w, flight, noise_rms, lost, spec.catalogue)
        if spec.kind == "outside":
            term = make_outside(name_of(spec), oracle, plain, w.scenario)
        else:
            hidden = _hidden(spec, oracle)
    values = {h.effect: h.values for h in hidden}
    recorder = {e: values.pop(e) for e in ("output-curve", "quantisation", "saturation") if e in values}
    sim = simulated(w, values) if values else plain
    return Prepared(w, _recorded(spec, w, sim, noise_rms, term, recorder), hidden, term, oracle)


def simulated(w: World, effects: EffectValues) -> Simulation:
    """The flight of a world with these effects."""
    return w.scenario.simulate(effects, record_gradient=w.gradient, start=w.start)


def table(sim: Simulation, voltages: Array) -> Table:
    """The columns of a flight with these voltages (4, N)."""
    columns = {"time": sim.time} | {n: np.asarray(x) for n, x in sim.channels.items()}
    return columns | {f"V_{j + 1}": v for j, v in enumerate(voltages)} | {"G_out": combine(voltages)}


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
    x = table(sim, sim.voltages_noise_free + noise)
    if term is not None:
        x["G_out"] = x["G_out"] + term.change
        x["V_1"] = x["V_1"] + term.change
    if w.output != "voltages":
        x = {n: v for n, v in x.items() if not n.startswith("V_")}
    rms = float(np.std(combine(noise))) or 1e-12 * float(np.std(x["G_out"]))
    clean = CleanOutput(x["G_out"] - combine(noise), rms, s.rate)
    x = records.KINDS[spec.record].change(x, clean, spec.rng(4))
    x["G_out"] = record_output(x["G_out"], resolve(recorder))
    return _channels(w, x) if w.output == "channels" else x


def _channels(w: World, x: Table) -> Table:
    """Demodulated channels in the place of the output; at both ends the filter has not seen enough."""
    phi, low = 2 * np.pi * w.scenario.sheet.spin_frequency * x["time"], low_pass(w.scenario.rate)
    k, half, G = w.scenario.sheet.scale_factor, len(low) // 2, x.pop("G_out")
    channels = {"inline": 4 * G * np.sin(2 * phi), "cross": -2 * G * np.cos(2 * phi)}
    return x | {n: np.pad(convolve(v, low) / k, half, constant_values=np.nan) for n, v in channels.items()}


def _hidden(spec: Spec, o: Oracle) -> tuple[Hidden, ...]:
    """The effects of a flight."""
    rng, effects = spec.rng(5), list(o.kinds)
    if spec.kind == "pair":
        return _pair(spec, o, rng)
    if spec.kind == "off-sheet" and spec.index % 3 == 2:
        return ()
    low, high = {"five": (5.0, 5.0), "ten": (10.0, 10.0), "strong": STRONG}.get(spec.kind, (10.0, 1000.0))
    strength = min(high, float(np.exp(rng.uniform(np.log(low), np.log(high)))))  # to rounding
    order = np.random.default_rng(list(COUNTS).index(spec.kind)).permutation(len(effects))
    place = spec.index + COUNTS[spec.kind] * (spec.sample % 10)
    effect = effects[order[place % len(effects)]]  # in turn, in an order of each kind's own
    for _ in range(TRIES):
        h = o.drawn(effect, strength, rng)
        if h is not None:
            return (h,)
        effect = str(rng.choice(effects))
    raise RuntimeError("no effect is testable on this flight")


def _pair(spec: Spec, o: Oracle, rng: np.random.Generator) -> tuple[Hidden, ...]:
    """Two effects, each of its strength beside the whole other one."""
    columns = [e for e, k in o.kinds.items() if k in ("deterministic", "step")]
    time = o.flight.time
    middle = float(time[0] + 0.4 * (time[-1] - time[0]))
    strong = 300.0 if spec.index % 2 else 10.0
    for _ in range(TRIES):
        first, second = (str(e) for e in rng.choice(columns, 2, replace=False))
        one = o.drawn(first, strong, rng, o.block(second, middle))
        other = o.drawn(second, 10.0, rng, o.block(first, middle))
        if one is not None and other is not None:
            return one, other
    raise RuntimeError("no two effects are testable on this flight")


def diagnosed(p: Prepared) -> dict[str, Any]:
    """What ``ragg diagnose`` says of sheet and flight in files."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        (place / "sheet.toml").write_text(plan.model_text(p.world.scenario.sheet), "utf-8")
        columns = tuple(DataColumn(n, SI_UNITS[n], x) for n, x in p.table.items())
        write_tables(place / "flight.parquet", [DataTable(columns)])
        try:
            m = ragg.new(place / "model", place / "sheet.toml")
            d = ragg.diagnose(m, ragg.read_flights(m, [place / "flight.parquet"])).as_json()
        except UserError as e:
            return {"verdict": "refused", "remark": str(e), "found": [], "ranking": []}
    return essence(d)


KEPT = ("verdict", "remark", "found", "tests", "unexplained", "credible_set", "error", "noise_floor")


def essence(d: Mapping[str, Any]) -> dict[str, Any]:
    """What the scoring needs of the JSON of a diagnosis; of the ranking the first, what is claimed, and what is probable."""
    ranking = [
        {n: r[n] for n in ("effect", "log10_p", "probability", "indistinguishable_from")}
        for k, r in enumerate(d["ranking"])
        if k < 6 or r["effect"] in d["found"] or (r["probability"] or 0.0) > PROBABLE
    ]
    return {n: d[n] for n in KEPT} | {"ranking": ranking}
