"""Derived models of other layouts, their spin and effects on them, against the numerical reference, which shares no equation with them."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.effects import catalogue
from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.instrument.units import EOTVOS, units
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.model import derive
from ragg_runtime.model.model import Model, evaluate_output, find_unit_factor, make_vector, scale_factor
from ragg_runtime.model.record import SPIN, Record, measure_spin, record
from ragg_runtime.reference import simulate
from ragg_runtime.reference.scenario import draw_gradient, draw_motion
from ragg_runtime.signals.derivative import DEGREES, smooth_slope, steady_and_swing
from ragg_runtime.simulate import parse_turning, simulate_flight
from tests.layouts import sheets

LAYOUTS: dict[str, tuple[Callable[[], list[str]], int]] = {
    "two": (sheets.two, 2),
    "three": (sheets.three, 3),
    "complements": (sheets.complements, 8),
    "umbrella": (sheets.umbrella, 12),
    "vertical": (sheets.vertical, 4),
    "oblique": (sheets.oblique, 4),
    "odd": (sheets.odd, 4),
}


def instrument(name: str, head: str = "", size: float = 1.0) -> Instrument:
    discs, count = LAYOUTS[name]
    return parse_instrument(sheets.sheet(discs(), count, head, size=size))


def flown(i: Instrument, kinematics: str, rotations: str) -> Flight:
    exact = rotations == "exact"
    s = simulate(
        i,
        draw_motion(np.random.default_rng(3), 60.0),
        60.0,
        16.0,
        gravity=draw_gradient(np.random.default_rng(4)),
        rotations="exact" if exact else "first-order",
        kinematics="full" if kinematics == "full" else "platform",
        effects={} if exact else {"second-order-misalignment": {"kappa": 0.0}},
    )
    return s.flight(voltages=True)


def worst(i: Instrument, flight: Flight, inner: slice = slice(20, -20)) -> float:
    """Largest difference of any output, Eo; by default not at the ends, where the rate of a recorded angle is less sure."""
    model, _ = derive.derived((), (), i.form, i.layout)
    p = make_vector(model, i)
    found = []
    for k, o in enumerate(i.layout.outputs):
        r = record(flight, i, k)
        left = flight.outputs[o.name] - evaluate_output(model.chain, r, p, o)
        found.append(float(np.max(np.abs(left[inner]))) / scale_factor(model, p, k))
    return max(found)


@pytest.mark.parametrize(("name", "head", "kinematics", "rotations"), [
    *((n, sheets.EXACT, "full", "exact") for n in LAYOUTS),
    ("odd", "", "platform", "first-order"),
    ("umbrella", sheets.FULL, "full", "first-order"),
])  # fmt: skip
def test_derived_agrees_with_reference(name: str, head: str, kinematics: str, rotations: str) -> None:
    i = instrument(name, head)
    flight = flown(i, kinematics, rotations)
    size = max(float(np.std(flight.outputs[n])) for n in i.layout.output_names)
    gap = worst(i, flight)
    assert gap < 1e-4, gap  # rounding of a single accelerometer's volt is 1e-6 Eo and more
    assert size / (i.scale_factor * EOTVOS) > 1e3


SPINS = {"varies": "0.25,0.4@0.05@0.3", "reverses": "0,9@0.02", "backwards": "-0.25", "stands still": "0"}
LIMIT = 0.1
"""Eo, nominal: what issues promise of a noise-free simulated instrument of the model's own order."""


def of_paper() -> Instrument:
    discs = '[disc]\nradius = "0.1 m"\nspin_frequency = "0.25 Hz"\ng0 = "9.8 m/s^2"\n'
    return parse_instrument(sheets.sheet([discs], 4, sheets.EXACT).replace('g0 = "9.8 m/s^2"\n', "", 1))


@pytest.mark.parametrize(("layout", "spin"), [("paper", "varies"), *(("complements", n) for n in SPINS)])
def test_exact_model_of_full_kinematics_is_the_simulated_instrument(layout: str, spin: str) -> None:
    i = of_paper() if layout == "paper" else instrument(layout, sheets.EXACT)
    flight = simulate_flight(
        i, (), duration=60.0, noise=0.0, sheet_error=0.0, no_gradient=False, spin=[SPINS[spin]]
    )
    assert "spin_angle" in flight.channels
    assert worst(i, flight) < LIMIT
    steady = simulate_flight(i, (), duration=60.0, noise=0.0, sheet_error=0.0, no_gradient=False)
    name = i.layout.output_names[0]
    away = np.std(flight.outputs[name] - steady.outputs[name])
    assert away > 0.1 * np.std(steady.outputs[name])  # it does matter how the disc turns


@pytest.mark.parametrize(("five", "spin"), [
    (False, "0.25,0.1@0.1"), (False, "0.25,0.4@0.05,0.1@0.21"), (True, "0.25,0.3@0.1"),
])  # fmt: skip
def test_the_rate_of_a_clean_encoder_follows_a_fast_swing(five: bool, spin: str) -> None:
    """Of five accelerometers at unlike places the Euler force, R phi'', does not cancel: the ends of the record count as well."""
    places = zip((0.0, 70.0, 100.0, 200.0, 300.0), (1, 1, -1, 1, -1), strict=True)
    disc = sheets.disc("A", [sheets.accelerometer(f"A{k}", a, s) for k, (a, s) in enumerate(places)])
    i = parse_instrument(sheets.sheet([disc], 5, sheets.EXACT)) if five else of_paper()
    flight = simulate_flight(
        i, (), duration=120.0, noise=0.0, sheet_error=0.0, no_gradient=False, spin=[spin]
    )
    assert worst(i, flight, slice(None)) < LIMIT


@pytest.mark.parametrize("swing", [0.0, 0.1, 0.3])
@pytest.mark.parametrize(("encoder", "f"), [("16 bits", 0.2503), ("16 bits", 0.3), ("1 mrad", 0.25)])
def test_the_rate_of_a_coarse_encoder_is_as_smooth_as_it_was(encoder: str, f: float, swing: float) -> None:
    """Also of one whose steps come in time with the samples (0.3 Hz at 16 Hz): its rounding is no white noise."""
    t, step = np.arange(9600) / 16.0, 2 * np.pi / 2**16
    angle = 2 * np.pi * f * t + swing * np.sin(2 * np.pi * 0.1 * t)
    noisy = angle + 1e-3 * np.random.default_rng(1).standard_normal(t.size)
    read = noisy if encoder == "1 mrad" else step * np.round(angle / step)
    found, (_, swing_read) = measure_spin(np.mod(read, 2 * np.pi), t, 16.0), steady_and_swing(read)
    np.testing.assert_array_equal(found[SPIN[1]], smooth_slope(swing_read, 10, 2, DEGREES[0]) * 256.0)


def test_a_gap_in_the_encoder_stays_where_it_is() -> None:
    t = np.arange(400) / 16.0
    angle = np.mod(2 * np.pi * 0.25 * t, 2 * np.pi)
    angle[100:103] = np.nan
    rate = measure_spin(angle, t, 16.0)[SPIN[0]]
    assert np.array_equal(rate == 0.0, np.isnan(angle))
    assert rate[rate != 0.0] == pytest.approx(2 * np.pi * 0.25, abs=1e-9)


def test_each_disc_turns_as_it_is_told() -> None:
    i = instrument("umbrella", sheets.EXACT)
    flight = simulate_flight(
        i, (), duration=60.0, noise=0.0, sheet_error=0.0, no_gradient=False, spin=["A:0.2", "C:0,3@0.02"]
    )
    assert {"spin_angle_A", "spin_angle_C"} == {n for n in flight.channels if n.startswith("spin_angle")}
    found = np.unwrap(flight.channels["spin_angle_A"])
    assert found == pytest.approx(2 * np.pi * 0.2 * flight.time, abs=1e-12)
    assert flight.channels["spin_angle_C"] == pytest.approx(
        3 * np.sin(2 * np.pi * 0.02 * flight.time), abs=1e-12
    )
    assert worst(i, flight) < LIMIT


def test_the_encoder_of_a_record_is_flown(tmp_path: Path) -> None:
    i = instrument("complements", sheets.EXACT)
    first = simulate_flight(
        i, (), duration=60.0, noise=0.0, sheet_error=0.0, no_gradient=False, spin=[SPINS["varies"]]
    )
    write_flight(first, tmp_path / "first.csv")
    again = simulate_flight(
        i, (), noise=0.0, sheet_error=0.0, no_gradient=False, motion=tmp_path / "first.csv"
    )
    read = read_flight(tmp_path / "first.csv", i.g0, accelerometers=i.layout).channels["spin_angle"]
    np.testing.assert_allclose(again.time, first.time, atol=1e-9)  # as many samples
    gap = np.angle(np.exp(1j * (again.channels["spin_angle"] - read)))
    assert np.max(np.abs(gap)) < 1e-11
    assert worst(i, again) < LIMIT
    stated = parse_turning(["0.3"], i.layout, first)["A"]
    assert (stated.frequency, stated.recorded) == (0.3, None)  # what is asked for goes before


@pytest.mark.parametrize("text", ["", "a", "0.25,1", "0.25,1@-2", "nan", "0.25,1@2@3@4", "B:0.25"])
def test_what_is_no_turning_is_said(text: str) -> None:
    with pytest.raises(UserError, match="disc"):
        parse_turning([text], instrument("complements").layout)


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
    "spin-axis-wobble": 1e-4,
    "magnetic-bias": 1e-3,
    "near-mass": 1e-4,
    "anisoinertia": 1e-4,
    "arm-sag": 1e-3,
    "imu-misalignment": 1e-4,
}
"""Effects that know a direction, and the share of each that its own square and misalignment may leave."""


@cache
def leaning() -> Instrument:
    more = 'height = "0.03 m"\ndirection = [0.2, 0.9, 0.3]\n'
    places = [
        sheets.accelerometer("A1", 10.0, 1, "G_out", more),
        sheets.accelerometer("A2", 200.0, 1, "G_out", 'radius = "0.12 m"\n'),
        sheets.accelerometer("A3", 100.0, -1, "G_out", "direction = [0, -1, 0]\n"),
    ]
    head = '[model]\nkinematics = "full"\norder = { second_order_angles = true }\n'
    return parse_instrument(sheets.sheet([sheets.disc("A", places, (0.6, 0.48, 0.64))], 3, head))


def left(model: Model, flight: Flight, p: NDArray[np.float64]) -> float:
    """Rms of what a model leaves, Eo."""
    i = leaning()
    found = flight.outputs["G_out"] - evaluate_output(
        model.chain, record(flight, i, 0), p, i.layout.outputs[0]
    )
    k_ggi = scale_factor(base(), make_vector(base(), i))
    return float(np.std(found[20:-20])) / k_ggi


def base() -> Model:
    return derive.derived((), (), leaning().form, leaning().layout)[0]


@pytest.mark.parametrize("id_", WITH_DIRECTIONS)
def test_an_effect_of_a_direction_is_the_reference_s(id_: str) -> None:
    i = leaning()
    (effect,) = (e for e in catalogue() if e.id == id_)
    known, rng = units(i.g0), np.random.default_rng(1)
    values = {
        q.name: 3
        * q.plausible
        * find_unit_factor(q.unit, known)
        * rng.uniform(0.7, 1.3, 1 if q.shared else 3)
        for q in effect.parameters
    }
    s = simulate(
        i,
        draw_motion(np.random.default_rng(3), 30.0),
        30.0,
        16.0,
        gravity=draw_gradient(np.random.default_rng(4)),
        kinematics="full",
        effects={id_: {n: v if len(v) > 1 else float(v[0]) for n, v in values.items()}},
    )
    model, _ = derive.derived((effect,), (), i.form, i.layout)
    p, at = make_vector(model, i), 0
    given = {effect.symbol(q).name: values[q.name] for q in effect.parameters}
    for name, size in model.chain.PARAMETERS:
        p[at : at + size] = given.get(name, p[at : at + size])
        at += size
    flight = s.flight()
    without = left(base(), flight, make_vector(base(), i))
    assert without > 0.1
    assert left(model, flight, p) < max(WITH_DIRECTIONS[id_] * without, 1e-4)
