"""model.toml from its grammar: what is well formed is derived, compiled and run, in C and in NumPy, or is one message.

The bytes of an input are the seed of the sheet; a mutation of them is another sheet.
"""

from __future__ import annotations

import random
import shutil
import warnings
from functools import cache

import numpy as np

from derive.effects import catalogue
from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model_dir import derive

from .places import Outcome, shown

NAMES = (
    "f_i",
    "f_o",
    "f_p",
    "a_x",
    "omega_z",
    "d_a_y",
    "cos_phi",
    "sin_phi",
    "time",
    "temperature",
    "delta_phi",
)
FUNCTIONS = ("abs", "sin", "cos", "exp", "tanh", "sqrt", "sign")
UNITS = ("ug", "1", "1/K", "ug/g^2", "s", "1e-6 m/s^2", "rad", "ug/g^2/K")
DEEPEST = 4
SAMPLES = 40
LARGEST = 1e100
"""Beyond this a figure says nothing: rounding of C and of NumPy may differ by any amount in a difference of such terms."""

NUDGE = 1e-14
"""Relative change of the inputs, some fifty roundings, that a figure must survive to say anything: the sine of 1e16 does not."""


def sheet(data: bytes) -> str:
    """A model.toml, the same for the same bytes."""
    chance = random.Random(data)
    effects = chance.sample([e.id for e in _catalogue()], chance.choice((0, 0, 1, 1, 2)))
    listed = [f'"{i}"' for i in effects] + [_own(n, chance) for n in range(chance.choice((0, 1, 1, 2)))]
    order = chance.choice(
        ('"paper"', '"exact"', "{ mounting = 2, misalignment = 1, second_order_angles = true }")
    )
    lines = [
        f"effects = [{', '.join(listed)}]",
        "[model]",
        f'kinematics = "{chance.choice(("platform", "full"))}"',
        f"order = {order}",
        "[disc]",
        f'radius = "{chance.choice(("0.1 m", "10 cm", "1e-3 km"))}"',
        f'spin_frequency = "{chance.choice(("0.25 Hz", "15 rpm", "1e-3 Hz"))}"',
        'g0 = "9.8 m/s^2"',
        "[accelerometers]",
        'K1 = "10 mA/g"',
        'k_VI = "1e9 ohm"',
    ]
    for q in PARAMETERS:
        if q.name not in ("K1", "k_VI") and chance.random() < 0.5:
            value = chance.choice((0, 1.5, [1, -2, 3, 0.5], -1e3))
            lines.append(f'{q.name} = {{ value = {value}, unit = "{q.display_unit}" }}')
    return "\n".join(lines) + "\n"


def _own(number: int, chance: random.Random) -> str:
    parameters = [f"c{k}" for k in range(chance.choice((1, 1, 2)))]
    add = " + ".join(f"{p}*({_expression(chance)})" for p in parameters)
    beside = ", ".join(
        f'{p} = {{ value = {chance.choice((0, 1e-3, -2.0))}, unit = "{chance.choice(UNITS)}" }}'
        for p in parameters
    )
    return f'{{ id = "own-{number}", stage = "transducer", add = "{add}", {beside} }}'


def _expression(chance: random.Random, depth: int = 0) -> str:
    kind = 9 if depth >= DEEPEST else chance.randrange(10)
    if kind <= 3:
        left, right = _expression(chance, depth + 1), _expression(chance, depth + 1)
        return f"({left} {chance.choice('+-*/')} {right})"
    if kind == 4:
        return f"({_expression(chance, depth + 1)})**{chance.choice((2, 2, 3, 8))}"
    if kind == 5:
        return f"{chance.choice(FUNCTIONS)}({_expression(chance, depth + 1)})"
    if kind == 6:
        return f"-({_expression(chance, depth + 1)})"
    if kind == 7:
        return chance.choice(("1", "0.5", "1e-9", "3", "1e9"))
    return chance.choice(NAMES)


def generated_model(data: bytes) -> Outcome:
    """A sheet from the grammar: derived, compiled, run; C gives what NumPy gives."""
    try:
        instrument = parse_instrument(sheet(data))
        model = derive.without_signatures(instrument, instrument.form)
        p = vector(model, instrument)
    except UserError as error:
        return shown(error)
    draw = np.random.default_rng(1)
    t = 0.137 + 0.1171 * np.arange(
        SAMPLES
    )  # off the poles that formulas have where sin(phi) or cos(phi) is 0
    inputs = 0.1 * draw.standard_normal((len(model.chain.INPUTS), SAMPLES))
    beside = inputs * (1.0 + NUDGE * draw.standard_normal(inputs.shape))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of NumPy: 1/0 and the like are the user's formula
        numpy, nudged = (model.compiled("numpy").voltages(t, x, p) for x in (inputs, beside))
    assert numpy.shape == (4, SAMPLES)
    if shutil.which("cc"):
        c = model.compiled("c").voltages(t, inputs, p)
        usual = np.isfinite(numpy) & (np.abs(numpy) < LARGEST)
        assert np.array_equal(np.isfinite(c[usual]), np.ones(usual.sum(), dtype=bool))
        near = {"rtol": 1e-6, "atol": 1e-9 * np.max(np.abs(numpy[usual]), initial=1.0)}
        usual &= np.isclose(nudged, numpy, **near)
        np.testing.assert_allclose(c[usual], numpy[usual], **near)
    return "read"


@cache
def _catalogue() -> tuple[derive.SymbolicEffect, ...]:
    return catalogue()
