"""Two flights of one instrument, and what is true of them."""

from __future__ import annotations

import dataclasses
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.diagnosis.plan import model_text
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.reference.scenario import draw_gradient, draw_motion, scenario
from ragg_runtime.signals.demodulators import Demodulator
from tests.runtime.commands import ragg
from tests.simulated import RATE

DURATION = 900.0
"""s"""
WHOLE = slice(None)
BRIEF = slice(0, 2000)
"""A quarter of an hour tells statistics; what is about files and figures in them needs four minutes."""


@cache
def flights(changed: float = 0.0) -> tuple[Flight, Flight]:
    """With a gradient that varies by 50 Eo; before the second the scale factor of A1 has changed by this share."""
    s = scenario(7, duration=DURATION, rate=RATE, gradient_rms=50e-9)
    K1 = s.instrument.accelerometers["K1"] * (1 + changed * np.array([1.0, 0.0, 0.0, 0.0]))
    other = dataclasses.replace(
        s,
        motion=draw_motion(np.random.default_rng(71), DURATION),
        gravity=draw_gradient(np.random.default_rng(72), 50e-9),
        instrument=s.instrument.replace(K1=K1),
        seed=73,
    )
    return s.simulate({}).flight("one"), other.simulate({}).flight("two")


def new_model(folder: Path) -> Path:
    """A model directory with the sheet of these flights' instrument."""
    (folder / "sheet.toml").write_text(model_text(scenario(7, duration=DURATION, rate=RATE).sheet))
    run("new", folder / "m", "--from", folder / "sheet.toml")
    return folder / "m"


def files(folder: Path, changed: float = 0.0, rows: slice = WHOLE) -> tuple[Path, Path]:
    """The flights as files, or some of their rows."""
    one, two = (x.part(rows) for x in flights(changed))
    places = folder / "one.parquet", folder / "two.parquet"
    write_flight(one, places[0])
    write_flight(two, places[1])
    return places


def run(*arguments: object) -> str:
    """A command; what it says on stdout."""
    done = ragg(*arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


def truth(x: Flight, d: Demodulator) -> NDArray[np.complex128]:
    """inline + i cross, Eo, that was flown over, as a demodulator lets it through."""
    c = x.channels
    g = (c["Gamma_xx"] - c["Gamma_yy"]) + 1j * c["Gamma_xy"]
    return np.asarray(d.low_pass(g / 1e-9))
