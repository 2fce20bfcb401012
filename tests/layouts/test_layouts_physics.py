"""Derived models of other layouts, their spin, effects and C, against the numerical reference."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.effects import catalogue
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.instrument.units import EOTVOS, units
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.model import derive
from ragg_runtime.model.model import Model, evaluate_output, find_unit_factor, make_vector, scale_factor
from ragg_runtime.model.record import Record, record
from ragg_runtime.reference.motion import Sinusoids, Turning
from ragg_runtime.reference.scenario import draw_gradient, draw_motion
from ragg_runtime.reference.simulate import simulate
from ragg_runtime.simulate import simulate_flight
from tests.layouts import sheets

LAYOUTS: dict[str, tuple[Callable[[], list[str]], int]] = {
    "two": (sheets.two, 2),
    "three": (sheets.three, 3),
    "complements": (sheets.complements, 8),
    "umbrella": (sheets.umbrella, 12),
    "oblique": (sheets.oblique, 4),
    "odd": (sheets.odd, 4),
}


def instrument(name: str, head: str = "", size: float = 1.0) -> Instrument:
    discs, count = LAYOUTS[name]
    return parse_instrument(sheets.sheet(discs(), count, head, size=size))


def flown(i: Instrument, duration: float = 60.0, **options: Any) -> Flight:
    """A flight of the numerical reference."""
    motion = draw_motion(np.random.default_rng(3), duration)
    gradient = draw_gradient(np.random.default_rng(4))
    return simulate(i, motion, duration, 16.0, gravity=gradient, **options).flight(voltages=True)


def worst(i: Instrument, flight: Flight, inner: slice = slice(20, -20)) -> float:
    """Largest difference of any output from the flight's, in C or NumPy, Eo; by default not at the ends, where the rate of a recorded
    angle is less sure.
    """
    model = derive.load_model(i, candidates=False)
    p = make_vector(model, i)
    differences = []
    for k, o in enumerate(i.layout.outputs):
        r = record(flight, i, k)
        for chain in (model.chain, replace(model.chain, sources={})):
            left = flight.outputs[o.name] - evaluate_output(chain, r, p, o)
            differences.append(float(np.max(np.abs(left[inner]))) / scale_factor(model, p, k))
    return max(differences)


@pytest.mark.parametrize(("name", "head", "kinematics", "rotations"), [
    *((n, sheets.EXACT, "full", "exact") for n in LAYOUTS),
    ("odd", "", "platform", "first-order"),
    ("umbrella", sheets.FULL, "full", "first-order"),
])  # fmt: skip
def test_derived_agrees_with_reference(name: str, head: str, kinematics: str, rotations: str) -> None:
    i = instrument(name, head)
    effects = {} if rotations == "exact" else {"second-order-misalignment": {"kappa": 0.0}}
    flight = flown(i, kinematics=kinematics, rotations=rotations, effects=effects)
    size = max(float(np.std(flight.outputs[n])) for n in i.layout.output_names)
    gap = worst(i, flight)
    # half a unit in the last place of a recorded force is worth 5e-5 Eo where the places do not balance
    assert gap < (5e-5 if name == "odd" else 1e-5), gap
    assert size / (i.scale_factor * EOTVOS) > 1e3


def swings(frequency: float, *parts: tuple[float, float, float]) -> Turning:
    """A steady rate, Hz, and swings: amplitude, rad, frequency, Hz, phase."""
    return Turning(frequency, Sinusoids(0.0, *np.transpose(parts)) if parts else None)


SPINS = {
    "varies": swings(0.25, (0.4, 0.05, 0.3)), "reverses": swings(0.0, (9.0, 0.02, 0.0)), "backwards": swings(-0.25),
    "stands still": swings(0.0),
}  # fmt: skip
LIMIT = 0.1
"""Eo, nominal: what issues promise of a noise-free simulated instrument of the model's own order."""


def fly(i: Instrument, **options: Any) -> Flight:
    """A minute of exactly the instrument of the sheet."""
    exact: Any = {"duration": 60.0, "noise": 0.0, "sheet_error": 0.0, "no_gradient": False}
    return simulate_flight(i, (), **(exact | options))


def of_paper() -> Instrument:
    discs = '[disc]\nradius = "0.1 m"\nspin_frequency = "0.25 Hz"\ng0 = "9.8 m/s^2"\n'
    return parse_instrument(sheets.sheet([discs], 4, sheets.EXACT).replace('g0 = "9.8 m/s^2"\n', "", 1))


@pytest.mark.parametrize(
    ("layout", "spin"), [("paper", "varies"), *(("complements", n) for n in list(SPINS)[1:])]
)
def test_exact_model_of_full_kinematics_is_the_simulated_instrument(layout: str, spin: str) -> None:
    i = of_paper() if layout == "paper" else instrument(layout, sheets.EXACT)
    flight, steady = fly(i, spin={i.layout.discs[0].name: SPINS[spin]}), fly(i)
    assert "spin_angle" in flight.channels
    assert worst(i, flight) < LIMIT
    name = i.layout.output_names[0]
    away = np.std(flight.outputs[name] - steady.outputs[name])
    assert away > 0.1 * np.std(steady.outputs[name])  # it does matter how the disc turns


@pytest.mark.parametrize(("five", "spin"), [
    (False, swings(0.25, (0.4, 0.05, 0.0), (0.1, 0.21, 0.0))), (True, swings(0.25, (0.3, 0.1, 0.0))),
])  # fmt: skip
def test_the_rate_of_a_clean_encoder_follows_a_fast_swing(five: bool, spin: Turning) -> None:
    """Of five accelerometers at unlike places the Euler force, R phi'', does not cancel: the ends of the record count as well."""
    places = zip((0.0, 70.0, 100.0, 200.0, 300.0), (1, 1, -1, 1, -1), strict=True)
    disc = sheets.disc("A", [sheets.accelerometer(f"A{k}", a, s) for k, (a, s) in enumerate(places)])
    i = parse_instrument(sheets.sheet([disc], 5, sheets.EXACT)) if five else of_paper()
    assert worst(i, fly(i, spin={i.layout.discs[0].name: spin}), slice(None)) < LIMIT


def test_each_disc_turns_as_it_is_told() -> None:
    i = instrument("umbrella", sheets.EXACT)
    flight = fly(i, spin={"A": swings(0.2), "C": swings(0.0, (3.0, 0.02, 0.0))})
    assert {"spin_angle_A", "spin_angle_C"} == {n for n in flight.channels if n.startswith("spin_angle")}
    angle, t = np.unwrap(flight.channels["spin_angle_A"]), flight.time
    assert angle == pytest.approx(2 * np.pi * 0.2 * t, abs=1e-12)
    assert flight.channels["spin_angle_C"] == pytest.approx(3 * np.sin(2 * np.pi * 0.02 * t), abs=1e-12)
    assert worst(i, flight) < LIMIT


def test_the_encoder_of_a_record_is_flown(tmp_path: Path) -> None:
    i = instrument("complements", sheets.EXACT)
    first = fly(i, spin={"A": SPINS["varies"]})
    write_flight(first, tmp_path / "first.csv")
    again = fly(i, motion=tmp_path / "first.csv")
    read = read_flight(tmp_path / "first.csv", i.g0, accelerometers=i.layout).channels["spin_angle"]
    np.testing.assert_allclose(again.time, first.time, atol=1e-9)  # as many samples
    gap = np.angle(np.exp(1j * (again.channels["spin_angle"] - read)))
    assert np.max(np.abs(gap)) < 1e-11
    assert worst(i, again) < LIMIT


def test_an_encoder_read_at_uneven_instants_turns_evenly() -> None:
    """What the disc turns while a sample is late is no change of its rate."""
    rng = np.random.default_rng(3)
    time = (np.arange(800.0) + 1e-3 * rng.normal(size=800)) / 16.0
    r = Record(time, {"spin_angle": 2 * np.pi * 0.25 * time}, 16.0, np.ones(800, dtype=np.bool_), 0.25)
    for part in (r, r.part(slice(200, 500))):
        rate, change = part.series("d_spin_angle"), part.series("d2_spin_angle")
        assert rate == pytest.approx(np.full(len(part.time), np.pi / 2), abs=1e-9)
        assert change == pytest.approx(np.zeros(len(part.time)), abs=1e-9)


WITH_DIRECTIONS = {
    "spin-axis-tilt": 1e-4,
    "magnetic-bias": 1e-3,
    "near-mass": 1e-4,
    "anisoinertia": 1e-4,
    "arm-sag": 1e-3,
    "imu-misalignment": 1e-4,
}
"""Effects that know a direction, and the share of each that its own square and misalignment may leave."""


@cache
def leaning() -> Instrument:
    head = '[model]\nkinematics = "full"\norder = { second_order_angles = true }\n'
    return parse_instrument(sheets.sheet([sheets.leaning((0.6, 0.48, 0.64))], 3, head))


def left(model: Model, flight: Flight, p: NDArray[np.float64]) -> float:
    """Rms of what a model leaves, Eo."""
    i = leaning()
    residual = flight.outputs["G_out"] - evaluate_output(
        model.chain, record(flight, i, 0), p, i.layout.outputs[0]
    )
    k_ggi = scale_factor(base(), make_vector(base(), i))
    return float(np.std(residual[20:-20])) / k_ggi


def base() -> Model:
    return derive.load_model(leaning(), candidates=False)


@pytest.mark.parametrize("id_", WITH_DIRECTIONS)
def test_an_effect_of_a_direction_is_the_reference_s(id_: str) -> None:
    i = leaning()
    (effect,) = (e for e in catalogue() if e.id == id_)
    registry, rng = units(i.g0), np.random.default_rng(1)
    sizes = {q: 3 * q.plausible * find_unit_factor(q.unit, registry) for q in effect.parameters}
    values = {q.name: size * rng.uniform(0.7, 1.3, 1 if q.shared else 3) for q, size in sizes.items()}
    parameters = {n: v if len(v) > 1 else float(v[0]) for n, v in values.items()}
    flight = flown(i, 30.0, kinematics="full", effects={id_: parameters})
    model = derive.with_effects(i, base(), [id_])
    p = make_vector(model, i)
    for q in effect.parameters:
        p[model.chain.places[effect.symbol(q).name]] = values[q.name]
    without = left(base(), flight, make_vector(base(), i))
    assert without > 0.1
    assert left(model, flight, p) < max(WITH_DIRECTIONS[id_] * without, 1e-4)
