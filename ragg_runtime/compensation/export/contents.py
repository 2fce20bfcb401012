"""What is exported of a model: its parameters, its inputs and a short motion with the model's answer to it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import column_endings, gain, sees
from ragg_runtime.instrument.parameters import DISC_UNITS, PARAMETER
from ragg_runtime.instrument.units import units
from ragg_runtime.io.angular_acceleration import Derivative
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, GRADIENT, SI_UNITS, is_disc_angle
from ragg_runtime.model.chain import Chain
from ragg_runtime.model.evaluate import named, scale_factor
from ragg_runtime.model.lateness import late
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import SPIN, Record, phase

Array = NDArray[np.float64]

_DERIVATIVE = re.compile(r"d(?P<order>2?)_(?P<of>.+)")

ROWS, RATE = 400, 16.0
"""Samples and rate, Hz, of the motions that go with an export."""

DISC = "disc"
"""Stands for the column of an input that is the angle of the output's own disc."""


@dataclass(frozen=True)
class Value:
    """A parameter of the model's chain with its places in the parameter vector; SI."""

    name: str
    unit: str
    meaning: str
    values: Array


@dataclass(frozen=True)
class Input:
    """A series that the model reads: a column of the flight, or a time derivative of one; of :data:`DISC` there is one a disc."""

    name: str
    column: str
    derivative: int


@dataclass(frozen=True)
class Out:
    """An output of the model.

    ``formula``: what it is of the voltages. ``members``: its accelerometers, counted from 0, ``signs`` how each counts.
    ``spin``: place of the disc's rate in the parameter vector. ``scale_factor``: k_ggi, V/Eo. ``phase``, rad: a
    gradient shows as k_ggi (inline/2 sin(2 phi + phase) - cross cos(2 phi + phase)). ``sees``: whether it sees a
    gradient, on a disc that turns. ``ending``: of its columns among what is found.
    """

    name: str
    formula: str
    members: tuple[int, ...]
    signs: tuple[int, ...]
    angle_column: str
    spin: int
    scale_factor: float
    phase: float
    sees: bool
    ending: str


@dataclass(frozen=True)
class Contents:
    """A model with its values.

    ``p`` (size,) SI. ``sources``: the model in C, file name -> text; ``module``: its chain in NumPy. ``origin``: where
    the values come from. ``information`` (n, n): square root of the calibration's, in the scales of the fitted
    parameters; ``None``: none.
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

    def outputs(self) -> tuple[Out, ...]:
        """In the order of model.toml."""
        layout, values = self.instrument.layout, named(self.chain, self.p)
        k1, R = values["k_VI"] * values["K1"], values["radius"] + values["dR"]
        endings = dict(zip(layout.output_names, column_endings(layout.output_names), strict=True))
        return tuple(
            Out(
                name=o.name,
                formula=layout.formula(o, [layout.voltage_columns(j)[0] for j in o.members]),
                members=o.members,
                signs=o.signs,
                angle_column=layout.discs[o.disc].angle_column,
                spin=1 if layout.like_paper else layout.size + o.members[0],
                scale_factor=scale_factor(self.model, self.p, k),
                phase=phase(gain(o, k1, R)),
                sees=sees(o, k1, R) and layout.discs[o.disc].spin_frequency != 0.0,
                ending=endings[o.name],
            )
            for k, o in enumerate(layout.outputs)
        )

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
            if name in SPIN:
                found.append(Input(name=name, column=DISC, derivative=1 + SPIN.index(name)))
            elif match is None:
                found.append(Input(name=name, column=name, derivative=0))
            else:
                found.append(Input(name=name, column=match["of"], derivative=int(match["order"] or 1)))
        return found

    def angles(self) -> list[str]:
        """The columns of disc angles."""
        return list(dict.fromkeys(o.angle_column for o in self.outputs()))

    def columns(self) -> list[str]:
        """The columns of a flight that the model reads, beside ``time`` and the disc angles."""
        return list(dict.fromkeys(x.column for x in self.inputs() if x.column != DISC))

    def limits(self) -> list[str]:
        """What is described less well than by Python, in words."""
        return [
            f"{q.symbol} makes motion late: a series of second order in it, good while it is far below the time scale of the "
            "motion (ragg itself takes the motion from where it stands in the record)"
            for k, q in late(self.model)
            if self.p[k]
        ]

    def example(self, *, derived: bool = False) -> tuple[dict[str, Array], dict[str, Array]]:
        """Columns (name -> (N,), SI) of a lively motion, ``time`` first, and the outputs (N,), V, that the model makes of it."""
        t = np.arange(ROWS) / RATE
        rng = np.random.default_rng(0)
        columns: dict[str, Array] = {"time": t}
        for name in self.columns():
            if name in columns:
                continue
            mean, size = _SIZES.get(name.partition("_")[0], (0.1, 1.0))
            f, angle = rng.uniform(0.05, 1.0), rng.uniform(0.0, 2 * np.pi)
            columns[name] = mean + size * np.sin(2 * np.pi * f * t + angle)
            if name in ANGULAR_RATE and (change := f"omegadot{name[5:]}") in self.columns():
                columns[change] = size * 2 * np.pi * f * np.cos(2 * np.pi * f * t + angle)
        if derived:
            columns = {n: x for n, x in columns.items() if n not in ANGULAR_ACCELERATION}
            spins = {o.angle_column: float(self.p[o.spin]) for o in self.outputs()}
            columns |= {
                n: np.mod(2 * np.pi * f * t + 1e-3 * np.sin(0.7 * t), 2 * np.pi) for n, f in spins.items()
            }
        return columns, self._answers(columns)

    def _answers(self, columns: Mapping[str, Array]) -> dict[str, Array]:
        t, wide = columns["time"], {n: x for n, x in columns.items() if n != "time"}
        for name, rate in zip(ANGULAR_ACCELERATION, ANGULAR_RATE, strict=True):
            if name not in wide and rate in wide:
                wide[name] = Derivative().of(wide[rate], RATE)[0]
        # by the form that is exported
        model = self.model if "folded.c" in self.sources else replace(self.model, folded=None)
        evaluator, found = model.compiled("numpy"), {}
        for k, o in enumerate(self.outputs()):
            record = Record(
                time=t,
                wide=wide,
                rate=RATE,
                valid=np.ones(len(t), dtype=np.bool_),
                spin_frequency=float(self.p[o.spin]),
                angle_column=o.angle_column,
            )
            found[o.name] = evaluator.output(t, record.inputs(self.chain), self.p, record.phi, which=k)
        return found


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
    return SI_UNITS.get(column, "rad" if column == DISC or is_disc_angle(column) else "1")


def is_gradient(column: str) -> bool:
    """Whether a column is a gravity gradient: zero where it is not recorded."""
    return column in GRADIENT
