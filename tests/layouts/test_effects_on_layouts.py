"""Effects on a disc that leans, with heights and directions: the derived ones against the reference's."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.effects import catalogue
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.instrument.units import units
from ragg_runtime.io import Flight
from ragg_runtime.model import derive
from ragg_runtime.model.evaluate import output, scale_factor, unit_factor, vector
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import record
from ragg_runtime.reference import simulate
from ragg_runtime.reference.scenario import draw_gradient, draw_motion
from tests.layouts import sheets

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
    found = flight.outputs["G_out"] - output(model.chain, record(flight, i, 0), p, i.layout.outputs[0])
    k_ggi = scale_factor(base(), vector(base(), i))
    return float(np.std(found[20:-20])) / k_ggi


def base() -> Model:
    return derive.derived((), (), leaning().form, leaning().layout)[0]


@pytest.mark.parametrize("id_", WITH_DIRECTIONS)
def test_an_effect_of_a_direction_is_the_reference_s(id_: str) -> None:
    i = leaning()
    (effect,) = (e for e in catalogue() if e.id == id_)
    known, rng = units(i.g0), np.random.default_rng(1)
    values = {
        q.name: 3 * q.plausible * unit_factor(q.unit, known) * rng.uniform(0.7, 1.3, 1 if q.shared else 3)
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
    p, at = vector(model, i), 0
    given = {effect.symbol(q).name: values[q.name] for q in effect.parameters}
    for name, size in model.chain.PARAMETERS:
        p[at : at + size] = given.get(name, p[at : at + size])
        at += size
    flight = s.flight()
    without = left(base(), flight, vector(base(), i))
    assert without > 0.1
    assert left(model, flight, p) < max(WITH_DIRECTIONS[id_] * without, 1e-4)
