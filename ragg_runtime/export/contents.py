"""What is exported of a model: its parameters, its inputs and a short motion with the model's answer to it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.flight.record import ANGULAR_ACCELERATION, ANGULAR_RATE, SI_UNITS
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import DISC_UNITS, PARAMETER
from ragg_runtime.instrument.units import units
from ragg_runtime.model.evaluate import EOTVOS
from ragg_runtime.model.model import Chain, Model
from ragg_runtime.model.record import GRADIENTS, Record

Array = NDArray[np.float64]

_DERIVATIVE = re.compile(r"d(?P<order>2?)_(?P<of>.+)")

ROWS, RATE = 400, 16.0
"""Samples and rate, Hz, of the motion that goes with an export."""


@dataclass(frozen=True)
class Value:
    """A parameter of the model's chain with its places in the parameter vector; SI."""

    name: str
    unit: str
    meaning: str
    values: Array


@dataclass(frozen=True)
class Input:
    """A series that the model reads: a column of the flight, or a time derivative of one."""

    name: str
    column: str
    derivative: int


@dataclass(frozen=True)
class Contents:
    """A model with its values.

    Attributes
    ----------
    name
        Of the model.
    model, instrument
        As loaded.
    p
        (size,) SI.
    sources
        The model in C, header and source: file name -> text.
    module
        The model's chain in NumPy, as derived.
    origin
        Where the values come from, in a sentence.
    information
        (n, n) square root of the calibration's information, in the scales of the fitted parameters; ``None``: none.
    calibration
        What was saved of the calibration; ``None``: the values are those of model.toml.
    """

    name: str
    model: Model
    instrument: Instrument
    p: Array
    sources: Mapping[str, str]
    module: str
    origin: str
    information: Array | None
    calibration: Mapping[str, Any] | None

    @property
    def chain(self) -> Chain:
        return self.model.chain

    @property
    def scale_factor(self) -> float:
        """k_ggi, V/Eo."""
        values = {v.name: v.values for v in self.values()}
        return float(np.sum(values["k_VI"] * values["K1"] * (values["radius"] + values["dR"]))) * EOTVOS

    def values(self) -> list[Value]:
        """The parameters in the order of the vector."""
        known = units(self.instrument.g0)
        effects = {
            q.symbol: (known.base_unit(q.unit), f"{e.id}: {q.meaning}")
            for e in self.model.effects
            for q in e.parameters
        }
        found, start = [], 0
        for name, size in self.chain.PARAMETERS:
            if name in effects:
                unit, meaning = effects[name]
            elif name in PARAMETER:
                unit, meaning = PARAMETER[name].si_unit, PARAMETER[name].description
            else:
                unit, meaning = DISC_UNITS[name], "of the disc"
            found.append(Value(name=name, unit=unit, meaning=meaning, values=self.p[start : start + size]))
            start += size
        return found

    def inputs(self) -> list[Input]:
        """The series that the model reads, in order."""
        found = []
        for name in self.chain.INPUTS:
            match = None if name in SI_UNITS else _DERIVATIVE.fullmatch(name)
            if match is None:
                found.append(Input(name=name, column=name, derivative=0))
            else:
                found.append(Input(name=name, column=match["of"], derivative=int(match["order"] or 1)))
        return found

    def columns(self) -> list[str]:
        """The columns of a flight that the model reads, beside ``time`` and ``spin_angle``."""
        found = dict.fromkeys(x.column for x in self.inputs())
        for change, rate in zip(ANGULAR_ACCELERATION, ANGULAR_RATE, strict=True):
            if change in found:  # where it is not recorded it is derived
                found.setdefault(rate)
        return list(found)

    def example(self) -> tuple[dict[str, Array], Array]:
        """Columns (name -> (N,), SI) of a lively motion, ``time`` first, and G_out (N,), V, that the model makes of it."""
        t = np.arange(ROWS) / RATE
        rng = np.random.default_rng(0)
        columns: dict[str, Array] = {"time": t}
        for name in self.columns():
            mean, size = _SIZES.get(name.partition("_")[0], (0.1, 1.0))
            f, phase = rng.uniform(0.05, 1.0), rng.uniform(0.0, 2 * np.pi)
            columns[name] = mean + size * np.sin(2 * np.pi * f * t + phase)
            if name in ANGULAR_RATE and (change := f"omegadot{name[5:]}") in self.columns():
                columns[change] = size * 2 * np.pi * f * np.cos(2 * np.pi * f * t + phase)
        record = Record(
            time=t,
            wide={n: x for n, x in columns.items() if n != "time"},
            rate=RATE,
            valid=np.ones(ROWS, dtype=np.bool_),
            spin_frequency=float(self.p[1]),
        )
        evaluator = self.model.compiled("numpy")
        return columns, evaluator.output(t, record.inputs(self.chain), self.p, record.phi)


_SIZES: Mapping[str, tuple[float, float]] = {
    "a": (0.1, 0.15),
    "omega": (5e-4, 7e-4),
    "Gamma": (1e-7, 5e-8),
    "temperature": (293.0, 2.0),
    "pressure": (9e4, 1e3),
    "B": (2e-5, 1e-5),
    "roll": (0.02, 0.05),
    "pitch": (-0.01, 0.05),
}
"""Mean and amplitude of the channels of an example, SI."""


def unit_of(column: str) -> str:
    """SI unit of a column, for one of no fixed meaning ``1``."""
    return SI_UNITS.get(column, "1")


def is_gradient(column: str) -> bool:
    """Whether a column is a gravity gradient: zero where it is not recorded."""
    return column in GRADIENTS
