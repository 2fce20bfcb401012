"""Derived models of other layouts against the numerical reference, which shares no equation with them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.io import Flight
from ragg_runtime.model import derive
from ragg_runtime.model.evaluate import output, scale_factor, vector
from ragg_runtime.model.record import record
from ragg_runtime.reference import simulate
from ragg_runtime.reference.scenario import draw_gradient, draw_motion
from tests.layouts import sheets

LAYOUTS: dict[str, tuple[Callable[[], list[str]], int]] = {
    "two": (sheets.two, 2),
    "three": (sheets.three, 3),
    "complements": (sheets.complements, 8),
    "umbrella": (sheets.umbrella, 12),
    "vertical": (sheets.vertical, 4),
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
    p = vector(model, i)
    found = []
    for k, o in enumerate(i.layout.outputs):
        r = record(flight, i, k)
        left = flight.outputs[o.name] - output(model.chain, r, p, o)
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


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('spin_frequency = "0.25 Hz"', 'spin_frequency = "0 Hz"'),
        ("sign = -1\n", 'sign = -1\nradius = "0.11 m"\n'),
    ],
    ids=["still", "radii"],
)
def test_the_papers_four_standing_still_or_at_other_radii_are_a_layout_of_their_own(
    old: str, new: str
) -> None:
    i = parse_instrument(sheets.sheet([sheets.disc("A", sheets.four("A", "G_out"))], 4).replace(old, new))
    assert worst(i, flown(i, "platform", "first-order")) < 1e-4
