"""What every effect must hold to, whoever wrote it: runs over the whole catalogue by itself.

The independent formulation is the reference simulator (vectors, exact rotations, integrals over the past).
Effects that it does not know are written down once more here, in ``DIRECT``; one that is in neither still has
to pass everything that needs no second opinion.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import pytest
import sympy as sp
from numpy.typing import NDArray
from sympy.printing.numpy import NumPyPrinter

from derive.chain import accelerometer
from derive.effect import Effect, EffectParameter
from derive.effects import catalogue
from derive.layout import SymbolicForm
from derive.stages import EXACT, PAPER, Kinematics, Order
from derive.symbols import ACCELEROMETER, DISC, MOTION, QUARTER_TURNS
from derive.tape import Program, settled
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import PAPER as FOUR
from ragg_runtime.instrument.units import units
from ragg_runtime.reference.effects import CATALOGUE
from ragg_runtime.reference.geometry import frame_rotation, mount
from ragg_runtime.reference.gravity import Gradient
from ragg_runtime.reference.motion import MotionSignals, Sinusoids, disc_angle
from ragg_runtime.reference.scenario import table_v
from ragg_runtime.reference.simulate import simulate

Array = NDArray[np.float64]
Record = tuple[Mapping[str, Array], Array]

G0 = 9.8
LIKE_REFERENCE = Order(1, 1, second_order_angles=True)
"""First-order rotations, kept in the second-order terms too: the counting of the reference simulator."""

UNORDERED = {"order": "none", "fully_qualified_modules": False, "inline": True}
UNORDERED |= {"allow_unknown_functions": True}
"""As ``lambdify`` prints, but sums as they stand: to put their terms in order takes half of the time."""


@dataclass(frozen=True)
class Evaluated:
    """A program as a function: values by symbol name -> outputs by name, each an array."""

    program: Program

    @cached_property
    def inputs(self) -> tuple[str, ...]:
        return tuple(s.name for s in self.program.inputs)

    @cached_property
    def function(self) -> Callable[..., Sequence[Array]]:
        """Compiled with SymPy's NumPy printer, once it is called."""
        outputs, printer = [e for _, e in self.program.outputs], NumPyPrinter(UNORDERED)
        steps = list(self.program.assignments)
        return sp.lambdify(
            self.program.inputs, outputs, "numpy", printer=printer, cse=lambda _: (steps, outputs)
        )

    def __call__(self, values: Mapping[str, Array | float]) -> dict[str, Array]:
        y = self.function(*(values[n] for n in self.inputs))
        return {n: np.asarray(v, dtype=float) for (n, _), v in zip(self.program.outputs, y, strict=True)}


def neutral_values(effects: Sequence[Effect]) -> dict[sp.Symbol, sp.Expr]:
    """Neutral values of what is fitted; an instant of a step stays open."""
    fitted = [(e, q) for e in effects for q in e.parameters if q.fitted or q.shape]
    return {e.symbol(q): sp.nsimplify(q.neutral) for e, q in fitted}


@cache
def voltage(effects: tuple[Effect, ...], order: Order, kinematics: Kinematics = "platform") -> Evaluated:
    """V of the generic accelerometer with ``effects``, their parameters open."""
    a = accelerometer(effects, SymbolicForm(order, kinematics))
    return Evaluated(settled(a.tape.assignments, {}).program([("V", a.voltage)]))


@cache
def signatures(effects: tuple[Effect, ...], order: Order) -> Evaluated:
    """dV/d(parameter) of all ``effects`` at their neutral values, by symbol name, and V itself."""
    a = accelerometer(effects, SymbolicForm(order), effects)
    at, by = a.tape.derivatives(a.voltage, settled(a.tape.assignments, neutral_values(effects)))
    rows = [(e.symbol(q).name, by(e.symbol(q))) for e in effects for q in e.parameters if q.fitted]
    return Evaluated(at.program([("V", a.voltage), *rows]))


def si(unit: str) -> float:
    """Factor from a display unit to SI."""
    registry = units(G0)
    return float(registry.to_si(1.0, unit, registry.base_unit(unit)))


def place(j: int) -> dict[str, float]:
    """Constant cosine and sine of the nominal place of accelerometer j = 0 ... 3."""
    quarter = QUARTER_TURNS[j]
    return {"cos_j": (1.0, 0.0, -1.0, 0.0)[quarter], "sin_j": (0.0, 1.0, 0.0, -1.0)[quarter]}


EFFECTS = catalogue()
HOOKED = tuple(e for e in EFFECTS if e.kind != "output")
DURATION, RATE = 16.0, 8.0
STEP_AT = 7.3
"""Instant of the gain step, s: between two samples."""

by_effect = pytest.mark.parametrize("effect", HOOKED, ids=lambda e: e.id)
FITTED = [(e, q) for e in HOOKED for q in e.parameters if q.fitted and not q.shape]


# A world in which nothing vanishes and nothing is symmetric.


def _instrument() -> Instrument:
    rng = np.random.default_rng(20)
    sheet = table_v()
    sizes = dict.fromkeys(("beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z"), 1e-4)
    sizes |= dict.fromkeys(("K2", "K4", "K5", "K6", "K7", "K8"), 2e-5 / G0) | {"K0": 1e-3, "dR": 1e-4}
    return sheet.replace(**{n: size * rng.standard_normal(4) for n, size in sizes.items()})


def _signal(rng: np.random.Generator, mean: float, spread: float) -> Sinusoids:
    shares, frequency, phase = (rng.uniform(*x, 4) for x in ((0.3, 1.0), (0.05, 0.5), (0, 6.28)))
    return Sinusoids(mean, spread * shares, frequency, phase)


def _averaged(s: Sinusoids, b: float) -> Sinusoids:
    """Over the interval sqrt(24 b)."""
    shares = np.sinc(np.asarray(s.frequency) * np.sqrt(24 * b))
    return Sinusoids(s.mean, np.asarray(s.amplitude) * shares, s.frequency, s.phase)


INSTRUMENT = _instrument()
_RNG = np.random.default_rng(21)
_A = tuple(_signal(_RNG, m, 0.3) for m in (0.15, -0.2, 1.0))
_OMEGA = tuple(_signal(_RNG, m, 0.02) for m in (0.01, -0.02, 0.015))
MOTION_TRUE = MotionSignals(_A, _OMEGA)
GRAVITY = Gradient(np.array([300.0, 120.0, 50.0, 200.0, -80.0, -500.0]) * 1e-9)
TEMPERATURE = _signal(_RNG, 294.0, 0.5)
SIZES = {
    "roll": (0.02, 0.03), "pitch": (-0.01, 0.02), "pressure": (98000.0, 400.0), "B_x": (2e-5, 1e-5), "B_y": (-1e-5, 1e-5),
    "B_z": (4e-5, 1e-5), "yaw": (0.7, 0.9), "fuel_mass": (400.0, 90.0), "vibration_rms": (0.3, 0.05),
    "angular_vibration_rms": (3e-4, 5e-5), "balance_current": (1e-3, 2e-4), "second_order_current": (1e-3, 3e-4),
    "mass_x": (0.1, 0.2), "mass_y": (0.1, 0.2), "mass_z": (0.1, 0.2),
}  # fmt: skip
"""Mean and spread, SI."""

AUXILIARIES = {"temperature": TEMPERATURE} | {n: _signal(_RNG, *s) for n, s in SIZES.items()}

RESPONSES = [
    *(f"C__mount_{n}_{k}" for n in ("a", "omega", "omegadot") for k in "xyz"),
    *(
        f"C__{n}_{k}"
        for n in ("rate", "curvature", "slip", "play", "creep", "flow")
        for k in ("radial", "tangential", "axial")
    ),
    *(f"C__heat_{k}" for k in ("rr", "rt", "ra", "tt", "ta", "aa")),
    *(f"C__{n}" for n in ("heat_start", "creep_start", "flow_start", "cycle_temperature")),
]
"""What is remembered at neutral values; its changes by a shape beside these are zero here."""

SHAPES = ("f_0", "Q", "tau", "w")


def _reference(effects: Mapping[str, Mapping[str, object]], kinematics: Kinematics = "platform") -> Record:
    """What the reference records: channels and the four voltages."""
    world = {"gravity": GRAVITY, "auxiliaries": AUXILIARIES, "kinematics": kinematics}
    record = simulate(INSTRUMENT, MOTION_TRUE, DURATION, RATE, effects=effects, **world)
    late = float(effects.get("time-offset", {}).get("delta_t", 0.0))
    channels = dict(record.channels) | {"time": record.time}
    drift = float(effects.get("clock-drift", {}).get("epsilon", 0.0))
    channels["d_temperature"] = TEMPERATURE(record.time, 0.0, 1)
    recorded = record.time - drift * record.time
    skew, filtered = effects.get("imu-skew", {}), effects.get("imu-filter", {})
    for name, signals, order in (("a", _A, 0), ("omegadot", _OMEGA, 1)):
        b = float(filtered.get("b_a" if name == "a" else "b_w", 0.0))
        for k, s in zip("xyz", signals, strict=True):
            by = late + (float(skew.get(f"delta_{k}", 0.0)) if name == "a" else 0.0)
            channels[f"d_{name}_{k}"] = _averaged(s, b)(recorded, by, order + 1)
            channels[f"d2_{name}_{k}"] = _averaged(s, b)(recorded, by, order + 2)
    for n, name in enumerate(RESPONSES):
        channels[name] = _signal(np.random.default_rng(n), 0.0, 0.1)(record.time)
        channels |= {f"{name}_by_{q}": np.zeros_like(record.time) for q in SHAPES}
    channels["G_out"] = record.G_out
    phi = disc_angle(INSTRUMENT.spin_frequency, record.time)
    spin = np.full(record.time.size, 2 * np.pi * INSTRUMENT.spin_frequency)
    channels |= {"d_spin_angle": spin, "d2_spin_angle": 0 * spin}
    return channels | {"cos_phi": np.cos(phi), "sin_phi": np.sin(phi)}, record.voltages


@cache
def _nothing() -> Record:
    return _reference({})


def _magnetic(value: Mapping[str, float]) -> Record:
    channels, V = _nothing()
    B, k = np.stack([channels[f"B_{n}"] for n in "xyz"]), INSTRUMENT.accelerometers
    mounts = [mount(FOUR.places[j], k["beta_x"][j], k["beta_z"][j], "first-order") for j in range(4)]
    axes = [frame_rotation(*(k[f"vartheta_{a}"][j] for a in "xyz"), "first-order")[0] for j in range(4)]
    inputs = [axis @ m.triad for axis, m in zip(axes, mounts, strict=True)]
    cos, sin = channels["cos_phi"], channels["sin_phi"]
    along = [(cos * x - sin * y) * B[0] + (sin * x + cos * y) * B[1] + z * B[2] for x, y, z in inputs]
    return channels, V + (k["k_VI"] * k["K1"])[:, None] * value["dK0_dB"] * np.stack(along)


def _curved(value: Mapping[str, float]) -> Record:
    # what the converter makes of the sum, all voltages have lost alike
    channels, V = _reference({"output-curve": value})
    return channels, V * (channels["G_out"] / _nothing()[0]["G_out"])


DIRECT: Mapping[str, Callable[[Mapping[str, float]], Record]] = {
    "magnetic-bias": _magnetic,
    "output-curve": _curved,
    # a random angle that happens to be constant is an offset of the angle
    "spin-rate-jitter": lambda value: _reference({"spin-phase-offset": {"phi_0": sum(value.values())}}),
}
"""Effects that the reference knows as a random process, or but along the nominal axes, written down again."""

STEPS = {e.id: next(q for q in e.parameters if not q.fitted).name for e in catalogue() if e.kind == "step"}
"""Effects that begin at an instant, and what it is called."""

STEP_SYMBOLS = {f"{i.replace('-', '_')}__{name}": STEP_AT for i, name in STEPS.items()}

ALONGSIDE: Mapping[str, Mapping[str, float]] = {
    **{i: {name: STEP_AT} for i, name in STEPS.items()},
    # A covariance must be positive: its components are varied about an isotropic one.
    "vibration-rectification": {"P_xx": 2e3, "P_yy": 2e3, "P_zz": 2e3},
    "vibration-level": {"L_xx": 2e4, "L_yy": 2e4, "L_zz": 2e4},
}

ONE_SIDED = frozenset({"imu-filter", "lag", "output-filter", "second-order-loop"})
"""The simulator looks backwards only, or has no resonances."""

TOLERANCE: Mapping[str, float] = {
    "lag": 3e-5,
    "imu-filter": 1e-4,
    "output-filter": 1e-4,
    "second-order-loop": 3e-4,
    "near-cuboid": 2e-4,
}
"""The lag is derived for the input force; the simulator delays the second-order terms (1e-5 of it), too. Filter and loop
are derived to first order in b; the simulator averages over an interval, and over past and future. What the shape of a cuboid adds to a
point is derived at the disc's centre."""


def truth(effect: Effect, values: Mapping[str, float]) -> Record:
    """Record of the independent formulation, channels and voltages (4, N) V."""
    values = dict(ALONGSIDE.get(effect.id, {})) | dict(values)
    if effect.id in DIRECT:
        return DIRECT[effect.id](values)
    return _reference({effect.id: values})


def chain_values(j: int, channels: Mapping[str, Array]) -> dict[str, Array | float]:
    k = {n: float(v[j]) for n, v in INSTRUMENT.accelerometers.items()}
    disc = {"radius": INSTRUMENT.radius, "spin_frequency": INSTRUMENT.spin_frequency}
    return {**channels, **k, **disc, **place(j), **STEP_SYMBOLS}


def model(
    effects: tuple[Effect, ...],
    order: Order,
    channels: Mapping[str, Array],
    p: Mapping[str, float],
    kinematics: Kinematics = "platform",
) -> Array:
    """V of the derived chain with the values ``p`` by symbol name, (4, N) V."""
    everything = {s.name: float(v) for s, v in neutral_values(effects).items()} | dict(p)
    V = voltage(effects, order, kinematics)
    n = channels["time"].size
    return np.stack([np.broadcast_to(V(chain_values(j, channels) | everything)["V"], n) for j in range(4)])


@cache
def all_signatures(order: Order) -> dict[str, Array]:
    """Every signature on the undisturbed record, (4, N) each; ``V`` itself among them."""
    channels = _nothing()[0]
    rows = [signatures(HOOKED, order)(chain_values(j, channels)) for j in range(4)]
    n = channels["time"].size
    return {name: np.stack([np.broadcast_to(r[name], n) for r in rows]) for name in rows[0]}


def row(effect: Effect, q: EffectParameter, order: Order) -> Array:
    return all_signatures(order)[effect.symbol(q).name]


def counted(effect: Effect) -> Order:
    """The order in which an effect is compared with the reference."""
    return PAPER if effect.id == "second-order-misalignment" else LIKE_REFERENCE


def rms(x: Array) -> float:
    return float(np.sqrt(np.mean(x**2)))


FARTHEST = {
    ("gyro-bias", "b_z"): 5e-3,
    ("gyro-delay", "delta_w"): 1e-4,
    ("gyro-delay", "delta_d"): 1e-4,
    ("second-order-loop", "b"): 3e-5,
    ("imu-filter", "b_a"): 3e-5,
    ("imu-filter", "b_w"): 3e-5,
    **{("imu-thermal", f"ds_{k}_dT"): 1e-3 for k in "xy"},
    **{("gyro-misalignment", f"m_{k}"): 1e-2 for k in ("xy", "xz", "yx", "yz", "zx", "zy")},
    **{("imu-acceleration-misalignment", f"m_z{k}"): 1e-3 for k in "xy"},
}
"""What hardly shows by itself would have to be so large that its square does: rad/s, s, s^2, 1/K."""


def reach(effect: Effect, q: EffectParameter, share: float) -> float:
    """Value of a parameter at which it changes the output by ``share`` of itself, if that is not absurdly large."""
    return min(
        share * rms(_nothing()[1]) / rms(row(effect, q, PAPER)), FARTHEST.get((effect.id, q.name), np.inf)
    )


# what is remembered is formed of a record by the runtime: tests/runtime/test_reference.py
KNOWN = [(e, q) for e, q in FITTED if (e.id in CATALOGUE or e.id in DIRECT) and e.memory is None]
by_known_parameter = pytest.mark.parametrize(
    ("effect", "parameter"), [pytest.param(e, q, id=f"{e.id}.{q.name}") for e, q in KNOWN]
)


@pytest.mark.parametrize("kinematics", ["platform", "full"])
def test_the_chain_is_the_reference_where_no_effect_is(kinematics: Kinematics) -> None:
    """Otherwise the comparisons below would say nothing about the effects."""
    channels, V = _reference({}, kinematics)
    values = model((), LIKE_REFERENCE, channels, {}, kinematics)
    np.testing.assert_allclose(values, V, rtol=0, atol=1e-13 * rms(V))


@pytest.mark.parametrize("order", [PAPER, EXACT], ids=["paper", "exact"])
def test_the_whole_catalogue_at_neutral_values_changes_nothing(order: Order) -> None:
    channels, V = _nothing()
    voltage = all_signatures(order)["V"]
    np.testing.assert_allclose(voltage, model((), order, channels, {}), rtol=0, atol=1e-14 * rms(V))


@by_known_parameter
def test_signature_is_what_the_independent_formulation_does(effect, parameter) -> None:
    """Derivative of (true output - output of the base model on the same record), by differences."""
    order = counted(effect)
    h = reach(effect, parameter, 1e-5)
    start = ALONGSIDE.get(effect.id, {}).get(parameter.name, 0.0)

    def missing(value: float) -> Array:
        channels, V = truth(effect, {parameter.name: start + value})
        return V - model((), order, channels, {})

    if effect.id in ONE_SIDED:
        slope = (4 * missing(h) - missing(2 * h) - 3 * missing(0.0)) / (2 * h)
    else:
        slope = (missing(h) - missing(-h)) / (2 * h)
    expected = row(effect, parameter, order)
    assert rms(slope - expected) < TOLERANCE.get(effect.id, 1e-6) * rms(expected)


def test_signatures_are_finite_and_hardly_depend_on_the_order() -> None:
    """Angles to first order, and left out of the second-order terms: parts in a thousand, not more."""
    for effect, q in FITTED:
        paper, exact = row(effect, q, PAPER), row(effect, q, EXACT)
        assert np.all(np.isfinite(paper)), f"{effect.id}.{q.name}"
        assert rms(paper) > 0, f"{effect.id}.{q.name}"
        if effect.id != "second-order-misalignment":
            for other in (paper, row(effect, q, LIKE_REFERENCE)):
                assert rms(other - exact) < 2e-3 * rms(exact), f"{effect.id}.{q.name}"


@pytest.mark.parametrize("effect", dict.fromkeys(e for e, _ in KNOWN), ids=lambda e: e.id)
def test_the_extended_model_removes_the_effect(effect: Effect) -> None:
    """All parameters together, each at a thousandth of the output: their own nonlinearity is followed, too. Also in full
    kinematics, where effects couple with the spin: a swing of the angle, a tilted axis, a scaled gyroscope.
    """
    order = counted(effect)
    value = dict(ALONGSIDE.get(effect.id, {}))
    fitted = [q for q in effect.parameters if q.fitted and not q.shape]
    for n, q in enumerate(fitted):
        size = 1.0 if q.name == "kappa" else reach(effect, q, 1e-3) * (1 - 0.1 * n / len(fitted))
        value[q.name] = value.get(q.name, 0.0) + size
    p = {effect.symbol(q).name: value[q.name] for q in effect.parameters if q.name in value}
    records: list[tuple[Kinematics, Record]] = [("platform", truth(effect, value))]
    if effect.id not in DIRECT and not effect.moot(LIKE_REFERENCE, "full"):
        records.append(("full", _reference({effect.id: value}, "full")))
    for kinematics, (channels, V) in records:
        before = rms(V - model((), order, channels, {}, kinematics))
        after = rms(V - model((effect,), order, channels, p, kinematics))
        assert after < max(1e-3 * before, 1e-13 * rms(V))
        if (
            kinematics == "platform"
            and order is not PAPER
            and not any((effect.id, q.name) in FARTHEST for q in fitted)
        ):
            assert before > 1e-4 * rms(V)


@by_effect
def test_it_reads_the_channels_that_it_declares(effect: Effect) -> None:
    a = signatures((effect,), PAPER)
    names = {q.name for q in (*DISC, *ACCELEROMETER)} | {c.name for c in MOTION}
    names |= {"cos_phi", "sin_phi", "cos_j", "sin_j", "time"} | {
        effect.symbol(q).name for q in effect.parameters
    }
    names |= {f"d_{c.name}" for c in MOTION} | {f"d2_{c.name}" for c in MOTION}
    names |= {"d_spin_angle", "d2_spin_angle"}
    declared = {*effect.channels, *(q.channel for q in effect.parameters if q.channel)}
    rates = {f"d_{name}" for name in declared}
    names |= set(RESPONSES) if effect.memory else set()
    assert set(a.inputs) - names <= declared | rates
    # An accelerometer's own misalignment may hide a channel from one signature, but not from the model.
    read = set(voltage((effect,), LIKE_REFERENCE).inputs)
    assert effect.memory or all({name, f"d_{name}"} & read for name in declared)


def test_it_can_be_shown_to_a_user() -> None:
    for e in EFFECTS:
        assert all(x.strip() for x in (e.title, e.physics, e.source, e.equation, e.limits)), e.id
        assert all(q.meaning and q.latex and si(q.unit) > 0 and q.plausible > 0 for q in e.parameters), e.id


def test_every_effect_of_the_simulator_is_in_the_catalogue_with_its_parameters() -> None:
    catalogue = {e.id: e for e in EFFECTS}
    for id_, parameters in CATALOGUE.items():
        mine = {q.name: q for q in catalogue[id_].parameters}
        assert list(mine) == list(parameters), id_
        for name, theirs in parameters.items():
            assert mine[name].shared != theirs.per_accelerometer, f"{id_}.{name}"
            assert units(G0).fits(mine[name].unit, theirs.unit), f"{id_}.{name}"


def test_the_catalogue_holds_the_interface() -> None:
    """Ids that users write: the effect's file may change, its name not."""
    names = (
        "arm-sag arm-stretch bias-drift cubic-cross cubic-input encoder-harmonic gain-drift gain-step gyro-scale "
        "imu-lever-arm imu-misalignment lag magnetic-bias mount-compliance near-mass odd-quadratic pendulum-angular "
        "pressure-bias quantisation saturation second-order-misalignment self-gradient spin-axis-tilt spin-axis-wobble "
        "spin-phase-offset spin-rate-jitter thermal-bias thermal-scale time-offset vibration-rectification"
    )
    assert set(names.split()) <= {e.id for e in EFFECTS}
    assert [e.id for e in EFFECTS] == sorted({e.id for e in EFFECTS})
